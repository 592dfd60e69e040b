//! The tree builder: binned surface-area splits of objects down to single primitives, then the cheapest way to hang
//! them into eight-wide nodes. The result does not depend on the number of threads.

#![allow(clippy::needless_range_loop, reason = "an axis or a lane is the same place in several arrays")]

mod binary;
mod collapse;
mod emit;
mod item;
mod pool;
mod split;

pub(crate) use item::Item;
pub use pool::Pool;
pub(crate) use pool::Workers;

use crate::layout::{Bounds, Tree, larger, smaller};

/// How a world is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildOptions {
    /// Candidate planes an axis at which a set of primitives may be split, 2 … 32. More is slower to build and
    /// hardly faster to trace.
    pub bins: u32,
}

impl Default for BuildOptions {
    fn default() -> Self {
        BuildOptions { bins: 24 }
    }
}

/// Below this count of primitives, work is not divided among threads.
const PARALLEL: usize = 4096;

/// Ms is never taken smaller than 2⁻⁶⁰: larger pads are always right, and tiny ones would underflow.
const SMALLEST_SCALE: f64 = 1.0 / (1u64 << 60) as f64;

/// The tree over `items`, whose order it changes.
pub(crate) fn build(items: &mut [Item], options: &BuildOptions, workers: Workers) -> Tree {
    if items.is_empty() {
        return Tree::default();
    }
    let (bounds, centres) = extent(items, workers);
    let plan = binary::Plan {
        bins: options.bins.clamp(2, split::MAX_BINS as u32) as usize,
        measure: Measure::of(&bounds),
        workers,
    };
    let (nodes, whole) = plan.tree(items, &bounds, &centres);
    let scale = bounds.magnitude().max(SMALLEST_SCALE);
    let root = emit::Part::of_root(items, &nodes, scale, &plan);
    let area = plan.measure.half_area(&bounds);
    let sah_cost = if area > 0.0 { f64::from(whole.cost[0] / area) } else { 1.0 };
    Tree { nodes: root.nodes, leaves: root.leaves, bounds, scale, depth: root.depth, sah_cost }
}

/// The box of all boxes and the box of their centres.
fn extent(items: &[Item], workers: Workers) -> (Bounds, Bounds) {
    if items.len() > 8 * PARALLEL {
        let (left, right) = items.split_at(items.len() / 2);
        let (a, b) = workers.join(true, || extent(left, workers), || extent(right, workers));
        return (a.0.union(&b.0), a.1.union(&b.1));
    }
    let (mut bounds, mut centres) = (split::Grow::EMPTY, split::Grow::EMPTY);
    for item in items {
        bounds.add(item);
        centres.add_point(&item.centre());
    }
    (bounds.bounds(), centres.bounds())
}

/// Measures areas relative to the extent of the whole, so that no scale overflows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measure {
    per_unit: f32,
}

impl Measure {
    fn of(bounds: &Bounds) -> Measure {
        let widest = (0..3).map(|a| f64::from(bounds.hi[a]) - f64::from(bounds.lo[a])).fold(0.0, f64::max);
        Measure { per_unit: smaller((1.0 / widest) as f32, f32::MAX) }
    }

    /// Half the surface of a box.
    #[inline(always)]
    pub fn half_area(&self, b: &Bounds) -> f32 {
        self.half_area_of(&b.lo, &b.hi)
    }

    /// Half the surface of the box from `lo` to `hi` (further lanes are not read).
    #[inline(always)]
    pub fn half_area_of(&self, lo: &[f32], hi: &[f32]) -> f32 {
        let s = self.per_unit;
        let (x, y, z) = (hi[0] * s - lo[0] * s, hi[1] * s - lo[1] * s, hi[2] * s - lo[2] * s);
        larger(x * y + y * z + z * x, 0.0)
    }

    /// A primitive's own area `area` [scene units²] in the same unit.
    #[inline(always)]
    pub fn own(&self, area: f32) -> f32 {
        area * self.per_unit * self.per_unit
    }
}
