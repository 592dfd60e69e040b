//! Independent random numbers: the variance of a mean falls as 1/N.

use antumbra_math::hash;

use super::{Dimension, Sampler, SamplerOptions};

/// Independent numbers.
#[derive(Clone, Copy, Debug)]
pub struct Random;

impl Random {
    /// The stream carries the seed.
    pub fn new(_options: SamplerOptions) -> Random {
        Random
    }
}

impl Sampler for Random {
    #[inline]
    fn pair(&self, stream: u32, index: u32, _of: u32, dimension: Dimension) -> [f32; 2] {
        let h = hash::hash3(stream, index, dimension.0);
        [hash::unit_f32(h), hash::unit_f32(hash::mix32(h ^ 0x68bc_21eb))]
    }
}
