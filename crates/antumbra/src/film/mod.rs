//! Sums with their own error, in f64 and in a fixed order. Floor 2.
//!
//! A block film holds what some passes of one tile brought; the tile's film takes blocks in the order of their passes.
//! The error comes from replicates: runs of passes with independent random numbers, closed one after the other.

mod planes;

pub use planes::Planes;

use antumbra_math::Rgb;

/// Cells (pixels, points) of one tile.
#[derive(Clone, Debug)]
pub struct Film {
    planes: Planes,
    /// Per plane of `planes`, per cell: Σ of samples.
    sums: Vec<[f64; 3]>,
    /// Samples per cell (all cells of a block have the same number).
    samples: u32,
    cells: usize,
    replicates: Option<Replicates>,
}

/// What is known of the scatter of replicates.
#[derive(Clone, Debug)]
struct Replicates {
    /// Beauty sums when the current replicate began.
    before: Vec<[f64; 3]>,
    samples_before: u32,
    /// Σ w_r (m_r − m)², by West's weighted update.
    scatter: Vec<[f64; 3]>,
    mean: Vec<[f64; 3]>,
    closed: u32,
}

impl Film {
    /// An empty block of `cells` cells.
    pub fn block(cells: usize, planes: Planes) -> Film {
        let planes = planes.summed().union(Planes::BEAUTY);
        Film { planes, sums: vec![[0.0; 3]; cells * planes.count()], samples: 0, cells, replicates: None }
    }

    /// An empty film that takes blocks and keeps the error.
    pub fn tile(cells: usize, planes: Planes) -> Film {
        let zero = vec![[0.0; 3]; cells];
        let replicates = Replicates {
            before: zero.clone(),
            samples_before: 0,
            scatter: zero.clone(),
            mean: zero,
            closed: 0,
        };
        Film { replicates: Some(replicates), ..Film::block(cells, planes) }
    }

    /// Forgets what was summed, keeps the memory.
    pub fn clear(&mut self) {
        self.sums.fill([0.0; 3]);
        self.samples = 0;
    }

    /// Which planes it sums.
    pub fn planes(&self) -> Planes {
        self.planes
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.cells
    }

    /// Samples that each cell has received.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Counts one more sample of every cell.
    pub fn next_sample(&mut self) {
        self.samples += 1;
    }

    /// Adds what arrived at `cell`; planes that are not summed take nothing.
    #[inline]
    pub fn add(&mut self, plane: Planes, cell: u32, carried: Rgb) {
        if let Some(index) = self.planes.index_of(plane) {
            let sum = &mut self.sums[index * self.cells + cell as usize];
            for (s, c) in sum.iter_mut().zip(carried.0) {
                *s += f64::from(c);
            }
        }
    }

    /// Takes a later block of the same cells.
    pub fn merge(&mut self, block: &Film) {
        for (sum, more) in self.sums.iter_mut().zip(&block.sums) {
            for (s, m) in sum.iter_mut().zip(more) {
                *s += m;
            }
        }
        self.samples += block.samples;
    }

    /// Ends a replicate: what came since the last end is one independent estimate of every cell.
    pub fn close_replicate(&mut self) {
        let beauty = &self.sums[..self.cells];
        let Some(r) = &mut self.replicates else { return };
        let weight = f64::from(self.samples - r.samples_before);
        if weight == 0.0 {
            return;
        }
        let total = f64::from(self.samples);
        for (cell, sum) in beauty.iter().enumerate() {
            for (c, sum) in sum.iter().enumerate() {
                let value = (sum - r.before[cell][c]) / weight;
                let delta = value - r.mean[cell][c];
                r.mean[cell][c] += delta * (weight / total);
                r.scatter[cell][c] += weight * delta * (value - r.mean[cell][c]);
            }
            r.before[cell] = *sum;
        }
        r.samples_before = self.samples;
        r.closed += 1;
    }

    /// Mean of a plane at a cell, per component; 0 without samples.
    pub fn mean(&self, plane: Planes, cell: usize) -> [f64; 3] {
        match self.planes.index_of(plane) {
            Some(index) if self.samples > 0 => {
                self.sums[index * self.cells + cell].map(|s| s / f64::from(self.samples))
            }
            _ => [0.0; 3],
        }
    }

    /// Replicates that were closed.
    pub fn replicates(&self) -> u32 {
        self.replicates.as_ref().map_or(0, |r| r.closed)
    }

    /// Standard error of the mean at a cell: √(Σ w_r (m_r − m)² / ((R − 1) Σ w_r)); `None` below two replicates.
    pub fn standard_error(&self, cell: usize) -> Option<[f64; 3]> {
        let r = self.replicates.as_ref().filter(|r| r.closed >= 2)?;
        let degrees = f64::from(r.closed - 1) * f64::from(r.samples_before);
        Some(r.scatter[cell].map(|s| (s / degrees).sqrt()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_samples_give_the_value() {
        let n = if std::env::var("ANTUMBRA_STRESS").is_ok() { 100_000_000 } else { 1_000_000 };
        let mut film = Film::tile(1, Planes::BEAUTY);
        let value = Rgb::new(0.1, 1e-6, 12_345.678);
        for _ in 0..n {
            film.add(Planes::BEAUTY, 0, value);
            film.next_sample();
        }
        for (mean, v) in film.mean(Planes::BEAUTY, 0).iter().zip(value.0) {
            // n additions in f64: at most n·2⁻⁵³ relative.
            assert!((mean / f64::from(v) - 1.0).abs() < f64::from(n) * 1.2e-16);
        }
    }

    #[test]
    fn the_error_is_that_of_the_replicates() {
        let mut film = Film::tile(1, Planes::BEAUTY);
        let values = [1.0f32, 3.0, 2.0, 6.0];
        for v in values {
            for _ in 0..5 {
                film.add(Planes::BEAUTY, 0, Rgb::grey(v));
                film.next_sample();
            }
            film.close_replicate();
        }
        // Mean 3, Σ(v−3)² = 14, s² = 14/3, error = √(14/3/4).
        let error = film.standard_error(0).unwrap()[0];
        assert!((error - (14.0f64 / 12.0).sqrt()).abs() < 1e-12, "{error}");
    }

    #[test]
    fn blocks_lie_side_by_side() {
        let planes = Planes::BEAUTY.union(Planes::DIRECT);
        let mut a = Film::block(2, planes);
        a.add(Planes::DIRECT, 1, Rgb::grey(2.0));
        a.next_sample();
        let mut film = Film::tile(2, planes);
        film.merge(&a);
        film.merge(&a);
        assert_eq!(film.mean(Planes::DIRECT, 1), [2.0; 3]);
        assert_eq!(film.mean(Planes::DIRECT, 0), [0.0; 3]);
    }
}
