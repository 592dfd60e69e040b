//! A disk that shines from its front, the side of its normal.

use antumbra_math::{DVec2, DVec3, Rgb, World, closed, real, warp};
use antumbra_trace::{NO_PRIM, PrimId, Shape};

use super::far::Far;
use super::flat::{Front, lies_on};
use super::square::Square;
use super::{End, LightBounds, LightHit, LightKind, LightPoints, LightSample, LightSurface, OutlinePoint};
use crate::receiver::Receiver;

/// A disk light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    /// Centre.
    pub center: World,
    /// Normal of the front, of any length above 0.
    pub normal: World,
    /// Radius R.
    pub radius: f32,
    /// Radiance L_e [W·m⁻²·sr⁻¹], the same in every direction.
    pub radiance: Rgb,
    /// The back shines too.
    pub both_sides: bool,
    prim: PrimId,
}

impl Disk {
    /// A disk that shines from the side of its normal.
    pub fn new(center: World, normal: World, radius: f32, radiance: Rgb) -> Disk {
        Disk { center, normal, radius, radiance, both_sides: false, prim: NO_PRIM }
    }

    /// Whether the back shines too.
    pub fn both_sides(self, both_sides: bool) -> Disk {
        Disk { both_sides, ..self }
    }

    #[inline]
    fn front(&self) -> Front {
        let radius = f64::from(self.radius);
        Front {
            n: self.normal.as_dvec3().normalize(),
            area: std::f64::consts::PI * radius * radius,
            extent: self.center.as_dvec3().abs().max_element() + radius,
            radiance: self.radiance,
            both_sides: self.both_sides,
        }
    }

    /// The point of the disk at (x, y) of the unit disk.
    #[inline]
    fn point(&self, n: DVec3, x: f32, y: f32) -> DVec3 {
        let (s, t) = n.any_orthonormal_pair();
        self.center.as_dvec3() + (s * f64::from(x) + t * f64::from(y)) * f64::from(self.radius)
    }
    /// q, or its foot in the plane, as a point (x, y) of the unit disk.
    #[inline]
    fn place(&self, q: DVec3) -> DVec2 {
        let (s, t) = self.front().n.any_orthonormal_pair();
        let d = q - self.center.as_dvec3();
        DVec2::new(d.dot(s), d.dot(t)) / f64::from(self.radius)
    }

    /// How points are drawn over the square that is bent onto the disk.
    #[inline]
    fn square(&self, p: DVec3, how: LightPoints) -> Square {
        Square::of(how, || {
            let near = self.place(p).clamp_length_max(1.0);
            let front = self.front();
            let distance = (self.point(front.n, near.x as f32, near.y as f32) - p).length();
            let width = 2.0 * f64::from(self.radius);
            (DVec2::from(warp::disk_inverse(near.into())), DVec2::splat(distance / width))
        })
    }
}

/// Edges of the polygon around a disk that the horizon cuts.
const EDGES: usize = 16;
/// Cosine and sine of a sixteenth of a turn.
const COS_STEP: f64 = 0.923_879_532_511_286_7;
const SIN_STEP: f64 = 0.382_683_432_365_089_8;
/// Cosine of half of that.
const COS_HALF_STEP: f64 = 0.980_785_280_403_230_4;

impl LightKind for Disk {
    /// Uniform on the area for both ways of drawing (the solid angle of a disk has no elementary map):
    /// p(ω) = r² / (A cos θ′), times the density over the square.
    #[inline]
    fn sample(&self, at: &Receiver, u: [f32; 2], how: LightPoints) -> Option<LightSample> {
        if lies_on(at, self.prim, 1) {
            return None;
        }
        let (front, square) = (self.front(), self.square(at.p.as_dvec3(), how));
        let x = square.sample(u.map(f64::from));
        let d = warp::disk(x.map(|x| x as f32));
        front.drawn(square.pdf(x)).sample(at.p, self.point(front.n, d.x, d.y), self.prim, None)
    }

    #[inline]
    fn pdf(&self, at: &Receiver, wi: World, how: LightPoints) -> f32 {
        let Some(hit) = self.hit(at.p, wi) else { return 0.0 };
        let (p, wi, distance) = (at.p.as_dvec3(), wi.as_dvec3(), f64::from(hit.distance));
        let density = match self.square(p, how) {
            Square::Even => 1.0,
            square => square.pdf(warp::disk_inverse(self.place(p + wi * distance).into())),
        };
        self.front().drawn(density).area_pdf(wi, distance)
    }

