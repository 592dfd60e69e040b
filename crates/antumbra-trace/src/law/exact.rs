//! Stage 2 of the law of the triangle: its signs without rounding (LAW §1), for the few pairs that stage 1 leaves open.

use super::expansion::{Expansion, two_diff};
use super::line::Line;

/// A vector of exact numbers, each high + low.
type Pairs = [Expansion<2>; 3];
/// A vector of exact numbers of up to 16 terms: a cross product of two [`Pairs`].
type Cross = [Expansion<16>; 3];
/// A scalar product of [`Pairs`] and [`Cross`]: 3 · 2 · 2 · 16 terms.
type Scalar = Expansion<192>;

/// p − q.
#[inline]
fn difference(p: [f64; 3], q: [f64; 3]) -> Pairs {
    [0, 1, 2].map(|k| Expansion::of(two_diff(p[k], q[k])))
}

/// s x y, s = ±1.
#[inline]
fn product(s: f64, x: &Expansion<2>, y: &Expansion<2>) -> Expansion<8> {
    let (mut low, mut high) = (Expansion::<4>::zero(), Expansion::<4>::zero());
    let mut out = Expansion::zero();
    match *x.terms() {
        [] => {}
        [x] => out.set_scaled(y.terms(), s * x),
        [x_low, x_high, ..] => {
            low.set_scaled(y.terms(), s * x_low);
            high.set_scaled(y.terms(), s * x_high);
            out.set_sum(low.terms(), high.terms());
        }
    }
    out
}

/// p × q.
#[inline]
fn cross(p: &Pairs, q: &Pairs) -> Cross {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
        let mut out = Expansion::zero();
        out.set_sum(product(1.0, &p[i], &q[j]).terms(), product(-1.0, &p[j], &q[i]).terms());
        out
    })
}

/// out = x m.
#[inline]
fn times(x: &Expansion<2>, m: &Expansion<16>, out: &mut Expansion<64>) {
    match *x.terms() {
        [] => {}
        [x] => out.set_scaled(m.terms(), x),
        [x_low, x_high, ..] => {
            let (mut low, mut high) = (Expansion::<32>::zero(), Expansion::<32>::zero());
            low.set_scaled(m.terms(), x_low);
            high.set_scaled(m.terms(), x_high);
            out.set_sum(low.terms(), high.terms());
        }
    }
}

/// p · m.
#[inline(never)]
fn dot(p: &Pairs, m: &Cross) -> Scalar {
    let mut parts = [Expansion::zero(), Expansion::zero(), Expansion::zero()];
    for k in 0..3 {
        times(&p[k], &m[k], &mut parts[k]);
    }
    let mut two = Expansion::<128>::zero();
    two.set_sum(parts[0].terms(), parts[1].terms());
    let mut out = Expansion::zero();
    out.set_sum(two.terms(), parts[2].terms());
    out
}

/// (a − o)·((b − o) × (c − o)).
#[inline]
fn volume([a, b, c]: &[Pairs; 3]) -> Scalar {
    dot(a, &cross(b, c))
}

/// The direction of a line, exactly.
#[inline]
fn direction(line: &Line) -> Pairs {
    [0, 1, 2].map(|k| Expansion::of((line.d[k], line.d_lo[k])))
}

/// d·((b − a) × (c − b)) = D.
#[inline]
fn determinant(d: &Pairs, [a, b, c]: [[f64; 3]; 3]) -> Scalar {
    dot(d, &cross(&difference(b, a), &difference(c, b)))
}

/// Stage 2: Some(t) iff the open line meets the closed triangle and is not parallel to its plane. `line` is valid.
#[doc(hidden)]
#[inline(never)]
pub fn stage2(line: &Line, corners: [[f64; 3]; 3]) -> Option<f64> {
    let seen = corners.map(|c| difference(c, line.o));
    let d = direction(line);
    // First what is at stake where planes meet ends of segments, then the edges.
    let v = volume(&seen);
    if v.sign() == 0 {
        return None;
    }
    let det = determinant(&d, corners);
    let side = det.sign();
    if v.sign() != side {
        return None;
    }
    if line.tmax < f64::INFINITY {
        // tmax D − V must have the sign of D.
        let (mut far, mut minus_v) = (Expansion::<384>::zero(), Scalar::zero());
        far.set_scaled(det.terms(), line.tmax);
        minus_v.set_negated(&v);
        let mut rest = Expansion::<576>::zero();
        rest.set_sum(far.terms(), minus_v.terms());
        if rest.sign() != side {
            return None;
        }
    }
    let [a, b, c] = &seen;
    for (p, q) in [(a, b), (b, c), (c, a)] {
        if dot(&d, &cross(p, q)).sign() * side < 0 {
            return None;
        }
    }
    Some((v.estimate() / det.estimate()).min(line.tmax))
}

/// The exact W1, W2, W0 (weights of a, b, c before the division by D), each rounded at the end.
#[inline(never)]
pub(super) fn weights(line: &Line, corners: [[f64; 3]; 3]) -> [f64; 3] {
    let [a, b, c] = corners.map(|c| difference(c, line.o));
    let d = direction(line);
    [(&b, &c), (&c, &a), (&a, &b)].map(|(p, q)| dot(&d, &cross(p, q)).estimate())
}

/// The sign of (a − o)·((b − o) × (c − o)): −1 where `o` is in front (corners run counter-clockwise), 0 on the plane.
#[inline(never)]
pub(crate) fn side_of_point(o: [f64; 3], corners: [[f64; 3]; 3]) -> i32 {
    volume(&corners.map(|c| difference(c, o))).sign()
}

/// The sign of n·((b − a) × (c − b)): +1 where `n` leaves the front.
#[inline(never)]
pub(crate) fn side_of_direction(n: [f64; 3], corners: [[f64; 3]; 3]) -> i32 {
    determinant(&n.map(|x| Expansion::of((x, 0.0))), corners).sign()
}
