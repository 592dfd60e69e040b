//! A triangle that shines from its front, the side on which a, b, c run counter-clockwise.

use antumbra_math::spherical::SphericalTriangle;
use antumbra_math::{DVec2, DVec3, Rgb, World, closed, warp};
use antumbra_trace::{NO_PRIM, PrimId};

use super::far::Far;
use super::flat::{Front, along_edges, largest, lies_on};
use super::square::Square;
use super::{End, LightBounds, LightHit, LightKind, LightPoints, LightSample, LightSurface, OutlinePoint};
use crate::receiver::Receiver;

/// A triangle light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// First corner.
    pub a: World,
    /// Second corner.
    pub b: World,
    /// Third corner.
    pub c: World,
    /// Radiance L_e [W·m⁻²·sr⁻¹], the same in every direction.
    pub radiance: Rgb,
    /// The back shines too.
    pub both_sides: bool,
    first_prim: PrimId,
}

impl Triangle {
    /// A triangle that shines from the side of (b−a) × (c−a).
    pub fn new(a: World, b: World, c: World, radiance: Rgb) -> Triangle {
        Triangle { a, b, c, radiance, both_sides: false, first_prim: NO_PRIM }
    }

    /// Whether the back shines too.
    pub fn both_sides(self, both_sides: bool) -> Triangle {
        Triangle { both_sides, ..self }
    }

    #[inline]
    fn corners(&self) -> [DVec3; 3] {
        [self.a.as_dvec3(), self.b.as_dvec3(), self.c.as_dvec3()]
    }

    #[inline]
    fn front(&self) -> Front {
        let corners = self.corners();
        let [a, b, c] = corners;
        let cross = (b - a).cross(c - a);
        let twice = cross.length();
        Front {
            n: cross / twice,
            area: 0.5 * twice,
            extent: largest(&corners),
            radiance: self.radiance,
            both_sides: self.both_sides,
        }
    }

    /// The weights of the second and third corner at q, or at its foot in the plane.
    #[inline]
    fn weights(&self, q: DVec3) -> [f64; 2] {
        let [a, b, c] = self.corners();
        let (e, f, to) = (b - a, c - a, q - a);
        let n = e.cross(f);
        [to.cross(f).dot(n), e.cross(to).dot(n)].map(|x| x / n.length_squared())
    }

    /// How points are drawn over the square that is folded onto the triangle.
    #[inline]
    fn square(&self, p: DVec3, how: LightPoints) -> Square {
        Square::of(how, || {
            let [v, w] = self.weights(p).map(|x| x.max(0.0));
            // From outside, about the nearest point: the foot drawn onto the triangle toward its first corner.
            let shrink = (v + w).max(1.0);
            let [v, w] = [v / shrink, w / shrink];
            let [a, b, c] = self.corners();
            let distance = (a + (b - a) * v + (c - a) * w - p).length();
            let [x, y] = warp::triangle_inverse([v, w]);
            (DVec2::new(x, y), DVec2::new(distance / (b - a).length(), distance / (c - a).length()))
        })
    }

    /// The triangle as p sees it, its seen side counter-clockwise; `None` where it does not shine or looks so small that
    /// no digit of its solid angle is left: then points are drawn by area.
    #[inline]
    fn seen(&self, p: DVec3) -> Option<SphericalTriangle> {
        let [a, b, c] = self.corners().map(|x| x - p);
        SphericalTriangle::new(a, b, c)
            .or_else(|| if self.both_sides { SphericalTriangle::new(a, c, b) } else { None })
    }
}

impl LightKind for Triangle {
    /// Solid angle: Arvo 1995. Area: p(ω) = r² / (A cos θ′).
    #[inline]
    fn sample(&self, at: &Receiver, u: [f32; 2], how: LightPoints) -> Option<LightSample> {
        if lies_on(at, self.first_prim, 1) {
            return None;
        }
        let front = self.front();
        let [a, b, c] = self.corners();
        if how == LightPoints::SolidAngle
            && let Some(seen) = self.seen(at.p.as_dvec3())
        {
            let p = at.p.as_dvec3();
            let wi = seen.sample(u.map(f64::from));
            let q = p + wi * front.plane_distance(p, wi, a)?;
            return front.sample(at.p, q, self.first_prim, Some(1.0 / seen.solid_angle));
        }
        let square = self.square(at.p.as_dvec3(), how);
        let x = square.sample(u.map(f64::from));
        let [v, w] = warp::triangle(x.map(|x| x as f32)).map(f64::from);
        let q = a + (b - a) * v + (c - a) * w;
        front.drawn(square.pdf(x)).sample(at.p, q, self.first_prim, None)
    }

