//! A rectangle (or any parallelogram) that shines from its front, the side of u × v.

use antumbra_math::spherical::{SphericalRectangle, SphericalTriangle};
use antumbra_math::{DVec2, DVec3, Rgb, World, closed};
use antumbra_trace::{NO_PRIM, PrimId};

use super::far::Far;
use super::flat::{Front, along_edges, largest, lies_on};
use super::square::Square;
use super::{End, LightBounds, LightHit, LightKind, LightPoints, LightSample, LightSurface, OutlinePoint};
use crate::receiver::Receiver;

/// A rectangle light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// One corner.
    pub corner: World,
    /// The edge to the next corner.
    pub u: World,
    /// The edge to the previous corner.
    pub v: World,
    /// Radiance L_e [W·m⁻²·sr⁻¹], the same in every direction.
    pub radiance: Rgb,
    /// The back shines too.
    pub both_sides: bool,
    first_prim: PrimId,
    sides: Sides,
}

/// What follows from its edges, once for all samples.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sides {
    /// Unit edges and their lengths.
    edges: [DVec3; 2],
    lengths: [f64; 2],
    /// Unit normal of the front, area, largest coordinate.
    n: DVec3,
    area: f64,
    extent: f64,
    /// u ⊥ v.
    right: bool,
}

impl Sides {
    fn of(corner: DVec3, u: DVec3, v: DVec3) -> Sides {
        let (cross, lengths) = (u.cross(v), [u.length(), v.length()]);
        let area = cross.length();
        Sides {
            edges: [u / lengths[0], v / lengths[1]],
            lengths,
            n: cross / area,
            area,
            extent: largest(&[corner, corner + u, corner + u + v, corner + v]),
            right: u.dot(v).abs() <= 1e-6 * (lengths[0] * lengths[1]),
        }
    }
}

/// How the solid angle is drawn: one density 1/Ω, by whichever form keeps its digits.
enum Seen {
    Rectangle(SphericalRectangle),
    /// Fanned about the corner, so that the map of the square is continuous across the diagonal.
    Triangles([Option<SphericalTriangle>; 2]),
}

impl Rectangle {
    /// The rectangle corner + α u + β v, α and β in [0, 1], shining from the side of u × v.
    pub fn new(corner: World, u: World, v: World, radiance: Rgb) -> Rectangle {
        let sides = Sides::of(corner.as_dvec3(), u.as_dvec3(), v.as_dvec3());
        Rectangle { corner, u, v, radiance, both_sides: false, first_prim: NO_PRIM, sides }
    }

    /// Whether the back shines too.
    pub fn both_sides(self, both_sides: bool) -> Rectangle {
        Rectangle { both_sides, ..self }
    }

    /// The corners as the world stores them, in f32.
    fn corners(&self) -> [World; 4] {
        [self.corner, self.corner + self.u, self.corner + (self.u + self.v), self.corner + self.v]
    }

    #[inline]
    fn edges(&self) -> (DVec3, DVec3, DVec3) {
        (self.corner.as_dvec3(), self.u.as_dvec3(), self.v.as_dvec3())
    }

    #[inline]
    fn front(&self) -> Front {
        let Sides { n, area, extent, .. } = self.sides;
        Front { n, area, extent, radiance: self.radiance, both_sides: self.both_sides }
    }

    /// The primitive under the point (α, β): the triangle below the diagonal or the one above.
    #[inline]
    fn prim(&self, [alpha, beta]: [f64; 2]) -> PrimId {
        if self.first_prim != NO_PRIM && beta > alpha { self.first_prim + 1 } else { self.first_prim }
    }

    /// How points are drawn over (α, β).
    #[inline]
    fn square(&self, p: DVec3, how: LightPoints) -> Square {
        Square::of(how, || {
            let (corner, u, v) = self.edges();
            let (n, to) = (u.cross(v), p - corner);
            let foot = DVec2::new(to.cross(v).dot(n), -to.cross(u).dot(n)) / n.length_squared();
            let near = foot.clamp(DVec2::ZERO, DVec2::ONE);
            let distance = (corner + u * near.x + v * near.y - p).length();
            (near, distance / DVec2::from(self.sides.lengths))
        })
    }

