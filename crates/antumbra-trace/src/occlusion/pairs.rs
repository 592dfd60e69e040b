//! Eight pairs of a receiver and a triangle side by side: whether any direction can meet, and in which cells of the table
//! the three planes of receiver and edge lie.

#![allow(clippy::needless_range_loop, reason = "an axis or a lane is the same place in several arrays")]

use fearless_simd::{Simd, f32x8, prelude::*, u32x8};

use super::levels::FLOOR;
use super::region::EIGHT_U;
use super::table::{OFF, SIDE, UNKNOWN};
use super::{Directions, Receiver};
use crate::layout::{TriangleBlock, WIDTH};
use crate::traverse::{Seen, U, V3};

/// Up to eight receivers, or one in every lane.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    pub start: V3<S>,
    /// Two tangents and the normal.
    pub frame: [V3<S>; 3],
}

impl<S: Simd> Lanes<S> {
    /// One receiver in every lane.
    #[inline(always)]
    pub fn one(simd: S, at: &Receiver) -> Lanes<S> {
        Lanes { start: V3::splat(simd, at.start), frame: at.frame().map(|v| V3::splat(simd, v)) }
    }

    /// One a lane; further lanes repeat the first. There is one at least.
    #[inline(always)]
    pub fn of(simd: S, receivers: &[Receiver], members: &[u32]) -> Lanes<S> {
        let lanes = |vector: &dyn Fn(&Receiver) -> [f32; 3]| {
            let mut rows = [[0.0; WIDTH]; 3];
            for lane in 0..WIDTH {
                let member = members.get(lane).unwrap_or(&members[0]);
                let v = vector(&receivers[*member as usize]);
                (0..3).for_each(|k| rows[k][lane] = v[k]);
            }
            V3::load(simd, &rows)
        };
        Lanes { start: lanes(&|r| r.start), frame: [0, 1, 2].map(|k| lanes(&|r| r.frame()[k])) }
    }
}

/// Pairs that may meet, and how far from the receiver the triangle lies.
pub(super) struct Near {
    /// One bit a lane.
    pub active: u32,
    /// Not above the squared distance of its nearest point.
    pub near2: [f32; WIDTH],
    /// Above the squared distance of its farthest point.
    pub far2: [f32; WIDTH],
}

/// Leaves out what lies below the horizon or beyond the longest ray.
#[inline(always)]
pub(super) fn near<S: Simd>(
    simd: S,
    of: &Directions,
    at: &Lanes<S>,
    block: &TriangleBlock,
    active: u32,
) -> Near {
    let [a, b, c] = &block.corners;
    // Written out: a closure in `map` does not know the SIMD level.
    let a = V3::load(simd, a).minus(at.start);
    let b = V3::load(simd, b).minus(at.start);
    let c = V3::load(simd, c).minus(at.start);
    let (low, high) = (a.smaller(b).smaller(c), a.larger(b).larger(c));
    let zero = f32x8::splat(simd, 0.0);
    let gap = V3 {
        x: low.x.max(-high.x).max(zero),
        y: low.y.max(-high.y).max(zero),
        z: low.z.max(-high.z).max(zero),
    };
    let n = at.frame[2];
    let top = n.dot(a).max(n.dot(b)).max(n.dot(c));
    let floor = f32x8::splat(simd, FLOOR);
    let off = n.abs().dot(low.abs().larger(high.abs())).mul_add(EIGHT_U, floor);
    let near2 = gap.dot(gap);
    let below = (top + off).simd_lt(gap.largest() * of.low);
    let beyond = near2.simd_gt(of.levels.longest);
    let far2 = a.dot(a).max(b.dot(b)).max(c.dot(c)).mul_add(1.0 + FAR, floor);
    Near {
        active: active & !((below | beyond).to_bitmask() as u32),
        near2: near2.to_array(),
        far2: far2.to_array(),
    }
}

/// 2⁻¹⁸
const FAR: f32 = 1.0 / 262_144.0;

/// What a normal may be off by, in units of E L (docs/visibility.md §3).
const NORMAL_OFF: f32 = 160.0 * U;
/// Shorter normals are off by more than the table allows: √3 for |m|₁ in place of |m|.
const SHORTEST: f32 = 1.7322 * NORMAL_OFF / OFF;

/// The planes through a receiver and the edges of a triangle.
pub(super) struct Planes {
    pub seen: Seen,
    /// Lanes that see the back (V > 0), and lanes that see the front.
    pub sides: [u32; 2],
    /// Cell of each edge's plane.
    cells: [[u32; WIDTH]; 3],
    /// Lanes in which it is the opposite half-space that holds the triangle.
    opposite: [u32; 3],
}

impl Planes {
    /// Cell of edge `i`'s plane in a lane, and whether its opposite is meant.
    #[inline(always)]
    pub fn plane(&self, i: usize, lane: usize) -> (u32, bool) {
        (self.cells[i][lane % WIDTH], self.opposite[i] >> lane & 1 == 1)
    }

    /// Of the pairs of receivers and triangles in the same lane.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, at: &Lanes<S>, block: &TriangleBlock) -> Planes {
        let seen = Seen::of::<S, false>(simd, block, at.start, 0.0);
        let v = f32x8::load_array_ref(simd, &seen.volume[0]);
        let bound = f32x8::load_array_ref(simd, &seen.volume[1]);
        let sides = [v.simd_gt(bound).to_bitmask() as u32, v.simd_lt(-bound).to_bitmask() as u32];
        let shortest = f32x8::load_array_ref(simd, &seen.bound) * SHORTEST;
        let (mut cells, mut opposite) = ([[0; WIDTH]; 3], [0; 3]);
        for i in 0..3 {
            // −2 A × B: its opposite is inside where V > 0.
            let m = V3::load(simd, &seen.turn[i]);
            let (x, y, z) = (at.frame[0].dot(m), at.frame[1].dot(m), at.frame[2].dot(m));
            let down = z.simd_lt(0.0);
            opposite[i] = (down.to_bitmask() as u32) ^ sides[0];
            cells[i] = cell(simd, down.select(-x, x), down.select(-y, y), z.abs(), shortest).to_array();
        }
        Planes { seen, sides, cells, opposite }
    }
}

/// The cell of a normal with z ≥ 0.
#[inline(always)]
fn cell<S: Simd>(simd: S, x: f32x8<S>, y: f32x8<S>, z: f32x8<S>, shortest: f32x8<S>) -> u32x8<S> {
    let size = x.abs() + y.abs() + z;
    let scale = f32x8::splat(simd, 0.5 * SIDE as f32) / size;
    let along = |v: f32x8<S>| {
        let k = (v * scale + 0.5 * SIDE as f32).max(f32x8::splat(simd, 0.0));
        u32x8::truncate_from(k.min(f32x8::splat(simd, SIDE as f32 - 0.5)))
    };
    let cell = along(x - y) * SIDE as u32 + along(x + y);
    size.simd_ge(shortest).select(cell, u32x8::splat(simd, UNKNOWN))
}
