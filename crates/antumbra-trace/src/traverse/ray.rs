//! A line made ready for boxes: reciprocals, the sides of near planes, and the conditions under which f32 is proven.

use fearless_simd::{Simd, f32x8, prelude::*};

use crate::law::Line;
use crate::layout::{Tree, below, larger, smaller};
use crate::{Segments, TO_POINT};

/// A line rounded to f32; origin and direction are off by at most one rounding each.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FastLine {
    pub o: [f32; 3],
    pub d: [f32; 3],
    pub tmax: f32,
}

impl FastLine {
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

/// A batch whose columns are known to be equally long: one bounds check an entry is enough.
#[derive(Clone, Copy)]
pub(crate) struct Lines<'a> {
    origin: [&'a [f32]; 3],
    end: [&'a [f32]; 3],
    reach: &'a [f32],
}

impl<'a> Lines<'a> {
    /// The lines of a batch, in world space.
    #[inline(always)]
    pub fn of(segments: &Segments<'a>) -> Lines<'a> {
        let n = segments.reach.len();
        let (o, e) = (segments.origin, segments.end);
        Lines {
            origin: [&o[0][..n], &o[1][..n], &o[2][..n]],
            end: [&e[0][..n], &e[1][..n], &e[2][..n]],
            reach: segments.reach,
        }
    }

    /// Origin, end and reach by component.
    #[inline(always)]
    pub fn columns(&self) -> [&'a [f32]; 7] {
        let ([a, b, c], [d, e, f]) = (self.origin, self.end);
        [a, b, c, d, e, f, self.reach]
    }

    /// The largest t of entry i.
    #[inline(always)]
    pub fn tmax(&self, i: usize) -> f32 {
        if self.reach[i] == TO_POINT { 1.0 } else { self.reach[i] }
    }

    /// Entry i.
    #[inline(always)]
    pub fn line(&self, i: usize) -> FastLine {
        let o = [self.origin[0][i], self.origin[1][i], self.origin[2][i]];
        let e = [self.end[0][i], self.end[1][i], self.end[2][i]];
        if self.reach[i] == TO_POINT {
            FastLine { o, d: [e[0] - o[0], e[1] - o[1], e[2] - o[2]], tmax: self.tmax(i) }
        } else {
            FastLine { o, d: e, tmax: self.tmax(i) }
        }
    }
}

/// |v|∞, where no component is NaN.
#[inline(always)]
pub(crate) fn size(v: &[f32; 3]) -> f32 {
    larger(larger(v[0].abs(), v[1].abs()), v[2].abs())
}

/// 2^k as f32.
pub(crate) const fn power(k: i32) -> f32 {
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

    /// There are origins for which f32 is proven.
    #[inline(always)]
    pub fn are_sound(&self) -> bool {
        self.origin >= 0.0
    }

    /// The same, but for origins up to `origin` only.
    pub fn within(self, origin: f64) -> Limits {
        Limits { origin: self.origin.min(below(origin)) }
    }

    /// The conditions of LAW §3 (fma form) and §4 hold: 2⁻⁴⁰ ≤ |d|∞, |d|₁ ≤ 2⁴⁰, |o|∞ ≤ 2¹⁹ Ms, 2⁶⁶ |d|∞ and 2⁴⁰,
    /// 0 < tmax. False for NaN.
    #[inline(always)]
    pub fn hold(&self, line: &FastLine) -> bool {
        let within =
            |v: &[f32; 3], limit: f32| (v[0].abs() <= limit) & (v[1].abs() <= limit) & (v[2].abs() <= limit);
        let d = size(&line.d);
        let far = smaller(self.origin, power(66) * d);
        within(&line.o, far) & within(&line.d, power(38)) & (d >= power(-40)) & (line.tmax > 0.0)
    }

    /// [`hold`](Limits::hold) of eight lines; `size`: |d|∞.
    #[inline(always)]
    pub fn hold_eight<S: Simd>(
        &self,
        simd: S,
        o: &[f32x8<S>; 3],
        d: &[f32x8<S>; 3],
        size: f32x8<S>,
        tmax: f32x8<S>,
    ) -> u64 {
        let far = f32x8::splat(simd, self.origin).min(size * power(66));
        let within = |v: &[f32x8<S>; 3], limit: f32x8<S>| {
            v[0].abs().simd_le(limit) & v[1].abs().simd_le(limit) & v[2].abs().simd_le(limit)
        };
        let fine = size.simd_ge(power(-40)) & tmax.simd_gt(0.0);
        (within(o, far) & within(d, f32x8::splat(simd, power(38))) & fine).to_bitmask()
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
        let eta = power(-60) * size(d);
        let r = [reciprocal(d[0], eta), reciprocal(d[1], eta), reciprocal(d[2], eta)];
        let or = [-(line.o[0] * r[0]), -(line.o[1] * r[1]), -(line.o[2] * r[2])];
        let lane = |x: f32| f32x8::splat(simd, x);
        BoxRay {
            r: [lane(r[0]), lane(r[1]), lane(r[2])],
            or: [lane(or[0]), lane(or[1]), lane(or[2])],
            near: [row(r[0], 0), row(r[1], 1), row(r[2], 2)],
            far: [row(-r[0], 0), row(-r[1], 1), row(-r[2], 2)],
        }
    }
}

/// 1/d, or ±1/η where |d| < η.
#[inline(always)]
fn reciprocal(d: f32, eta: f32) -> f32 {
    1.0 / if d.abs() < eta { eta.copysign(d) } else { d }
}

/// The row of planes that a line of direction `r` meets first; r is not 0.
#[inline(always)]
fn row(r: f32, axis: usize) -> usize {
    axis + 3 * (r.to_bits() >> 31) as usize
}
