//! A point that shines into a cone with a soft edge (glTF `KHR_lights_punctual`, Mitsuba's `spot`).

use antumbra_math::{Rgb, World, real};
use antumbra_trace::{NO_PRIM, PrimId};

use super::flat::amount_fault;
use super::{End, LightBounds, LightHit, LightKind, LightPoints, LightSample, OutlinePoint};
use crate::density::Density;
use crate::receiver::Receiver;

/// How the light of a spot falls off between its two angles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpotEdge {
    /// t² with t = (cos a − cos outer) / max(0.001, cos inner − cos outer) in [0, 1]: glTF.
    #[default]
    Smooth,
    /// (outer − a) / (outer − inner): Mitsuba.
    Linear,
    /// t² (3 − 2t) of the same t as glTF's: pbrt.
    Hermite,
}

/// A spot light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Where it is.
    pub position: World,
    /// Unit vector along its axis, away from it.
    pub direction: World,
    /// Radiant intensity I on the axis [W/sr].
    pub intensity: Rgb,
    /// Half-angle up to which I is full [rad].
    pub inner: f32,
    /// Half-angle from which on there is no light [rad].
    pub outer: f32,
    /// How I falls off between the two.
    pub edge: SpotEdge,
    /// Distance at which the light has faded to nothing; `None`: never.
    pub range: Option<f32>,
}

/// A linear edge narrower than this [rad] is one as wide.
const NARROWEST: f32 = 1e-3;

impl Spot {
    /// A spot light with glTF's edge; `direction` of any length above 0, angles in radians.
    pub fn new(
        position: World,
        direction: World,
        intensity: Rgb,
        inner: f32,
        outer: f32,
        range: Option<f32>,
    ) -> Spot {
        let direction = direction.as_dvec3().normalize().as_vec3();
        Spot { position, direction, intensity, inner, outer, edge: SpotEdge::Smooth, range }
    }

    /// The share of I at an angle from the axis.
    #[inline]
    fn share(&self, cos: f32) -> f32 {
        let cos_outer = real::cosf(self.outer);
        if self.edge == SpotEdge::Linear {
            let width = (self.outer - self.inner).max(NARROWEST);
            return ((self.outer - real::acosf(cos.clamp(-1.0, 1.0))) / width).clamp(0.0, 1.0);
        }
        let t = ((cos - cos_outer) / (real::cosf(self.inner) - cos_outer).max(0.001)).clamp(0.0, 1.0);
        if self.edge == SpotEdge::Hermite { t * t * (3.0 - 2.0 * t) } else { t * t }
    }

    /// max(min(1 − (d/range)⁴, 1), 0).
    #[inline]
    fn fade(&self, distance2: f32) -> f32 {
        self.range.map_or(1.0, |range| {
            let part = distance2 / (range * range);
            (1.0 - part * part).clamp(0.0, 1.0)
        })
    }

    /// Direction and distance to it, and I · edge · fade / r².
    #[inline]
    fn arrival(&self, p: World) -> Option<(World, f32, Rgb)> {
        let to_light = self.position - p;
        let distance2 = to_light.length_squared();
        let distance = distance2.sqrt();
        let wi = to_light / distance;
        let share = self.share(-wi.dot(self.direction)) * self.fade(distance2) / distance2;
        (share > 0.0 && share.is_finite()).then(|| (wi, distance, self.intensity * share))
    }
}

impl LightKind for Spot {
    /// I t² fade / r² arrives along the only direction.
    #[inline]
    fn sample(&self, at: &Receiver, _u: [f32; 2], _how: LightPoints) -> Option<LightSample> {
        self.arrival(at.p).map(|(wi, distance, radiance)| LightSample {
            wi,
            end: End::Point(self.position),
            distance,
            radiance,
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

    fn irradiance(&self, at: &Receiver) -> f32 {
        self.arrival(at.p).map_or(0.0, |(wi, _, e)| e.luminance() * wi.dot(at.ng).max(0.0))
    }

    /// 2π I [(1 − cos inner) + (cos inner − cos outer)/3], pbrt's edge /2; linear: 2π I [1 − (sin outer − sin inner)/(outer − inner)].
    fn power(&self, _scene_radius: f32) -> f32 {
        let (inner, outer) = (real::cosf(self.inner), real::cosf(self.outer));
        let width = self.outer - self.inner;
        let share = match self.edge {
            SpotEdge::Linear if width > NARROWEST => {
                1.0 - (real::sinf(self.outer) - real::sinf(self.inner)) / width
            }
            SpotEdge::Hermite => (1.0 - inner) + (inner - outer) / 2.0,
            _ => (1.0 - inner) + (inner - outer) / 3.0,
        };
        2.0 * real::PI * self.intensity.luminance() * share
    }

    fn bounds(&self) -> LightBounds {
        LightBounds {
            low: self.position,
            high: self.position,
            axis: self.direction,
            cos_spread: real::cosf(self.outer),
        }
    }

    fn outline(&self, _at: &Receiver, _u: f32) -> Option<OutlinePoint> {
        None
    }

    fn is_delta(&self) -> bool {
        true
    }

    fn fault(&self) -> Option<String> {
        if !self.position.is_finite() || !self.direction.is_normalized() {
            return Some("its position or direction is not usable".into());
        }
        if !(0.0 <= self.inner && self.inner <= self.outer && self.outer <= real::PI) {
            return Some(format!(
                "its angles {} and {} are not 0 ≤ inner ≤ outer ≤ π",
                self.inner, self.outer
            ));
        }
        if self.range.is_some_and(|r| r.is_nan() || r <= 0.0) {
            return Some("its range is not positive".into());
        }
        amount_fault(self.intensity)
    }

    fn examples() -> Vec<Spot> {
        let (at, down) = (World::new(0.0, 3.0, 0.0), World::NEG_Y);
        vec![
            Spot { edge: SpotEdge::Linear, ..Spot::new(at, down, Rgb::grey(100.0), 0.3, 0.6, None) },
            Spot { edge: SpotEdge::Hermite, ..Spot::new(at, down, Rgb::grey(50.0), 0.2, 0.5, None) },
            Spot::new(at, World::new(0.2, -1.0, 0.1), Rgb::new(9.0, 8.0, 7.0), 0.0, 1.2, Some(5.0)),
        ]
    }
}
