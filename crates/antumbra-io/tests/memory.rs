//! A scene that would take more memory than it may is refused by its announced counts.

use antumbra_io::{Format, Limits, MemoryFiles, ReadError, read};

/// What is said of a file where `memory` bytes may be taken.
fn told(format: Format, bytes: &[u8], memory: u64) -> Option<ReadError> {
    let limits = Limits { memory: Some(memory), ..Limits::default() };
    read(format, bytes, &MemoryFiles::default(), &limits).err()
}

/// An STL of `n` triangles.
fn stl(n: u32) -> Vec<u8> {
    let triangle = [0.0f32, 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 0.].map(f32::to_le_bytes).concat();
    let record = [&triangle[..], &[0, 0]].concat();
    [&[0; 80][..], &n.to_le_bytes(), &record.repeat(n as usize)].concat()
}

/// A triangle takes 48 bytes and 128 for its tree.
#[test]
fn stl_is_refused_above_its_forecast() {
    let bytes = stl(1000);
    assert_eq!(told(Format::Stl, &bytes, 176_000), None);
    let error = told(Format::Stl, &bytes, 175_999).expect("a byte is missing");
    assert!(error.what.contains("171.9 KiB") && error.what.contains("1000 triangles"), "{error}");
    assert!(!error.hint.is_empty());
}

/// The header is enough: what follows is broken, and is not looked at.
#[test]
fn ply_is_refused_by_its_header() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 3\nproperty list uchar int vertex_indices\nend_header\n";
    let bytes = [header, &"no number ".repeat(20)].concat().into_bytes();
    let said = |memory| told(Format::Ply, &bytes, memory).map(|e| e.what).unwrap_or_default();
    assert!(said(400).contains("of memory"), "{}", said(400));
    assert!(!said(1 << 20).contains("of memory"), "{}", said(1 << 20));
}

/// The accessors are enough: their buffer is not even there.
#[test]
fn gltf_is_refused_by_its_accessors() {
    let text = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]},{"primitives":[{"attributes":{"POSITION":2}}]}],
        "accessors":[{"componentType":5126,"type":"VEC3","count":1000},{"componentType":5125,"type":"SCALAR","count":3000},
        {"componentType":5126,"type":"VEC3","count":9000000000000000000}],
        "buffers":[{"uri":"missing.bin","byteLength":24000}]}"#;
    let said = |memory| told(Format::Gltf, text.as_bytes(), memory).map(|e| e.what).unwrap_or_default();
    // 1000 triangles, their corners, and the tree; the second mesh is not shown.
    assert!(said(151_999).contains("1000 triangles"), "{}", said(151_999));
    assert!(!said(152_000).contains("of memory"), "{}", said(152_000));
}

/// Text formats are held against the limit when they are read, before the tree is built.
#[test]
fn obj_is_refused_before_its_tree() {
    let text = ["v 0 0 0\nv 1 0 0\nv 0 1 0\n", &"f 1 2 3\n".repeat(1000)].concat();
    assert_eq!(told(Format::Obj, text.as_bytes(), 200_000), None);
    assert!(told(Format::Obj, text.as_bytes(), 100_000).is_some());
}
