//! The centres of a grid: no noise but a pattern (banding); `rotate` shifts it by a random offset per stream.

use antumbra_math::{hash, real};

use super::{Dimension, Sampler, SamplerOptions, permute};

/// Cell centres of an exact grid of N cells (the squarest that N factors into), in shuffled order.
#[derive(Clone, Copy, Debug)]
pub struct Regular {
    rotate: bool,
    seed: u32,
}

impl Regular {
    /// With or without the random shift.
    pub fn new(options: SamplerOptions) -> Regular {
        Regular { rotate: options.rotate, seed: options.seed }
    }
}

/// Columns and rows with columns · rows = n, as square as n allows.
fn exact_grid(n: u32) -> [u32; 2] {
    let n = n.max(1);
    let rows = (1..=f64::from(n).sqrt() as u32).rev().find(|r| n.is_multiple_of(*r)).unwrap_or(1);
    [n / rows, rows]
}

impl Sampler for Regular {
    #[inline(never)]
    fn pair(&self, stream: u32, index: u32, of: u32, dimension: Dimension) -> [f32; 2] {
        let of = of.max(1);
        let [columns, rows] = exact_grid(of);
        // The order differs between dimensions, so that pixel and light point are not tied to each other; it is the
        // same for every receiver unless rotated.
        let order = hash::hash2(if self.rotate { stream } else { self.seed }, dimension.0);
        let cell = permute(index % of, of, order);
        let mut x = ((cell % columns) as f32 + 0.5) / columns as f32;
        let mut y = ((cell / columns) as f32 + 0.5) / rows as f32;
        if self.rotate {
            let h = hash::hash2(stream, dimension.0 ^ 0x5bd1_e995);
            x += hash::unit_f32(h);
            y += hash::unit_f32(hash::mix32(h ^ 0x68bc_21eb));
        }
        [x, y].map(|v| (if v >= 1.0 { v - 1.0 } else { v }).min(real::ONE_MINUS))
    }
}