    /// p lies where the light shines.
    #[inline]
    fn faces(&self, p: DVec3) -> bool {
        let height = (p - self.corner.as_dvec3()).dot(self.sides.n);
        height > 0.0 || (self.both_sides && height < 0.0)
    }

    /// The spherical rectangle where u ⊥ v and its angles keep their digits, else two spherical triangles.
    #[inline]
    fn seen(&self, p: DVec3) -> Seen {
        let (corner, u, v) = self.edges();
        let a = corner - p;
        let Sides { edges, lengths, right, .. } = self.sides;
        if right && let Some(rectangle) = SphericalRectangle::of_sides(a, edges, lengths) {
            return Seen::Rectangle(rectangle);
        }
        let [b, c, d] = [a + u, a + u + v, a + v];
        let triangle = SphericalTriangle::new;
        Seen::Triangles(if a.dot(u.cross(v)) < 0.0 {
            [triangle(d, a, c), triangle(c, a, b)]
        } else {
            [triangle(b, a, c), triangle(c, a, d)]
        })
    }
}

impl Seen {
    /// Ω, above 0; `None` if no digit of it is left: then points are drawn by area.
    #[inline]
    fn solid_angle(&self) -> Option<f64> {
        match self {
            Seen::Rectangle(r) => Some(r.solid_angle),
            Seen::Triangles(two) => {
                let sum: f64 = two.iter().flatten().map(|t| t.solid_angle).sum();
                (sum > 0.0).then_some(sum)
            }
        }
    }
}

/// The part of `two` that u₀ falls into, with u₀ stretched over it.
#[inline]
fn choose(two: &[Option<SphericalTriangle>; 2], u: f64) -> Option<(SphericalTriangle, f64)> {
    let omega = two.map(|t| t.map_or(0.0, |t| t.solid_angle));
    let x = u * (omega[0] + omega[1]);
    match two {
        [Some(first), _] if x < omega[0] => Some((*first, x / omega[0])),
        [_, Some(second)] => Some((*second, ((x - omega[0]) / omega[1]).min(1.0))),
        [first, None] => first.map(|t| (t, u)),
    }
}

impl LightKind for Rectangle {
    /// Solid angle: Ureña, Fajardo and King 2013, or Arvo 1995 on two triangles. Area: p(ω) = r² / (A cos θ′), times the
    /// density over (α, β).
    #[inline]
    fn sample(&self, at: &Receiver, u: [f32; 2], how: LightPoints) -> Option<LightSample> {
        let p = at.p.as_dvec3();
        if !self.faces(p) || lies_on(at, self.first_prim, 2) {
            return None;
        }
        let front = self.front();
        let (corner, eu, ev) = self.edges();
        let u = u.map(f64::from);
        let on = |[alpha, beta]: [f64; 2]| corner + eu * alpha + ev * beta;
        if how != LightPoints::SolidAngle {
            let square = self.square(p, how);
            let ab = square.sample(u);
            return front.drawn(square.pdf(ab)).sample(at.p, on(ab), self.prim(ab), None);
        }
        match self.seen(p) {
            Seen::Rectangle(r) => {
                let ab = r.sample(u);
                front.sample(at.p, on(ab), self.prim(ab), Some(1.0 / r.solid_angle))
            }
            seen @ Seen::Triangles(two) => {
                let Some((triangle, u0)) = choose(&two, u[0]) else {
                    return front.sample(at.p, on(u), self.prim(u), None);
                };
                let wi = triangle.sample([u0, u[1]]);
                let ab = self.meet(p, wi)?.0.map(|x| x.clamp(0.0, 1.0));
                front.sample(at.p, on(ab), self.prim(ab), seen.solid_angle().map(|omega| 1.0 / omega))
            }
        }
    }

    #[inline]
    fn pdf(&self, at: &Receiver, wi: World, how: LightPoints) -> f32 {
        let Some(hit) = self.hit(at.p, wi) else { return 0.0 };
        let (p, wi) = (at.p.as_dvec3(), wi.as_dvec3());
        let solid_angle = match how {
            LightPoints::SolidAngle => self.seen(p).solid_angle(),
            _ => None,
        };
        if let Some(omega) = solid_angle {
            return (1.0 / omega) as f32;
        }
        let density = match (how, self.meet(p, wi)) {
            (LightPoints::SolidAngle | LightPoints::Area, _) | (_, None) => 1.0,
            (how, Some((ab, _))) => self.square(p, how).pdf(ab),
        };
        self.front().drawn(density).area_pdf(wi, f64::from(hit.distance))
    }

