//! Flat shapes: rectangle and disk.

use antumbra::scene::Mesh;
use antumbra_math::DVec3;
use antumbra_trace::{Shape, Triangles};

use super::super::Reader;
use super::super::document::Element;
use super::{Body, Placing};
use crate::error::ReadError;
use crate::read::tessellate::{fan, similar};

/// From (−1, −1, 0) to (1, 1, 0), facing +z.
pub(super) fn rectangle(reader: &mut Reader, element: &Element, at: &Placing) -> Result<Body, ReadError> {
    let flipped = element.boolean("flip_normals", false)?;
    let mesh = reader.mesh(format!("rectangle {flipped}"), |_| Ok(square(flipped)))?;
    let corner = |x: f64, y: f64| at.world.point(DVec3::new(x, y, 0.0)).as_vec3();
    let (c, mut u, mut v) = (corner(-1.0, -1.0), at.world.vector(DVec3::X), at.world.vector(DVec3::Y));
    // u × v is the front, which stays where it is when the world is mirrored.
    if flipped != at.world.mirrors() {
        std::mem::swap(&mut u, &mut v);
    }
    Ok(Body::Parallelogram([c, (u * 2.0).as_vec3(), (v * 2.0).as_vec3()], mesh, at.world))
}

/// The square; `turned`: facing −z.
fn square(turned: bool) -> Mesh {
    let vertices = vec![[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    let indices = if turned { vec![[0, 2, 1], [2, 0, 3]] } else { vec![[0, 1, 2], [2, 3, 0]] };
    let uvs = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    Mesh { triangles: Triangles { vertices, indices }, uvs: [Some(uvs), None], ..Mesh::default() }
}

/// Of radius 1 about the origin, facing +z.
pub(super) fn disk(reader: &mut Reader, element: &Element, at: &Placing) -> Result<Body, ReadError> {
    let flipped = element.boolean("flip_normals", false)?;
    let (x, y) = (at.world.vector(DVec3::X), at.world.vector(DVec3::Y));
    if !at.textured
        && let Some(radius) = similar(&[x, y])
    {
        let center = at.world.translation.as_vec3().to_array();
        let front = if flipped { DVec3::NEG_Z } else { DVec3::Z };
        let normal = at.world.normal(front).normalize_or_zero().as_vec3().to_array();
        return Ok(Body::Shape(Shape::Disk { center, normal, radius }));
    }
    let mesh = reader.mesh(format!("disk {flipped}"), |_| Ok(fan(flipped)))?;
    Ok(Body::Mesh(mesh, at.world))
}
