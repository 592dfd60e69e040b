//! Ambient occlusion: (1/π) ∫ V cos θ dω about the geometric normal turned to the viewer; 1 = open.
//!
//! An occluder at distance t within R weighs none: 1, linear: 1 − t/R, quadratic: (1 − t/R)². That weight is the chance
//! that a random ray length is above t, so any hit is enough and no ray asks for the closest one.

use antumbra_math::{Frame, Rgb, warp};

use super::{Draws, Estimator, Nth, Options, Proposals};
use crate::receiver::Receiver;
use crate::sampler::Use;
use crate::scene::Scene;

/// Weight of an occluder at distance t (`--falloff`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Falloff {
    /// 1.
    #[default]
    None,
    /// 1 − t/R.
    Linear,
    /// (1 − t/R)².
    Quadratic,
}

impl Falloff {
    /// A length l in (0, R] with P(l > t) = weight of t.
    #[inline]
    pub(crate) fn length(self, radius: f32, u: f32) -> f32 {
        match self {
            Falloff::None => radius,
            Falloff::Linear => radius * (1.0 - u),
            Falloff::Quadratic => radius * (1.0 - u.sqrt()),
        }
    }
}

/// N cosine-weighted directions; each that is free brings 1/N.
pub struct AmbientOcclusion {
    radius: f32,
    falloff: Falloff,
}

impl AmbientOcclusion {
    /// Needs nothing of the scene.
    pub fn new(_scene: &Scene, options: Options) -> AmbientOcclusion {
        let falloff = if options.radius.is_finite() { options.falloff } else { Falloff::None };
        AmbientOcclusion { radius: options.radius, falloff }
    }
}

impl Estimator for AmbientOcclusion {
    fn propose(&self, _scene: &Scene, at: &[Receiver], u: &Draws<'_>, out: &mut Proposals) {
        for at in at {
            let n = u.count(at);
            let frame = Frame::about(at.ng);
            for nth in Nth::of(n) {
                // p(ω) = cos θ / π: the cosine and 1/π cancel.
                let wi = frame.to_world(warp::cosine_hemisphere(u.pair(at, Use::Direction, nth)));
                let length = match self.falloff {
                    Falloff::None => self.radius,
                    falloff => falloff.length(self.radius, u.one(at, Use::Lobe, nth)),
                };
                if at.sees_side(wi) && length > 0.0 {
                    out.probe(at, nth.j, wi, length, Rgb::grey(1.0 / n as f32));
                }
            }
        }
    }
}
