//! What triangle, rectangle and disk share: a point on a flat front, and how it is seen.

use antumbra_math::{DVec3, Rgb, World};
use antumbra_trace::{NO_PRIM, PrimId, start};

use super::{End, LightBounds, LightHit, LightSample, OutlinePoint};
use crate::density::Density;
use crate::receiver::Receiver;

/// The plane of a flat light and how far its numbers reach.
#[derive(Clone, Copy)]
pub(super) struct Front {
    /// Unit normal of the front.
    pub n: DVec3,
    /// Area A.
    pub area: f64,
    /// Largest coordinate, for the start offset.
    pub extent: f64,
    /// L_e.
    pub radiance: Rgb,
    /// The back shines too.
    pub both_sides: bool,
}

impl Front {
    /// The same with points that are drawn `density` times as densely as even ones.
    #[inline]
    pub fn drawn(self, density: f64) -> Front {
        Front { area: self.area / density, ..self }
    }

    /// The point q of the light as p sees it, drawn with `solid_angle_pdf`, or with 1/A if that is `None`; `None` where
    /// the light does not shine.
    #[inline]
    pub fn sample(
        &self,
        p: World,
        q: DVec3,
        prim: PrimId,
        solid_angle_pdf: Option<f64>,
    ) -> Option<LightSample> {
        let to_light = q - p.as_dvec3();
        let distance2 = to_light.length_squared();
        let distance = distance2.sqrt();
        let wi = to_light / distance;
        let cos = self.cos(wi)?;
        let pdf = solid_angle_pdf.unwrap_or_else(|| distance2 / (self.area * cos.abs())) as f32;
        (pdf > 0.0 && pdf.is_finite()).then(|| LightSample {
            wi: wi.as_vec3(),
            end: End::Point(lifted(q, self.n * cos.signum(), self.extent)),
            distance: distance as f32,
            radiance: self.radiance,
            density: Density::SolidAngle(pdf),
            prim,
            cos: cos.abs() as f32,
        })
    }

    /// The density of a point drawn with 1/A, met along `wi` at `distance`: r² / (A cos θ′).
    #[inline]
    pub fn area_pdf(&self, wi: DVec3, distance: f64) -> f32 {
        self.cos(wi).map_or(0.0, |cos| (distance * distance / (self.area * cos.abs())) as f32)
    }

    /// What is met at `distance` along `wi`.
    #[inline]
    pub fn hit(&self, wi: DVec3, distance: f64) -> Option<LightHit> {
        self.cos(wi).map(|_| LightHit { distance: distance as f32, radiance: self.radiance })
    }

    /// Where a segment along `wi` ends that meets the light at q.
    #[inline]
    pub fn end(&self, q: DVec3, wi: DVec3) -> End {
        End::Point(lifted(q, self.n * -wi.dot(self.n).signum(), self.extent))
    }

    /// Where along `wi` from p the plane through q lies, if ahead.
    #[inline]
    pub fn plane_distance(&self, p: DVec3, wi: DVec3, q: DVec3) -> Option<f64> {
        let t = (q - p).dot(self.n) / wi.dot(self.n);
        (t > 0.0 && t.is_finite()).then_some(t)
    }

    /// L_e leaving the front or the back.
    #[inline]
    pub fn emitted(&self, front: bool) -> Rgb {
        if front || self.both_sides { self.radiance } else { Rgb::BLACK }
    }

    /// An irradiance of radiance 1, signed by the side, times what that side sends (luminance).
    #[inline]
    pub fn irradiance(&self, signed: f64) -> f32 {
        lit(signed as f32, self.both_sides) * self.radiance.luminance()
    }

    /// π A L_e, twice if both sides shine.
    pub fn power(&self) -> f32 {
        let sides = if self.both_sides { 2.0 } else { 1.0 };
        (std::f64::consts::PI * self.area) as f32 * sides * self.radiance.luminance()
    }

    /// cos θ′ toward where `wi` comes from, negative on a back that shines; `None` on a dark side.
    #[inline]
    fn cos(&self, wi: DVec3) -> Option<f64> {
        let cos = -wi.dot(self.n);
        (cos > 0.0 || (self.both_sides && cos < 0.0)).then_some(cos)
    }

    /// The box of its corners and the half-space that it shines into.
    pub fn bounds(&self, corners: &[World]) -> LightBounds {
        LightBounds {
            low: corners.iter().fold(World::INFINITY, |low, c| low.min(*c)),
            high: corners.iter().fold(World::NEG_INFINITY, |high, c| high.max(*c)),
            axis: self.n.as_vec3(),
            cos_spread: if self.both_sides { -1.0 } else { 0.0 },
        }
    }

    /// The point q of the rim as p sees it, lifted toward p's side.
    pub fn outline(&self, p: World, q: DVec3) -> Option<OutlinePoint> {
        let to_rim = q - p.as_dvec3();
        let toward = self.n * -to_rim.dot(self.n).signum();
        let wi = to_rim.try_normalize()?.as_vec3();
        Some(OutlinePoint { wi, end: End::Point(lifted(q, toward, self.extent)) })
    }

    /// What is wrong with it.
    pub fn fault(&self, what: &str) -> Option<String> {
        if !(self.n.is_finite() && self.area > 0.0 && self.area.is_finite()) {
            Some(format!("{what} has no area, or a number that is not finite"))
        } else {
            amount_fault(self.radiance)
        }
    }
}

/// What is left of a signed irradiance if only the front shines, or both sides.
#[inline]
pub(super) fn lit(signed: f32, both_sides: bool) -> f32 {
    if both_sides { signed.abs() } else { signed.max(0.0) }
}

/// The receiver lies on the flat light itself (primitives `first`, `first` + 1, …), which never lights itself: its own
/// rounding decides on which side of the plane it is.
#[inline]
pub(super) fn lies_on(at: &Receiver, first: PrimId, primitives: u32) -> bool {
    first != NO_PRIM && at.prim.wrapping_sub(first) < primitives
}

/// q lifted by the start offset of LAW §5 toward `n`.
#[inline]
pub(super) fn lifted(q: DVec3, n: DVec3, extent: f64) -> World {
    World::from_array(start::start_on_shape(q.to_array(), n.to_array(), extent))
}

/// A radiance, intensity or irradiance that is negative or not finite.
pub(super) fn amount_fault(amount: Rgb) -> Option<String> {
    let usable = amount.is_finite() && amount.0.iter().all(|c| *c >= 0.0);
    (!usable).then(|| format!("its light {:?} is negative or not finite", amount.0))
}

/// The largest |coordinate|.
#[inline]
pub(super) fn largest(corners: &[DVec3]) -> f64 {
    corners.iter().fold(0.0, |m, c| m.max(c.abs().max_element()))
}

/// The point at u in [0, 1) once around a polygon, each edge having the same share.
pub(super) fn along_edges(corners: &[DVec3], u: f32) -> DVec3 {
    let n = corners.len();
    let x = f64::from(u) * n as f64;
    let i = (x as usize).min(n - 1);
    corners[i].lerp(corners[(i + 1) % n], x - i as f64)
}
