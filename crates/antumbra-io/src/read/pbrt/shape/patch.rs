//! bilinearmesh: patches that are bilinear between four corners, flat ones as two triangles, others as fine grids.

use antumbra::scene::Mesh;
use antumbra_math::DVec3;
use antumbra_trace::Triangles;

use super::super::Reader;
use super::super::parameters::Parameters;
use super::mesh::{attribute, faces, rows, turned};
use super::{Body, Placing};
use crate::error::ReadError;

/// Steps along each side of a bent patch.
const STEPS: u32 = 16;

/// Corners p00, p10, p01, p11 of each patch; its front is ∂p/∂u × ∂p/∂v, or that of its normals.
pub(super) fn bilinearmesh(
    reader: &mut Reader,
    p: &Parameters,
    at: &Placing,
) -> Result<Option<Body>, ReadError> {
    p.pass_over(&["faceIndices"]);
    if p.get("emissionfilename").is_some() {
        reader.said.warn(p.at.words(), "a picture that a patch emits is not read: it shines evenly");
    }
    let Some(points) = rows::<3>(p, "P")? else { return Err(p.error("\"point3 P\" is missing")) };
    let patches = faces::<4>(p, points.len())?;
    let normals = attribute::<3>(p, "N", points.len())?;
    let uvs = attribute::<2>(p, "uv", points.len())?;
    let room = patches.len() as u64 * u64::from((STEPS + 1) * (STEPS + 1));
    reader.context.take(room, 64).map_err(|why| p.error(why))?;
    let mut mesh = Grown { with_normals: normals.is_some(), ..Grown::default() };
    for patch in &patches {
        let corner = |i: usize| patch[i] as usize;
        let of = |v: &[f32; 3]| DVec3::from(v.map(f64::from));
        let given = normals.as_ref().map(|n| [0, 1, 2, 3].map(|i| of(&n[corner(i)])));
        let square = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        let coordinates = uvs.as_ref().map_or(square, |uv| [0, 1, 2, 3].map(|i| uv[corner(i)]));
        mesh.add([0, 1, 2, 3].map(|i| of(&points[corner(i)])), given, coordinates);
    }
    Ok(reader.mesh(turned(mesh.finish(), at.reverse)))
}

/// (1−u)(1−v) a + u(1−v) b + (1−u)v c + uv d.
fn bilinear([a, b, c, d]: [DVec3; 4], [u, v]: [f64; 2]) -> DVec3 {
    (a * (1.0 - u) + b * u) * (1.0 - v) + (c * (1.0 - u) + d * u) * v
}

/// A mesh as patches are added.
#[derive(Default)]
struct Grown {
    triangles: Triangles,
    normals: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    /// The file gives normals.
    with_normals: bool,
}

impl Grown {
    fn add(&mut self, corners: [DVec3; 4], normals: Option<[DVec3; 4]>, uvs: [[f32; 2]; 4]) {
        let [a, b, c, d] = corners;
        let size = (d - a).length().max((c - b).length());
        let flat = (a - b - c + d).length() <= 1e-6 * size;
        let steps = if flat { 1 } else { STEPS };
        let first = self.triangles.vertices.len() as u32;
        for j in 0..=steps {
            for i in 0..=steps {
                let at = [i, j].map(|k| f64::from(k) / f64::from(steps));
                self.triangles.vertices.push(bilinear(corners, at).as_vec3().to_array());
                let [u, v] = at;
                let across = (b - a) * (1.0 - v) + (d - c) * v;
                let along = (c - a) * (1.0 - u) + (d - b) * u;
                let normal = normals.map_or_else(|| across.cross(along), |n| bilinear(n, at));
                self.normals.push(normal.normalize_or_zero().as_vec3().to_array());
                let wide = uvs.map(|[u, v]| DVec3::new(u.into(), v.into(), 0.0));
                let uv = bilinear(wide, at);
                self.uvs.push([uv.x as f32, uv.y as f32]);
            }
        }
        let at = |i: u32, j: u32| first + j * (steps + 1) + i;
        for j in 0..steps {
            for i in 0..steps {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
                self.triangles.indices.extend([[a, b, d], [a, d, c]]);
            }
        }
        self.with_normals |= !flat;
    }

    fn finish(self) -> Mesh {
        let normals = self.with_normals.then_some(self.normals);
        Mesh { triangles: self.triangles, normals, uvs: [Some(self.uvs), None], ..Mesh::default() }
    }
}
