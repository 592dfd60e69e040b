//! Method 2: from each receiver through the tree, all that its rays may meet; the masks of eight triangles at a time.

use fearless_simd::{Simd, prelude::*};

use super::decide::{Eight, Judge};
use super::pairs::Lanes;
use super::region::Region;
use super::{Block, Receiver};
use crate::NO_PRIM;
use crate::layout::{Child, LeafIds, Node, WIDTH};
use crate::traverse::{Masks, V3};

/// Adds to the row of receiver `m` what the triangles of the tree block for it.
#[inline(always)]
pub(super) fn walk<S: Simd, M: Masks>(
    simd: S,
    judge: &mut Judge<'_, M>,
    (receivers, m): (&[Receiver], u32),
    stack: &mut Vec<Child>,
    rows: &mut [Block],
) {
    let (of, at) = (judge.of, &receivers[m as usize]);
    let region = Region::of(simd, std::iter::once(at), judge.directions);
    let lanes = Lanes::one(simd, at);
    let blocks = judge.directions.blocks();
    let mut eight = Eight { receivers, member: [m; WIDTH], leaf: 0, slot: [0, 1, 2, 3, 4, 5, 6, 7] };
    stack.clear();
    stack.push(Child::node(0));
    while let Some(next) = stack.pop() {
        if !next.is_leaf() {
            push(simd, &of.tree.nodes[next.index()], &region, stack);
            judge.work.boxes += WIDTH as u64;
            continue;
        }
        eight.leaf = next.index();
        let there = lanes_of(&of.tree.leaves[eight.leaf]);
        judge.eight(simd, &eight, (&lanes, &of.blocks[eight.leaf], there), rows);
        if rows[m as usize * blocks..][..blocks] == *judge.directions.all() {
            return;
        }
    }
}

/// Lanes of a leaf that hold a triangle.
#[inline(always)]
pub(super) fn lanes_of(ids: &LeafIds) -> u32 {
    (0..WIDTH).fold(0, |m, lane| m | u32::from(ids[lane] != NO_PRIM) << lane)
}

/// Pushes the children that the region may meet, in their stored order: the largest blockers are taken first.
#[inline(always)]
pub(super) fn push<S: Simd>(simd: S, node: &Node, region: &Region<S>, stack: &mut Vec<Child>) {
    let [x, y, z, u, v, w] = &node.planes;
    let plane = |row: &[f32; WIDTH]| fearless_simd::f32x8::load_array_ref(simd, row);
    let lo = V3 { x: plane(x), y: plane(y), z: plane(z) };
    let hi = V3 { x: plane(u), y: plane(v), z: plane(w) };
    let mut met = region.meets(simd, lo, hi);
    while met != 0 {
        stack.push(node.child[met.trailing_zeros() as usize % WIDTH]);
        met &= met - 1;
    }
}
