//! Sums of f64 numbers without rounding: Shewchuk's floating-point expansions (Discrete & Computational Geometry 18,
//! 1997). Only f64 additions, subtractions and products in a written order: the same bits with or without FMA hardware.
//!
//! Exact as long as no product overflows or loses a bit below 2⁻¹⁰⁷⁴; the caller's numbers see to that (LAW §1).

use std::mem::MaybeUninit;

/// a + b = `.0` + `.1` exactly, `.0` the rounded sum.
#[inline]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let x = a + b;
    let from_b = x - a;
    let from_a = x - from_b;
    (x, (a - from_a) + (b - from_b))
}

/// a − b = `.0` + `.1` exactly, `.0` the rounded difference.
#[inline]
pub(crate) fn two_diff(a: f64, b: f64) -> (f64, f64) {
    let x = a - b;
    let from_b = a - x;
    let from_a = x + from_b;
    (x, (a - from_a) + (from_b - b))
}

/// As [`two_sum`] where |a| ≥ |b|.
#[inline]
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let x = a + b;
    (x, b - (x - a))
}

/// Veltkamp's split into two halves of at most 26 bits; |a| < 2⁹⁹⁶.
#[inline]
fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a; // 2²⁷ + 1
    let high = c - (c - a);
    (high, a - high)
}

/// a · b = `.0` + `.1` exactly (Dekker).
#[inline]
fn two_prod(a: f64, (b, b_high, b_low): (f64, f64, f64)) -> (f64, f64) {
    let x = a * b;
    let (a_high, a_low) = split(a);
    let error = ((x - a_high * b_high) - a_low * b_high) - a_high * b_low;
    (x, a_low * b_low - error)
}

/// An exact sum of up to `N` numbers, none of them 0, from the smallest to the largest magnitude, strongly
/// nonoverlapping (each operation here keeps that under round-to-even). No number at all is 0.
pub(crate) struct Expansion<const N: usize> {
    terms: [MaybeUninit<f64>; N],
    len: usize,
}

impl<const N: usize> Expansion<N> {
    /// The sum 0.
    #[inline]
    pub(crate) fn zero() -> Expansion<N> {
        // The slots stay unwritten: clearing them would cost more than the sums that use them.
        Expansion { terms: [MaybeUninit::uninit(); N], len: 0 }
    }

    /// high + low, as [`two_sum`], [`two_diff`] and `two_prod` give them.
    #[inline]
    pub(crate) fn of((high, low): (f64, f64)) -> Expansion<N> {
        let mut e = Expansion::zero();
        e.push(low);
        e.push(high);
        e
    }

    /// Appends `x` unless it is 0.
    #[inline]
    fn push(&mut self, x: f64) {
        if x != 0.0 {
            self.terms[self.len].write(x);
            self.len += 1;
        }
    }

    /// The numbers, smallest first.
    #[inline]
    pub(crate) fn terms(&self) -> &[f64] {
        let written = &self.terms[..self.len];
        // SAFETY: `len` grows only in `push`, which writes slot `len` first, so slots 0..len are initialised; and
        // MaybeUninit<f64> has the size and alignment of f64.
        unsafe { std::slice::from_raw_parts(written.as_ptr().cast::<f64>(), written.len()) }
    }

    /// The sign of the sum: that of its largest number.
    #[inline]
    pub(crate) fn sign(&self) -> i32 {
        match self.terms().last() {
            None => 0,
            Some(&x) if x > 0.0 => 1,
            Some(_) => -1,
        }
    }

    /// The sum, rounded: added up from the smallest number.
    #[inline]
    pub(crate) fn estimate(&self) -> f64 {
        self.terms().iter().sum()
    }

    /// The sum with its sign turned.
    #[inline]
    pub(crate) fn negated(&self) -> Expansion<N> {
        let mut out = Expansion::zero();
        for &x in self.terms() {
            out.push(-x);
        }
        out
    }
}

/// e + f (`FAST-EXPANSION-SUM` with zero elimination). `N` is at least the sum of both lengths.
#[inline]
pub(crate) fn sum<const N: usize>(e: &[f64], f: &[f64]) -> Expansion<N> {
    let mut out = Expansion::zero();
    let (mut i, mut j) = (0, 0);
    // Merges both by magnitude, smallest first.
    let mut next = || {
        let take_e = match (e.get(i), f.get(j)) {
            (Some(x), Some(y)) => x.abs() < y.abs(),
            (Some(_), None) => true,
            (None, Some(_)) => false,
            (None, None) => return None,
        };
        let (list, at) = if take_e { (e, &mut i) } else { (f, &mut j) };
        *at += 1;
        Some(list[*at - 1])
    };
    let Some(mut q) = next() else { return out };
    if let Some(second) = next() {
        let (high, low) = fast_two_sum(second, q);
        out.push(low);
        q = high;
    }
    while let Some(x) = next() {
        let (high, low) = two_sum(q, x);
        out.push(low);
        q = high;
    }
    out.push(q);
    out
}

/// e · b (`SCALE-EXPANSION` with zero elimination). `N` is at least twice the length of e.
#[inline]
pub(crate) fn scale<const N: usize>(e: &[f64], b: f64) -> Expansion<N> {
    let mut out = Expansion::zero();
    let Some((&first, rest)) = e.split_first() else { return out };
    let (high, low) = split(b);
    let b = (b, high, low);
    let (mut q, low) = two_prod(first, b);
    out.push(low);
    for &x in rest {
        let (product, product_low) = two_prod(x, b);
        let (sum, low) = two_sum(q, product_low);
        out.push(low);
        let (high, low) = fast_two_sum(product, sum);
        out.push(low);
        q = high;
    }
    out.push(q);
    out
}
