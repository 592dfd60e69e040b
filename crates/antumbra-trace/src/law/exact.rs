//! Stage 2 of the law of the triangle: its signs without rounding (LAW §1). 0.66 µs a call, for the pairs that
//! stage 1 leaves open.

use super::expansion::{Expansion, scale, sum, two_diff};
use super::line::Line;

/// An exact number as high + low.
type Pair = Expansion<2>;
/// A vector of exact numbers of `N` terms.
type Exact3<const N: usize> = [Expansion<N>; 3];

/// p − q.
#[inline]
fn difference(p: [f64; 3], q: [f64; 3]) -> Exact3<2> {
    [0, 1, 2].map(|k| Pair::of(two_diff(p[k], q[k])))
}

/// x · y for two numbers of two terms.
#[inline]
fn product(x: &Pair, y: &Pair) -> Expansion<8> {
    let mut out = Expansion::<8>::zero();
    for &factor in x.terms() {
        let part: Expansion<4> = scale(y.terms(), factor);
        out = sum(out.terms(), part.terms());
    }
    out
}

/// p × q.
#[inline]
fn cross(p: &Exact3<2>, q: &Exact3<2>) -> Exact3<16> {
    [(1, 2), (2, 0), (0, 1)]
        .map(|(i, j)| sum(product(&p[i], &q[j]).terms(), product(&p[j], &q[i]).negated().terms()))
}

/// p · m.
#[inline]
fn dot(p: &Exact3<2>, m: &Exact3<16>) -> Expansion<192> {
    let mut out = Expansion::<192>::zero();
    for (x, y) in p.iter().zip(m) {
        for &factor in x.terms() {
            let part: Expansion<32> = scale(y.terms(), factor);
            out = sum(out.terms(), part.terms());
        }
    }
    out
}

/// The corners seen from the origin of a line, and its direction.
struct View {
    corners: [Exact3<2>; 3],
    d: Exact3<2>,
}

impl View {
    fn new(line: &Line, corners: [[f64; 3]; 3]) -> View {
        View {
            corners: corners.map(|c| difference(c, line.o)),
            d: [0, 1, 2].map(|k| Pair::of((line.d[k], line.d_lo[k]))),
        }
    }

    /// W_i: W0 = d·(A × B), W1 = d·(B × C), W2 = d·(C × A).
    fn edge(&self, i: usize) -> Expansion<192> {
        dot(&self.d, &cross(&self.corners[i], &self.corners[(i + 1) % 3]))
    }

    /// V = A·(B × C).
    fn volume(&self) -> Expansion<192> {
        volume(&self.corners)
    }
}

fn volume(corners: &[Exact3<2>; 3]) -> Expansion<192> {
    dot(&corners[0], &cross(&corners[1], &corners[2]))
}

/// Stage 2: Some(t) iff the open line meets the closed triangle and is not parallel to its plane. `line` is valid.
#[doc(hidden)]
#[inline(never)]
pub fn stage2(line: &Line, corners: [[f64; 3]; 3]) -> Option<f64> {
    let view = View::new(line, corners);
    let w0 = view.edge(0);
    let w1 = view.edge(1);
    if w0.sign() * w1.sign() < 0 {
        return None;
    }
    let w2 = view.edge(2);
    // One sign, or 0: then D = W0 + W1 + W2 has it too, and is 0 only if all three are.
    let side = if w0.sign() != 0 { w0.sign() } else { w1.sign() };
    if side * w2.sign() < 0 {
        return None;
    }
    let side = if side != 0 { side } else { w2.sign() };
    let v = view.volume();
    if side == 0 || v.sign() != side {
        return None;
    }
    let d: Expansion<576> = sum(sum::<384>(w0.terms(), w1.terms()).terms(), w2.terms());
    if line.tmax < f64::INFINITY {
        let far: Expansion<1344> = sum(scale::<1152>(d.terms(), line.tmax).terms(), v.negated().terms());
        if far.sign() != side {
            return None;
        }
    }
    Some((v.estimate() / d.estimate()).min(line.tmax))
}

/// The exact W1, W2, W0 (weights of a, b, c before the division by D), each rounded once at the end.
#[inline(never)]
pub(super) fn weights(line: &Line, corners: [[f64; 3]; 3]) -> [f64; 3] {
    let view = View::new(line, corners);
    [1, 2, 0].map(|i| view.edge(i).estimate())
}

/// The sign of (a − o)·((b − o) × (c − o)): −1 where `o` is in front (corners run counter-clockwise), 0 on the plane.
#[inline(never)]
pub(crate) fn side_of_point(o: [f64; 3], corners: [[f64; 3]; 3]) -> i32 {
    volume(&corners.map(|c| difference(c, o))).sign()
}

/// The sign of n·((b − a) × (c − b)): +1 where `n` leaves the front.
#[inline(never)]
pub(crate) fn side_of_direction(n: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> i32 {
    dot(&n.map(|x| Pair::of((x, 0.0))), &cross(&difference(b, a), &difference(c, b))).sign()
}
