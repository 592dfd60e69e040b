//! One random point in each cell of a grid of at least N cells, in shuffled order ("jittered").

use antumbra_math::{hash, real};

use super::{Dimension, Sampler, SamplerOptions, permute};

/// Jittered strata. With N a square the grid is √N × √N and each cell is met once; otherwise the grid is the next
/// larger one and N of its cells are met, each at most once.
#[derive(Clone, Copy, Debug)]
pub struct Stratified;

impl Stratified {
    /// The stream carries the seed.
    pub fn new(_options: SamplerOptions) -> Stratified {
        Stratified
    }
}

/// Columns and rows of the nearly square grid with at least `n` cells.
#[inline]
pub(super) fn grid(n: u32) -> [u32; 2] {
    let columns = (1..)
        .skip((f64::from(n).sqrt() as u32).saturating_sub(1) as usize)
        .find(|c: &u32| c.saturating_mul(*c) >= n);
    let columns = columns.unwrap_or(1).max(1);
    [columns, n.div_ceil(columns).max(1)]
}

impl Sampler for Stratified {
    // Long: taken into every question it would slow down the samplers that are asked most.
    #[inline(never)]
    fn pair(&self, stream: u32, index: u32, of: u32, dimension: Dimension) -> [f32; 2] {
        let key = hash::hash2(stream, dimension.0);
        let [columns, rows] = grid(of);
        let cells = columns * rows;
        // Each run of `cells` samples is a new shuffle.
        let shuffle = hash::hash2(key, index / cells);
        let cell = permute(index % cells, cells, shuffle);
        let h = hash::hash2(shuffle, cell);
        let jitter = [hash::unit_f32(h), hash::unit_f32(hash::mix32(h ^ 0x68bc_21eb))];
        let at = |i: u32, n: u32, u: f32| ((i as f32 + u) / n as f32).min(real::ONE_MINUS);
        [at(cell % columns, columns, jitter[0]), at(cell / columns, rows, jitter[1])]
    }
}
