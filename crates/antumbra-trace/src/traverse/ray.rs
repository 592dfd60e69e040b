//! A line made ready for boxes: reciprocals, the sides of near planes, and the conditions under which f32 is proven.

use fearless_simd::{Simd, f32x8, prelude::*};

use crate::law::Line;
use crate::layout::{Tree, below};
use crate::{Segments, TO_POINT};

/// A line rounded to f32; origin and direction are off by at most one rounding each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FastLine {
    pub o: [f32; 3],
    pub d: [f32; 3],
    pub tmax: f32,
}

impl FastLine {
    /// Entry i of a batch, in world space.
    #[inline(always)]
    pub fn of(segments: &Segments<'_>, i: usize) -> FastLine {
        let (o, end, reach) = (segments.origin_at(i), segments.end_at(i), segments.reach[i]);
        if reach == TO_POINT {
            FastLine { o, d: [end[0] - o[0], end[1] - o[1], end[2] - o[2]], tmax: 1.0 }
        } else {
            FastLine { o, d: end, tmax: reach }
        }
    }

    /// A line of an object's space; `tmax` in f32 as it was asked, or shorter. `None` if a component of the direction
    /// would lose more than one rounding.
    #[inline(always)]
    pub fn of_line(line: &Line, tmax: f32) -> Option<FastLine> {
        let f = |v: [f64; 3]| [v[0] as f32, v[1] as f32, v[2] as f32];
        let normal = |c: f64| c == 0.0 || c.abs() >= f64::from(f32::MIN_POSITIVE);
        let whole = normal(line.d[0]) & normal(line.d[1]) & normal(line.d[2]);
        whole.then(|| FastLine { o: f(line.o), d: f(line.d), tmax })
    }
}

/// 2^k as f32.
const fn power(k: i32) -> f32 {
    f32::from_bits(((127 + k) as u32) << 23)
}

/// From where and how far a tree's boxes and filters are proven in f32 (LAW §3, §4).
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Limits {
    /// Largest |o|∞: 2¹⁹ Ms and 2⁴⁰; below 0 if the tree itself is too large.
    origin: f32,
}

impl Limits {
    /// For a tree with everything inside ± `scale`.
    pub fn of_scale(scale: f64) -> Limits {
        if scale.is_nan() || scale > f64::from(power(40)) {
            return Limits { origin: -1.0 };
        }
        // The product is exact in f64; rounding to f32 may exceed it by 2⁻²⁴, which the bound's factor of 2 holds.
        Limits { origin: ((scale * f64::from(power(19))) as f32).min(power(40)) }
    }

    /// For a tree.
    pub fn of(tree: &Tree) -> Limits {
        Limits::of_scale(tree.scale)
    }

    /// The same, but for origins up to `origin` only.
    pub fn within(self, origin: f64) -> Limits {
        Limits { origin: self.origin.min(below(origin)) }
    }

    /// The conditions of LAW §3 (fma form) and §4 hold: 2⁻⁴⁰ ≤ |d|∞, |d|₁ ≤ 2⁴⁰, |o|∞ ≤ 2¹⁹ Ms, 2⁶⁶ |d|∞ and 2⁴⁰,
    /// 0 < tmax. False for NaN.
    #[inline(always)]
    pub fn hold(&self, line: &FastLine) -> bool {
        let largest = |v: &[f32; 3]| v[0].abs().max(v[1].abs()).max(v[2].abs());
        let (o, d) = (largest(&line.o), largest(&line.d));
        // max drops NaN, the sums do not.
        let clean = line.o[0] + line.o[1] + line.o[2] + line.d[0] + line.d[1] + line.d[2];
        (power(-40)..=power(38)).contains(&d)
            && o <= self.origin
            && o <= power(66) * d
            && line.tmax > 0.0
            && !clean.is_nan()
    }
}

/// A line as boxes see it: t of a plane x = p is p·r − o·r.
#[derive(Clone, Copy)]
pub(crate) struct BoxRay<S: Simd> {
    /// 1/d, its size at most 2⁶⁰/|d|∞.
    pub r: [f32x8<S>; 3],
    /// −o·r
    pub or: [f32x8<S>; 3],
    /// Row of the near plane in a node, by axis: 0, 1, 2 for lower planes, 3, 4, 5 for upper ones.
    pub near: [usize; 3],
    /// Row of the far plane.
    pub far: [usize; 3],
}

impl<S: Simd> BoxRay<S> {
    /// For a line for which [`Limits::hold`].
    #[inline(always)]
    pub fn new(simd: S, line: &FastLine) -> BoxRay<S> {
        let d = &line.d;
        let eta = power(-60) * d[0].abs().max(d[1].abs()).max(d[2].abs());
        let (rx, ry, rz) = (reciprocal(d[0], eta), reciprocal(d[1], eta), reciprocal(d[2], eta));
        let lane = |x: f32| f32x8::splat(simd, x);
        BoxRay {
            r: [lane(rx), lane(ry), lane(rz)],
            or: [lane(-(line.o[0] * rx)), lane(-(line.o[1] * ry)), lane(-(line.o[2] * rz))],
            near: [row(rx, 0), row(ry, 1), row(rz, 2)],
            far: [row(-rx, 0), row(-ry, 1), row(-rz, 2)],
        }
    }
}

/// 1/d, or ±1/η where |d| < η.
#[inline(always)]
fn reciprocal(d: f32, eta: f32) -> f32 {
    1.0 / if d.abs() < eta { eta.copysign(d) } else { d }
}

#[inline(always)]
fn row(r: f32, axis: usize) -> usize {
    axis + if r < 0.0 { 3 } else { 0 }
}
