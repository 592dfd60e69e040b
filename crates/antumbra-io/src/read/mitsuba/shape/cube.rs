//! The cube.

use antumbra::scene::Mesh;
use antumbra_trace::Triangles;

use super::super::Reader;
use super::super::document::Element;
use super::{Body, Placing};
use crate::error::ReadError;

/// From (−1, −1, −1) to (1, 1, 1), facing outwards.
pub(super) fn cube(reader: &mut Reader, element: &Element, at: &Placing) -> Result<Body, ReadError> {
    let flipped = element.boolean("flip_normals", false)?;
    let mesh = reader.mesh(format!("cube {flipped}"), |_| Ok(made(flipped)))?;
    Ok(Body::Mesh(mesh, at.world))
}

/// Four corners a face, in the order of their texture coordinates.
fn made(flipped: bool) -> Mesh {
    const UVS: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    // As signs of x, y, z, one face a row: −y, +y, +x, +z, −x, −z.
    const FACES: [[&[u8; 3]; 4]; 6] = [
        [b"+--", b"+-+", b"--+", b"---"],
        [b"++-", b"-+-", b"-++", b"+++"],
        [b"+--", b"++-", b"+++", b"+-+"],
        [b"+-+", b"+++", b"-++", b"--+"],
        [b"--+", b"-++", b"-+-", b"---"],
        [b"++-", b"+--", b"---", b"-+-"],
    ];
    let sign = |s: u8| if s == b'+' { 1.0 } else { -1.0 };
    let vertices = FACES.iter().flatten().map(|c| c.map(sign)).collect();
    let turn = |[a, b, c]: [u32; 3]| if flipped { [a, c, b] } else { [a, b, c] };
    let face = |f: u32| [[4 * f, 4 * f + 1, 4 * f + 2], [4 * f + 3, 4 * f, 4 * f + 2]].map(turn);
    let indices = (0..6).flat_map(face).collect();
    let uvs = FACES.iter().flat_map(|_| UVS).collect();
    Mesh { triangles: Triangles { vertices, indices }, uvs: [Some(uvs), None], ..Mesh::default() }
}
