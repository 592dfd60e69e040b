//! Lights in proportion to the power that they emit.

use super::{Chooser, LightSamplerKind, Scratch};
use crate::light::{Light, steps};
use crate::receiver::Receiver;

/// p = Φ / ΣΦ; lights at infinity by what they send through the scene.
#[derive(Clone, Debug)]
pub struct Power {
    ends: Vec<u32>,
}

impl Power {
    /// For any number of lights.
    pub fn of(lights: &[Light], scene_radius: f32) -> Power {
        let mut ends = Vec::with_capacity(lights.len());
        let power: Vec<f32> = lights.iter().map(|light| light.power(scene_radius)).collect();
        steps::share_out(power.iter().copied(), &mut ends);
        Power { ends }
    }
}

impl LightSamplerKind for Power {
    fn new(lights: &[Light], scene_radius: f32) -> Option<Power> {
        Some(Power::of(lights, scene_radius))
    }

    #[inline]
    fn prepare<'a>(&'a self, _lights: &[Light], _at: &Receiver, _scratch: &'a mut Scratch) -> Chooser<'a> {
        Chooser { ends: &self.ends }
    }
}
