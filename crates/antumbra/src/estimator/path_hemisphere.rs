//! Paths without light sampling: directions only, light counts where a path happens to find it.

use super::hemisphere::{Directions, blind_to_points};
use super::path::survive;
use super::{Draws, Estimator, Found, Nth, Onward, Options, Proposals};
use crate::receiver::Receiver;
use crate::scene::Scene;

/// Path tracing in the hemisphere form.
pub struct PathHemisphere {
    directions: Directions,
    bounces: u32,
    roulette: bool,
}

impl PathHemisphere {
    /// Needs nothing of the scene.
    pub fn new(_scene: &Scene, options: Options) -> PathHemisphere {
        let Options { directions, bounces, roulette, .. } = options;
        PathHemisphere { directions, bounces, roulette }
    }
}

impl Estimator for PathHemisphere {
    fn propose(&self, _scene: &Scene, at: &[Receiver], u: &Draws<'_>, out: &mut Proposals) {
        for (from, at) in at.iter().enumerate() {
            let n = u.count(at);
            let goes_on = survive(at, u, self.bounces, self.roulette);
            for nth in Nth::of(n) {
                let Some(d) = self.directions.draw(at, u, nth) else { continue };
                let throughput = d.throughput * at.throughput / n as f32;
                let (from, branch, density) = (from as u32, nth.j, d.density);
                let onward = Onward { from, throughput, branch, density, found: Found::All, goes_on };
                out.ray(at, d.wi, onward);
            }
        }
    }

    fn blind_to(&self, scene: &Scene) -> Vec<String> {
        blind_to_points(scene, "path-hemisphere")
    }
}
