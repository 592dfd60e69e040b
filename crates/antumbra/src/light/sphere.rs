//! A sphere that shines outwards.

use antumbra_math::{DVec3, Rgb, World, closed, real, solid_angle, warp};
use antumbra_trace::{NO_PRIM, PrimId, Shape};

use super::flat::{amount_fault, lifted};
use super::{End, LightBounds, LightHit, LightKind, LightPoints, LightSample, LightSurface, OutlinePoint};
use crate::density::Density;
use crate::receiver::Receiver;

/// A sphere light; black from inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: World,
    /// Radius r.
    pub radius: f32,
    /// Radiance L_e [W·m⁻²·sr⁻¹], the same in every direction.
    pub radiance: Rgb,
    prim: PrimId,
}

impl Sphere {
    /// A sphere that shines outwards.
    pub fn new(center: World, radius: f32, radiance: Rgb) -> Sphere {
        Sphere { center, radius, radiance, prim: NO_PRIM }
    }

    /// The sphere as p sees it; `None` from inside or on it.
    #[inline]
    fn seen(&self, p: World) -> Option<Seen> {
        let to_center = self.center.as_dvec3() - p.as_dvec3();
        let distance2 = to_center.length_squared();
        let radius = f64::from(self.radius);
        let versin = solid_angle::ball_versin(radius, distance2)?;
        Some(Seen { to_center, distance: distance2.sqrt(), radius, versin })
    }

    /// Where a segment to the point c + r n ends.
    #[inline]
    fn end(&self, n: DVec3) -> End {
        let (center, radius) = (self.center.as_dvec3(), f64::from(self.radius));
        End::Point(lifted(center + n * radius, n, center.abs().max_element() + radius))
    }

    /// The point c + r n as a sample along `wi`.
    #[inline]
    fn arrive(&self, wi: DVec3, distance: f64, n: DVec3, pdf: f64) -> Option<LightSample> {
        let pdf = pdf as f32;
        (pdf > 0.0 && pdf.is_finite()).then(|| LightSample {
            wi: wi.as_vec3(),
            end: self.end(n),
            distance: distance as f32,
            radiance: self.radiance,
            density: Density::SolidAngle(pdf),
            prim: self.prim,
            cos: n.dot(-wi).abs() as f32,
        })
    }
}

/// The cone that a sphere fills.
struct Seen {
    to_center: DVec3,
    distance: f64,
    radius: f64,
    /// 1 − cos α.
    versin: f64,
}

impl Seen {
    /// How far along `wi` the sphere begins; the nearest point of the silhouette if rounding missed it.
    #[inline]
    fn reach(&self, wi: DVec3) -> f64 {
        let along = self.to_center.dot(wi);
        let off2 = (self.to_center - wi * along).length_squared();
        along - (self.radius * self.radius - off2).max(0.0).sqrt()
    }

    /// The outward normal of the point at distance t along `wi`.
    #[inline]
    fn normal(&self, wi: DVec3, t: f64) -> DVec3 {
        (wi * t - self.to_center).normalize()
    }
}

impl LightKind for Sphere {
    /// Solid angle: a direction of the cone, p(ω) = 1 / (2π (1 − cos α)). Area: a point of the whole sphere, no light if
    /// it faces away, p(ω) = d² / (4π r² cos θ′).
    #[inline]
    fn sample(&self, at: &Receiver, u: [f32; 2], how: LightPoints) -> Option<LightSample> {
        let seen = self.seen(at.p)?;
        if how != LightPoints::Area {
            let axis = seen.to_center / seen.distance;
            let (s, t) = axis.any_orthonormal_pair();
            let l = warp::cone(u, seen.versin as f32).0.as_dvec3();
            let wi = (s * l.x + t * l.y + axis * l.z).normalize();
            let distance = seen.reach(wi);
            return self.arrive(
                wi,
                distance,
                seen.normal(wi, distance),
                1.0 / solid_angle::cone(seen.versin),
            );
        }
        let n = warp::sphere(u).0.as_dvec3().normalize();
        let to_light = seen.to_center + n * seen.radius;
        let distance2 = to_light.length_squared();
        let distance = distance2.sqrt();
        let wi = to_light / distance;
        let cos = -wi.dot(n);
        let area = 4.0 * std::f64::consts::PI * seen.radius * seen.radius;
        if cos > 0.0 { self.arrive(wi, distance, n, distance2 / (area * cos)) } else { None }
    }

