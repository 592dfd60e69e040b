//! What boxes the directions of some receivers can meet at all: within the longest ray, above the horizon.

use fearless_simd::{Simd, f32x8, prelude::*};

use super::levels::FLOOR;
use super::{Directions, Receiver};
use crate::layout::{larger, smaller};
use crate::traverse::V3;

/// 2⁻²¹ = 8u: what a scalar product of differences is off by, as a part of its absolute terms (at most 4u).
pub(super) const EIGHT_U: f32 = 1.0 / 2_097_152.0;

/// Receivers as a box of starts and a box of normals.
#[derive(Clone, Copy)]
pub(super) struct Region<S: Simd> {
    start: [V3<S>; 2],
    normal: [V3<S>; 2],
    /// Above the squared length of every ray.
    longest: f32,
    /// Below the cosine of every direction.
    low: f32,
}

impl<S: Simd> Region<S> {
    /// Around one receiver or more.
    #[inline(always)]
    pub fn of<'a>(simd: S, all: impl Iterator<Item = &'a Receiver>, directions: &Directions) -> Region<S> {
        let (low, high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        let (mut start, mut normal) = ([low, high], [low, high]);
        for at in all {
            for (bounds, v) in [(&mut start, at.start), (&mut normal, at.frame()[2])] {
                for k in 0..3 {
                    bounds[0][k] = smaller(bounds[0][k], v[k]);
                    bounds[1][k] = larger(bounds[1][k], v[k]);
                }
            }
        }
        let splat = |v: [[f32; 3]; 2]| v.map(|v| V3::splat(simd, v));
        let (longest, low) = (directions.levels.longest, directions.low);
        Region { start: splat(start), normal: splat(normal), longest, low }
    }

    /// Which of eight boxes may hold what a ray meets.
    ///
    /// The distance of two boxes on an axis is one difference. A point X = o + t d above the horizon has
    /// n·(X − o) ≥ low |X − o|: no product of the bounds may stay below that.
    #[inline(always)]
    pub fn meets(&self, simd: S, lo: V3<S>, hi: V3<S>) -> u32 {
        let (from, to) = (lo.minus(self.start[1]), hi.minus(self.start[0]));
        let zero = f32x8::splat(simd, 0.0);
        let gap = V3 {
            x: from.x.max(-to.x).max(zero),
            y: from.y.max(-to.y).max(zero),
            z: from.z.max(-to.z).max(zero),
        };
        let [n0, n1] = self.normal;
        let most = |n0: f32x8<S>, n1: f32x8<S>, a: f32x8<S>, b: f32x8<S>| {
            (n0 * a).max(n0 * b).max((n1 * a).max(n1 * b))
        };
        let height =
            most(n0.x, n1.x, from.x, to.x) + most(n0.y, n1.y, from.y, to.y) + most(n0.z, n1.z, from.z, to.z);
        let (n, far) = (n0.abs().larger(n1.abs()), from.abs().larger(to.abs()));
        let off = n.dot(far).mul_add(EIGHT_U, f32x8::splat(simd, FLOOR));
        let below = (height + off).simd_lt(gap.largest() * self.low);
        let beyond = gap.dot(gap).simd_gt(self.longest);
        // Lanes without a box hold +∞, −∞.
        let there = lo.x.simd_le(hi.x);
        (there & !(below | beyond)).to_bitmask() as u32
    }
}
