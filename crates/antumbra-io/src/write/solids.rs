//! Round shapes as meshes, for formats without them: unit solids and where they stand.

use antumbra::scene::Mesh;
use antumbra_math::{DMat3, DVec3, Frame, Transform, Vec3, real};
use antumbra_trace::{Shape, Triangles};

use crate::read::tessellate;

/// Which unit solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Solid {
    /// The ball of radius 1.
    Ball,
    /// The same of fewer triangles with its area kept, for light: every triangle is one.
    Lamp,
    /// The disk of radius 1 that faces +z, its area kept.
    Disk,
    /// The side of the cylinder of radius 1 from z = 0 to 1.
    Tube,
}

/// Steps around and from pole to pole of a lamp.
const LAMP: [u32; 2] = [32, 16];

impl Solid {
    /// Its mesh, without the texture coordinates that nothing asks for.
    pub(super) fn mesh(self) -> Mesh {
        let made = match self {
            Solid::Ball => tessellate::ball(false),
            Solid::Lamp => lamp(),
            Solid::Disk => tessellate::fan(false),
            Solid::Tube => tessellate::tube(false),
        };
        Mesh { uvs: [None, None], ..made }
    }

    /// What people call it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Solid::Ball | Solid::Lamp => "sphere",
            Solid::Disk => "disk",
            Solid::Tube => "cylinder",
        }
    }
}

/// The solid that a shape is, and solid → world; `shines`: every triangle will be a light.
pub(super) fn of(shape: &Shape, shines: bool) -> (Solid, Transform) {
    let wide = |p: &[f32; 3]| DVec3::from(p.map(f64::from));
    match shape {
        Shape::Sphere { center, radius } => {
            let linear = DMat3::from_diagonal(DVec3::splat(f64::from(*radius)));
            let solid = if shines { Solid::Lamp } else { Solid::Ball };
            (solid, Transform { linear, translation: wide(center) })
        }
        Shape::Disk { center, normal, radius } => {
            let n = wide(normal).normalize();
            (Solid::Disk, Transform { linear: about(n, (*radius).into(), 1.0), translation: wide(center) })
        }
        Shape::Cylinder { p, q, radius } => {
            let axis = wide(q) - wide(p);
            let linear = about(axis.normalize(), (*radius).into(), axis.length());
            (Solid::Tube, Transform { linear, translation: wide(p) })
        }
    }
}

/// z along the unit vector `n`, stretched by `along`; x and y at right angles to it, stretched by `across`.
pub(super) fn about(n: DVec3, across: f64, along: f64) -> DMat3 {
    let s = Frame::about(n.as_vec3()).s.as_dvec3();
    let s = (s - n * s.dot(n)).normalize();
    DMat3::from_cols(s * across, n.cross(s) * across, n * along)
}

/// A convex body shows each side a quarter of its area on average: with the sphere's area it sends out the sphere's light.
fn lamp() -> Mesh {
    let [around, down] = LAMP;
    let point = |i: u32, j: u32| {
        let phi = std::f64::consts::TAU * f64::from(i % around) / f64::from(around);
        let theta = std::f64::consts::PI * f64::from(j) / f64::from(down);
        let sin = if j == 0 || j == down { 0.0 } else { real::sin(theta) };
        DVec3::new(real::cos(phi) * sin, real::sin(phi) * sin, real::cos(theta))
    };
    let mut faces = Vec::new();
    for (i, j) in (0..down).flat_map(|j| (0..around).map(move |i| (i, j))) {
        let [a, b, c, d] = [point(i, j), point(i, j + 1), point(i + 1, j), point(i + 1, j + 1)];
        if j + 1 < down {
            faces.push([a, b, d]);
        }
        if j > 0 {
            faces.push([a, d, c]);
        }
    }
    let area: f64 = faces.iter().map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a).length()).sum();
    let grow = (4.0 * std::f64::consts::PI / area).sqrt();
    let vertices: Vec<[f32; 3]> = faces.iter().flatten().map(|p| (*p * grow).as_vec3().to_array()).collect();
    let indices = (0..faces.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Mesh { triangles: Triangles { vertices, indices }, ..Mesh::default() }
}

/// Whether a node of translation, rotation and scale can stand for it: its axes are at right angles.
pub(super) fn is_square(t: &Transform) -> bool {
    let m = t.linear;
    let right = |a: DVec3, b: DVec3| a.dot(b).abs() <= 1e-6 * a.length() * b.length();
    right(m.x_axis, m.y_axis) && right(m.y_axis, m.z_axis) && right(m.z_axis, m.x_axis)
}

/// A mesh in world numbers.
pub(super) fn moved(mesh: &Mesh, by: &Transform) -> Mesh {
    let mut moved = Mesh { tangents: None, ..mesh.clone() };
    let wide = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    let narrow = |v: DVec3| Vec3::to_array(&v.as_vec3());
    moved.triangles.vertices.iter_mut().for_each(|v| *v = narrow(by.point(wide(*v))));
    let normals = moved.normals.iter_mut().flatten();
    normals.for_each(|n| *n = narrow(by.normal(wide(*n)).normalize_or_zero()));
    if by.mirrors() {
        moved.triangles.indices.iter_mut().for_each(|t| t.swap(1, 2));
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faces(mesh: &Mesh) -> impl Iterator<Item = [DVec3; 3]> {
        let corners = |i| mesh.triangles.corners(i).map(|p| DVec3::from(p.map(f64::from)));
        (0..mesh.triangles.indices.len()).map(corners)
    }

    /// To the roundings of f32.
    #[test]
    fn lamps_keep_the_area_and_face_outwards() {
        for (solid, area) in [(Solid::Lamp, 4.0), (Solid::Disk, 1.0)] {
            let mesh = solid.mesh();
            let sum: f64 = faces(&mesh).map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum();
            assert!((sum / (area * std::f64::consts::PI) - 1.0).abs() < 1e-6, "{solid:?} {sum}");
        }
        assert!(faces(&Solid::Lamp.mesh()).all(|[a, b, c]| (b - a).cross(c - a).dot(a + b + c) > 0.0));
        assert!(faces(&Solid::Disk.mesh()).all(|[a, b, c]| (b - a).cross(c - a).z > 0.0));
    }

    #[test]
    fn a_disk_faces_its_normal() {
        let shape = Shape::Disk { center: [1.0, 2.0, 3.0], normal: [0.0, -2.0, 0.0], radius: 0.5 };
        let (solid, at) = of(&shape, false);
        assert_eq!((solid, at.translation), (Solid::Disk, DVec3::new(1.0, 2.0, 3.0)));
        assert!(at.vector(DVec3::Z).abs_diff_eq(DVec3::NEG_Y, 1e-12) && !at.mirrors() && is_square(&at));
        assert!((at.vector(DVec3::X).length() - 0.5).abs() < 1e-12);
    }
}
