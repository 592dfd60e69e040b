//! What part of a light is seen: mean V over its points, drawn evenly by area (flat lights) or solid angle (sphere, sun,
//! sky). A light point below the receiver's horizon is not seen.

use antumbra_math::Rgb;

use super::{Draws, Estimator, Nth, Proposals};
use crate::film::Planes;
use crate::light::LightId;
use crate::receiver::Receiver;
use crate::sampler::Use;
use crate::scene::Scene;

/// More lights than this are not all asked: so many are chosen, all alike.
const MOST_ASKED: u32 = 16;

/// Openness toward a light, or the mean over the lights.
pub struct VisibleFraction {
    of: Option<LightId>,
}

impl VisibleFraction {
    /// Of one light.
    pub fn of(light: LightId) -> VisibleFraction {
        VisibleFraction { of: Some(light) }
    }

    /// The mean over all lights.
    pub fn mean() -> VisibleFraction {
        VisibleFraction { of: None }
    }

    /// How many lights are asked.
    fn asked(&self, scene: &Scene) -> u32 {
        if self.of.is_some() { 1 } else { (scene.lights().len() as u32).min(MOST_ASKED) }
    }

    fn toward(
        &self,
        scene: &Scene,
        at: &Receiver,
        u: &Draws<'_>,
        (k, asked): (u32, u32),
        out: &mut Proposals,
    ) {
        let lights = scene.lights().len() as u32;
        let n = u.count(at);
        for nth in Nth::of(n) {
            let light = match self.of {
                Some(light) => light,
                None if asked == lights => k,
                None => {
                    let choice = u.pair_for(k, at, Use::LightChoice, nth)[0];
                    ((choice * lights as f32) as u32).min(lights - 1)
                }
            };
            let point = u.pair_for(k, at, Use::LightPoint, nth);
            let light = &scene.lights()[light as usize];
            let sample = light.sample(at, point, light.even());
            if let Some(s) = sample.filter(|s| at.sees_side(s.wi)) {
                out.segment(at, nth.j, &s, Planes::NONE, Rgb::grey(1.0 / (asked * n) as f32));
            }
        }
    }
}

impl Estimator for VisibleFraction {
    fn most_proposed(&self, scene: &Scene, n: usize) -> usize {
        n.saturating_mul(self.asked(scene) as usize)
    }

    fn propose(&self, scene: &Scene, at: &[Receiver], u: &Draws<'_>, out: &mut Proposals) {
        let asked = self.asked(scene);
        for at in at {
            for k in 0..asked {
                self.toward(scene, at, u, (k, asked), out);
            }
        }
    }
}
