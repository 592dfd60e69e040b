//! From a triangle's planes to the directions that it blocks: what the table is sure of, and what it is not, sixteen
//! directions at a time by the filter, the rest by the law.

use fearless_simd::{Simd, f32x16, prelude::*};

use super::mixed::Picked;
use super::pairs::{Lanes, Near, Planes, near};
use super::{BITS, Block, Directions, MOST_BLOCKS, OcclusionWork, Receiver};
use crate::law::{self, Line};
use crate::layout::{TriangleBlock, WIDTH};
use crate::traverse::{Masks, PACKET, Sixteen, TriangleTree, U};

/// Everything that triangles are put to.
pub(super) struct Judge<'a, M> {
    pub of: &'a TriangleTree,
    pub directions: &'a Directions,
    pub masks: &'a M,
    pub work: OcclusionWork,
}

/// Eight pairs of a receiver and a triangle.
pub(super) struct Eight<'a> {
    pub receivers: &'a [Receiver],
    /// Number of each lane's receiver, and of its row of masks.
    pub member: [u32; WIDTH],
    /// Leaf block of the triangles, and each one's lane there.
    pub leaf: usize,
    pub slot: [u8; WIDTH],
}

/// The same ready to be decided.
struct Ready<'a, S: Simd> {
    of: &'a Eight<'a>,
    at: &'a Lanes<S>,
    near: Near,
    planes: Planes,
}

/// With more open directions than these a triangle is put to the filter alone.
const MANY: u32 = 8;

impl<M: Masks> Judge<'_, M> {
    /// Adds to `rows` the directions in which the triangles of `block` block, for the lanes `there`.
    #[inline(always)]
    pub fn eight<S: Simd>(
        &mut self,
        simd: S,
        of: &Eight<'_>,
        (at, block, there): (&Lanes<S>, &TriangleBlock, u32),
        rows: &mut [Block],
    ) {
        self.work.pairs += u64::from(there.count_ones());
        let near = near(simd, self.directions, at, block, there);
        if near.active == 0 {
            return;
        }
        self.work.in_range += u64::from(near.active.count_ones());
        let mut active = self.directions.bins.some(simd, at, block, near.active);
        self.work.between += u64::from((near.active ^ active).count_ones());
        if active == 0 {
            return;
        }
        let ready = Ready { of, at, near, planes: Planes::of(simd, at, block) };
        let mut picked = Picked::NONE;
        while active != 0 {
            let lane = active.trailing_zeros() as usize % WIDTH;
            active &= active - 1;
            self.lane(simd, &ready, lane, &mut picked, rows);
        }
        self.mixed(simd, &ready, &mut picked, rows);
    }

    /// One of them: what the table says, and what it leaves open.
    #[inline(always)]
    fn lane<S: Simd>(
        &mut self,
        simd: S,
        ready: &Ready<'_, S>,
        lane: usize,
        picked: &mut Picked,
        rows: &mut [Block],
    ) {
        let (of, pair, sides) = (self.directions, ready.of, ready.planes.sides);
        let (slot, member) = (pair.slot[lane] as usize % WIDTH, pair.member[lane] as usize);
        if self.of.tree.leaves[pair.leaf][slot] == pair.receivers[member].first {
            return;
        }
        let row = &mut rows[member * of.blocks()..][..of.blocks()];
        // A mask is asked of every hit; on the plane itself no side is known.
        let masked = M::ASK && self.of.masked.get(pair.leaf).is_some_and(|m| m >> slot & 1 == 1);
        let known = !masked && (sides[0] | sides[1]) >> lane & 1 == 1;
        let (open, count) = open(of, ready, (lane, known), row);
        if count == 0 {
            return;
        }
        self.work.tested += u64::from(count);
        if masked || count > MANY {
            let mut own = Picked::NONE;
            each(
                &open[..of.blocks()],
                #[inline(always)]
                |i| {
                    own.add(i, lane);
                    if own.len == PACKET {
                        self.alone(simd, ready, (lane, masked), &mut own, rows);
                    }
                },
            );
            self.alone(simd, ready, (lane, masked), &mut own, rows);
        } else {
            each(
                &open[..of.blocks()],
                #[inline(always)]
                |i| {
                    picked.add(i, lane);
                    if picked.len == PACKET {
                        self.mixed(simd, ready, picked, rows);
                    }
                },
            );
        }
    }

    /// Decides directions that were picked for several triangles.
    #[inline(always)]
    fn mixed<S: Simd>(&mut self, simd: S, ready: &Ready<'_, S>, picked: &mut Picked, rows: &mut [Block]) {
        if picked.len > 0 {
            let met = picked.test(simd, self.directions, ready.at, &ready.planes.seen);
            self.set(ready.of, (met.hit, met.open), false, picked, rows);
            picked.len = 0;
        }
    }

    /// Decides directions that were picked for one triangle.
    #[inline(always)]
    fn alone<S: Simd>(
        &mut self,
        simd: S,
        ready: &Ready<'_, S>,
        (lane, masked): (usize, bool),
        picked: &mut Picked,
        rows: &mut [Block],
    ) {
        if picked.len > 0 {
            let at = &ready.of.receivers[ready.of.member[lane] as usize];
            let lines = self.lines(simd, at, picked);
            let met = lines.test::<false>(simd, &ready.planes.seen, lane, (1 << picked.len) - 1);
            let found = if masked { (0, met.hit | met.open) } else { (met.hit, met.open) };
            self.set(ready.of, found, masked, picked, rows);
            picked.len = 0;
        }
    }

    /// Sets what is hit; asks the law of what is open.
    #[inline(always)]
    fn set(
        &mut self,
        of: &Eight<'_>,
        (mut hit, mut open): (u32, u32),
        masked: bool,
        picked: &Picked,
        rows: &mut [Block],
    ) {
        let blocks = self.directions.blocks();
        let mut set = |k: usize| {
            let (i, lane) = (picked.direction[k] as usize, picked.lane[k] as usize % WIDTH);
            rows[of.member[lane] as usize * blocks + i / BITS][i % BITS / 64] |= 1 << (i % 64);
        };
        while hit != 0 {
            set(hit.trailing_zeros() as usize % PACKET);
            hit &= hit - 1;
        }
        while open != 0 {
            let k = open.trailing_zeros() as usize % PACKET;
            open &= open - 1;
            self.work.law += 1;
            if self.law(of, picked.lane[k] as usize % WIDTH, picked.direction[k] as usize, masked) {
                set(k);
            }
        }
    }

    /// Sixteen rays of a receiver: the same operations as in [`Receiver::direction`].
    #[inline(always)]
    fn lines<S: Simd>(&self, simd: S, at: &Receiver, picked: &Picked) -> Sixteen<S> {
        let of = self.directions;
        let x = picked.directions(simd, &of.local[0]);
        let y = picked.directions(simd, &of.local[1]);
        let z = picked.directions(simd, &of.local[2]);
        let [s, t, n] = at.frame();
        let d0 = (x * s[0] + y * t[0]) + z * n[0];
        let d1 = (x * s[1] + y * t[1]) + z * n[1];
        let d2 = (x * s[2] + y * t[2]) + z * n[2];
        let zero = f32x16::splat(simd, 0.0);
        let bound = (d0.abs() + d1.abs() + d2.abs()) * (1.00001 * 40.0 * U);
        let tmax = picked.directions(simd, &of.reach);
        Sixteen { d: [d0, d1, d2], q: [zero; 3], m: [zero; 3], bound, tmax }
    }

    /// The law, and the mask of a masked triangle.
    #[inline(never)]
    fn law(&self, of: &Eight<'_>, lane: usize, i: usize, masked: bool) -> bool {
        let (at, slot) = (&of.receivers[of.member[lane] as usize], of.slot[lane] as usize % WIDTH);
        let line = Line::ray(at.start, at.direction(self.directions, i), self.directions.reach(i));
        let corners = self.of.blocks[of.leaf].triangle(slot);
        law::blocks(&line, corners)
            && !(masked && {
                let (id, uv) = (self.of.tree.leaves[of.leaf][slot], law::barycentrics(&line, corners));
                self.masks.passes(at.number.wrapping_add(i as u32), id, uv)
            })
    }
}

