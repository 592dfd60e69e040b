//! The lights that an emissive object is: a triangle each, or a rectangle each two.

use antumbra_math::{DVec3, Vec3};
use antumbra_trace::Shape;

use super::{Body, Emission, Placed, SceneMesh};
use crate::light::{Disk, Light, Rectangle, Sphere, Triangle};

/// How far a fourth corner may lie beside its place: as a part of the largest coordinate, half of the lift of starts and
/// ends (LAW §5), so that a point of the rectangle, lifted, is in front of both triangles; four roundings take no more …
const BESIDE: f32 = 1.0 / 4_194_304.0;
/// … and as a part of the shorter side, so that its light is that of the triangles.
const ASKEW: f32 = 1.0 / 16_384.0;

/// The lights of an object, each of the same number of its primitives, in their order; none for a shape that cannot emit.
pub(super) fn lights(object: &Placed, meshes: &[SceneMesh], emission: Emission) -> Vec<Light> {
    let Emission { radiance, both_sides } = emission;
    match &object.body {
        Body::Mesh(m) => {
            let triangles = &meshes[*m as usize].triangles;
            let placed = |c: [f32; 3]| match &object.transform {
                None => Vec3::from(c),
                Some(t) => t.point(DVec3::from(c.map(f64::from))).as_vec3(),
            };
            let mirrors = object.transform.is_some_and(|t| t.mirrors());
            let corners = |i: usize| {
                let [a, b, c] = triangles.corners(i).map(placed);
                if mirrors { [a, c, b] } else { [a, b, c] }
            };
            let all: Vec<[Vec3; 3]> = (0..triangles.indices.len()).map(corners).collect();
            rectangles(&all).map_or_else(
                || {
                    let light = |[a, b, c]: &[Vec3; 3]| Triangle::new(*a, *b, *c, radiance);
                    all.iter().map(|corners| light(corners).both_sides(both_sides).into()).collect()
                },
                |all| {
                    let light = |[corner, u, v]: &[Vec3; 3]| Rectangle::new(*corner, *u, *v, radiance);
                    all.iter().map(|edges| light(edges).both_sides(both_sides).into()).collect()
                },
            )
        }
        Body::Shape(Shape::Sphere { center, radius }) => {
            vec![Sphere::new(Vec3::from(*center), *radius, radiance).into()]
        }
        Body::Shape(Shape::Disk { center, normal, radius }) => {
            let disk = Disk::new(Vec3::from(*center), Vec3::from(*normal), *radius, radiance);
            vec![disk.both_sides(both_sides).into()]
        }
        Body::Shape(Shape::Cylinder { .. }) => Vec::new(),
    }
}

/// Corner and edges of the rectangles (or parallelograms) that two triangles each are; `None` if not all are.
fn rectangles(triangles: &[[Vec3; 3]]) -> Option<Vec<[Vec3; 3]>> {
    let (pairs, rest) = triangles.as_chunks::<2>();
    if rest.is_empty() { pairs.iter().map(rectangle).collect() } else { None }
}

/// Corner and edges u, v of two triangles (a, b, c) and (a, c, d), their corners turned in any way, with d = a + c − b.
fn rectangle([one, other]: &[[Vec3; 3]; 2]) -> Option<[Vec3; 3]> {
    let turned = |[a, b, c]: [Vec3; 3], by: usize| [[a, b, c], [b, c, a], [c, a, b]][by];
    for i in 0..3 {
        for j in 0..3 {
            let ([a, b, c], [a2, c2, d]) = (turned(*one, i), turned(*other, j));
            if a != a2 || c != c2 {
                continue;
            }
            let (u, v) = (b - a, d - a);
            let beside = (a + (u + v) - c).abs().max_element();
            let largest = [a, b, c, d].iter().fold(0.0, |m: f32, x| m.max(x.abs().max_element()));
            let shorter = u.length().min(v.length());
            let fits = beside <= (BESIDE * largest).min(ASKEW * shorter);
            return (fits && u.cross(v).length() > 0.0).then_some([a, u, v]);
        }
    }
    None
}

impl Placed {
    /// Number of its primitives.
    pub fn primitives(&self, meshes: &[SceneMesh]) -> u32 {
        match &self.body {
            Body::Mesh(m) => meshes[*m as usize].triangles.indices.len() as u32,
            Body::Shape(_) => 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles that share a diagonal are a rectangle however their corners are turned; a bent, a skewed or a
    /// one-sided pair is not.
    #[test]
    fn two_triangles_are_a_rectangle() {
        let [a, b, c, d] =
            [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]].map(|[x, z]| Vec3::new(x, 3.0, z));
        for one in [[a, b, c], [b, c, a], [c, a, b]] {
            for other in [[a, c, d], [c, d, a], [d, a, c]] {
                assert_eq!(rectangle(&[one, other]), Some([a, b - a, d - a]));
            }
        }
        assert_eq!(rectangle(&[[a, b, c], [a, d, c]]), None);
        assert_eq!(rectangle(&[[a, b, c], [a, c, d + Vec3::Y * 1e-3]]), None);
        assert_eq!(rectangle(&[[a, b, c], [a, c, d - Vec3::X * 1e-3]]), None);
        assert_eq!(rectangles(&[[a, b, c]]), None);
        assert_eq!(rectangles(&[[a, b, c], [a, c, d]]).map(|all| all.len()), Some(1));
    }
}
