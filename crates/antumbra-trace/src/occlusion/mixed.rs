//! Sixteen pairs of a direction and one of eight triangles: the filter of packets with each pair's own numbers.

#![allow(clippy::needless_range_loop, reason = "a pair is the same place in several arrays")]

use fearless_simd::{Simd, f32x8, f32x16, prelude::*};

use super::Directions;
use super::pairs::Lanes;
use crate::layout::WIDTH;
use crate::traverse::{Met, PACKET, Seen, Sixteen, TINY, U};

/// Directions that wait for the filter, each with the lane of its pair.
pub(super) struct Picked {
    pub direction: [u32; PACKET],
    pub lane: [u32; PACKET],
    pub len: usize,
}

impl Picked {
    /// Nothing.
    pub const NONE: Picked = Picked { direction: [0; PACKET], lane: [0; PACKET], len: 0 };

    /// Adds one; there is room.
    #[inline(always)]
    pub fn add(&mut self, direction: u32, lane: usize) {
        self.direction[self.len % PACKET] = direction;
        self.lane[self.len % PACKET] = lane as u32;
        self.len += 1;
    }

    /// What f32 can decide about all of them (docs/visibility.md §2, common origin).
    #[inline(always)]
    pub fn test<S: Simd>(&self, simd: S, of: &Directions, at: &Lanes<S>, seen: &Seen) -> Met {
        let lines = self.lines(simd, of, at);
        let d = &lines.d;
        let w0 = self.dot(simd, d, &seen.turn[0]);
        let w1 = self.dot(simd, d, &seen.turn[1]);
        let w2 = self.dot(simd, d, &seen.turn[2]);
        let bound = lines.bound * self.lanes(simd, &seen.bound);
        let (low, high) = (w0.min(w1).min(w2), w0.max(w1).max(w2));
        let outside = (low.simd_lt(-bound) & high.simd_gt(bound)).to_bitmask() as u32;
        let undecided = ((1 << self.len) - 1) & !outside;
        if undecided == 0 {
            return Met { hit: 0, open: 0 };
        }
        let inside = (low.simd_gt(bound) | high.simd_lt(-bound)).to_bitmask() as u32;
        let size = [d[0].abs(), d[1].abs(), d[2].abs()];
        let det = self.dot(simd, d, &seen.normal);
        let bd = self.dot(simd, &size, &seen.span).mul_add(12.0 * U, f32x16::splat(simd, TINY));
        let v = (self.lanes(simd, &seen.volume[0]), self.lanes(simd, &seen.volume[1]));
        let (hit, miss) = lines.before_end(simd, (det, bd), v);
        let hit = (hit.to_bitmask() as u32) & inside & undecided;
        Met { hit, open: undecided & !hit & !(miss.to_bitmask() as u32) }
    }

    /// The rays: the same operations as in [`super::Receiver::direction`].
    #[inline(always)]
    fn lines<S: Simd>(&self, simd: S, of: &Directions, at: &Lanes<S>) -> Sixteen<S> {
        let x = self.directions(simd, &of.local[0]);
        let y = self.directions(simd, &of.local[1]);
        let z = self.directions(simd, &of.local[2]);
        let [s, t, n] = &at.frame;
        let d0 = (x * self.of(simd, s.x) + y * self.of(simd, t.x)) + z * self.of(simd, n.x);
        let d1 = (x * self.of(simd, s.y) + y * self.of(simd, t.y)) + z * self.of(simd, n.y);
        let d2 = (x * self.of(simd, s.z) + y * self.of(simd, t.z)) + z * self.of(simd, n.z);
        let zero = f32x16::splat(simd, 0.0);
        let bound = (d0.abs() + d1.abs() + d2.abs()) * (1.00001 * 40.0 * U);
        let tmax = self.directions(simd, &of.reach);
        Sixteen { d: [d0, d1, d2], q: [zero; 3], m: [zero; 3], bound, tmax }
    }

    /// v · (the vector of each pair's lane).
    #[inline(always)]
    fn dot<S: Simd>(&self, simd: S, v: &[f32x16<S>; 3], rows: &[[f32; WIDTH]; 3]) -> f32x16<S> {
        let z = v[2] * self.lanes(simd, &rows[2]);
        v[0].mul_add(self.lanes(simd, &rows[0]), v[1].mul_add(self.lanes(simd, &rows[1]), z))
    }

    /// The number of each pair's lane.
    #[inline(always)]
    fn lanes<S: Simd>(&self, simd: S, row: &[f32; WIDTH]) -> f32x16<S> {
        let mut out = [0.0; PACKET];
        for k in 0..PACKET {
            out[k] = row[self.lane[k] as usize % WIDTH];
        }
        f32x16::load_array(simd, out)
    }

    #[inline(always)]
    fn of<S: Simd>(&self, simd: S, row: f32x8<S>) -> f32x16<S> {
        self.lanes(simd, &row.to_array())
    }

    /// The number of each pair's direction.
    #[inline(always)]
    pub fn directions<S: Simd>(&self, simd: S, values: &[f32]) -> f32x16<S> {
        let mut out = [0.0; PACKET];
        for k in 0..PACKET {
            out[k] = values[self.direction[k] as usize];
        }
        f32x16::load_array(simd, out)
    }
}
