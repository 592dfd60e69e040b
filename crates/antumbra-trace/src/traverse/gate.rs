//! What the segments of a tile can meet at all: a few boxes of the tree, or a few triangles, or nothing.

#![allow(clippy::needless_range_loop, reason = "an axis or a lane is the same place in several arrays")]

use fearless_simd::Simd;

use super::shaft::Shaft;
use super::triangles::TriangleTree;
use crate::NO_PRIM;
use crate::layout::{Child, LeafIds, Node, TriangleBlock, WIDTH};

/// Nodes that are looked into at most.
const LOOKS: usize = 40;

/// A part of a tree that holds all that a shaft meets, as a root of its own.
pub(crate) struct Gate {
    /// Its boxes.
    pub node: Node,
    /// How many.
    pub count: usize,
    /// All its triangles, if they are few; then `node` is not set.
    pub few: Few,
}

/// Up to eight triangles from anywhere in the tree.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Few {
    pub block: TriangleBlock,
    /// Their primitives.
    pub ids: LeafIds,
    /// The leaf block and the lane of each.
    pub from: [(u32, u32); WIDTH],
    pub count: usize,
}

/// A box of a gate: the child in `lane` of a node.
#[derive(Clone, Copy)]
struct Entry<'a> {
    node: &'a Node,
    lane: u8,
    child: Child,
}

/// Up to eight of them, in the order in which an any-hit query visits them.
struct Entries<'a> {
    of: [Entry<'a>; WIDTH],
    count: usize,
}

impl<'a> Entries<'a> {
    /// Puts the children `met` of `node` in the place of the one at `at`; there is room for them.
    #[inline(always)]
    fn open(&mut self, at: usize, node: &'a Node, met: u32) {
        let new = met.count_ones() as usize;
        let old = self.of;
        // Written as loops of eight: nothing is called.
        for (k, slot) in self.of.iter_mut().enumerate() {
            if k >= at + new {
                *slot = old[(k + 1 - new) % WIDTH];
            }
        }
        self.put(at, node, met);
        self.count = self.count + new - 1;
    }

    /// Writes the children `met` of `node` from `at` on.
    #[inline(always)]
    fn put(&mut self, mut at: usize, node: &'a Node, mut met: u32) {
        while met != 0 {
            let lane = met.trailing_zeros() as usize % WIDTH;
            met &= met - 1;
            self.of[at % WIDTH] = Entry { node, lane: lane as u8, child: node.child[lane] };
            at += 1;
        }
    }

    /// Keeps those in `keep`.
    #[inline(always)]
    fn keep(&mut self, keep: u32) {
        let mut to = 0;
        for k in 0..self.count.min(WIDTH) {
            self.of[to % WIDTH] = self.of[k];
            to += (keep >> k & 1) as usize;
        }
        self.count = to;
    }

    /// As a node.
    #[inline(always)]
    fn write(&self, to: &mut Node) {
        for (k, entry) in self.of.iter().enumerate() {
            let there = k < self.count;
            let lane = entry.lane as usize % WIDTH;
            for row in 0..6 {
                let empty = if row < 3 { f32::INFINITY } else { f32::NEG_INFINITY };
                to.planes[row][k] = if there { entry.node.planes[row][lane] } else { empty };
            }
            to.child[k] = if there { entry.child } else { Child::NONE };
        }
    }
}

impl Gate {
    /// None yet: what [`set`](Gate::set) makes use of.
    pub const NONE: Gate = Gate { node: Node::EMPTY, count: 0, few: Few::NONE };

    /// Becomes the parts of the tree below `root` that `shaft` meets; how many nodes were looked into.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, simd: S, of: &TriangleTree, root: &Node, shaft: &Shaft) -> usize {
        let first = Entry { node: root, lane: 0, child: Child::NONE };
        let mut entries = Entries { of: [first; WIDTH], count: 0 };
        let met = shaft.meets(simd, root);
        entries.put(0, root, met);
        entries.count = met.count_ones() as usize;
        let (mut looks, mut at) = (0, 0);
        while at < entries.count && looks < LOOKS {
            let child = entries.of[at % WIDTH].child;
            if child.is_leaf() {
                at += 1;
                continue;
            }
            let node = &of.tree.nodes[child.index()];
            let met = shaft.meets(simd, node);
            looks += 1;
            if entries.count + met.count_ones() as usize > WIDTH + 1 {
                at += 1;
                continue;
            }
            entries.open(at, node, met);
        }
        self.few.count = 0;
        if entries.of[..entries.count.min(WIDTH)].iter().all(|entry| entry.child.is_leaf()) {
            self.gather(simd, of, shaft, &mut entries);
        }
        self.count = entries.count;
        if self.count > 0 && self.few.count == 0 {
            entries.write(&mut self.node);
        }
        looks + 1
    }

    /// Keeps the leaf blocks with a triangle in the shaft, and takes the triangles if they are few.
    #[inline(always)]
    fn gather<S: Simd>(&mut self, simd: S, of: &TriangleTree, shaft: &Shaft, entries: &mut Entries<'_>) {
        let scale = of.tree.scale as f32 * 1.001;
        let (mut met, mut keep, mut count) = ([0u32; WIDTH], 0, 0);
        for k in 0..entries.count.min(WIDTH) {
            let leaf = entries.of[k].child.index();
            met[k] = shaft.triangles(simd, &of.blocks[leaf], scale) & present(&of.tree.leaves[leaf]);
            keep |= u32::from(met[k] != 0) << k;
            count += met[k].count_ones() as usize;
        }
        if count <= WIDTH {
            for k in 0..entries.count.min(WIDTH) {
                self.few.take(of, entries.of[k].child.index(), met[k]);
            }
        }
        entries.keep(keep);
    }
}

impl Few {
    pub const NONE: Few = Few {
        block: TriangleBlock { corners: [[[0.0; WIDTH]; 3]; 3], edge: [0.0; WIDTH] },
        ids: [NO_PRIM; WIDTH],
        from: [(0, 0); WIDTH],
        count: 0,
    };

    /// Adds the triangles `lanes` of a leaf; there is room for them.
    #[inline(always)]
    pub fn take(&mut self, of: &TriangleTree, leaf: usize, mut lanes: u32) {
        let (block, ids) = (&of.blocks[leaf], &of.tree.leaves[leaf]);
        while lanes != 0 {
            let (lane, to) = (lanes.trailing_zeros() as usize % WIDTH, self.count % WIDTH);
            lanes &= lanes - 1;
            for (to_corner, corner) in self.block.corners.iter_mut().zip(&block.corners) {
                for (to_axis, axis) in to_corner.iter_mut().zip(corner) {
                    to_axis[to] = axis[lane];
                }
            }
            self.block.edge[to] = block.edge[lane];
            self.ids[to] = ids[lane];
            self.from[to] = (leaf as u32, lane as u32);
            self.count += 1;
        }
    }
}

/// The lanes of a leaf that hold a primitive.
#[inline(always)]
pub(super) fn present(ids: &LeafIds) -> u32 {
    let mut lanes = 0;
    for (lane, id) in ids.iter().enumerate() {
        lanes |= u32::from(*id != NO_PRIM) << lane;
    }
    lanes
}