    /// Its far side is not seen.
    fn even(&self) -> LightPoints {
        LightPoints::SolidAngle
    }

    #[inline]
    fn pdf(&self, at: &Receiver, wi: World, how: LightPoints) -> f32 {
        let (Some(seen), Some(_)) = (self.seen(at.p), self.hit(at.p, wi)) else { return 0.0 };
        if how != LightPoints::Area {
            return (1.0 / solid_angle::cone(seen.versin)) as f32;
        }
        let wi = wi.as_dvec3();
        let t = seen.reach(wi);
        let cos = -wi.dot(seen.normal(wi, t));
        let area = 4.0 * std::f64::consts::PI * seen.radius * seen.radius;
        if cos > 0.0 { (t * t / (area * cos)) as f32 } else { 0.0 }
    }

    #[inline]
    fn hit(&self, from: World, wi: World) -> Option<LightHit> {
        let seen = self.seen(from)?;
        let wi = wi.as_dvec3();
        let along = seen.to_center.dot(wi);
        let off2 = (seen.to_center - wi * along).length_squared();
        (along > 0.0 && off2 <= seen.radius * seen.radius)
            .then(|| LightHit { distance: seen.reach(wi) as f32, radiance: self.radiance })
    }

    #[inline]
    fn end_along(&self, from: World, wi: World) -> Option<(End, PrimId)> {
        self.hit(from, wi)?;
        let (seen, wi) = (self.seen(from)?, wi.as_dvec3());
        Some((self.end(seen.normal(wi, seen.reach(wi))), self.prim))
    }

    fn emitted(&self, _wi: World, front: bool) -> Rgb {
        if front { self.radiance } else { Rgb::BLACK }
    }

    /// π sin²α cos θ, cut by the horizon (`closed::cone`).
    fn irradiance(&self, at: &Receiver) -> f32 {
        self.seen(at.p).map_or(0.0, |seen| {
            let cos = seen.to_center.dot(at.ng.as_dvec3()) / seen.distance;
            closed::cone(seen.versin, cos) as f32 * self.radiance.luminance()
        })
    }

    /// π L_e · 4π r².
    fn power(&self, _scene_radius: f32) -> f32 {
        let area = 4.0 * real::PI * self.radius * self.radius;
        real::PI * area * self.radiance.luminance()
    }

    fn bounds(&self) -> LightBounds {
        let half = World::splat(self.radius);
        LightBounds { low: self.center - half, high: self.center + half, axis: World::Y, cos_spread: -1.0 }
    }

    /// The circle in which the tangents from p touch: c − (r²/d) ω_c ± r √(1 − r²/d²).
    fn outline(&self, at: &Receiver, u: f32) -> Option<OutlinePoint> {
        let seen = self.seen(at.p)?;
        let axis = seen.to_center / seen.distance;
        let (s, t) = axis.any_orthonormal_pair();
        let phi = 2.0 * std::f64::consts::PI * f64::from(u);
        let sin = seen.radius / seen.distance;
        let around = (s * real::cos(phi) + t * real::sin(phi)) * (1.0 - sin * sin).max(0.0).sqrt();
        let n = (around - axis * sin).normalize();
        let to_rim = seen.to_center + n * seen.radius;
        let center = self.center.as_dvec3();
        let extent = center.abs().max_element() + seen.radius;
        let end = End::Point(lifted(center + n * seen.radius, n, extent));
        Some(OutlinePoint { wi: to_rim.normalize().as_vec3(), end })
    }

    fn surface(&self) -> Option<LightSurface> {
        Some(LightSurface::Shape(Shape::Sphere { center: self.center.to_array(), radius: self.radius }))
    }

    fn fault(&self) -> Option<String> {
        if !self.center.is_finite() || !self.radius.is_finite() || self.radius <= 0.0 {
            return Some(format!("its centre {} or radius {} is not usable", self.center, self.radius));
        }
        amount_fault(self.radiance)
    }

    fn set_first_prim(&mut self, first: PrimId) {
        self.prim = first;
    }

    fn examples() -> Vec<Sphere> {
        let lamp = Sphere::new(World::new(0.5, 2.0, -0.3), 0.5, Rgb::new(5.0, 4.0, 3.0));
        let large = Sphere::new(World::new(3.0, 0.0, 0.0), 2.5, Rgb::WHITE);
        let small = Sphere::new(World::new(0.0, 3.0, 1.0), 0.01, Rgb::grey(1000.0));
        vec![lamp, large, small]
    }
}
