//! Sampling the lights: which one, which point of it, and what a segment to it would carry.

use antumbra_math::{Rgb, World};

use super::proposals::plane_of;
use super::{Draws, FoundLight, Mistake, Nth, Options, Proposals};
use crate::bsdf::Bsdf;
use crate::density::Density;
use crate::light::sampler::{Choose, LightSampler, Scratch};
use crate::light::{End, LightId, LightPoints, LightSample};
use crate::receiver::Receiver;
use crate::sampler::Use;
use crate::scene::{Placed, Scene, blended};

/// Which lights a receiver asks (`--lights`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightChoice {
    /// All up to four lights, else the best chooser there is.
    #[default]
    Auto,
    /// Every light, N shadow rays each.
    All,
    /// One a shadow ray, all alike.
    Uniform,
    /// One a shadow ray, in proportion to its power.
    Power,
    /// One a shadow ray, in proportion to its unoccluded light at the receiver.
    Contribution,
}

/// `auto` asks every light up to this number.
const AUTO_ALL: usize = 4;
/// `contribution` looks at every light, which beyond this number takes longer than shadow rays save: there `auto` takes
/// `power`.
const AUTO_CONTRIBUTION: usize = 1024;

/// The lights of a scene, ready to be drawn.
pub struct Lights {
    /// `None`: every light.
    sampler: Option<LightSampler>,
    how: LightPoints,
    mistake: Mistake,
    opaque: bool,
}

/// A light point that was drawn, with every factor of what a segment to it carries.
#[derive(Clone, Copy, Debug)]
pub struct Drawn {
    /// Which of the receiver's samples.
    pub nth: Nth,
    /// The light.
    pub light: LightId,
    /// p(light).
    pub prob: f32,
    /// The point; `None` where the light does not shine.
    pub to: Option<LightSample>,
    /// f_r(ω_o, ω_i).
    pub f: Rgb,
    /// Share against other strategies, times what a mistake adds.
    pub weight: f32,
    /// What the segment carries if it is free, N included; black where none is asked.
    pub carried: Rgb,
}

impl Lights {
    /// Prepares the choice among the scene's lights.
    pub fn new(scene: &Scene, options: &Options) -> Lights {
        let n = scene.lights().len();
        let choose = match options.lights {
            LightChoice::All => None,
            LightChoice::Auto if n <= AUTO_ALL => None,
            // Nothing to choose.
            _ if n <= 1 => None,
            LightChoice::Auto if n > AUTO_CONTRIBUTION => Some(Choose::Power),
            LightChoice::Auto | LightChoice::Contribution => Some(Choose::Contribution),
            LightChoice::Uniform => Some(Choose::Uniform),
            LightChoice::Power => Some(Choose::Power),
        };
        let sampler = choose.map(|c| LightSampler::new(c, scene.lights(), scene.radius()));
        let Options { light_points: how, mistake, opaque, .. } = *options;
        Lights { sampler, how, mistake, opaque }
    }

    /// Proposes N segments to the lights (or to each light), weighed against drawing the direction from `other`; where
    /// light comes through the surface, as many from its other side.
    pub fn propose(
        &self,
        scene: &Scene,
        at: &Receiver,
        u: &Draws<'_>,
        other: Option<&dyn Fn(&LightSample) -> f32>,
        out: &mut Proposals,
    ) {
        let mut weights = std::mem::take(&mut out.light_weights);
        self.each(scene, at, u, other, &mut weights, |at, drawn| {
            if let (Some(to), false) = (&drawn.to, drawn.carried.is_black()) {
                out.segment(at, drawn.nth.j, to, plane_of(at), drawn.carried);
            }
        });
        out.light_weights = weights;
    }

    /// The most segments of `propose` for a receiver that takes `n` samples: through glass as many from its other side.
    pub fn most_proposed(&self, scene: &Scene, n: usize) -> usize {
        let asked = if self.sampler.is_some() { 1 } else { scene.lights().len() };
        n.saturating_mul(2 * asked)
    }

    /// Draws the N points (of each light) that `propose` draws, in its order: from the receiver, then from behind it.
    #[inline]
    pub fn each(
        &self,
        scene: &Scene,
        at: &Receiver,
        u: &Draws<'_>,
        other: Option<&dyn Fn(&LightSample) -> f32>,
        weights: &mut Scratch,
        mut visit: impl FnMut(&Receiver, Drawn),
    ) {
        self.each_from(scene, at, u, other, weights, |drawn| visit(at, drawn));
        if at.spreads_through() {
            let behind = at.from_behind();
            self.each_from(scene, &behind, u, other, weights, |drawn| visit(&behind, drawn));
        }
    }