/// Sets in `row` what the table is sure of, if the plane's side is `known`; what is left open, and how many they are.
#[inline(always)]
fn open<S: Simd>(
    of: &Directions,
    ready: &Ready<'_, S>,
    (lane, known): (usize, bool),
    row: &mut [Block],
) -> ([Block; MOST_BLOCKS], u32) {
    let planes = &ready.planes;
    let perhaps = of.levels.perhaps(ready.near.near2[lane]);
    let mut open = [[0; 4]; MOST_BLOCKS];
    let mut count = 0;
    if known {
        let surely = of.levels.surely(ready.near.far2[lane]);
        let [a, b, c] = [planes.plane(0, lane), planes.plane(1, lane), planes.plane(2, lane)];
        let [a, b, c] = [of.table.get(a.0, a.1), of.table.get(b.0, b.1), of.table.get(c.0, c.1)];
        for (k, blocked) in row.iter_mut().enumerate() {
            let may = and(and(perhaps[k], not(*blocked)), and(a.perhaps(k), and(b.perhaps(k), c.perhaps(k))));
            let hit = and(and(surely[k], may), and(a.surely(k), and(b.surely(k), c.surely(k))));
            *blocked = or(*blocked, hit);
            open[k % MOST_BLOCKS] = and(may, not(hit));
            count += ones(open[k % MOST_BLOCKS]);
        }
    } else {
        for (k, blocked) in row.iter().enumerate() {
            open[k % MOST_BLOCKS] = and(perhaps[k], not(*blocked));
            count += ones(open[k % MOST_BLOCKS]);
        }
    }
    (open, count)
}

/// Calls `of` with the number of every direction of a mask.
#[inline(always)]
fn each(mask: &[Block], mut of: impl FnMut(u32)) {
    for (k, word) in mask.as_flattened().iter().enumerate() {
        let mut word = *word;
        while word != 0 {
            of((k * 64) as u32 + word.trailing_zeros());
            word &= word - 1;
        }
    }
}

#[inline(always)]
fn not(a: Block) -> Block {
    [!a[0], !a[1], !a[2], !a[3]]
}

#[inline(always)]
fn ones(a: Block) -> u32 {
    a[0].count_ones() + a[1].count_ones() + a[2].count_ones() + a[3].count_ones()
}

#[inline(always)]
fn and(a: Block, b: Block) -> Block {
    [a[0] & b[0], a[1] & b[1], a[2] & b[2], a[3] & b[3]]
}

#[inline(always)]
fn or(a: Block, b: Block) -> Block {
    [a[0] | b[0], a[1] | b[1], a[2] | b[2], a[3] | b[3]]
}
