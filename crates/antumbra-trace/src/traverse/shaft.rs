//! The shaft of many segments: the convex hull of a box that holds their starts and a box that holds their ends.
//! What lies outside blocks none of them (docs/visibility.md §1).

use fearless_simd::{Simd, f32x8, f32x16, mask32x8, prelude::*};

use super::filter::U;
use super::ray::power;
use crate::layout::{Bounds, Node, Row, TriangleBlock, WIDTH, larger, smaller};

/// Slanted sides that there may be: four in each of the three coordinate planes, and room.
const SIDES: usize = 16;

/// By side: its two axes, and on each whether it bounds from above.
const SIDE: [([usize; 2], [bool; 2]); SIDES] = {
    let mut out = [([0, 1], [false, false]); SIDES];
    let mut k = 0;
    while k < 12 {
        out[k] = ([k / 4, (k / 4 + 1) % 3], [k % 2 == 1, k / 2 % 2 == 1]);
        k += 1;
    }
    out
};

/// By side: where its corner of a box stands in `[lower x, y, z, upper x, y, z]`, on both of its axes.
const CORNER: [[usize; SIDES]; 2] = {
    let mut out = [[0; SIDES]; 2];
    let mut k = 0;
    while k < SIDES {
        let ([p, q], [up, uq]) = SIDE[k];
        (out[0][k], out[1][k]) = (p + 3 * up as usize, q + 3 * uq as usize);
        k += 1;
    }
    out
};

/// By side: the planes of a box that hold its corner farthest inside.
const ROWS: [[Row; 2]; SIDES] = {
    let mut out = [[Row::FIRST; 2]; SIDES];
    let mut k = 0;
    while k < SIDES {
        let ([p, q], [up, uq]) = SIDE[k];
        out[k] = [Row::plane(p, !up), Row::plane(q, !uq)];
        k += 1;
    }
    out
};

/// The outward signs of a side on one of its axes.
const fn signs(of: usize) -> [f32; SIDES] {
    let mut out = [1.0; SIDES];
    let mut k = 0;
    while k < SIDES {
        out[k] = if SIDE[k].1[of] { 1.0 } else { -1.0 };
        k += 1;
    }
    out
}

const SIGNS: [[f32; SIDES]; 2] = [signs(0), signs(1)];

/// The hull, as its box and the sides on which it is narrower than its box.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shaft {
    hull: Bounds,
    /// Points with n·(X_p, X_q) > c lie outside; max |n| = 1.
    n: [[f32; SIDES]; 2],
    c: [f32; SIDES],
    /// Which sides there are.
    sides: u32,
}

