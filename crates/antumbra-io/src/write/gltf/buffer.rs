//! The buffer with its views and accessors.

use serde_json::{Value, json};

use super::numbers;

const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const ARRAY: u32 = 34962;
const ELEMENTS: u32 = 34963;

/// Numbers of meshes and bytes of pictures, each view at a multiple of four bytes.
#[derive(Default)]
pub(super) struct Buffer {
    pub bytes: Vec<u8>,
    pub views: Vec<Value>,
    pub accessors: Vec<Value>,
}

impl Buffer {
    /// A view of bytes that are no vertices.
    pub(super) fn view(&mut self, bytes: &[u8]) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}));
        self.views.len() - 1
    }

    /// Vectors of floats, one a vertex; `bounds`: with least and largest, as positions need.
    pub(super) fn vectors<const N: usize>(&mut self, values: &[[f32; N]], bounds: bool) -> usize {
        let view = self.view(bytemuck::cast_slice(values.as_flattened()));
        self.views[view]["target"] = json!(ARRAY);
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        let mut accessor =
            json!({"bufferView": view, "componentType": FLOAT, "count": values.len(), "type": kind});
        if bounds {
            let fold = |start: f32, pick: fn(f32, f32) -> f32| {
                values.iter().fold([start; N], |m, v| std::array::from_fn(|i| pick(m[i], v[i])))
            };
            accessor["min"] = numbers(fold(f32::INFINITY, f32::min));
            accessor["max"] = numbers(fold(f32::NEG_INFINITY, f32::max));
        }
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Triangles of vertices, of which there are `vertices`.
    pub(super) fn indices(&mut self, triangles: &[[u32; 3]], vertices: usize) -> usize {
        let flat = triangles.as_flattened();
        // The largest number of a width is not allowed.
        let (view, kind) = if vertices <= usize::from(u16::MAX) {
            let short: Vec<u16> = flat.iter().map(|i| *i as u16).collect();
            (self.view(bytemuck::cast_slice(&short)), UNSIGNED_SHORT)
        } else {
            (self.view(bytemuck::cast_slice(flat)), UNSIGNED_INT)
        };
        self.views[view]["target"] = json!(ELEMENTS);
        let count = flat.len();
        self.accessors
            .push(json!({"bufferView": view, "componentType": kind, "count": count, "type": "SCALAR"}));
        self.accessors.len() - 1
    }
}
