//! Light from one direction at infinity: E = E₀ cos θ.

use antumbra_math::{Rgb, World, real};
use antumbra_trace::{NO_PRIM, PrimId};

use super::flat::amount_fault;
use super::{End, LightBounds, LightHit, LightKind, LightPoints, LightSample, OutlinePoint};
use crate::density::Density;
use crate::receiver::Receiver;

/// A directional light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Directional {
    /// Unit vector toward the light.
    pub to_light: World,
    /// Irradiance E₀ of a surface that faces it [W/m²].
    pub irradiance: Rgb,
}

impl Directional {
    /// A directional light; `to_light` of any length above 0.
    pub fn new(to_light: World, irradiance: Rgb) -> Directional {
        Directional { to_light: to_light.as_dvec3().normalize().as_vec3(), irradiance }
    }
}

impl LightKind for Directional {
    /// E₀ arrives along the only direction.
    #[inline]
    fn sample(&self, _at: &Receiver, _u: [f32; 2], _how: LightPoints) -> Option<LightSample> {
        Some(LightSample {
            wi: self.to_light,
            end: End::Infinity,
            distance: f32::INFINITY,
            radiance: self.irradiance,
            density: Density::Delta,
            prim: NO_PRIM,
            cos: 1.0,
        })
    }

    fn pdf(&self, _at: &Receiver, _wi: World, _how: LightPoints) -> f32 {
        0.0
    }

    fn hit(&self, _from: World, _wi: World) -> Option<LightHit> {
        None
    }

    fn end_along(&self, _from: World, _wi: World) -> Option<(End, PrimId)> {
        None
    }

    fn emitted(&self, _wi: World, _front: bool) -> Rgb {
        Rgb::BLACK
    }

    /// E₀ cos θ.
    fn irradiance(&self, at: &Receiver) -> f32 {
        self.irradiance.luminance() * self.to_light.dot(at.ng).max(0.0)
    }

    /// E₀ π R².
    fn power(&self, scene_radius: f32) -> f32 {
        self.irradiance.luminance() * real::PI * scene_radius * scene_radius
    }

    fn bounds(&self) -> LightBounds {
        LightBounds::at_infinity(-self.to_light, 1.0)
    }

    fn outline(&self, _at: &Receiver, _u: f32) -> Option<OutlinePoint> {
        None
    }

    fn is_delta(&self) -> bool {
        true
    }

    fn is_infinite(&self) -> bool {
        true
    }

    fn fault(&self) -> Option<String> {
        if !self.to_light.is_normalized() {
            return Some("its direction is zero or not finite".into());
        }
        amount_fault(self.irradiance)
    }

    fn examples() -> Vec<Directional> {
        vec![Directional::new(World::new(1.0, 2.0, 0.5), Rgb::new(5.0, 4.0, 3.0))]
    }
}