    #[inline]
    fn pdf(&self, at: &Receiver, wi: World, how: LightPoints) -> f32 {
        let Some(hit) = self.hit(at.p, wi) else { return 0.0 };
        if how == LightPoints::SolidAngle
            && let Some(seen) = self.seen(at.p.as_dvec3())
        {
            return (1.0 / seen.solid_angle) as f32;
        }
        let (p, wi) = (at.p.as_dvec3(), wi.as_dvec3());
        let density = match self.square(p, how) {
            Square::Even => 1.0,
            square => square.pdf(warp::triangle_inverse(self.weights(p + wi * f64::from(hit.distance)))),
        };
        self.front().drawn(density).area_pdf(wi, f64::from(hit.distance))
    }

    /// The plane, then the three signs of the triangle law.
    #[inline]
    fn hit(&self, from: World, wi: World) -> Option<LightHit> {
        let (o, d) = (from.as_dvec3(), wi.as_dvec3());
        let [a, b, c] = self.corners();
        let w = [(a, b), (b, c), (c, a)].map(|(x, y)| d.dot((x - o).cross(y - o)));
        let inside = w.iter().all(|w| *w >= 0.0) || w.iter().all(|w| *w <= 0.0);
        let front = self.front();
        if inside { front.hit(d, front.plane_distance(o, d, a)?) } else { None }
    }

    #[inline]
    fn end_along(&self, from: World, wi: World) -> Option<(End, PrimId)> {
        self.hit(from, wi)?;
        let (o, d, front) = (from.as_dvec3(), wi.as_dvec3(), self.front());
        let distance = front.plane_distance(o, d, self.a.as_dvec3())?;
        Some((front.end(o + d * distance, d), self.first_prim))
    }

    fn emitted(&self, _wi: World, front: bool) -> Rgb {
        self.front().emitted(front)
    }

    /// Lambert's sum over the edges, clipped by the horizon.
    fn irradiance(&self, at: &Receiver) -> f32 {
        let p = at.p.as_dvec3();
        let corners = self.corners().map(|x| x - p);
        self.front().irradiance(closed::polygon(&corners, at.ng.as_dvec3()))
    }

    #[inline]
    fn far(&self) -> Option<Far> {
        let middle = (self.a + self.b + self.c) / 3.0;
        let reach = |x: World| (x - middle).length_squared();
        Some(Far {
            middle,
            area: 0.5 * (self.b - self.a).cross(self.c - self.a),
            reach2: reach(self.a).max(reach(self.b)).max(reach(self.c)),
            both_sides: self.both_sides,
            luminance: self.radiance.luminance(),
        })
    }

    fn power(&self, _scene_radius: f32) -> f32 {
        self.front().power()
    }

    fn bounds(&self) -> LightBounds {
        self.front().bounds(&[self.a, self.b, self.c])
    }

    /// Along its edges, a third of u each.
    fn outline(&self, at: &Receiver, u: f32) -> Option<OutlinePoint> {
        self.front().outline(at.p, along_edges(&self.corners(), u))
    }

    fn surface(&self) -> Option<LightSurface> {
        Some(LightSurface::Triangles(vec![[self.a, self.b, self.c].map(|x| x.to_array())]))
    }

    fn fault(&self) -> Option<String> {
        self.front().fault("the triangle")
    }

    fn set_first_prim(&mut self, first: PrimId) {
        self.first_prim = first;
    }

    fn examples() -> Vec<Triangle> {
        let at = World::new;
        let plain =
            Triangle::new(at(1.0, 2.0, 0.5), at(-1.5, 2.5, 1.0), at(0.2, 1.8, -1.4), Rgb::new(3.0, 2.0, 1.0));
        let sliver = Triangle::new(at(-4.0, 1.0, 0.3), at(4.0, 1.0, 0.3), at(0.0, 1.0, 0.29), Rgb::WHITE);
        vec![plain, sliver, plain.both_sides(true)]
    }
}
