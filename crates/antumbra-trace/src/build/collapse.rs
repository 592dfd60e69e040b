//! The cheapest way to turn a binary tree into eight-wide nodes and leaf blocks: a dynamic program from below.

use super::Measure;
use super::item::Item;
use crate::layout::WIDTH;

/// Cost of testing a leaf block, in visits of a node. A block costs the same for one triangle and for eight.
const LEAF_COST: f32 = 1.2;

/// What a subtree costs, hung into 1 … 8 slots of a node above it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Summary {
    /// `cost[s − 1]`: the least cost with at most s slots, times half the area of the boxes (relative units).
    pub cost: [f32; WIDTH],
    /// `ways[s − 1]` for s > 1: how many slots go to the left part, 0 = no better than s − 1 slots. `ways[0]`: how many
    /// of the eight slots of an own node go to the left part, 0 = one leaf block.
    pub ways: [u8; WIDTH],
    /// How much of a line of sight its primitives can block: their area, in a leaf at most that of its box.
    pub blocks: f32,
}

impl Summary {
    /// A single primitive.
    pub fn of_one(item: &Item, half_area: f32, measure: &Measure) -> Summary {
        let own = measure.own(item.area());
        let blocks = if own < half_area { own } else { half_area };
        Summary { cost: [LEAF_COST * half_area; WIDTH], ways: [0; WIDTH], blocks }
    }

    /// It is one leaf block.
    pub fn is_leaf(&self) -> bool {
        self.ways[0] == 0
    }
}

/// The subtree with the parts `l` and `r` of `counts` primitives, in a box of `half_area`.
///
/// Costs may be infinite or NaN (coordinates near the ends of f32): every choice is valid before the first comparison.
pub(crate) fn combine(l: &Summary, r: &Summary, counts: (usize, usize), half_area: f32) -> Summary {
    let fits = counts.0 + counts.1 <= WIDTH;
    let mut out = Summary { cost: [0.0; WIDTH], ways: [0; WIDTH], blocks: l.blocks + r.blocks };
    let mut spread = [(0.0, 1u8); WIDTH + 1];
    for slots in 2..=WIDTH {
        let mut best = (l.cost[0] + r.cost[slots - 2], 1);
        for left in 2..slots {
            let cost = l.cost[left - 1] + r.cost[slots - left - 1];
            if cost < best.0 {
                best = (cost, left as u8);
            }
        }
        spread[slots] = best;
    }
    (out.cost[0], out.ways[0]) = (half_area + spread[WIDTH].0, spread[WIDTH].1);
    let leaf = LEAF_COST * half_area;
    let pays = out.cost[0] < leaf;
    if fits && !pays {
        (out.cost[0], out.ways[0]) = (leaf, 0);
    }
    for slots in 2..=WIDTH {
        out.cost[slots - 1] = out.cost[slots - 2];
        if spread[slots].0 < out.cost[slots - 2] {
            (out.cost[slots - 1], out.ways[slots - 1]) = spread[slots];
        }
    }
    if out.ways[0] == 0 && half_area < out.blocks {
        out.blocks = half_area;
    }
    out
}
