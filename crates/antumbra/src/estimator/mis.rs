//! Both `area` and `hemisphere`, N samples each, weighed by the balance heuristic (Veach & Guibas 1995). Direct light.

use antumbra_math::World;

use super::hemisphere::Directions;
use super::lights::{Lights, balance, sees_lights};
use super::{Draws, Estimator, Found, Mistake, Onward, Options, Proposals};
use crate::light::sampler::Scratch;
use crate::light::{LightId, LightSample};
use crate::receiver::Receiver;
use crate::scene::Scene;

/// Light points and directions, weighed.
pub struct Mis {
    lights: Lights,
    directions: Directions,
    mistake: Mistake,
}

impl Mis {
    /// For a scene's lights.
    pub fn new(scene: &Scene, options: Options) -> Mis {
        let Options { directions, mistake, .. } = options;
        Mis { lights: Lights::new(scene, &options), directions, mistake }
    }

    /// Both strategies at one receiver; with this many directions, which go on as `goes_on` says.
    pub(super) fn propose_at(
        &self,
        scene: &Scene,
        (from, at): (usize, &Receiver),
        u: &Draws<'_>,
        directions: u32,
        goes_on: f32,
        scratch: &mut Scratch,
        out: &mut Proposals,
    ) {
        let n = u.count(at) as f32;
        let twice = self.mistake == Mistake::CountedTwice;
        // The other strategy draws `directions` samples for the n of this one.
        let other = |s: &LightSample| self.directions.pdf(at, at.to_local(s.wi)) * directions as f32 / n;
        if sees_lights(&at.bsdf) {
            let other: Option<&dyn Fn(&LightSample) -> f32> = if twice { None } else { Some(&other) };
            self.lights.propose(scene, at, u, other, scratch, out);
        }
        let share = if self.mistake == Mistake::NoCount { 1.0 } else { 1.0 / directions as f32 };
        for j in 0..directions {
            let Some(d) = self.directions.draw(at, u, j) else { continue };
            let throughput = d.throughput * at.throughput * share;
            let found = if d.density.is_delta() || twice { Found::All } else { Found::Weighed };
            out.ray(at, d.wi, Onward { from: from as u32, throughput, density: d.density, found, goes_on });
        }
    }

    /// Share of a direction that found `light`, against `rays` shadow rays for `directions` directions.
    pub(super) fn weight(
        &self,
        scene: &Scene,
        from: &Receiver,
        ray: &Onward,
        light: LightId,
        wi: World,
        rays: f32,
    ) -> f32 {
        balance(ray.density.pdf(), rays * self.lights.density(scene, from, light, wi))
    }
}

impl Estimator for Mis {
    fn propose(&self, scene: &Scene, at: &[Receiver], u: &Draws<'_>, out: &mut Proposals) {
        let mut scratch = Vec::new();
        for (from, at) in at.iter().enumerate() {
            self.propose_at(scene, (from, at), u, u.count(at), 0.0, &mut scratch, out);
        }
    }

    fn found_weight(&self, scene: &Scene, from: &Receiver, ray: &Onward, light: LightId, wi: World) -> f32 {
        self.weight(scene, from, ray, light, wi, 1.0)
    }
}
