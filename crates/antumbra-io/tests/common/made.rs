//! Small glTF files made in tests.

#![allow(dead_code, reason = "each test file uses its part")]

use std::collections::HashMap;

use antumbra::scene::SceneBuilder;
use antumbra_io::{Format, MemoryFiles, ReadError, ReadOptions, read_with};

/// Lists of numbers that become buffer views and accessors.
#[derive(Default)]
pub struct Made {
    pub bytes: Vec<u8>,
    pub views: Vec<String>,
    pub accessors: Vec<String>,
}

impl Made {
    /// Adds a view with its accessor; the index of both.
    pub fn add(&mut self, component: u32, kind: &str, count: usize, more: &str, bytes: &[u8]) -> usize {
        let (offset, length) = (self.bytes.len(), bytes.len());
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = self.views.len();
        self.views.push(format!(r#"{{"buffer":0,"byteOffset":{offset},"byteLength":{length}}}"#));
        self.accessors.push(format!(
            r#"{{"bufferView":{view},"componentType":{component},"type":"{kind}","count":{count}{more}}}"#
        ));
        view
    }

    /// Adds floats.
    pub fn floats(&mut self, kind: &str, lanes: usize, numbers: &[f32]) -> usize {
        let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes()).collect();
        self.add(5126, kind, numbers.len() / lanes, "", &bytes)
    }

    /// Reads the document that `rest` completes.
    pub fn read(&self, rest: &str) -> Result<SceneBuilder, ReadError> {
        self.read_with(rest, &ReadOptions::default())
    }

    /// The same with options.
    pub fn read_with(&self, rest: &str, options: &ReadOptions) -> Result<SceneBuilder, ReadError> {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"buffers":[{{"uri":"a%20b.bin","byteLength":{}}}],
            "bufferViews":[{}],"accessors":[{}],{rest}}}"#,
            self.bytes.len(),
            self.views.join(","),
            self.accessors.join(",")
        );
        let files = MemoryFiles(HashMap::from([("a b.bin".into(), self.bytes.clone())]));
        read_with(Format::Gltf, json.as_bytes(), &files, options)
    }
}

/// Three corners.
pub const TRIANGLE: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
/// One node with mesh 0.
pub const ONE_NODE: &str = r#""scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"#;
/// Mesh 0 of the first accessor.
pub const PLAIN: &str = r#""meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]"#;

/// Equal to 10⁻⁶: single precision after a few steps.
pub fn close(a: [f32; 3], b: [f32; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6)
}

/// A white PNG of one pixel.
pub const PIXEL: &str =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8/5+hHgAHggJ/PchI7wAAAABJRU5ErkJggg==";
