//! The hemisphere form: L = ∫ f_r L_e(ω) cos θ dω, directions drawn at the receiver. Direct light.

use antumbra_math::{Local, Rgb, World, real, warp};

use super::{Draws, Estimator, Found, Mistake, Nth, Onward, Options, Proposals};
use crate::bsdf::Bsdf;
use crate::density::Density;
use crate::receiver::Receiver;
use crate::sampler::Use;
use crate::scene::Scene;

/// How directions are drawn (`--directions`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Directions {
    /// As the BSDF reflects.
    #[default]
    Bsdf,
    /// p = cos θ / π.
    Cosine,
    /// p = 1 / 2π.
    Uniform,
}

/// A direction with what light along it is worth.
pub(super) struct Direction {
    pub wi: World,
    /// The same in the shading frame.
    local: Local,
    /// f_r · cos θ / p.
    pub throughput: Rgb,
    pub density: Density,
}

impl Directions {
    /// Draws ω_i for a sample; mirrors reflect as mirrors do.
    #[inline]
    pub(super) fn draw(self, at: &Receiver, u: &Draws<'_>, nth: Nth) -> Option<Direction> {
        let [u0, u1] = u.pair(at, Use::Direction, nth);
        let drawn = if self.follows(&at.bsdf) {
            let lobe = if at.bsdf.has_lobes() { u.one(at, Use::Lobe, nth) } else { 0.0 };
            let s = at.bsdf.sample(at.wo, [u0, u1, lobe])?;
            Direction { wi: at.to_world(s.wi), local: s.wi, throughput: s.throughput, density: s.density }
        } else {
            let map = if self == Directions::Uniform { warp::hemisphere } else { warp::cosine_hemisphere };
            let local = map([u0, u1]);
            let p = self.pdf(at, local);
            if p <= 0.0 {
                return None;
            }
            let throughput = at.bsdf.eval(at.wo, local) * (local.cos() / p);
            Direction { wi: at.to_world(local), local, throughput, density: Density::SolidAngle(p) }
        };
        // Below the shading normal light leaves only through the surface, on the other side of both normals.
        let through = drawn.local.cos() < 0.0;
        (at.sees_side(drawn.wi) != through && !drawn.throughput.is_black()).then_some(drawn)
    }

    /// Directions are drawn as the BSDF sends light: where the hemisphere above holds not all of them, or single ones.
    #[inline]
    fn follows(self, bsdf: &Bsdf) -> bool {
        self == Directions::Bsdf || bsdf.has_single_directions() || bsdf.index_below().is_some()
    }

    /// p(ω) of `draw` [1/sr].
    #[inline]
    pub(super) fn pdf(self, at: &Receiver, wi: Local) -> f32 {
        if self.follows(&at.bsdf) {
            return at.bsdf.pdf(at.wo, wi);
        }
        match self {
            Directions::Bsdf | Directions::Cosine => wi.cos().max(0.0) * real::INV_PI,
            Directions::Uniform => 0.5 * real::INV_PI,
        }
    }
}

/// N directions; those that find a light carry it.
pub struct Hemisphere {
    directions: Directions,
    mistake: Mistake,
}

impl Hemisphere {
    /// Needs nothing of the scene.
    pub fn new(_scene: &Scene, options: Options) -> Hemisphere {
        Hemisphere { directions: options.directions, mistake: options.mistake }
    }
}

impl Estimator for Hemisphere {
    fn propose(&self, _scene: &Scene, at: &[Receiver], u: &Draws<'_>, out: &mut Proposals) {
        for (from, at) in at.iter().enumerate() {
            let n = u.count(at);
            let share = if self.mistake == Mistake::NoCount { 1.0 } else { 1.0 / n as f32 };
            for nth in Nth::of(n) {
                let Some(d) = self.directions.draw(at, u, nth) else { continue };
                let throughput = d.throughput * at.throughput * share;
                let onward = Onward {
                    from: from as u32,
                    throughput,
                    branch: nth.j,
                    density: d.density,
                    found: Found::All,
                    goes_on: None,
                };
                out.ray(at, d.wi, onward);
            }
        }
    }

    fn blind_to(&self, scene: &Scene) -> Vec<String> {
        blind_to_points(scene, "hemisphere")
    }
}

/// Directions never find lights without size.
pub(super) fn blind_to_points(scene: &Scene, name: &str) -> Vec<String> {
    let n = scene.lights().iter().filter(|l| l.is_delta()).count();
    let text =
        format!("estimator {name} does not see lights without size ({n} point, spot or directional here)");
    if n > 0 { vec![text] } else { Vec::new() }
}
