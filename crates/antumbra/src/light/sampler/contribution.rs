//! Lights in proportion to about the irradiance that each would give the receiver, were nothing in the way.

use super::{Chooser, LightSamplerKind, Scratch};
use crate::light::{FarLights, Light, steps};
use crate::receiver::Receiver;

/// p = E / ΣE at the receiver: the best choice short of visibility and reflection, at a price that grows with the
/// number of lights.
#[derive(Clone, Debug)]
pub struct Contribution {
    far: FarLights,
}

/// Among more lights a step of 2⁻²⁴, which each has at least, would be a share that shows.
const MOST: usize = 1 << 20;

impl LightSamplerKind for Contribution {
    fn new(lights: &[Light], _scene_radius: f32) -> Option<Contribution> {
        (lights.len() <= MOST).then(|| Contribution { far: FarLights::new(lights) })
    }

    fn prepare<'a>(&'a self, lights: &[Light], at: &Receiver, scratch: &'a mut Scratch) -> Chooser<'a> {
        // Weighed once: the sum needs every weight before the first share.
        let Scratch { weights, ends } = scratch;
        weights.resize(lights.len(), 0.0);
        self.far.weigh(lights, at, weights);
        let any = if lights.len() > steps::FAST {
            steps::share_out(weights.iter().copied(), ends);
            !ends.is_empty()
        } else {
            ends.resize(lights.len(), 0);
            steps::share_out_fast(weights, ends)
        };
        Chooser { ends: if any { ends } else { &[] } }
    }
}
