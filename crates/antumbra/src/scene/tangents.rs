//! Tangents of a mesh: where u grows over its surface, for normal maps and for facets of two widths.

use antumbra_math::{Vec3, real};
use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};

use super::Mesh;

/// Direction of growing u and the handedness w = ±1 of (tangent, bitangent, normal): bitangent = w · normal × tangent,
/// which runs up in the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Tangents {
    values: Vec<[f32; 4]>,
    /// One for each corner of each triangle; else one for each vertex.
    of_corners: bool,
}

impl Tangents {
    /// One a vertex, as a file gives them.
    pub fn of_vertices(values: Vec<[f32; 4]>) -> Tangents {
        Tangents { values, of_corners: false }
    }

    /// As MikkTSpace makes them from positions, normals and texture coordinates (set `set`; `downwards`: v grows towards
    /// the bottom of the picture). `None` without texture coordinates.
    pub fn made(mesh: &Mesh, set: usize, downwards: bool) -> Option<Tangents> {
        let uvs = mesh.uvs.get(set)?.as_deref()?;
        let values = vec![[1.0, 0.0, 0.0, 1.0]; 3 * mesh.triangles.indices.len()];
        let mut making = Making { mesh, uvs, downwards, values };
        // The crate's error has no case.
        generate_tangents(&mut making).ok()?;
        Some(Tangents { values: making.values, of_corners: true })
    }

    /// Those of the three corners of triangle `local`.
    #[inline]
    pub(super) fn corners(&self, indices: &[[u32; 3]], local: u32) -> [[f32; 4]; 3] {
        if self.of_corners {
            [0, 1, 2].map(|k| self.values[3 * local as usize + k])
        } else {
            indices[local as usize].map(|v| self.values[v as usize])
        }
    }

    /// All their numbers, in a row.
    pub(super) fn numbers(&self) -> &[f32] {
        self.values.as_flattened()
    }

    /// The number of vertices that they are for, if they are for vertices.
    pub(super) fn vertices(&self) -> Option<usize> {
        (!self.of_corners).then_some(self.values.len())
    }

    /// Each through `f`; `turned`: the second and third corner of each triangle change places.
    pub(super) fn moved(mut self, f: impl Fn([f32; 4]) -> [f32; 4], turned: bool) -> Tangents {
        self.values.iter_mut().for_each(|t| *t = f(*t));
        if turned && self.of_corners {
            self.values.chunks_exact_mut(3).for_each(|t| t.swap(1, 2));
        }
        self
    }
}

/// A mesh as MikkTSpace asks for it, and what it answers.
struct Making<'a> {
    mesh: &'a Mesh,
    uvs: &'a [[f32; 2]],
    downwards: bool,
    values: Vec<[f32; 4]>,
}

impl Making<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.mesh.triangles.indices[face][corner] as usize
    }
}

/// Roots and arcs with the same bits on every platform.
struct SameBits;

impl Ops for SameBits {
    fn sqrt(x: f32) -> f32 {
        x.sqrt()
    }

    fn acos(x: f32) -> f32 {
        real::acos(f64::from(x)) as f32
    }
}

impl Geometry<SameBits> for Making<'_> {
    fn num_faces(&self) -> usize {
        self.mesh.triangles.indices.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.mesh.triangles.vertices[self.vertex(face, corner)]
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        match &self.mesh.normals {
            Some(normals) => Vec3::from(normals[self.vertex(face, corner)]).normalize_or_zero().to_array(),
            None => {
                let [a, b, c] = self.mesh.triangles.corners(face).map(Vec3::from);
                (b - a).cross(c - a).normalize_or_zero().to_array()
            }
        }
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        let [u, v] = self.uvs[self.vertex(face, corner)];
        [u, if self.downwards { 1.0 - v } else { v }]
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        if let Some(space) = space {
            self.values[3 * face + corner] = space.tangent_encoded();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_trace::Triangles;

    /// A square that faces +z, u along +x; `up`: v along +y.
    fn square(up: bool, mirrored: bool) -> Mesh {
        let vertices = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let uv = |v: &[f32; 3]| [if mirrored { -v[0] } else { v[0] }, if up { v[1] } else { 1.0 - v[1] }];
        let uvs = [Some(vertices.iter().map(uv).collect()), None];
        let triangles = Triangles { vertices, indices: vec![[0, 1, 2], [0, 2, 3]] };
        Mesh { triangles, uvs, ..Mesh::default() }
    }

    #[test]
    fn the_bitangent_runs_up_in_the_picture() {
        // v downwards from the top of the square (glTF), or upwards (OBJ): w · n × t = +y either way.
        for downwards in [true, false] {
            let made = Tangents::made(&square(!downwards, false), 0, downwards).unwrap();
            for corner in made.corners(&[], 1) {
                assert_eq!(corner, [1.0, 0.0, 0.0, 1.0]);
            }
            // u to the left: t = −x, and the bitangent is still +y.
            let made = Tangents::made(&square(!downwards, true), 0, downwards).unwrap();
            assert_eq!(made.corners(&[], 0)[2], [-1.0, 0.0, 0.0, -1.0]);
        }
    }

    #[test]
    fn nothing_without_coordinates() {
        assert!(Tangents::made(&Mesh { uvs: [None, None], ..square(true, false) }, 0, true).is_none());
    }
}
