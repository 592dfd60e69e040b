//! From a triangle's planes to the directions that it blocks: what the table is sure of, and what it is not, sixteen
//! directions at a time by the filter, the rest by the law.

use fearless_simd::{Simd, f32x16, prelude::*};

use super::pairs::{Near, Planes};
use super::{BITS, Block, Directions, OcclusionWork, Receiver};
use crate::law::{self, Line};
use crate::traverse::{Masks, PACKET, Seen, Sixteen, TriangleTree, U};

/// Everything that triangles are put to.
pub(super) struct Judge<'a, M> {
    pub of: &'a TriangleTree,
    pub directions: &'a Directions,
    pub masks: &'a M,
    pub work: OcclusionWork,
}

/// A pair of a receiver and a triangle.
#[derive(Clone, Copy)]
pub(super) struct Pair<'a> {
    pub at: &'a Receiver,
    /// Leaf block and lane in it.
    pub leaf: usize,
    pub slot: usize,
}

/// Directions that wait for the filter.
struct Picked {
    of: [u32; PACKET],
    len: usize,
}

impl<M: Masks> Judge<'_, M> {
    /// Adds to `blocked` the directions in which the triangle of `pair`, seen as `lane` of `planes`, blocks.
    #[inline(always)]
    pub fn pair<S: Simd>(
        &mut self,
        simd: S,
        pair: &Pair<'_>,
        (near, planes, lane): (&Near, &Planes, usize),
        blocked: &mut [Block],
    ) {
        let of = self.directions;
        if self.of.tree.leaves[pair.leaf][pair.slot] == pair.at.first {
            return;
        }
        let perhaps = of.levels.perhaps(near.near2[lane]);
        let mut picked = Picked { of: [0; PACKET], len: 0 };
        // A mask is asked of every hit; on the plane itself no side is known.
        let masked = M::ASK && self.of.masked.get(pair.leaf).is_some_and(|m| m >> pair.slot & 1 == 1);
        if masked || (planes.sides[0] | planes.sides[1]) >> lane & 1 == 0 {
            for block in 0..blocked.len() {
                let open = and(perhaps[block], blocked[block].map(|w| !w));
                self.pick(simd, pair, (&planes.seen, lane, masked), (block, open), &mut picked, blocked);
            }
        } else {
            let halves = [0, 1, 2].map(|i| {
                let (cell, opposite) = planes.plane(i, lane);
                of.table.get(cell, opposite)
            });
            let surely = of.levels.surely(near.far2[lane]);
            for block in 0..blocked.len() {
                let [a, b, c] = halves.each_ref().map(|h| h.perhaps(block));
                let open = and(and(perhaps[block], blocked[block].map(|w| !w)), and(a, and(b, c)));
                if open == [0; 4] {
                    continue;
                }
                let [a, b, c] = halves.each_ref().map(|h| h.surely(block));
                let hit = and(and(surely[block], open), and(a, and(b, c)));
                blocked[block] = or(blocked[block], hit);
                let open = and(open, hit.map(|w| !w));
                self.pick(simd, pair, (&planes.seen, lane, false), (block, open), &mut picked, blocked);
            }
        }
        self.test(simd, pair, (&planes.seen, lane, masked), &picked, blocked);
    }

    /// Puts the directions `open` to the filter as soon as there are enough of them.
    #[inline(always)]
    fn pick<S: Simd>(
        &mut self,
        simd: S,
        pair: &Pair<'_>,
        seen: (&Seen, usize, bool),
        (block, open): (usize, Block),
        picked: &mut Picked,
        blocked: &mut [Block],
    ) {
        for (w, mut word) in open.into_iter().enumerate() {
            while word != 0 {
                picked.of[picked.len % PACKET] = (block * BITS + w * 64) as u32 + word.trailing_zeros();
                picked.len += 1;
                word &= word - 1;
                if picked.len == PACKET {
                    self.test(simd, pair, seen, picked, blocked);
                    picked.len = 0;
                }
            }
        }
    }

    /// Decides the directions that were picked.
    #[inline(always)]
    fn test<S: Simd>(
        &mut self,
        simd: S,
        pair: &Pair<'_>,
        (seen, lane, masked): (&Seen, usize, bool),
        picked: &Picked,
        blocked: &mut [Block],
    ) {
        if picked.len == 0 {
            return;
        }
        let lines = self.lines(simd, pair.at, picked);
        let met = lines.test::<false>(simd, seen, lane, (1 << picked.len) - 1);
        self.work.tested += picked.len as u64;
        let mut set = |i: u32| blocked[i as usize / BITS][i as usize % BITS / 64] |= 1 << (i % 64);
        let (mut certain, mut open) = if masked { (0, met.hit | met.open) } else { (met.hit, met.open) };
        while certain != 0 {
            set(picked.of[certain.trailing_zeros() as usize % PACKET]);
            certain &= certain - 1;
        }
        while open != 0 {
            let i = picked.of[open.trailing_zeros() as usize % PACKET];
            open &= open - 1;
            self.work.law += 1;
            if self.law(pair, i as usize, masked) {
                set(i);
            }
        }
    }

    /// Sixteen rays of a receiver: the same operations as in [`Receiver::direction`].
    #[inline(always)]
    fn lines<S: Simd>(&self, simd: S, at: &Receiver, picked: &Picked) -> Sixteen<S> {
        let of = self.directions;
        let row = |values: &[f32]| {
            let mut out = [0.0; PACKET];
            for (out, i) in out.iter_mut().zip(&picked.of) {
                *out = values[*i as usize];
            }
            f32x16::load_array(simd, out)
        };
        let [x, y, z] = [row(&of.local[0]), row(&of.local[1]), row(&of.local[2])];
        let [s, t, n] = at.frame();
        let along = |k: usize| (x * s[k] + y * t[k]) + z * n[k];
        let d = [along(0), along(1), along(2)];
        let zero = f32x16::splat(simd, 0.0);
        let bound = (d[0].abs() + d[1].abs() + d[2].abs()) * (1.00001 * 40.0 * U);
        Sixteen { d, q: [zero; 3], m: [zero; 3], bound, tmax: row(&of.reach) }
    }

    /// The law, and the mask of a masked triangle.
    #[inline(never)]
    fn law(&self, pair: &Pair<'_>, i: usize, masked: bool) -> bool {
        let (at, of) = (pair.at, self.directions);
        let line = Line::ray(at.start, at.direction(of, i), of.reach(i));
        let corners = self.of.blocks[pair.leaf].triangle(pair.slot);
        law::blocks(&line, corners)
            && !(masked && {
                let (id, uv) = (self.of.tree.leaves[pair.leaf][pair.slot], law::barycentrics(&line, corners));
                self.masks.passes(at.number.wrapping_add(i as u32), id, uv)
            })
    }
}

#[inline(always)]
fn and(a: Block, b: Block) -> Block {
    [a[0] & b[0], a[1] & b[1], a[2] & b[2], a[3] & b[3]]
}

#[inline(always)]
fn or(a: Block, b: Block) -> Block {
    [a[0] | b[0], a[1] | b[1], a[2] | b[2], a[3] | b[3]]
}