    #[inline]
    fn hit(&self, from: World, wi: World) -> Option<LightHit> {
        let (o, d, c) = (from.as_dvec3(), wi.as_dvec3(), self.center.as_dvec3());
        let front = self.front();
        let distance = front.plane_distance(o, d, c)?;
        let inside = (o + d * distance - c).length_squared() <= f64::from(self.radius * self.radius);
        if inside { front.hit(d, distance) } else { None }
    }

    #[inline]
    fn end_along(&self, from: World, wi: World) -> Option<(End, PrimId)> {
        self.hit(from, wi)?;
        let (o, d, front) = (from.as_dvec3(), wi.as_dvec3(), self.front());
        let distance = front.plane_distance(o, d, self.center.as_dvec3())?;
        Some((front.end(o + d * distance, d), self.prim))
    }

    fn emitted(&self, _wi: World, front: bool) -> Rgb {
        self.front().emitted(front)
    }

    /// Exact above the horizon; cut by it, a little more: that of the polygon of 16 edges around it.
    fn irradiance(&self, at: &Receiver) -> f32 {
        let front = self.front();
        let (c, n) = (self.center.as_dvec3() - at.p.as_dvec3(), at.ng.as_dvec3());
        let radius = f64::from(self.radius);
        let tilt = n.dot(front.n);
        let reach = radius * (1.0 - tilt * tilt).max(0.0).sqrt();
        let height = n.dot(c);
        if height >= reach {
            return front.irradiance(closed::disk(c, front.n, radius, n));
        }
        if height <= -reach {
            return 0.0;
        }
        let (s, t) = front.n.any_orthonormal_pair();
        let around = radius / COS_HALF_STEP;
        let mut spoke = (1.0, 0.0);
        // Counter-clockwise seen from the front: n = s × t.
        let corners: [DVec3; EDGES] = std::array::from_fn(|_| {
            let (x, y) = spoke;
            spoke = (x * COS_STEP - y * SIN_STEP, x * SIN_STEP + y * COS_STEP);
            c + (s * x + t * y) * around
        });
        front.irradiance(closed::polygon(&corners, n))
    }

    #[inline]
    fn far(&self) -> Option<Far> {
        let reach2 = self.radius * self.radius;
        Some(Far {
            middle: self.center,
            area: self.normal.normalize() * (real::PI * reach2),
            reach2,
            both_sides: self.both_sides,
            luminance: self.radiance.luminance(),
        })
    }

    fn power(&self, _scene_radius: f32) -> f32 {
        self.front().power()
    }

    /// Half-width of the box along axis i: R √(1 − nᵢ²).
    fn bounds(&self) -> LightBounds {
        let n = self.front().n.as_vec3();
        let half = (World::ONE - n * n).max(World::ZERO).map(f32::sqrt) * (self.radius * (1.0 + 1e-6));
        self.front().bounds(&[self.center - half, self.center + half])
    }

    /// Its rim.
    fn outline(&self, at: &Receiver, u: f32) -> Option<OutlinePoint> {
        let front = self.front();
        let phi = 2.0 * real::PI * u;
        front.outline(at.p, self.point(front.n, real::cosf(phi), real::sinf(phi)))
    }

    fn surface(&self) -> Option<LightSurface> {
        Some(LightSurface::Shape(Shape::Disk {
            center: self.center.to_array(),
            normal: self.normal.to_array(),
            radius: self.radius,
        }))
    }

    fn fault(&self) -> Option<String> {
        if !self.center.is_finite() || !self.radius.is_finite() || self.radius <= 0.0 {
            return Some(format!("its centre {} or radius {} is not usable", self.center, self.radius));
        }
        self.front().fault("the disk")
    }

    fn set_first_prim(&mut self, first: PrimId) {
        self.prim = first;
    }

    fn examples() -> Vec<Disk> {
        let lamp =
            Disk::new(World::new(0.3, 2.0, 0.0), World::new(0.0, -1.0, 0.2), 1.0, Rgb::new(4.0, 3.0, 2.0));
        let wall = Disk::new(World::new(1.5, 0.2, 0.0), World::new(-2.0, 0.0, 0.0), 1.0, Rgb::WHITE);
        vec![lamp, wall.both_sides(true)]
    }
}
