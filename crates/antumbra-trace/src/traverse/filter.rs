//! One line against eight triangles in f32: certain hits, certain misses, and the rest (LAW §4, the "single" form).

use fearless_simd::{Simd, f32x8, prelude::*};

use super::ray::{FastLine, size};
use super::vector::V3;
use crate::layout::{TriangleBlock, WIDTH};

/// 2⁻²⁴, half a unit in the last place of 1.
pub(crate) const U: f32 = 1.0 / 16_777_216.0;
/// 2⁻¹²⁰: covers what underflows.
pub(crate) const TINY: f32 = f32::from_bits(7 << 23);

/// A line made ready for triangles.
#[derive(Clone, Copy)]
pub(crate) struct TriangleRay<S: Simd> {
    o: V3<S>,
    d: V3<S>,
    /// 40 u D1, D1 = 1.00001 |d|₁.
    edge: f32x8<S>,
    /// |o′|∞, what an origin rounded to f32 may be off by in units of u; 0 in world space.
    off: f32x8<S>,
}

impl<S: Simd> TriangleRay<S> {
    /// `placed`: the origin of `line` was rounded.
    #[inline(always)]
    pub fn new(simd: S, line: &FastLine, placed: bool) -> TriangleRay<S> {
        let (o, d) = (&line.o, &line.d);
        let d1 = (d[0].abs() + d[1].abs() + d[2].abs()) * 1.00001;
        let off = if placed { size(o) } else { 0.0 };
        TriangleRay {
            o: V3::splat(simd, *o),
            d: V3::splat(simd, *d),
            edge: f32x8::splat(simd, 40.0 * U * d1),
            off: f32x8::splat(simd, off),
        }
    }

    /// A line of world space with its edge bound.
    #[inline(always)]
    pub fn world(simd: S, o: V3<S>, d: V3<S>, edge: f32) -> TriangleRay<S> {
        TriangleRay { o, d, edge: f32x8::splat(simd, edge), off: f32x8::splat(simd, 0.0) }
    }
}

/// Lanes that are hit for certain, and lanes that only the law can decide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Verdict {
    pub hit: u32,
    pub open: u32,
}

impl Verdict {
    /// Lanes that are or may be hit.
    #[inline(always)]
    pub fn lanes(self) -> u32 {
        self.hit | self.open
    }
}

/// Decides what f32 can decide about 0 < t < `tmax`.
#[inline(always)]
pub(crate) fn filter<S: Simd, const PLACED: bool>(
    simd: S,
    block: &TriangleBlock,
    ray: &TriangleRay<S>,
    tmax: f32,
) -> Verdict {
    let sides = Sides::of::<PLACED>(simd, block, ray);
    if sides.undecided == 0 {
        return Verdict { hit: 0, open: 0 };
    }
    Along::of::<PLACED>(simd, &sides, ray).verdict(simd, &sides, tmax)
}

/// As [`filter`], and the interval in which t of each certain hit lies.
#[inline(always)]
pub(crate) fn filter_with_t<S: Simd, const PLACED: bool>(
    simd: S,
    block: &TriangleBlock,
    ray: &TriangleRay<S>,
    tmax: f32,
) -> (Verdict, Interval) {
    let sides = Sides::of::<PLACED>(simd, block, ray);
    let none = (Verdict { hit: 0, open: 0 }, Interval { from: [0.0; WIDTH], to: [0.0; WIDTH] });
    if sides.undecided == 0 {
        return none;
    }
    let along = Along::of::<PLACED>(simd, &sides, ray);
    let verdict = along.verdict(simd, &sides, tmax);
    if verdict.lanes() == 0 {
        return none;
    }
    (verdict, along.interval())
}

/// Where t of eight triangles lies; means something for certain hits only.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    pub from: [f32; WIDTH],
    pub to: [f32; WIDTH],
}

/// w_i = d·(e_i × (A_i + A_i+1)) of the three edges with their common bound, and the differences on the way.
struct Edges<S: Simd> {
    w: [f32x8<S>; 3],
    bound: f32x8<S>,
    a: V3<S>,
    e0: V3<S>,
    e1: V3<S>,
}

impl<S: Simd> Edges<S> {
    #[inline(always)]
    fn of<const PLACED: bool>(simd: S, block: &TriangleBlock, ray: &TriangleRay<S>) -> Edges<S> {
        let [va, vb, vc] = &block.corners;
        let (va, vb, vc) = (V3::load(simd, va), V3::load(simd, vb), V3::load(simd, vc));
        let (a, b, c) = (va.minus(ray.o), vb.minus(ray.o), vc.minus(ray.o));
        let (e0, e1, e2) = (vb.minus(va), vc.minus(vb), va.minus(vc));
        let w0 = ray.d.dot(e0.cross(a.plus(b)));
        let w1 = ray.d.dot(e1.cross(b.plus(c)));
        let w2 = ray.d.dot(e2.cross(c.plus(a)));
        let edge = f32x8::load_array_ref(simd, &block.edge);
        let mut size = a.abs().largest() + edge;
        if PLACED {
            size += ray.off;
        }
        Edges { w: [w0, w1, w2], bound: ray.edge * edge * size, a, e0, e1 }
    }
}

