//! Method 1: tiles of receivers that lie together; each triangle near a tile once, its masks to every receiver of the
//! tile within its reach.

use fearless_simd::Simd;

use super::decide::{Eight, Judge};
use super::pairs::Lanes;
use super::receiver_major::{lanes_of, push};
use super::region::Region;
use super::{Block, Receiver};
use crate::layout::{Child, TriangleBlock, WIDTH};
use crate::traverse::{Masks, V3};

/// Receivers of a tile: one bit each in a word.
const TILE: usize = 64;

/// Adds to `rows` what the triangles of the tree block for the receivers `members`, which this puts into another order.
#[inline(always)]
pub(super) fn walk<S: Simd, M: Masks>(
    simd: S,
    judge: &mut Judge<'_, M>,
    receivers: &[Receiver],
    members: &mut [u32],
    rows: &mut [Block],
) {
    sort(receivers, members);
    let (mut stack, mut left) = (Vec::new(), &*members);
    let widest = judge.directions.levels.longest.sqrt();
    while !left.is_empty() {
        let (tile, rest) = left.split_at(together(receivers, left, widest));
        Tile::new(simd, judge, receivers, tile).walk(simd, judge, &mut stack, rows);
        left = rest;
    }
}

/// How many of the first members make a tile: as long as it is not wider than the longest ray.
fn together(receivers: &[Receiver], members: &[u32], widest: f32) -> usize {
    let first = receivers[members[0] as usize].start;
    let (mut low, mut high) = (first, first);
    let fits = |m: &&u32| {
        for (k, x) in receivers[**m as usize].start.into_iter().enumerate() {
            (low[k], high[k]) = (low[k].min(x), high[k].max(x));
        }
        (0..3).all(|k| high[k] - low[k] <= widest)
    };
    members.iter().take(TILE).take_while(fits).count().max(1)
}

/// Receivers side by side.
struct Tile<'a, S: Simd> {
    receivers: &'a [Receiver],
    members: &'a [u32],
    region: Region<S>,
    /// Eight members each.
    groups: [Lanes<S>; TILE / WIDTH],
    /// Members with a direction that is not blocked yet.
    open: u64,
}

impl<'a, S: Simd> Tile<'a, S> {
    #[inline(always)]
    fn new<M: Masks>(
        simd: S,
        judge: &Judge<'_, M>,
        receivers: &'a [Receiver],
        members: &'a [u32],
    ) -> Tile<'a, S> {
        let all = members.iter().map(|m| &receivers[*m as usize]);
        let mut groups = [Lanes::one(simd, &receivers[members[0] as usize]); TILE / WIDTH];
        for (group, members) in groups.iter_mut().zip(members.chunks(WIDTH)) {
            *group = Lanes::of(simd, receivers, members);
        }
        let region = Region::of(simd, all, judge.directions);
        Tile { receivers, members, region, groups, open: !0 >> (TILE - members.len()) }
    }

    #[inline(always)]
    fn walk<M: Masks>(
        &mut self,
        simd: S,
        judge: &mut Judge<'_, M>,
        stack: &mut Vec<Child>,
        rows: &mut [Block],
    ) {
        let of = judge.of;
        stack.clear();
        stack.push(Child::node(0));
        while let Some(next) = stack.pop() {
            if !next.is_leaf() {
                push(simd, &of.tree.nodes[next.index()], &self.region, stack);
                judge.work.boxes += WIDTH as u64;
                continue;
            }
            let (leaf, block) = (next.index(), &of.blocks[next.index()]);
            let [a, b, c] = &block.corners;
            let (a, b, c) = (V3::load(simd, a), V3::load(simd, b), V3::load(simd, c));
            let (lo, hi) = (a.smaller(b).smaller(c), a.larger(b).larger(c));
            let mut near = self.region.meets(simd, lo, hi) & lanes_of(&of.tree.leaves[leaf]);
            while near != 0 {
                let slot = near.trailing_zeros() as usize % WIDTH;
                near &= near - 1;
                self.triangle(simd, judge, (leaf, slot), &spread(block, slot), rows);
            }
            self.close(judge, rows);
            if self.open == 0 {
                return;
            }
        }
    }

    /// One triangle, in every lane of `block`, and every member.
    #[inline(always)]
    fn triangle<M: Masks>(
        &self,
        simd: S,
        judge: &mut Judge<'_, M>,
        (leaf, slot): (usize, usize),
        block: &TriangleBlock,
        rows: &mut [Block],
    ) {
        for (g, lanes) in self.groups.iter().enumerate() {
            let open = (self.open >> (g * WIDTH)) as u32 & 0xff;
            if open != 0 {
                let of = self.members.get(g * WIDTH..).unwrap_or(&[]);
                let member = std::array::from_fn(|lane| of.get(lane).copied().unwrap_or(0));
                let eight = Eight { receivers: self.receivers, member, leaf, slot: [slot as u8; WIDTH] };
                judge.eight(simd, &eight, (lanes, block, open), rows);
            }
        }
    }

    /// Leaves out the members all of whose directions are blocked.
    #[inline(always)]
    fn close<M: Masks>(&mut self, judge: &Judge<'_, M>, rows: &[Block]) {
        let (all, mut left) = (judge.directions.all(), self.open);
        while left != 0 {
            let bit = left.trailing_zeros() as usize;
            left &= left - 1;
            if rows[self.members[bit] as usize * all.len()..][..all.len()] == *all {
                self.open &= !(1 << bit);
            }
        }
    }
}

/// The triangle in `slot` in every lane.
#[inline(always)]
fn spread(block: &TriangleBlock, slot: usize) -> TriangleBlock {
    let mut out = TriangleBlock { corners: [[[0.0; WIDTH]; 3]; 3], edge: [block.edge[slot]; WIDTH] };
    for (out, of) in out.corners.as_flattened_mut().iter_mut().zip(block.corners.as_flattened()) {
        *out = [of[slot]; WIDTH];
    }
    out
}

/// Puts members that lie together side by side: by the Morton order of their starts.
fn sort(receivers: &[Receiver], members: &mut [u32]) {
    const CELLS: f32 = 1024.0;
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for m in members.iter() {
        for (k, x) in receivers[*m as usize].start.into_iter().enumerate() {
            (low[k], high[k]) = (low[k].min(x), high[k].max(x));
        }
    }
    let size = (0..3).fold(0f32, |size, k| size.max(high[k] - low[k]));
    let scale = if size > 0.0 && size.is_finite() { (CELLS - 1.0) / size } else { 0.0 };
    let key = |m: &u32| {
        let start = receivers[*m as usize].start;
        (0..3).fold(0u32, |key, k| key | apart(((start[k] - low[k]) * scale) as u32) << k)
    };
    members.sort_by_cached_key(|m| (key(m), *m));
}

/// The ten lowest bits, three apart.
fn apart(x: u32) -> u32 {
    let x = x & 0x3ff;
    let x = (x | x << 16) & 0x0300_00ff;
    let x = (x | x << 8) & 0x0300_f00f;
    let x = (x | x << 4) & 0x030c_30c3;
    (x | x << 2) & 0x0924_9249
}
