//! Every light with the same probability.

use super::{Chooser, LightSamplerKind, Scratch};
use crate::light::{Light, steps};
use crate::receiver::Receiver;

/// p = 1/K.
#[derive(Clone, Debug)]
pub struct Uniform {
    ends: Vec<u32>,
}

impl LightSamplerKind for Uniform {
    fn new(lights: &[Light], _scene_radius: f32) -> Option<Uniform> {
        let mut ends = Vec::with_capacity(lights.len());
        steps::share_out(lights.iter().map(|_| 1.0), &mut ends);
        Some(Uniform { ends })
    }

    #[inline]
    fn prepare<'a>(&'a self, _lights: &[Light], _at: &Receiver, _scratch: &'a mut Scratch) -> Chooser<'a> {
        Chooser { ends: &self.ends }
    }
}
