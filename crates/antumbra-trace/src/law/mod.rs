//! The law of visibility: when a line meets a primitive, and where. Everything else in this room may only be faster.
//!
//! **Triangle.** With A = a − o, B = b − o, C = c − o as real numbers, W0 = d·(A×B), W1 = d·(B×C), W2 = d·(C×A),
//! D = W0 + W1 + W2, V = A·(B×C): *hit iff D ≠ 0, no W_i has the sign opposite to D, and 0 < V/D < tmax* — the open
//! segment meets the closed triangle and is not parallel to its plane. No epsilon. Stage 1 decides in f64 with a
//! proven bound, stage 2 exactly.
//!
//! **Shapes.** One f64 formula each ([`shape`](shape())).

// `!(x > y)` is meant: a comparison with NaN must end in a miss or in stage 2.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod exact;
mod expansion;
mod line;
mod shape;
mod stage1;

pub use line::Line;
pub use shape::{shape, shape_box};

#[doc(hidden)]
pub use exact::stage2;
#[doc(hidden)]
pub use stage1::{Verdict, stage1};

pub(crate) use exact::{side_of_direction, side_of_point};
pub(crate) use stage1::{Edges, Numbers, T_BOUND, TEN_W, decide, facing, volume};

/// Weights are taken from stage 1 while its bounds are below this part of their sum: 2⁻³⁰.
pub(crate) const WEIGHT_BOUND: f64 = 1.0 / 1_073_741_824.0;

/// Corners in f64 (written out: a closure here is not always inlined, and this is the hottest line of the referee).
#[inline(always)]
fn widened([a, b, c]: [[f32; 3]; 3]) -> [[f64; 3]; 3] {
    let wide = |v: [f32; 3]| [f64::from(v[0]), f64::from(v[1]), f64::from(v[2])];
    [wide(a), wide(b), wide(c)]
}

/// The t (relative error ≤ 2⁻²⁹, at most `tmax`) at which a line hits a triangle, iff the law says that it does.
#[inline]
pub fn triangle(line: &Line, corners: [[f32; 3]; 3]) -> Option<f64> {
    let corners = widened(corners);
    match stage1(line, corners) {
        Verdict::Miss => None,
        Verdict::Hit(t) => Some(t),
        Verdict::HitSomewhere | Verdict::Open => stage2(line, corners),
    }
}

/// Whether a line hits a triangle: [`triangle`] without its t.
#[inline]
pub fn blocks(line: &Line, corners: [[f32; 3]; 3]) -> bool {
    let corners = widened(corners);
    match stage1(line, corners) {
        Verdict::Miss => false,
        Verdict::Hit(_) | Verdict::HitSomewhere => true,
        Verdict::Open => stage2(line, corners).is_some(),
    }
}

/// Where a line that hits a triangle does so: the weights of corners b and c, both ≥ 0, their sum ≤ 1.
///
/// Error ≤ 2⁻²⁴ or so: rounded from f64 weights of relative error 2⁻²⁸.
#[inline]
pub fn barycentrics(line: &Line, corners: [[f32; 3]; 3]) -> [f32; 2] {
    let corners = widened(corners);
    let edges = stage1::edges(line, corners);
    good_weights(&edges).unwrap_or_else(|| from_weights(exact::weights(line, corners)))
}

/// [`barycentrics`] from the edges of stage 1, where they are good enough.
#[inline(always)]
pub(crate) fn good_weights(&Edges { w, b }: &Edges) -> Option<[f32; 2]> {
    let sum = (w[0] + w[1] + w[2]).abs();
    let good = (b[0] <= WEIGHT_BOUND * sum) & (b[1] <= WEIGHT_BOUND * sum) & (b[2] <= WEIGHT_BOUND * sum);
    // Edge ab (0) faces c, edge bc (1) faces a, edge ca (2) faces b.
    (good && sum > 0.0).then(|| from_weights([w[1], w[2], w[0]]))
}

#[inline(always)]
fn from_weights([a, b, c]: [f64; 3]) -> [f32; 2] {
    let sign = 1f64.copysign(a + b + c);
    let (a, b, c) = ((sign * a).max(0.0), (sign * b).max(0.0), (sign * c).max(0.0));
    let sum = a + b + c;
    if !(sum > 0.0) {
        return [0.0; 2];
    }
    let u = ((b / sum) as f32).min(1.0);
    // 1 − u is exact or rounds to a number whose sum with u rounds to 1.
    [u, ((c / sum) as f32).min(1.0 - u)]
}