/// On which sides of the edges the line passes, and what the distance is computed from.
struct Sides<S: Simd> {
    /// Lanes that the line does not certainly pass by.
    undecided: u32,
    /// Lanes that it certainly goes through.
    inside: u32,
    a: V3<S>,
    e0: V3<S>,
    e1: V3<S>,
}

impl<S: Simd> Sides<S> {
    #[inline(always)]
    fn of<const PLACED: bool>(simd: S, block: &TriangleBlock, ray: &TriangleRay<S>) -> Sides<S> {
        let Edges { w: [w0, w1, w2], bound, a, e0, e1 } = Edges::of::<PLACED>(simd, block, ray);
        let (low, high) = (w0.min(w1).min(w2), w0.max(w1).max(w2));
        let outside = low.simd_lt(-bound) & high.simd_gt(bound);
        let inside = low.simd_gt(bound) | high.simd_lt(-bound);
        let undecided = !(outside.to_bitmask() as u32) & 0xff;
        Sides { undecided, inside: inside.to_bitmask() as u32, a, e0, e1 }
    }
}

/// The distance as sv/size, with the bounds of both.
struct Along<S: Simd> {
    sv: f32x8<S>,
    bv: f32x8<S>,
    size: f32x8<S>,
    bd: f32x8<S>,
}

impl<S: Simd> Along<S> {
    #[inline(always)]
    fn of<const PLACED: bool>(simd: S, sides: &Sides<S>, ray: &TriangleRay<S>) -> Along<S> {
        let (a, e0, e1) = (sides.a, sides.e0, sides.e1);
        let tiny = f32x8::splat(simd, TINY);
        let n = e0.cross(e1);
        let (f0, f1) = (e0.abs(), e1.abs());
        let p = V3 {
            x: f0.y.mul_add(f1.z, f0.z.mul_add(f1.y, tiny)),
            y: f0.z.mul_add(f1.x, f0.x.mul_add(f1.z, tiny)),
            z: f0.x.mul_add(f1.y, f0.y.mul_add(f1.x, tiny)),
        };
        let (v, det) = (a.dot(n), ray.d.dot(n));
        let mut reach = a.abs();
        if PLACED {
            reach = reach.plus(V3 { x: ray.off, y: ray.off, z: ray.off });
        }
        let (bv, bd) = (reach.dot(p).mul_add(12.0 * U, tiny), ray.d.abs().dot(p).mul_add(12.0 * U, tiny));
        Along { sv: det.simd_lt(0.0).select(-v, v), bv, size: det.abs(), bd }
    }

    #[inline(always)]
    fn verdict(&self, simd: S, sides: &Sides<S>, tmax: f32) -> Verdict {
        let sure = self.size.simd_gt(self.bd);
        let t = f32x8::splat(simd, tmax);
        // tmax = ∞ makes the bound ∞ too: such a line has no far end to pass.
        let (far, bf) = (t.mul_sub(self.size, self.sv), t.mul_add(self.bd, self.bv));
        let before_end = far.simd_gt(bf) | t.simd_eq(f32::INFINITY);
        let hit = (sure & self.sv.simd_gt(self.bv) & before_end).to_bitmask() as u32;
        let miss = (sure & (self.sv.simd_lt(-self.bv) | far.simd_lt(-bf))).to_bitmask() as u32;
        let hit = hit & sides.undecided & sides.inside;
        Verdict { hit, open: sides.undecided & !hit & !miss }
    }

    /// The quotients of the bounds, their own four roundings covered by 2⁻²⁰.
    #[inline(always)]
    fn interval(&self) -> Interval {
        let from = (self.sv - self.bv) / (self.size + self.bd) * (1.0 - SLACK);
        let to = (self.sv + self.bv) / (self.size - self.bd) * (1.0 + SLACK);
        Interval { from: from.to_array(), to: to.to_array() }
    }
}

/// 2⁻²⁰
const SLACK: f32 = 1.0 / 1_048_576.0;

#[cfg(test)]
#[allow(dead_code, reason = "shared with the attacks on the law, which use more of it")]
#[path = "../../tests/attack/rng.rs"]
pub(super) mod rng;
#[cfg(test)]
#[path = "filter_tests.rs"]
mod tests;
