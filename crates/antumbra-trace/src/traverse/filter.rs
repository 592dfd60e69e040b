//! One line against eight triangles in f32: certain hits, certain misses, and the rest (LAW §4, the "single" form).

use fearless_simd::{Simd, f32x8, prelude::*};

use super::ray::FastLine;
use super::vector::V3;
use crate::layout::TriangleBlock;

/// 2⁻²⁴, half a unit in the last place of 1.
const U: f32 = 1.0 / 16_777_216.0;
/// 2⁻¹²⁰: covers what underflows.
const TINY: f32 = f32::from_bits(7 << 23);

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
        let off = if placed { o[0].abs().max(o[1].abs()).max(o[2].abs()) } else { 0.0 };
        TriangleRay {
            o: V3::splat(simd, *o),
            d: V3::splat(simd, *d),
            edge: f32x8::splat(simd, 40.0 * U * d1),
            off: f32x8::splat(simd, off),
        }
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
    let (va, vb, vc) = (
        V3::load(simd, &block.corners[0]),
        V3::load(simd, &block.corners[1]),
        V3::load(simd, &block.corners[2]),
    );
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
    let bound = ray.edge * edge * size;
    let (low, high) = (w0.min(w1).min(w2), w0.max(w1).max(w2));
    let outside = low.simd_lt(-bound) & high.simd_gt(bound);
    let undecided = !(outside.to_bitmask() as u32) & 0xff;
    if undecided == 0 {
        return Verdict { hit: 0, open: 0 };
    }
    let inside = (low.simd_gt(bound) | high.simd_lt(-bound)).to_bitmask() as u32;
    let (hit, miss) = along::<S, PLACED>(simd, (a, e0, e1), ray, tmax);
    let hit = undecided & inside & hit;
    Verdict { hit, open: undecided & !hit & !miss }
}

/// The distance: lanes certainly in 0 < t < tmax, and lanes certainly not.
#[inline(always)]
fn along<S: Simd, const PLACED: bool>(
    simd: S,
    (a, e0, e1): (V3<S>, V3<S>, V3<S>),
    ray: &TriangleRay<S>,
    tmax: f32,
) -> (u32, u32) {
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
    let size = det.abs();
    let sv = det.simd_lt(0.0).select(-v, v);
    let sure = size.simd_gt(bd);
    let t = f32x8::splat(simd, tmax);
    // tmax = ∞ makes the bound ∞ too: such a line has no far end to pass.
    let (far, bf) = (t.mul_sub(size, sv), t.mul_add(bd, bv));
    let before_end = far.simd_gt(bf) | t.simd_eq(f32::INFINITY);
    let hit = sure & sv.simd_gt(bv) & before_end;
    let miss = sure & (sv.simd_lt(-bv) | far.simd_lt(-bf));
    (hit.to_bitmask() as u32, miss.to_bitmask() as u32)
}
