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

/// A factor with its halves.
#[derive(Clone, Copy)]
struct Split {
    whole: f64,
    high: f64,
    low: f64,
}

impl Split {
    #[inline]
    fn new(b: f64) -> Split {
        let (high, low) = split(b);
        Split { whole: b, high, low }
    }
}

/// a · b = `.0` + `.1` exactly (Dekker).
#[inline]
fn two_prod(a: f64, b: Split) -> (f64, f64) {
    let x = a * b.whole;
    let (high, low) = split(a);
    let error = ((x - high * b.high) - low * b.high) - high * b.low;
    (x, low * b.low - error)
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

    /// high + low, as [`two_sum`], [`two_diff`] and [`two_prod`] give them.
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
        // Without a branch: a 0 is overwritten by the next number. No operation below appends more than `N` numbers,
        // zeros included (but a first 0 of `carry`), so the slot exists.
        self.terms[self.len].write(x);
        self.len += usize::from(x != 0.0);
    }

    /// The numbers, smallest first.
    #[inline]
    pub(crate) fn terms(&self) -> &[f64] {
        let written = &self.terms[..self.len];
        // SAFETY: `len` grows only in `push`, by one and after slot `len` is written: slots 0..len are initialised; and
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

    /// self = e + f (`FAST-EXPANSION-SUM` with zero elimination); `N` is at least the sum of both lengths.
    #[inline]
    pub(crate) fn set_sum(&mut self, e: &[f64], f: &[f64]) {
        self.len = 0;
        let (mut i, mut j) = (0, 0);
        let mut q = 0.0;
        // Both lists merged by magnitude, smallest first; what a sum rounds off goes out.
        while i < e.len() && j < f.len() {
            let take_e = e[i].abs() < f[j].abs();
            let x = if take_e { e[i] } else { f[j] };
            i += usize::from(take_e);
            j += usize::from(!take_e);
            q = self.carry(q, x);
        }
        for &x in e[i..].iter().chain(&f[j..]) {
            q = self.carry(q, x);
        }
        self.push(q);
    }

    /// self = e · b (`SCALE-EXPANSION` with zero elimination); `N` is at least twice the length of e.
    #[inline]
    pub(crate) fn set_scaled(&mut self, e: &[f64], b: f64) {
        self.len = 0;
        let Some((&first, rest)) = e.split_first() else { return };
        let b = Split::new(b);
        let (mut q, low) = two_prod(first, b);
        self.push(low);
        for &x in rest {
            let (product, product_low) = two_prod(x, b);
            let sum = self.carry(q, product_low);
            let (high, low) = fast_two_sum(product, sum);
            self.push(low);
            q = high;
        }
        self.push(q);
    }

    /// self = −e.
    #[inline]
    pub(crate) fn set_negated(&mut self, e: &Expansion<N>) {
        self.len = 0;
        e.terms().iter().for_each(|x| self.push(-x));
    }

    /// q + x rounded; the rest is appended.
    #[inline]
    fn carry(&mut self, q: f64, x: f64) -> f64 {
        let (high, low) = two_sum(q, x);
        self.push(low);
        high
    }
}
