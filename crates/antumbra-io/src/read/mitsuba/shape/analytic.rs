//! Flat shapes: rectangle and disk.

use std::f64::consts::PI;

use antumbra::scene::Mesh;
use antumbra_math::{DVec3, real};
use antumbra_trace::{Shape, Triangles};

use super::super::Reader;
use super::super::document::Element;
use super::{Body, Placing};
use crate::error::ReadError;
use crate::read::tessellate::similar;

/// Sides of a disk that the core cannot have as one.
const SIDES: u32 = 256;

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

/// A disk of triangles with its area kept; u is the radius, v the angle.
fn fan(turned: bool) -> Mesh {
    // The polygon's area is n/2·sin(2π/n) r² where the disk's is π.
    let step = 2.0 * PI / f64::from(SIDES);
    let radius = (PI / (0.5 * f64::from(SIDES) * real::sin(step))).sqrt();
    let mut mesh = Mesh::default();
    let mut uvs = Vec::new();
    for i in 0..=SIDES {
        let (angle, v) = (step * f64::from(i % SIDES), i as f32 / SIDES as f32);
        let rim = DVec3::new(real::cos(angle), real::sin(angle), 0.0) * radius;
        mesh.triangles.vertices.extend([[0.0; 3], rim.as_vec3().to_array()]);
        uvs.extend([[0.0, v], [1.0, v]]);
        if i < SIDES {
            let (center, here, next) = (2 * i, 2 * i + 1, 2 * i + 3);
            mesh.triangles.indices.push(if turned { [center, next, here] } else { [center, here, next] });
        }
    }
    mesh.uvs[0] = Some(uvs);
    mesh
}
