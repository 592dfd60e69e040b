//! A disc of the sky: the sun at its true angular size.

use antumbra_math::{Frame, Rgb, World, closed, real, solid_angle, warp};
use antumbra_trace::{NO_PRIM, PrimId};

use super::flat::amount_fault;
use super::{End, LightBounds, LightHit, LightKind, LightPoints, LightSample, OutlinePoint};
use crate::density::Density;
use crate::receiver::Receiver;

/// A sun: radiance L_e within the angle α of a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit vector toward its middle.
    pub to_light: World,
    /// Half-angle α in (0, π/2] [rad]; the sun of the earth: 0.00465.
    pub half_angle: f32,
    /// Radiance L_e [W·m⁻²·sr⁻¹].
    pub radiance: Rgb,
    /// Belongs to a sky, and goes with it where a person chooses another environment.
    pub of_sky: bool,
}

impl Sun {
    /// A sun; `to_light` of any length above 0, `half_angle` in radians.
    pub fn new(to_light: World, half_angle: f32, radiance: Rgb) -> Sun {
        Sun { to_light: to_light.as_dvec3().normalize().as_vec3(), half_angle, radiance, of_sky: false }
    }

    /// 1 − cos α.
    #[inline]
    fn versin(&self) -> f64 {
        solid_angle::versin(f64::from(self.half_angle))
    }

    /// `wi` lies in the cone: |ω − ω_sun|² = 2 (1 − cos θ) ≤ 2 (1 − cos α).
    #[inline]
    fn holds(&self, wi: World) -> bool {
        (wi.as_dvec3() - self.to_light.as_dvec3()).length_squared() <= 2.0 * self.versin()
    }
}

impl LightKind for Sun {
    /// A direction of the cone for both ways of drawing: p(ω) = 1 / (2π (1 − cos α)).
    #[inline]
    fn sample(&self, _at: &Receiver, u: [f32; 2], _how: LightPoints) -> Option<LightSample> {
        let versin = self.versin();
        let wi = Frame::about(self.to_light).to_world(warp::cone(u, versin as f32));
        Some(LightSample {
            wi: wi.normalize(),
            end: End::Infinity,
            distance: f32::INFINITY,
            radiance: self.radiance,
            density: Density::SolidAngle((1.0 / solid_angle::cone(versin)) as f32),
            prim: NO_PRIM,
            cos: 1.0,
        })
    }

    #[inline]
    fn pdf(&self, _at: &Receiver, wi: World, _how: LightPoints) -> f32 {
        if self.holds(wi) { (1.0 / solid_angle::cone(self.versin())) as f32 } else { 0.0 }
    }

    #[inline]
    fn hit(&self, _from: World, wi: World) -> Option<LightHit> {
        self.holds(wi).then_some(LightHit { distance: f32::INFINITY, radiance: self.radiance })
    }

    #[inline]
    fn end_along(&self, _from: World, wi: World) -> Option<(End, PrimId)> {
        self.holds(wi).then_some((End::Infinity, NO_PRIM))
    }

    fn emitted(&self, _wi: World, _front: bool) -> Rgb {
        Rgb::BLACK
    }

    /// π sin²α cos θ, cut by the horizon (`closed::cone`).
    fn irradiance(&self, at: &Receiver) -> f32 {
        let cos = self.to_light.as_dvec3().dot(at.ng.as_dvec3());
        closed::cone(self.versin(), cos) as f32 * self.radiance.luminance()
    }

    /// L_e Ω π R².
    fn power(&self, scene_radius: f32) -> f32 {
        let solid_angle = solid_angle::cone(self.versin()) as f32;
        self.radiance.luminance() * solid_angle * real::PI * scene_radius * scene_radius
    }

    fn bounds(&self) -> LightBounds {
        LightBounds::at_infinity(-self.to_light, real::cosf(self.half_angle))
    }

    /// Its rim.
    fn outline(&self, _at: &Receiver, u: f32) -> Option<OutlinePoint> {
        let (sin, cos) = (real::sinf(self.half_angle), real::cosf(self.half_angle));
        let phi = 2.0 * real::PI * u;
        let frame = Frame::about(self.to_light);
        let wi = (frame.s * real::cosf(phi) + frame.t * real::sinf(phi)) * sin + frame.n * cos;
        Some(OutlinePoint { wi: wi.normalize(), end: End::Infinity })
    }

    fn is_infinite(&self) -> bool {
        true
    }

    fn is_environment(&self) -> bool {
        self.of_sky
    }

    fn fault(&self) -> Option<String> {
        if !self.to_light.is_normalized() {
            return Some("its direction is zero or not finite".into());
        }
        if !(self.half_angle > 0.0 && self.half_angle <= 0.5 * real::PI) {
            return Some(format!("its half-angle {} is not in (0, π/2]", self.half_angle));
        }
        amount_fault(self.radiance)
    }

    fn examples() -> Vec<Sun> {
        vec![
            Sun::new(World::new(0.6, 0.8, 0.1), 0.00465, Rgb::new(3e4, 2.5e4, 2e4)),
            Sun::new(World::new(1.0, 0.1, -0.2), 0.4, Rgb::WHITE),
        ]
    }
}
