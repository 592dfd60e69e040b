//! Direct and indirect light computed apart: at every point of a path the lights are sampled, and one direction goes on.
//!
//! Light that the direction finds is the same direct light a second way: the two are weighed as in `mis`.

use super::mis::Mis;
use super::{Draws, Estimator, FoundLight, Nth, Options, Proposals};
use crate::light::sampler::Scratch;
use crate::receiver::Receiver;
use crate::sampler::Use;
use crate::scene::Scene;

/// Paths are sure to go on to this bounce; from there Russian roulette decides.
const SURE_BOUNCES: u32 = 2;
/// The largest probability of going on.
const LARGEST: f32 = 0.95;

/// Path tracing with light sampling.
pub struct Path {
    mis: Mis,
    bounces: u32,
    roulette: bool,
    shadow_rays: u32,
}

impl Path {
    /// For a scene's lights.
    pub fn new(scene: &Scene, options: Options) -> Path {
        let Options { bounces, roulette, shadow_rays, .. } = options;
        Path { mis: Mis::new(scene, options), bounces, roulette, shadow_rays }
    }
}

/// 1/q if the path goes on, with probability q = what is left of its light; `None` if it ends.
pub(super) fn survive(at: &Receiver, u: &Draws<'_>, bounces: u32, roulette: bool) -> Option<f32> {
    if at.bounce + 1 >= bounces {
        return None;
    }
    if !roulette || at.bounce < SURE_BOUNCES {
        return Some(1.0);
    }
    // Radiance inside a body of index n is n² times what it will be outside: what counts is what leaves.
    let inside = at.bsdf.index_below().map_or(1.0, |eta| 1.0 / (eta * eta).min(1.0));
    let q = ((at.throughput * at.bsdf.albedo()).max() * inside).min(LARGEST);
    (u.one(at, Use::Roulette, Nth::ONLY) < q).then_some(1.0 / q)
}

impl Estimator for Path {
    fn propose(&self, scene: &Scene, at: &[Receiver], u: &Draws<'_>, out: &mut Proposals) {
        for (from, at) in at.iter().enumerate() {
            // One ray looks for light (always) and goes on (if the roulette says so).
            let goes_on = survive(at, u, self.bounces, self.roulette);
            self.mis.propose_at(scene, (from, at), u, 1, goes_on, out);
        }
    }

    fn most_proposed(&self, scene: &Scene, n: usize) -> usize {
        self.mis.lights.most_proposed(scene, n).saturating_add(1)
    }

    fn found_weight(&self, scene: &Scene, found: &FoundLight<'_>, scratch: &mut Scratch) -> f32 {
        let rays = if found.from.bounce == 0 { self.shadow_rays as f32 } else { 1.0 };
        self.mis.weight(scene, found, rays, scratch)
    }
}