    #[inline]
    fn hit(&self, from: World, wi: World) -> Option<LightHit> {
        let (ab, distance) = self.meet(from.as_dvec3(), wi.as_dvec3())?;
        let inside = ab.iter().all(|x| (0.0..=1.0).contains(x));
        if inside { self.front().hit(wi.as_dvec3(), distance) } else { None }
    }

    #[inline]
    fn end_along(&self, from: World, wi: World) -> Option<(End, PrimId)> {
        self.hit(from, wi)?;
        let (o, d) = (from.as_dvec3(), wi.as_dvec3());
        let (ab, distance) = self.meet(o, d)?;
        Some((self.front().end(o + d * distance, d), self.prim(ab)))
    }

    fn emitted(&self, _wi: World, front: bool) -> Rgb {
        self.front().emitted(front)
    }

    /// Lambert's sum over the edges, clipped by the horizon.
    fn irradiance(&self, at: &Receiver) -> f32 {
        let (corner, u, v) = self.edges();
        let a = corner - at.p.as_dvec3();
        let corners = [a, a + u, a + u + v, a + v];
        self.front().irradiance(closed::polygon(&corners, at.ng.as_dvec3()))
    }

    #[inline]
    fn far(&self) -> Option<Far> {
        let (u, v) = (self.u, self.v);
        Some(Far {
            middle: self.corner + 0.5 * (u + v),
            area: u.cross(v),
            reach2: 0.25 * (u.length_squared() + v.length_squared() + 2.0 * u.dot(v).abs()),
            both_sides: self.both_sides,
            luminance: self.radiance.luminance(),
        })
    }

    fn power(&self, _scene_radius: f32) -> f32 {
        self.front().power()
    }

    fn bounds(&self) -> LightBounds {
        self.front().bounds(&self.corners())
    }

    /// Along its edges, a quarter of u each.
    fn outline(&self, at: &Receiver, u: f32) -> Option<OutlinePoint> {
        self.front().outline(at.p, along_edges(&self.corners().map(|x| x.as_dvec3()), u))
    }

    /// Two triangles, below and above the diagonal from the corner.
    fn surface(&self) -> Option<LightSurface> {
        let [a, b, c, d] = self.corners().map(|x| x.to_array());
        Some(LightSurface::Triangles(vec![[a, b, c], [a, c, d]]))
    }

    fn fault(&self) -> Option<String> {
        let lost = !self.corner.is_finite();
        let lost = lost.then(|| format!("its corner {} is not finite", self.corner));
        lost.or_else(|| self.front().fault("the rectangle"))
    }

    fn set_first_prim(&mut self, first: PrimId) {
        self.first_prim = first;
    }

    fn examples() -> Vec<Rectangle> {
        let at = World::new;
        let (u, v) = (at(2.0, 0.0, 0.0), at(0.0, 0.0, 2.0));
        // Over the origin, facing down.
        let ceiling = Rectangle::new(at(-1.0, 1.5, -1.0), u, v, Rgb::new(1.0, 2.0, 3.0));
        let sheared = Rectangle::new(at(0.5, 0.2, -1.0), at(0.0, 1.0, 0.4), at(0.3, 0.0, 2.0), Rgb::WHITE);
        let strip = Rectangle::new(at(-5.0, 1.0, 0.2), at(10.0, 0.0, 0.0), at(0.0, 0.0, 0.01), Rgb::WHITE);
        vec![ceiling, sheared.both_sides(true), strip]
    }
}

impl Rectangle {
    /// Where along `wi` its plane lies, as (α, β), and how far.
    #[inline]
    fn meet(&self, p: DVec3, wi: DVec3) -> Option<([f64; 2], f64)> {
        let (corner, u, v) = self.edges();
        let n = u.cross(v);
        let det = wi.dot(n);
        let a = corner - p;
        let distance = a.dot(n) / det;
        // p + t ω = corner + α u + β v.
        let alpha = a.cross(wi).dot(v) / det;
        let beta = -a.cross(wi).dot(u) / det;
        (distance > 0.0 && distance.is_finite()).then_some(([alpha, beta], distance))
    }
}
