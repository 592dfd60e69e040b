//! The area form over the lights: L = ∫ f_r L_e V cos θ cos θ′ / r² dA, points drawn on the lights. Direct light.

use super::lights::{Lights, blind_to_single_directions, sees_lights};
use super::{Drawn, Draws, Estimator, Options, Proposals};
use crate::light::sampler::Scratch;
use crate::receiver::Receiver;
use crate::scene::Scene;

/// N shadow rays to points of the lights.
pub struct Area {
    lights: Lights,
}

impl Area {
    /// For a scene's lights.
    pub fn new(scene: &Scene, options: Options) -> Area {
        Area { lights: Lights::new(scene, &options) }
    }
}

impl Estimator for Area {
    fn propose(&self, scene: &Scene, at: &[Receiver], u: &Draws<'_>, out: &mut Proposals) {
        for at in at.iter().filter(|at| sees_lights(&at.bsdf)) {
            self.lights.propose(scene, at, u, None, out);
        }
    }

    fn most_proposed(&self, scene: &Scene, n: usize) -> usize {
        self.lights.most_proposed(scene, n)
    }

    fn each_point(
        &self,
        scene: &Scene,
        at: &Receiver,
        u: &Draws<'_>,
        scratch: &mut Scratch,
        visit: &mut dyn FnMut(&Receiver, Drawn),
    ) {
        if sees_lights(&at.bsdf) {
            self.lights.each(scene, at, u, None, scratch, visit);
        }
    }

    fn blind_to(&self, scene: &Scene) -> Vec<String> {
        blind_to_single_directions(scene, "area")
    }
}