impl Shaft {
    /// The hull of both boxes, which are not empty.
    ///
    /// A side is the support line through the same corner of both boxes, seen along the third axis; there is one where
    /// the line falls as its outward signs say.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, from: &Bounds, to: &Bounds) -> Shaft {
        let [a0, a1] = corners(simd, from);
        let [b0, b1] = corners(simd, to);
        let (d0, d1) = (b0 - a0, b1 - a1);
        let (s0, s1) = (f32x16::load_array(simd, SIGNS[0]), f32x16::load_array(simd, SIGNS[1]));
        let (size0, size1) = (d0.abs(), d1.abs());
        // (s0 d0)(s1 d1) < 0, without a product that could underflow.
        let there = ((d0 * s0).simd_gt(0.0) & (d1 * s1).simd_lt(0.0))
            | ((d0 * s0).simd_lt(0.0) & (d1 * s1).simd_gt(0.0));
        let one = f32x16::splat(simd, 1.0) / size0.max(size1);
        let (n0, n1) = (size1 * one * s0, size0 * one * s1);
        let high = n0.mul_add(a0, n1 * a1).max(n0.mul_add(b0, n1 * b1));
        let reach = n0.abs() * a0.abs().max(b0.abs()) + n1.abs() * a1.abs().max(b1.abs());
        let c = high + (reach * (8.0 * U) + power(-120));
        Shaft {
            hull: from.union(to),
            n: [n0.to_array(), n1.to_array()],
            c: c.to_array(),
            sides: there.to_bitmask() as u32 & 0xfff,
        }
    }

    /// Which boxes of `node` it may meet, one bit a child; the others hold no point of it.
    #[inline(always)]
    pub fn meets<S: Simd>(&self, simd: S, node: &Node) -> u32 {
        let (lo, hi) = (&self.hull.lo, &self.hull.hi);
        let mut out = load(simd, &node.planes[0]).simd_gt(hi[0]) | load(simd, &node.planes[3]).simd_lt(lo[0]);
        for axis in 1..3 {
            out |= load(simd, &node.planes[axis]).simd_gt(hi[axis]);
            out |= load(simd, &node.planes[axis + 3]).simd_lt(lo[axis]);
        }
        let mut sides = self.sides;
        while sides != 0 {
            let k = sides.trailing_zeros() as usize % SIDES;
            sides &= sides - 1;
            let (p, q) = (load(simd, node.row(ROWS[k][0])), load(simd, node.row(ROWS[k][1])));
            out |= self.at(k, p, q).simd_gt(self.c[k]);
        }
        !(out.to_bitmask() as u32) & 0xff
    }

    /// Which triangles of `block` it may meet, one bit a lane. `scale`: at least their largest |coordinate|.
    #[inline(always)]
    pub fn triangles<S: Simd>(&self, simd: S, block: &TriangleBlock, scale: f32) -> u32 {
        let [a, b, c] = &block.corners;
        let mut out = mask32x8::splat(simd, false);
        for axis in 0..3 {
            let (a, b, c) = (load(simd, &a[axis]), load(simd, &b[axis]), load(simd, &c[axis]));
            out |= a.min(b).min(c).simd_gt(self.hull.hi[axis]);
            out |= a.max(b).max(c).simd_lt(self.hull.lo[axis]);
        }
        let mut sides = self.sides;
        while sides != 0 {
            let k = sides.trailing_zeros() as usize % SIDES;
            sides &= sides - 1;
            let [p, q] = SIDE[k].0;
            let at_a = self.at(k, load(simd, &a[p]), load(simd, &a[q]));
            let at_b = self.at(k, load(simd, &b[p]), load(simd, &b[q]));
            let at_c = self.at(k, load(simd, &c[p]), load(simd, &c[q]));
            out |= at_a.min(at_b).min(at_c).simd_gt(self.c[k] + 8.0 * U * scale);
        }
        !(out.to_bitmask() as u32) & 0xff
    }

    /// n·(p, q) of side `k`.
    #[inline(always)]
    fn at<S: Simd>(&self, k: usize, p: f32x8<S>, q: f32x8<S>) -> f32x8<S> {
        p.mul_add(self.n[0][k], q * self.n[1][k])
    }
}

/// The corners of a box that the sides go through, by axis.
#[inline(always)]
fn corners<S: Simd>(simd: S, b: &Bounds) -> [f32x16<S>; 2] {
    let at = [b.lo[0], b.lo[1], b.lo[2], b.hi[0], b.hi[1], b.hi[2]];
    let (mut p, mut q) = ([0.0; SIDES], [0.0; SIDES]);
    for k in 0..SIDES {
        (p[k], q[k]) = (at[CORNER[0][k]], at[CORNER[1][k]]);
    }
    [f32x16::load_array(simd, p), f32x16::load_array(simd, q)]
}

#[inline(always)]
fn load<S: Simd>(simd: S, row: &[f32; WIDTH]) -> f32x8<S> {
    f32x8::load_array_ref(simd, row)
}

/// Where the segments of a tile start and end, or a little more.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ends {
    pub from: Bounds,
    pub to: Bounds,
}

impl Ends {
    /// The same with ends moved by what their rounding may have cost: 8 u (|o| + |e|) in each component.
    #[inline(always)]
    pub fn grown(mut self) -> Ends {
        let size = |b: &Bounds, a: usize| larger(b.lo[a].abs(), b.hi[a].abs());
        for a in 0..3 {
            let by = 8.0 * U * (size(&self.from, a) + size(&self.to, a)) + power(-120);
            self.to.lo[a] -= by;
            self.to.hi[a] += by;
        }
        self
    }

    /// Their shaft.
    #[inline(always)]
    pub fn shaft<S: Simd>(&self, simd: S) -> Shaft {
        Shaft::of(simd, &self.from, &self.to)
    }

    /// How wide the box of the ends is, on its widest axis.
    #[inline(always)]
    pub fn width(&self) -> f32 {
        (0..3).map(|a| self.to.hi[a] - self.to.lo[a]).fold(0.0, larger)
    }
}

/// How far a line from `from` goes at most in one component before it has left `scene`.
#[inline(always)]
pub(crate) fn across(from: &Bounds, scene: &Bounds) -> f32 {
    let one = |a: usize| larger(scene.hi[a] - from.lo[a], from.hi[a] - scene.lo[a]);
    larger(smaller(larger(larger(one(0), one(1)), one(2)), f32::MAX), 0.0) * (1.0 + 1.0 / 65_536.0)
}

#[cfg(test)]
#[path = "shaft_tests.rs"]
mod tests;
