//! Round shapes: sphere and cylinder, as the core has them where it can, else as fine meshes with smooth normals.

use std::f64::consts::PI;

use antumbra::scene::Mesh;
use antumbra_math::{DVec3, Transform, real};
use antumbra_trace::Shape;

use super::super::Reader;
use super::super::document::Element;
use super::{Body, Placing};
use crate::error::ReadError;

/// Steps around a round shape. The corners of 256 lie 7·10⁻⁵ of the radius outside of its sides.
const AROUND: u32 = 256;
/// Steps from pole to pole.
const DOWN: u32 = 128;

/// The length of vectors that are equally long and at right angles (to 10⁻⁴, what hand-written matrices keep).
pub(super) fn similar(axes: &[DVec3]) -> Option<f32> {
    let length = axes[0].length();
    let fits = |x: f64| x.abs() <= 1e-4 * length * length;
    let square = |a: &DVec3| fits(a.length_squared() - length * length);
    let right = |i: usize| (0..i).all(|j| fits(axes[i].dot(axes[j])));
    let all = length > 0.0 && axes.iter().all(square) && (0..axes.len()).all(right);
    all.then_some(length as f32)
}

/// The images of the axes.
fn axes(t: &Transform) -> [DVec3; 3] {
    [t.linear.x_axis, t.linear.y_axis, t.linear.z_axis]
}

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

/// The sphere of radius 1; u runs around +z, v from +z down.
fn ball(flipped: bool) -> Mesh {
    let at = |i: u32, j: u32| {
        let theta = PI * f64::from(j) / f64::from(DOWN);
        // Both poles are points, and the last meridian is the first to the bit.
        let r = if j == 0 || j == DOWN { 0.0 } else { real::sin(theta) };
        ring(i) * r + DVec3::Z * real::cos(theta)
    };
    grid(DOWN, flipped, at, at)
}

/// The side of the cylinder of radius 1 from z = 0 to 1.
fn tube(flipped: bool) -> Mesh {
    grid(1, flipped, |i, j| ring(i) + DVec3::Z * f64::from(j), |i, _| ring(i))
}

/// Place i on the circle.
fn ring(i: u32) -> DVec3 {
    let phi = 2.0 * PI * f64::from(i % AROUND) / f64::from(AROUND);
    DVec3::new(real::cos(phi), real::sin(phi), 0.0)
}

/// A grid around z with points and normals at (i, j), j from 0 to `down`.
fn grid(
    down: u32,
    flipped: bool,
    point: impl Fn(u32, u32) -> DVec3,
    normal: impl Fn(u32, u32) -> DVec3,
) -> Mesh {
    let mut mesh = Mesh::default();
    let (mut normals, mut uvs) = (Vec::new(), Vec::new());
    let side = if flipped { -1.0 } else { 1.0 };
    for j in 0..=down {
        for i in 0..=AROUND {
            mesh.triangles.vertices.push(point(i, j).as_vec3().to_array());
            normals.push((normal(i, j) * side).as_vec3().to_array());
            uvs.push([i as f32 / AROUND as f32, j as f32 / down as f32]);
        }
    }
    let at = |i: u32, j: u32| j * (AROUND + 1) + i;
    for j in 0..down {
        for i in 0..AROUND {
            // Seen from outside: a above b (or below, for a tube), c and d one step on.
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)];
            let both = [[a, b, d], [a, d, c]];
            mesh.triangles.indices.extend(both.map(|[a, b, c]| if flipped { [a, c, b] } else { [a, b, c] }));
        }
    }
    let whole = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.triangles.vertices[i as usize]);
        a != b && b != c && a != c
    };
    let kept: Vec<_> = mesh.triangles.indices.iter().copied().filter(whole).collect();
    mesh.triangles.indices = kept;
    (mesh.normals, mesh.uvs[0]) = (Some(normals), Some(uvs));
    face_the_normals(&mut mesh);
    mesh
}

/// Turns triangles round that face away from their normals: the side of a surface is that of its normals.
pub(super) fn face_the_normals(mesh: &mut Mesh) {
    let Some(normals) = &mesh.normals else { return };
    let wide = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    for triangle in &mut mesh.triangles.indices {
        let [a, b, c] = triangle.map(|i| wide(mesh.triangles.vertices[i as usize]));
        let mean: DVec3 = triangle.iter().map(|i| wide(normals[*i as usize])).sum();
        if (b - a).cross(c - a).dot(mean) < 0.0 {
            triangle.swap(1, 2);
        }
    }
}
