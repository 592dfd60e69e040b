//! sphere, disk, cylinder: as the core has them where they are whole, else as fine meshes with smooth normals.

use std::f64::consts::PI;

use antumbra::scene::Mesh;
use antumbra_math::{DVec3, real};
use antumbra_trace::Shape;

use super::super::Reader;
use super::super::parameters::Parameters;
use super::{Body, Placing};
use crate::error::ReadError;
use crate::read::tessellate::{AROUND, DOWN, axes, flip, grid, sector, similar};

/// The part of the circle that is swept [rad].
fn angle(p: &Parameters) -> Result<f64, ReadError> {
    let degrees = p.positive("phimax", 360.0)?;
    Ok(degrees.min(360.0).to_radians())
}

/// A mesh about z: the profile's (r, z) and its normal at each row, v from 0 at the first to 1 at the last.
fn swept(
    reader: &mut Reader,
    reverse: bool,
    (angle, rows): (f64, u32),
    profile: impl Fn(u32) -> [f64; 4],
) -> Option<Body> {
    let at = |i: u32, r: f64, z: f64| sector(i, angle) * r + DVec3::Z * z;
    let point = |i, j| {
        let [r, z, ..] = profile(j);
        at(i, r, z)
    };
    let normal = |i, j| {
        let [.., r, z] = profile(j);
        at(i, r, z)
    };
    let mut mesh: Mesh = grid(rows, false, point, normal);
    if reverse {
        flip(&mut mesh);
    }
    reader.mesh(mesh)
}

pub(super) fn sphere(reader: &mut Reader, p: &Parameters, at: &Placing) -> Result<Option<Body>, ReadError> {
    let radius = p.positive("radius", 1.0)?;
    let clamped = |name, default| p.float(name, default).map(|z| z.clamp(-radius, radius));
    let (low, high) = (clamped("zmin", -radius)?, clamped("zmax", radius)?);
    let (low, high, angle) = (low.min(high), low.max(high), angle(p)?);
    let whole = low == -radius && high == radius && angle == 2.0 * PI;
    if whole
        && !at.mesh
        && !at.reverse
        && let Some(scale) = similar(&axes(&at.world))
    {
        let center = at.world.translation.as_vec3().to_array();
        return Ok(Some(Body::Shape(Shape::Sphere { center, radius: scale * radius as f32 })));
    }
    // θ from that of zmin to that of zmax; poles are points.
    let (first, last) = (real::acos(low / radius), real::acos(high / radius));
    let row = |j: u32| {
        let theta = first + (last - first) * f64::from(j) / f64::from(DOWN);
        let z = real::cos(theta);
        let pole = (j == 0 && low == -radius) || (j == DOWN && high == radius);
        let r = if pole { 0.0 } else { real::sin(theta) };
        [r * radius, z * radius, r, z]
    };
    Ok(swept(reader, at.reverse, (angle, DOWN), row))
}

pub(super) fn cylinder(reader: &mut Reader, p: &Parameters, at: &Placing) -> Result<Option<Body>, ReadError> {
    let radius = p.positive("radius", 1.0)?;
    let (a, b) = (p.float("zmin", -1.0)?, p.float("zmax", 1.0)?);
    let (low, high, angle) = (a.min(b), a.max(b), angle(p)?);
    if low == high {
        return Err(p.error(format!("\"zmin\" and \"zmax\" are both {low}: it has no height")));
    }
    let is_mesh = at.mesh || at.reverse || at.shines || angle < 2.0 * PI;
    if !is_mesh && let Some(scale) = similar(&axes(&at.world)) {
        let end = |z: f64| at.world.point(DVec3::Z * z).as_vec3().to_array();
        let shape = Shape::Cylinder { p: end(low), q: end(high), radius: scale * radius as f32 };
        return Ok(Some(Body::Shape(shape)));
    }
    Ok(swept(reader, at.reverse, (angle, 1), |j| [radius, if j == 0 { low } else { high }, 1.0, 0.0]))
}

/// Facing +z.
pub(super) fn disk(reader: &mut Reader, p: &Parameters, at: &Placing) -> Result<Option<Body>, ReadError> {
    let (radius, hole, height) =
        (p.positive("radius", 1.0)?, p.float("innerradius", 0.0)?, p.float("height", 0.0)?);
    let angle = angle(p)?;
    if !(0.0..radius).contains(&hole) {
        return Err(p.error(format!("\"innerradius\" is {hole}: from 0 to less than \"radius\" {radius}")));
    }
    let whole = hole == 0.0 && angle == 2.0 * PI;
    let flat = [at.world.linear.x_axis, at.world.linear.y_axis];
    if whole
        && !at.mesh
        && let Some(scale) = similar(&flat)
    {
        let front = if at.reverse { DVec3::NEG_Z } else { DVec3::Z };
        let normal = at.world.normal(front).normalize_or_zero().as_vec3().to_array();
        let center = at.world.point(DVec3::Z * height).as_vec3().to_array();
        return Ok(Some(Body::Shape(Shape::Disk { center, normal, radius: scale * radius as f32 })));
    }
    // A polygon as large as the disk: of each sector, sin(step)/2 r² where the disk has step/2 r².
    let step = angle / f64::from(AROUND);
    let grown = (step / real::sin(step)).sqrt();
    let row = |j: u32| [if j == 0 { radius } else { hole } * grown, height, 0.0, 1.0];
    Ok(swept(reader, at.reverse, (angle, 1), row))
}
