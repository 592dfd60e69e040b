//! A point that shines evenly: E = I cos θ / r².

use antumbra_math::{Rgb, World, real};
use antumbra_trace::{NO_PRIM, PrimId};

use super::flat::amount_fault;
use super::{End, LightBounds, LightHit, LightKind, LightPoints, LightSample, OutlinePoint};
use crate::density::Density;
use crate::receiver::Receiver;

/// A point light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Where it is.
    pub position: World,
    /// Radiant intensity I [W/sr], the same in every direction.
    pub intensity: Rgb,
}

impl LightKind for Point {
    /// I/r² arrives along the only direction.
    fn sample(&self, at: &Receiver, _u: [f32; 2], _how: LightPoints) -> Option<LightSample> {
        let to_light = self.position - at.p;
        let distance2 = to_light.length_squared();
        if distance2 <= 0.0 {
            return None;
        }
        let distance = distance2.sqrt();
        Some(LightSample {
            wi: to_light / distance,
            end: End::Point(self.position),
            distance,
            radiance: self.intensity / distance2,
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

    /// I cos θ / r².
    fn irradiance(&self, at: &Receiver) -> f32 {
        let to_light = self.position - at.p;
        let distance2 = to_light.length_squared();
        let cos = to_light.dot(at.ng) / distance2.sqrt();
        if distance2 > 0.0 { self.intensity.luminance() * cos.max(0.0) / distance2 } else { 0.0 }
    }

    /// 4π I.
    fn power(&self, _scene_radius: f32) -> f32 {
        4.0 * real::PI * self.intensity.luminance()
    }

    fn bounds(&self) -> LightBounds {
        LightBounds { low: self.position, high: self.position, axis: World::Y, cos_spread: -1.0 }
    }

    fn outline(&self, _at: &Receiver, _u: f32) -> Option<OutlinePoint> {
        None
    }

    fn is_delta(&self) -> bool {
        true
    }

    fn fault(&self) -> Option<String> {
        let lost = !self.position.is_finite();
        lost.then(|| format!("its position {} is not finite", self.position))
            .or_else(|| amount_fault(self.intensity))
    }

    fn examples() -> Vec<Point> {
        vec![Point { position: World::new(1.5, 2.0, 0.0), intensity: Rgb::new(100.0, 50.0, 20.0) }]
    }
}