    #[inline]
    fn each_from(
        &self,
        scene: &Scene,
        at: &Receiver,
        u: &Draws<'_>,
        other: Option<&dyn Fn(&LightSample) -> f32>,
        weights: &mut Scratch,
        mut visit: impl FnMut(Drawn),
    ) {
        let n = u.count(at);
        match &self.sampler {
            None => {
                for light in 0..scene.lights().len() as LightId {
                    for nth in Nth::of(n) {
                        let point = u.pair_for(light, at, Use::LightPoint, nth);
                        visit(self.draw(scene, at, (light, 1.0), point, nth, other));
                    }
                }
            }
            Some(sampler) => {
                let chooser = sampler.prepare(scene.lights(), at, weights);
                for nth in Nth::of(n) {
                    let Some(pick) = chooser.pick(u.one(at, Use::LightChoice, nth)) else { break };
                    let point = u.pair(at, Use::LightPoint, nth);
                    visit(self.draw(scene, at, (pick.light, pick.prob), point, nth, other));
                }
            }
        }
    }

    /// L ≈ f_r(ω_o,ω_i) · L_e · cosθ_i / (p(light) · p(ω_i)) / N, short of V.
    #[inline]
    fn draw(
        &self,
        scene: &Scene,
        at: &Receiver,
        (light, prob): (LightId, f32),
        u: [f32; 2],
        nth: Nth,
        other: Option<&dyn Fn(&LightSample) -> f32>,
    ) -> Drawn {
        let nothing = Drawn { nth, light, prob, to: None, f: Rgb::BLACK, weight: 0.0, carried: Rgb::BLACK };
        let Some(s) = scene.lights()[light as usize].sample(at, u, self.how) else { return nothing };
        let Some(wi) = at.local_in_sight(s.wi) else { return Drawn { to: Some(s), ..nothing } };
        let f = at.bsdf.eval(at.wo, wi);
        let mut carried = f * s.radiance * (wi.cos().abs() / (prob * s.density.weight()));
        let n = nth.n;
        let mut weight = 1.0;
        if let (Some(other), Density::SolidAngle(p)) = (other, s.density) {
            weight = balance(n as f32 * prob * p, n as f32 * other(&s));
            carried = carried * weight;
        }
        let covered = if self.opaque { 1.0 } else { scene.coverage(s.prim, at.p + s.wi * s.distance) };
        let more = self.mistaken(&s, n) * covered;
        carried = carried * more * at.throughput;
        let carried = if carried.is_finite() { carried / n as f32 } else { Rgb::BLACK };
        Drawn { nth, light, prob, to: Some(s), f, weight: weight * more, carried }
    }

    /// p(light) · p(ω): how densely one shadow ray draws the direction that found a light.
    pub fn density(&self, scene: &Scene, found: &FoundLight<'_>, scratch: &mut Scratch) -> f32 {
        let behind = (!found.from.sees_side(found.wi)).then(|| found.from.from_behind());
        let from = behind.as_ref().unwrap_or(found.from);
        let prob = match &self.sampler {
            None => 1.0,
            Some(sampler) => sampler.prepare(scene.lights(), from, scratch).prob(found.light),
        };
        prob * scene.lights()[found.light as usize].pdf(from, found.wi, self.how)
    }

    /// No light lies along `wi`, blocked or not: a ray that only looks for light need not be traced. Says so where the
    /// lights are few enough to be asked.
    #[inline]
    pub fn out_of_reach(&self, scene: &Scene, at: &Receiver, wi: World) -> bool {
        let along = scene.along();
        along.few()
            && !along.everywhere()
            && along.lights(scene.lights(), (at.p, at.prim), wi).next().is_none()
    }

    /// The factor by which a wrong estimator differs from the right one.
    fn mistaken(&self, s: &LightSample, n: u32) -> f32 {
        let distance2 = s.distance * s.distance;
        if self.mistake == Mistake::NoCount {
            return n as f32;
        }
        if s.density.is_delta() || s.end == End::Infinity {
            return if self.mistake == Mistake::NoDistance && distance2.is_finite() {
                distance2
            } else {
                1.0
            };
        }
        match self.mistake {
            Mistake::NoCosLight => 1.0 / s.cos.max(1e-6),
            Mistake::NoDistance => distance2,
            // pdf_A taken for pdf_ω leaves out G's cos θ′/r²; the other way round it comes twice.
            Mistake::WrongMeasure if self.how != LightPoints::SolidAngle => distance2 / s.cos.max(1e-6),
            Mistake::WrongMeasure => s.cos / distance2,
            _ => 1.0,
        }
    }
}

/// Veach's balance heuristic: the share of the strategy with density `mine`.
#[inline]
pub fn balance(mine: f32, other: f32) -> f32 {
    if mine <= 0.0 { 0.0 } else { 1.0 / (1.0 + other / mine) }
}

/// What light sampling cannot see of a scene, for the estimator `name`.
pub(super) fn blind_to_single_directions(scene: &Scene, name: &str) -> Vec<String> {
    let materials = &scene.materials;
    let of = |id: &u32| materials[*id as usize].surface.has_single_directions();
    let single = |o: &Placed| blended(materials, o.material).iter().any(of);
    let text = || {
        format!("estimator {name} does not see lights in mirrors or through clear glass (mis and path do)")
    };
    scene.objects.iter().any(single).then(text).into_iter().collect()
}

/// Light sampling can see this reflection.
#[inline]
pub fn sees_lights(bsdf: &Bsdf) -> bool {
    !bsdf.is_delta()
}
