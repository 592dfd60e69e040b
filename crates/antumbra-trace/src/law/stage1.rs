//! Stage 1 of the law of the triangle: f64 in a fixed order with a running error bound (LAW §1). It decides nearly
//! every pair in some 24 ns, and says so where it cannot.

use super::line::Line;

/// 10 w, w = 2⁻⁵³: proved in LAW §1 for every value below, the bounds' own rounding included.
pub(crate) const TEN_W: f64 = 10.0 / 9_007_199_254_740_992.0;
/// 2⁻³⁰: t = sv / |det| is taken from here only if both parts are this good.
pub(crate) const T_BOUND: f64 = 1.0 / 1_073_741_824.0;

/// What stage 1 knows of a line and a triangle.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// They do not meet.
    Miss,
    /// They meet, at this t (relative error ≤ 2⁻²⁹).
    Hit(f64),
    /// They meet; t must come from stage 2.
    HitSomewhere,
    /// Stage 2 decides.
    Open,
}

/// x · y in the law's order.
#[inline(always)]
pub(super) fn dot(x: [f64; 3], y: [f64; 3]) -> f64 {
    (x[0] * y[0] + x[1] * y[1]) + x[2] * y[2]
}

#[inline(always)]
pub(super) fn cross(x: [f64; 3], y: [f64; 3]) -> [f64; 3] {
    [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]
}

/// |x| X |y|: the cross product of absolute values with + instead of −.
#[inline(always)]
fn cross_bound(x: [f64; 3], y: [f64; 3]) -> [f64; 3] {
    let (x, y) = (x.map(f64::abs), y.map(f64::abs));
    [x[1] * y[2] + x[2] * y[1], x[2] * y[0] + x[0] * y[2], x[0] * y[1] + x[1] * y[0]]
}

#[inline(always)]
pub(super) fn add(x: [f64; 3], y: [f64; 3]) -> [f64; 3] {
    [x[0] + y[0], x[1] + y[1], x[2] + y[2]]
}

#[inline(always)]
pub(super) fn sub(x: [f64; 3], y: [f64; 3]) -> [f64; 3] {
    [x[0] - y[0], x[1] - y[1], x[2] - y[2]]
}

/// The three w_i = −2 W_i and their bounds b_i.
#[derive(Clone, Copy)]
pub(crate) struct Edges {
    pub w: [f64; 3],
    pub b: [f64; 3],
}

/// The differences that all of stage 1 is made of.
#[derive(Clone, Copy)]
struct View {
    e: [[f64; 3]; 3],
    from_o: [[f64; 3]; 3],
}

#[inline(always)]
fn view(o: [f64; 3], [a, b, c]: [[f64; 3]; 3]) -> View {
    View { e: [sub(b, a), sub(c, b), sub(a, c)], from_o: [sub(a, o), sub(b, o), sub(c, o)] }
}

#[inline(always)]
fn edges_of(v: &View, d: [f64; 3]) -> Edges {
    let d_abs = d.map(f64::abs);
    let edge = |i: usize| {
        let (p, q) = (v.from_o[i], v.from_o[(i + 1) % 3]);
        let w = dot(d, cross(v.e[i], add(p, q)));
        let b = TEN_W * dot(d_abs, cross_bound(v.e[i], add(p.map(f64::abs), q.map(f64::abs))));
        (w, b)
    };
    let ((w0, b0), (w1, b1), (w2, b2)) = (edge(0), edge(1), edge(2));
    Edges { w: [w0, w1, w2], b: [b0, b1, b2] }
}

/// w_i and b_i of a line and a triangle.
#[inline]
pub(super) fn edges(line: &Line, corners: [[f64; 3]; 3]) -> Edges {
    edges_of(&view(line.o, corners), line.d)
}

/// V = A·n and its bound.
#[inline]
pub(crate) fn volume(o: [f64; 3], corners: [[f64; 3]; 3]) -> (f64, f64) {
    let v = view(o, corners);
    let bound = dot(v.from_o[0].map(f64::abs), cross_bound(v.e[0], v.e[1]));
    (dot(v.from_o[0], cross(v.e[0], v.e[1])), TEN_W * bound)
}

/// d·n and its bound.
#[inline]
pub(crate) fn facing(d: [f64; 3], corners: [[f64; 3]; 3]) -> (f64, f64) {
    let (e0, e1) = (sub(corners[1], corners[0]), sub(corners[2], corners[1]));
    (dot(d, cross(e0, e1)), TEN_W * dot(d.map(f64::abs), cross_bound(e0, e1)))
}

/// All that stage 1 computes of a line and a triangle, before it decides.
#[derive(Clone, Copy)]
pub(crate) struct Numbers {
    /// w_i = −2 W_i of the edges ab, bc, ca, and their bounds.
    pub edges: Edges,
    /// V and its bound.
    pub v: (f64, f64),
    /// D and its bound.
    pub det: (f64, f64),
}

/// Stage 1. `line` is valid; corners are f32 numbers.
#[doc(hidden)]
#[inline]
pub fn stage1(line: &Line, corners: [[f64; 3]; 3]) -> Verdict {
    let view = view(line.o, corners);
    let d = line.d;
    let edges = edges_of(&view, d);
    if certainly_beside(&edges) {
        return Verdict::Miss;
    }
    let n = cross(view.e[0], view.e[1]);
    let p = cross_bound(view.e[0], view.e[1]);
    let v = (dot(view.from_o[0], n), TEN_W * dot(view.from_o[0].map(f64::abs), p));
    let det = (dot(d, n), TEN_W * dot(d.map(f64::abs), p));
    decide(&Numbers { edges, v, det }, line.tmax)
}

/// The line passes an edge on the outer side for certain.
#[inline(always)]
fn certainly_beside(Edges { w, b }: &Edges) -> bool {
    ((w[0] > b[0]) | (w[1] > b[1]) | (w[2] > b[2])) & ((w[0] < -b[0]) | (w[1] < -b[1]) | (w[2] < -b[2]))
}

/// What follows from the numbers of stage 1 for 0 < t < `tmax`.
#[inline(always)]
pub(crate) fn decide(numbers: &Numbers, tmax: f64) -> Verdict {
    if certainly_beside(&numbers.edges) {
        return Verdict::Miss;
    }
    let Numbers { edges: Edges { w, b }, v: (v, bv), det: (det, bd) } = *numbers;
    let pos = (w[0] > b[0]) & (w[1] > b[1]) & (w[2] > b[2]);
    let neg = (w[0] < -b[0]) & (w[1] < -b[1]) & (w[2] < -b[2]);
    let det_abs = det.abs();
    if !(pos | neg) {
        if bd == 0.0 {
            return Verdict::Miss;
        }
        if det_abs <= bd {
            return Verdict::Open;
        }
    }
    // w = −2 W: all w above 0 means D < 0.
    let sv = if pos | (!neg & (det < 0.0)) { -v } else { v };
    if sv < -bv {
        return Verdict::Miss;
    }
    if det_abs <= bd {
        return Verdict::Open;
    }
    if tmax < f64::INFINITY {
        let far = tmax * det_abs - sv;
        let bf = tmax * (bd + 2.0 * TEN_W / 10.0 * det_abs) + bv;
        if far < -bf {
            return Verdict::Miss;
        }
        if !(far > bf) {
            return Verdict::Open;
        }
    }
    if !(sv > bv && (pos | neg)) {
        return Verdict::Open;
    }
    if bv <= T_BOUND * sv && bd <= T_BOUND * det_abs {
        return Verdict::Hit(sv / det_abs);
    }
    Verdict::HitSomewhere
}
