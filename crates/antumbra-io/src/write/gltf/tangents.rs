//! Tangents of corners as those of vertices, which is what the format has.

use std::collections::HashMap;

use antumbra::scene::{Mesh, Tangents};
use antumbra_trace::Triangles;

/// The mesh with a vertex for each tangent that its corners have, and the tangents of its vertices.
pub(super) fn split(mesh: &Mesh, tangents: &Tangents) -> (Mesh, Vec<[f32; 4]>) {
    if let Some(values) = tangents.per_vertex() {
        return (mesh.clone(), values.to_vec());
    }
    let indices = &mesh.triangles.indices;
    let (mut known, mut of, mut values) = (HashMap::new(), Vec::new(), Vec::new());
    let mut corner = |vertex: u32, tangent: [f32; 4]| {
        *known.entry((vertex, tangent.map(f32::to_bits))).or_insert_with(|| {
            of.push(vertex as usize);
            values.push(tangent);
            of.len() as u32 - 1
        })
    };
    let triangle = |(i, t): (usize, &[u32; 3])| {
        let tangents = tangents.corners(indices, i as u32);
        [0, 1, 2].map(|k| corner(t[k], tangents[k]))
    };
    let indices = indices.iter().enumerate().map(triangle).collect();
    let three = |all: &[[f32; 3]]| of.iter().map(|v| all[*v]).collect();
    let split = Mesh {
        name: mesh.name.clone(),
        triangles: Triangles { vertices: three(&mesh.triangles.vertices), indices },
        normals: mesh.normals.as_deref().map(three),
        uvs: mesh.uvs.each_ref().map(|uvs| uvs.as_ref().map(|uvs| of.iter().map(|v| uvs[*v]).collect())),
        tangents: None,
        colors: mesh.colors.as_ref().map(|colors| of.iter().map(|v| colors[*v]).collect()),
    };
    (split, values)
}
