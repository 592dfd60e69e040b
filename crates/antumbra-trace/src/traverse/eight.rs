//! Stage 1 of the law for eight pairs of a line and a triangle side by side: the same operations in the same order on
//! each, hence the same bits as the law's own, for those that it decides as hits. The rest is asked of the law itself.

#![allow(clippy::needless_range_loop, reason = "an axis or a lane is the same place in several arrays")]

use fearless_simd::{Simd, f64x8, prelude::*};

use super::measure::Vectors;
use super::ray::Lines;
use crate::TO_POINT;
use crate::law::{T_BOUND, TEN_W, WEIGHT_BOUND};
use crate::layout::{TriangleBlock, WIDTH};

type V<S> = Vectors<f64x8<S>>;

/// Whom a pair is of.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pair {
    pub line: u32,
    pub leaf: u32,
    pub lane: u32,
}

/// Up to eight pairs.
pub(super) struct Pairs {
    of: [Pair; WIDTH],
    len: usize,
}

/// What stage 1 says.
pub(super) struct Found {
    /// Pairs that certainly meet, with all numbers good enough.
    pub clear: u64,
    /// Where they do.
    pub t: [f64; WIDTH],
    /// Weights of the second and third corner, before rounding.
    weights: [[f64; WIDTH]; 2],
}

impl Found {
    /// Weights of the second and third corner of pair `k` (rounded as the law does).
    #[inline(always)]
    pub fn uv(&self, k: usize) -> [f32; 2] {
        let u = (self.weights[0][k] as f32).min(1.0);
        [u, (self.weights[1][k] as f32).min(1.0 - u)]
    }
}

impl Pairs {
    /// No pair.
    pub const NONE: Pairs = Pairs { of: [Pair { line: 0, leaf: 0, lane: 0 }; WIDTH], len: 0 };

    #[inline(always)]
    pub fn is_full(&self) -> bool {
        self.len == WIDTH
    }

    #[inline(always)]
    pub fn clear(&mut self) {
        self.len = 0;
    }

    #[inline(always)]
    pub fn all(&self) -> impl Iterator<Item = &Pair> {
        self.of.iter().take(self.len)
    }

    /// Adds line `line` of a chunk with the triangle in `lane` of leaf block `leaf`. There is room.
    #[inline(always)]
    pub fn add(&mut self, line: usize, leaf: u32, lane: u32) {
        self.of[self.len % WIDTH] = Pair { line: line as u32, leaf, lane };
        self.len += 1;
    }

    /// Stage 1 of all, lines counted from entry `from` of `lines`; bits beyond the last pair mean nothing.
    #[inline(always)]
    pub fn decide<S: Simd>(
        &self,
        simd: S,
        (lines, from): (&Lines<'_>, usize),
        blocks: &[TriangleBlock],
    ) -> Found {
        let gathered = Gathered::of(self, (lines, from), blocks);
        let (o, d, tmax) = gathered.lines(simd);
        let [a, b, c] = gathered.corners.each_ref().map(|c| wide(simd, [&c[0], &c[1], &c[2]]));
        let ten_w = f64x8::splat(simd, TEN_W);
        let (e0, e1, e2) = (b.minus(a), c.minus(b), a.minus(c));
        let (pa, pb, pc) = (a.minus(o), b.minus(o), c.minus(o));
        let [w0, b0] = e0.edge(d, pa, pb, ten_w);
        let [w1, b1] = e1.edge(d, pb, pc, ten_w);
        let [w2, b2] = e2.edge(d, pc, pa, ten_w);
        let (n, size) = (e0.cross(e1), e0.cross_bound(e1));
        let (v, bv) = (pa.dot(n), ten_w * pa.abs().dot(size));
        let (det, bd) = (d.dot(n).abs(), ten_w * d.abs().dot(size));
        // What `law::decide` and `law::good_weights` ask of a hit, all at once.
        let pos = w0.simd_gt(b0) & w1.simd_gt(b1) & w2.simd_gt(b2);
        let neg = w0.simd_lt(-b0) & w1.simd_lt(-b1) & w2.simd_lt(-b2);
        let sv = pos.select(-v, v);
        let far = (tmax * det - sv).simd_gt(tmax * (bd + det * (2.0 * TEN_W / 10.0)) + bv);
        let before_end = far | tmax.simd_eq(f64::INFINITY);
        let good = bv.simd_le(sv * T_BOUND) & bd.simd_le(det * T_BOUND);
        let sum = (w0 + w1 + w2).abs() * WEIGHT_BOUND;
        let fine = b0.simd_le(sum) & b1.simd_le(sum) & b2.simd_le(sum);
        let clear = (pos | neg) & sv.simd_gt(bv) & det.simd_gt(bd) & before_end & good & fine;
        let (wa, wb, wc) = (w1.abs(), w2.abs(), w0.abs());
        let all = wa + wb + wc;
        Found {
            clear: clear.to_bitmask(),
            t: (sv / det).to_array(),
            weights: [(wb / all).to_array(), (wc / all).to_array()],
        }
    }
}

/// The numbers of all pairs, side by side.
struct Gathered {
    /// Origin, end and reach as the batch has them.
    line: [[f32; WIDTH]; 7],
    /// Corner, axis, pair.
    corners: [[[f32; WIDTH]; 3]; 3],
}

impl Gathered {
    #[inline(always)]
    fn of(pairs: &Pairs, (lines, from): (&Lines<'_>, usize), blocks: &[TriangleBlock]) -> Gathered {
        let mut to = Gathered { line: [[0.0; WIDTH]; 7], corners: [[[0.0; WIDTH]; 3]; 3] };
        let columns = lines.columns();
        for (k, pair) in pairs.all().enumerate() {
            let (entry, lane) = (from + pair.line as usize, pair.lane as usize % WIDTH);
            for i in 0..7 {
                to.line[i][k % WIDTH] = columns[i].get(entry).copied().unwrap_or(0.0);
            }
            let corners = &blocks[pair.leaf as usize].corners;
            for corner in 0..3 {
                for axis in 0..3 {
                    to.corners[corner][axis][k % WIDTH] = corners[corner][axis][lane];
                }
            }
        }
        to
    }

    /// Origins, rounded directions and ends as the law takes them.
    #[inline(always)]
    fn lines<S: Simd>(&self, simd: S) -> (V<S>, V<S>, f64x8<S>) {
        let [x, y, z, u, v, w, reach] = &self.line;
        let (o, end, reach) = (wide(simd, [x, y, z]), wide(simd, [u, v, w]), wide_row(simd, reach));
        let to_point = reach.simd_eq(f64::from(TO_POINT));
        let along = end.minus(o);
        let d = V {
            x: to_point.select(along.x, end.x),
            y: to_point.select(along.y, end.y),
            z: to_point.select(along.z, end.z),
        };
        (o, d, to_point.select(f64x8::splat(simd, 1.0), reach))
    }
}

#[inline(always)]
fn wide<S: Simd>(simd: S, [x, y, z]: [&[f32; WIDTH]; 3]) -> V<S> {
    V { x: wide_row(simd, x), y: wide_row(simd, y), z: wide_row(simd, z) }
}

#[inline(always)]
fn wide_row<S: Simd>(simd: S, row: &[f32; WIDTH]) -> f64x8<S> {
    f64x8::load_array(simd, row.map(f64::from))
}

#[cfg(test)]
#[path = "eight_tests.rs"]
mod tests;
