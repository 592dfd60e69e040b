//! Tangents of a mesh: where u grows over its surface, for normal maps and for facets of two widths.

use antumbra_math::{Vec3, hash, real};
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

    /// One a vertex, if that is what they are: those that a file gave.
    pub fn per_vertex(&self) -> Option<&[[f32; 4]]> {
        (!self.of_corners).then_some(&self.values[..])
    }

    /// As MikkTSpace makes them from positions, normals and texture coordinates (set `set`; `downwards`: v grows towards
    /// the bottom of the picture), with what its reader should hear. `None` without texture coordinates.
    pub fn made(mesh: &Mesh, set: usize, downwards: bool) -> Option<(Tangents, Option<String>)> {
        let uvs = mesh.uvs.get(set)?.as_deref()?;
        let values = vec![[1.0, 0.0, 0.0, 1.0]; 3 * mesh.triangles.indices.len()];
        let mut making = Making { mesh, uvs, downwards, values };
        let crowd = making.most_around_a_corner();
        let mut said = None;
        if crowd > MOST_AROUND_A_CORNER {
            making.of_faces();
            said = Some(format!(
                "{crowd} triangles meet in one corner: tangents are taken from each triangle alone"
            ));
        } else {
            // The crate's error has no case.
            generate_tangents(&mut making).ok()?;
        }
        Some((Tangents { values: making.values, of_corners: true }, said))
    }

    /// Those of the three corners of triangle `local`.
    #[inline]
    pub fn corners(&self, indices: &[[u32; 3]], local: u32) -> [[f32; 4]; 3] {
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

/// MikkTSpace goes round a corner by calling itself and compares all pairs of its triangles: 4096 take 1 MB of the stack.
const MOST_AROUND_A_CORNER: usize = 4096;

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

    /// The most corners of one position, normal and texture coordinate, which MikkTSpace takes for one vertex.
    fn most_around_a_corner(&self) -> usize {
        let key = |face: usize, corner: usize| {
            let numbers = self.position(face, corner).into_iter().chain(self.normal(face, corner));
            // Adding 0 makes −0 of 0.
            hash::fnv1a_words(numbers.chain(self.tex_coord(face, corner)).map(|x| (x + 0.0).to_bits()))
        };
        let faces = 0..self.num_faces();
        let mut keys: Vec<u64> = faces.flat_map(|face| [0, 1, 2].map(|corner| key(face, corner))).collect();
        keys.sort_unstable();
        keys.chunk_by(|a, b| a == b).map(<[u64]>::len).max().unwrap_or(0)
    }

    /// Where u grows over each triangle by itself, made square to the normal of each corner.
    fn of_faces(&mut self) {
        for face in 0..self.num_faces() {
            let [a, b, c] = self.mesh.triangles.corners(face).map(Vec3::from);
            let [ta, tb, tc] = [0, 1, 2].map(|corner| self.tex_coord(face, corner));
            let ([u1, v1], [u2, v2]) = ([tb[0] - ta[0], tb[1] - ta[1]], [tc[0] - ta[0], tc[1] - ta[1]]);
            let w = if u1 * v2 - u2 * v1 < 0.0 { -1.0 } else { 1.0 };
            let along = ((b - a) * v2 - (c - a) * v1) * w;
            for corner in 0..3 {
                let n = Vec3::from(self.normal(face, corner));
                let t = (along - n * n.dot(along)).normalize_or_zero();
                if t != Vec3::ZERO {
                    self.values[3 * face + corner] = [t.x, t.y, t.z, w];
                }
            }
        }
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
            let (made, _) = Tangents::made(&square(!downwards, false), 0, downwards).unwrap();
            for corner in made.corners(&[], 1) {
                assert_eq!(corner, [1.0, 0.0, 0.0, 1.0]);
            }
            // u to the left: t = −x, and the bitangent is still +y.
            let (made, _) = Tangents::made(&square(!downwards, true), 0, downwards).unwrap();
            assert_eq!(made.corners(&[], 0)[2], [-1.0, 0.0, 0.0, -1.0]);
        }
    }

    #[test]
    fn each_triangle_by_itself_says_the_same_on_a_plane() {
        for (up, mirrored) in [(true, false), (false, false), (true, true)] {
            let mesh = square(up, mirrored);
            let mut making = Making {
                mesh: &mesh,
                uvs: mesh.uvs[0].as_deref().unwrap(),
                downwards: !up,
                values: vec![[0.0; 4]; 6],
            };
            making.of_faces();
            assert_eq!(making.values, Tangents::made(&mesh, 0, !up).unwrap().0.values);
        }
    }

    #[test]
    fn a_fan_of_many_triangles_round_one_corner() {
        // A disk, u along +x and v along −y (glTF): with one apex, and with an apex of each triangle's own.
        let n = 100_000u32;
        let rim = |k: u32| {
            let phi = f64::from(k) * std::f64::consts::TAU / f64::from(n);
            [real::cos(phi) as f32, real::sin(phi) as f32, 0.0]
        };
        let vertices: Vec<[f32; 3]> = std::iter::once([0.0; 3]).chain((0..n).map(rim)).collect();
        let welded: Vec<[u32; 3]> = (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % n]).collect();
        let apart: Vec<[f32; 3]> = welded.iter().flatten().map(|v| vertices[*v as usize]).collect();
        let own = (0..n).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        for (vertices, indices) in [(vertices, welded), (apart, own)] {
            let uvs = [Some(vertices.iter().map(|v| [v[0], -v[1]]).collect()), None];
            let mesh = Mesh {
                normals: Some(vec![[0.0, 0.0, 1.0]; vertices.len()]),
                triangles: Triangles { vertices, indices },
                uvs,
                ..Mesh::default()
            };
            let (made, said) = Tangents::made(&mesh, 0, true).unwrap();
            assert!(said.is_some_and(|text| text.contains("100000 triangles")));
            // Edges of 6e-5 are known to ε: a thousandth.
            let off = |t: &[f32; 4]| (t[0] - 1.0).abs().max(t[1].abs()).max((t[3] - 1.0).abs());
            assert!(made.values.iter().all(|t| off(t) < 5e-3));
        }
    }

    #[test]
    fn nothing_without_coordinates() {
        assert!(Tangents::made(&Mesh { uvs: [None, None], ..square(true, false) }, 0, true).is_none());
    }
}
