//! What a tree is in memory: nodes of eight boxes, leaf blocks of up to eight primitives.

#![allow(clippy::needless_range_loop, reason = "an axis or a lane is the same place in several arrays")]

mod memory;
mod node;
mod triangles;

pub(crate) use memory::{filled, roomy};
pub(crate) use node::{Child, Node, Row, WIDTH, above, below};
pub(crate) use triangles::TriangleBlock;

use crate::NO_PRIM;

/// The deepest chain of nodes that a builder may make; the traversal stacks rest on it.
pub(crate) const MAX_DEPTH: usize = 80;

/// Up to eight primitives by number; unused lanes at the end are [`NO_PRIM`].
pub(crate) type LeafIds = [u32; WIDTH];

/// A tree over numbered primitives. The root is node 0; without primitives there is no node.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Tree {
    /// Nodes, parents before children.
    pub nodes: Vec<Node>,
    /// The primitives of each leaf block.
    pub leaves: Vec<LeafIds>,
    /// Box of all primitives, not padded.
    pub bounds: Bounds,
    /// Ms of LAW §3: at least the largest |coordinate| that a box of this tree holds.
    pub scale: f64,
    /// Longest chain of nodes from the root, at most [`MAX_DEPTH`].
    pub depth: usize,
    /// Expected cost of a random line that meets the root's box, in box-node visits.
    pub sah_cost: f64,
}

impl Tree {
    /// There is nothing to hit.
    #[inline(always)]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice()) + size_of_val(self.leaves.as_slice())
    }
}

/// An axis-parallel box; empty where `lo` > `hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    /// Smallest corner.
    pub lo: [f32; 3],
    /// Largest corner.
    pub hi: [f32; 3],
}

impl Default for Bounds {
    fn default() -> Self {
        Bounds::EMPTY
    }
}

impl Bounds {
    /// Holds no point.
    pub const EMPTY: Bounds = Bounds { lo: [f32::INFINITY; 3], hi: [f32::NEG_INFINITY; 3] };

    /// The smallest box around three points.
    #[inline]
    pub fn of_corners(c: [[f32; 3]; 3]) -> Bounds {
        let (mut lo, mut hi) = (c[0], c[0]);
        for p in &c[1..] {
            for axis in 0..3 {
                lo[axis] = smaller(lo[axis], p[axis]);
                hi[axis] = larger(hi[axis], p[axis]);
            }
        }
        Bounds { lo, hi }
    }

    /// The smallest box around both.
    #[inline]
    pub fn union(&self, other: &Bounds) -> Bounds {
        let mut out = *self;
        for axis in 0..3 {
            out.lo[axis] = smaller(out.lo[axis], other.lo[axis]);
            out.hi[axis] = larger(out.hi[axis], other.hi[axis]);
        }
        out
    }

    /// Largest |coordinate|; 0 if empty.
    pub fn magnitude(&self) -> f64 {
        if self.lo[0] > self.hi[0] {
            return 0.0;
        }
        (0..3).map(|a| f64::from(self.lo[a]).abs().max(f64::from(self.hi[a]).abs())).fold(0.0, f64::max)
    }
}

/// min without the NaN rules of `f32::min`: one instruction.
#[inline(always)]
pub(crate) fn smaller(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

/// max without the NaN rules of `f32::max`: one instruction.
#[inline(always)]
pub(crate) fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// The leaf ids of up to eight primitives.
pub(crate) fn leaf_ids(ids: impl Iterator<Item = u32>) -> LeafIds {
    let mut out = [NO_PRIM; WIDTH];
    for (slot, id) in out.iter_mut().zip(ids) {
        *slot = id;
    }
    out
}
