//! Where a segment starts so that its own surface does not block it (LAW §5): the only place that solves this.
//!
//! The start is lifted from the surface by h = 2⁻²¹ M along the unit normal, M the largest coordinate in play, and
//! rounded to f32 once. That is proved to clear the own triangle, its coplanar and its convex neighbours at every scale.

use crate::law::{facing, side_of_direction, side_of_point, volume};

/// 2⁻²¹: the lift as a part of the largest coordinate (LAW §5, T5).
const LIFT: f64 = 1.0 / 2_097_152.0;

/// The start above point `p` of a triangle, on the side of the unit normal `n_toward`: where the segment leaves.
///
/// `corners` are world numbers. Proved (T5): a direction d with d·n ≥ 0, rounded once to f32, never hits this triangle.
pub fn start_on_triangle(p: [f64; 3], n_toward: [f64; 3], corners: [[f64; 3]; 3]) -> [f32; 3] {
    start_on_placed_triangle(p, n_toward, corners, 0.0)
}

/// As [`start_on_triangle`] for a triangle placed by a map x ↦ R x + t: `extent` = max(‖R‖∞ |a|∞, |t|∞), the size of
/// the numbers that the corners were computed from, with a the largest corner in object space.
pub fn start_on_placed_triangle(
    p: [f64; 3],
    n_toward: [f64; 3],
    corners: [[f64; 3]; 3],
    extent: f64,
) -> [f32; 3] {
    let m = corners.iter().fold(largest(p).max(extent), |m, c| m.max(largest(*c)));
    let front = front(n_toward, corners);
    let mut h = LIFT * m;
    let mut o = lift(p, n_toward, h);
    // At once in all but made-up cases; ends because h reaches infinity.
    while front != 0 && h.is_finite() && side(o, corners) != front {
        h *= 2.0;
        o = lift(p, n_toward, h);
    }
    o
}

/// The start above point `p` of a sphere, disk or cylinder; `extent` = |centre|∞ + r, or |ends|∞ + r.
pub fn start_on_shape(p: [f64; 3], n_toward: [f64; 3], extent: f64) -> [f32; 3] {
    lift(p, n_toward, LIFT * largest(p).max(extent))
}

/// The start above a point that belongs to no known primitive (a query with points and normals of its own).
pub fn start_free(p: [f64; 3], n: [f64; 3]) -> [f32; 3] {
    lift(p, n, LIFT * largest(p))
}

/// p + n h, rounded to f32 once.
fn lift(p: [f64; 3], n: [f64; 3], h: f64) -> [f32; 3] {
    [0, 1, 2].map(|k| (p[k] + n[k] * h) as f32)
}

/// |x|∞.
fn largest(x: [f64; 3]) -> f64 {
    x.iter().fold(0.0, |m, c| m.max(c.abs()))
}

/// The exact side to which `n` points: +1 in front, 0 along the plane.
fn front(n: [f64; 3], corners: [[f64; 3]; 3]) -> i32 {
    let (det, bound) = facing(n, corners);
    if det > bound {
        1
    } else if det < -bound {
        -1
    } else {
        side_of_direction(n, corners)
    }
}

/// The exact side of the triangle on which `o` lies: +1 in front (corners counter-clockwise), 0 on the plane.
fn side(o: [f32; 3], corners: [[f64; 3]; 3]) -> i32 {
    let o = o.map(f64::from);
    let (v, bound) = volume(o, corners);
    // V = (a − o)·n < 0 in front.
    if v < -bound {
        1
    } else if v > bound {
        -1
    } else {
        -side_of_point(o, corners)
    }
}
