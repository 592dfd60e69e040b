//! Round shapes: sphere and cylinder, as the core has them where it can, else as fine meshes with smooth normals.

use antumbra_math::{DVec3, Transform};
use antumbra_trace::Shape;

use super::super::Reader;
use super::super::document::Element;
use super::{Body, Placing};
use crate::error::ReadError;
use crate::read::tessellate::{axes, ball, similar, tube};

/// About `center` with `radius`, facing outwards.
pub(super) fn sphere(reader: &mut Reader, element: &Element, at: &Placing) -> Result<Body, ReadError> {
    let flipped = element.boolean("flip_normals", false)?;
    let center = element.vector("center")?.unwrap_or(DVec3::ZERO);
    let radius = element.float("radius", 1.0)?;
    if radius <= 0.0 {
        return Err(element.at.error(format!("a sphere of radius {radius}: it must be above 0")));
    }
    if !at.textured
        && !flipped
        && let Some(scale) = similar(&axes(&at.world))
    {
        let center = at.world.point(center).as_vec3().to_array();
        return Ok(Body::Shape(Shape::Sphere { center, radius: scale * radius as f32 }));
    }
    let mesh = reader.mesh(format!("sphere {flipped}"), |_| Ok(ball(flipped)))?;
    let own =
        Transform { linear: antumbra_math::DMat3::from_diagonal(DVec3::splat(radius)), translation: center };
    Ok(Body::Mesh(mesh, at.world.after(&own)))
}

/// From `p0` to `p1` with `radius`, without caps, facing outwards.
pub(super) fn cylinder(reader: &mut Reader, element: &Element, at: &Placing) -> Result<Body, ReadError> {
    let flipped = element.boolean("flip_normals", false)?;
    let (p, q) = (element.vector("p0")?, element.vector("p1")?);
    let (p, q) = (p.unwrap_or(DVec3::ZERO), q.unwrap_or(DVec3::Z));
    let radius = element.float("radius", 1.0)?;
    let axis = q - p;
    if radius <= 0.0 || axis == DVec3::ZERO {
        let what =
            format!("a cylinder of radius {radius} and length {}: both must be above 0", axis.length());
        return Err(element.at.error(what));
    }
    if !(at.textured || flipped || at.shines)
        && let Some(scale) = similar(&axes(&at.world))
    {
        let end = |p: DVec3| at.world.point(p).as_vec3().to_array();
        return Ok(Body::Shape(Shape::Cylinder { p: end(p), q: end(q), radius: scale * radius as f32 }));
    }
    let mesh = reader.mesh(format!("cylinder {flipped}"), |_| Ok(tube(flipped)))?;
    let frame = antumbra_math::Frame::about(axis.normalize().as_vec3());
    let (s, t) = (frame.s.as_dvec3() * radius, frame.t.as_dvec3() * radius);
    let own = Transform { linear: antumbra_math::DMat3::from_cols(s, t, axis), translation: p };
    Ok(Body::Mesh(mesh, at.world.after(&own)))
}
