//! Meshes as PLY, binary, little endian.

use antumbra::scene::{Mesh, MeshId};
use antumbra_math::Rgb;

use super::Writer;

/// What tells the files of meshes apart: the mesh, its set of texture coordinates, and the factor of its colours.
pub(super) type Key = (MeshId, u8, Option<[u32; 3]>);

impl Writer<'_, '_> {
    /// The file of a mesh with one of its sets of texture coordinates, and with its colours times a factor.
    pub(super) fn ply(&mut self, id: MeshId, set: u8, tint: Option<Rgb>) -> String {
        let key = (id, set, tint.map(|c| c.0.map(f32::to_bits)));
        if let Some(known) = self.meshes.get(&key) {
            return known.clone();
        }
        let mesh = self.job.mesh(id);
        let name = if mesh.name.is_empty() { "mesh" } else { &mesh.name };
        let file = self.file(name, "ply", bytes(mesh, set, tint));
        self.meshes.insert(key, file.clone());
        file
    }
}

/// The bytes of the file. Colours are an attribute that Mitsuba calls `vertex_color`.
pub(super) fn bytes(mesh: &Mesh, set: u8, tint: Option<Rgb>) -> Vec<u8> {
    let (vertices, triangles) = (&mesh.triangles.vertices, &mesh.triangles.indices);
    let uvs = mesh.uvs.get(usize::from(set)).and_then(Option::as_ref);
    let colors = mesh.colors.as_ref().zip(tint);
    let mut header = format!("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", vertices.len());
    let columns = [
        (true, &["x", "y", "z"][..]),
        (mesh.normals.is_some(), &["nx", "ny", "nz"]),
        (uvs.is_some(), &["s", "t"]),
        (colors.is_some(), &["color_0", "color_1", "color_2"]),
    ];
    for name in columns.iter().filter(|c| c.0).flat_map(|c| c.1) {
        header.push_str(&format!("property float {name}\n"));
    }
    header.push_str(&format!("element face {}\n", triangles.len()));
    header.push_str("property list uchar int vertex_indices\nend_header\n");
    let mut bytes = header.into_bytes();
    let mut put = |numbers: &[f32]| bytes.extend_from_slice(bytemuck::cast_slice(numbers));
    for (i, vertex) in vertices.iter().enumerate() {
        put(vertex);
        mesh.normals.iter().for_each(|n| put(&n[i]));
        uvs.iter().for_each(|uv| put(&uv[i]));
        colors.iter().for_each(|(c, Rgb([r, g, b]))| put(&[c[i][0] * r, c[i][1] * g, c[i][2] * b]));
    }
    for triangle in triangles {
        bytes.push(3);
        bytes.extend_from_slice(bytemuck::cast_slice(triangle));
    }
    bytes
}
