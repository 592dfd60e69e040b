//! The binary tree down to single primitives, and on the way back the cost of hanging each subtree into n slots.

use std::mem::MaybeUninit;

use super::collapse::{Summary, combine};
use super::item::Item;
use super::split::{self, Binning, Bins};
use super::{Measure, PARALLEL, Workers, extent};
use crate::layout::{Bounds, WIDTH, roomy};

/// From this depth on sets are halved, so that no input makes the tree deep: 44 + log₂ 2³² < `MAX_DEPTH`.
const HALVE_FROM: usize = 44;

/// An inner node of the binary tree. A subtree of n primitives is a run of n − 1 of them: the node, those of its left
/// part, those of its right part.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Binary {
    /// Box of its primitives.
    pub bounds: Bounds,
    /// Primitives in its left part.
    pub left: u32,
    /// Cost and ways, see [`Summary`].
    pub summary: Summary,
}

/// What the recursion carries along.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plan {
    pub bins: usize,
    pub measure: Measure,
    pub workers: Workers,
}

impl Plan {
    /// The whole tree over `items`, and what it costs.
    pub fn tree(&self, items: &mut [Item], bounds: &Bounds, centres: &Bounds) -> (Vec<Binary>, Summary) {
        let n = items.len() - 1;
        let mut nodes = roomy(n);
        let whole = self.divide(items, &mut nodes.spare_capacity_mut()[..n], bounds, centres, 0);
        // SAFETY: `divide` writes the first node it is given and hands all others on, each once: n nodes are written.
        unsafe { nodes.set_len(n) };
        (nodes, whole)
    }

    /// Builds the subtree of `items` into `nodes` (one fewer), writing every node, and says what it costs.
    fn divide(
        &self,
        items: &mut [Item],
        nodes: &mut [MaybeUninit<Binary>],
        bounds: &Bounds,
        centres: &Bounds,
        depth: usize,
    ) -> Summary {
        let count = items.len();
        let Some((node, below)) = nodes.split_first_mut() else {
            return Summary::of_one(&items[0], self.measure.half_area(bounds), &self.measure);
        };
        let left = self.cut(items, centres, depth);
        let (left_items, right_items) = items.split_at_mut(left);
        let (left_nodes, right_nodes) = below.split_at_mut(left - 1);
        let (l, r) = self.workers.join(
            count > PARALLEL,
            || self.subtree(left_items, left_nodes, depth + 1),
            || self.subtree(right_items, right_nodes, depth + 1),
        );
        let summary = combine(&l, &r, (left, count - left), self.measure.half_area(bounds));
        node.write(Binary { bounds: *bounds, left: left as u32, summary });
        summary
    }

    /// [`divide`](Plan::divide) with the boxes that it needs.
    fn subtree(&self, items: &mut [Item], nodes: &mut [MaybeUninit<Binary>], depth: usize) -> Summary {
        let (bounds, centres) = extent(items, self.workers);
        self.divide(items, nodes, &bounds, &centres, depth)
    }

    /// Divides at least two items into two sides of at least one; how many are on the left.
    fn cut(&self, items: &mut [Item], centres: &Bounds, depth: usize) -> usize {
        if depth >= HALVE_FROM {
            return split::halve(items, centres);
        }
        if items.len() <= split::SWEEP {
            return split::sweep(items, &self.measure);
        }
        let binning = Binning::new(self.bins.min(items.len().max(WIDTH)), centres);
        let bins = self.bin(items, &binning);
        match bins.cheapest(&binning, &self.measure) {
            Some((axis, bin)) => split::partition(items, &binning, axis, bin),
            None => split::halve(items, centres),
        }
    }

    fn bin(&self, items: &[Item], binning: &Binning) -> Bins {
        if items.len() <= 8 * PARALLEL {
            return Bins::of(items, binning);
        }
        let (left, right) = items.split_at(items.len() / 2);
        let (a, b) = self.workers.join(true, || self.bin(left, binning), || self.bin(right, binning));
        a.join(&b)
    }
}
