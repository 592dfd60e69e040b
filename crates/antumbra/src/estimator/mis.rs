//! Both `area` and `hemisphere`, N samples each, weighed by the balance heuristic (Veach & Guibas 1995). Direct light.

use super::hemisphere::Directions;
use super::lights::{Lights, balance, sees_lights};
use super::{Drawn, Draws, Estimator, Found, FoundLight, Mistake, Nth, Onward, Options, Proposals};
use crate::light::LightSample;
use crate::light::sampler::Scratch;
use crate::receiver::Receiver;
use crate::scene::Scene;

/// Light points and directions, weighed.
pub struct Mis {
    pub(super) lights: Lights,
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
        goes_on: Option<f32>,
        out: &mut Proposals,
    ) {
        let twice = self.mistake == Mistake::CountedTwice;
        if sees_lights(&at.bsdf) {
            let other = self.other(at, u, directions);
            self.lights.propose(scene, at, u, if twice { None } else { Some(&other) }, out);
        }
        let share = if self.mistake == Mistake::NoCount { 1.0 } else { 1.0 / directions as f32 };
        for nth in Nth::of(directions) {
            let Some(d) = self.directions.draw(at, u, nth) else { continue };
            let throughput = d.throughput * at.throughput * share;
            let found = if d.density.is_delta() || twice { Found::All } else { Found::Weighed };
            if goes_on.is_none() && self.lights.out_of_reach(scene, at, d.wi) {
                continue;
            }
            let (from, branch, density) = (from as u32, nth.j, d.density);
            out.ray(at, d.wi, Onward { from, throughput, branch, density, found, goes_on });
        }
    }

    /// How densely the other strategy draws a light point: `directions` samples for the n of light sampling.
    fn other<'a>(
        &'a self,
        at: &'a Receiver,
        u: &Draws<'_>,
        directions: u32,
    ) -> impl Fn(&LightSample) -> f32 + use<'a> {
        let n = u.count(at) as f32;
        move |s| self.directions.pdf(at, at.to_local(s.wi)) * directions as f32 / n
    }

    /// Share of a direction that found a light, against `rays` shadow rays for each direction.
    pub(super) fn weight(
        &self,
        scene: &Scene,
        found: &FoundLight<'_>,
        rays: f32,
        scratch: &mut Scratch,
    ) -> f32 {
        balance(found.ray.density.pdf(), rays * self.lights.density(scene, found, scratch))
    }
}

impl Estimator for Mis {
    fn propose(&self, scene: &Scene, at: &[Receiver], u: &Draws<'_>, out: &mut Proposals) {
        for (from, at) in at.iter().enumerate() {
            self.propose_at(scene, (from, at), u, u.count(at), None, out);
        }
    }

    fn most_proposed(&self, scene: &Scene, n: usize) -> usize {
        self.lights.most_proposed(scene, n).saturating_add(n)
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
            let other = self.other(at, u, u.count(at));
            let twice = self.mistake == Mistake::CountedTwice;
            self.lights.each(scene, at, u, if twice { None } else { Some(&other) }, scratch, visit);
        }
    }

    fn found_weight(&self, scene: &Scene, found: &FoundLight<'_>, scratch: &mut Scratch) -> f32 {
        self.weight(scene, found, 1.0, scratch)
    }
}
