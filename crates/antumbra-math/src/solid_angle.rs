//! How large things look: solid angles [sr] in f64.
//!
//! Corners and centres are relative to the point that looks. Flat things have a front: the side from which their
//! corners run counter-clockwise; they count as positive when their front is seen, negative from behind.

use crate::{DVec3, real};

const PI: f64 = std::f64::consts::PI;

/// Six times the signed volume of the triangle and the point that looks: −a·((b−a)×(c−a)), positive in front.
///
/// Edges instead of corners keep its relative error at a few 2⁻⁵³ for tiny triangles too.
#[inline]
pub fn triangle_volume(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    -a.dot((b - a).cross(c - a))
}

/// tan(Ω/2) = V / (abc + (a·b)c + (a·c)b + (b·c)a) (Van Oosterom and Strackee 1983).
#[inline]
pub fn triangle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let v = triangle_volume(a, b, c);
    let d = la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la;
    if v == 0.0 { 0.0 } else { 2.0 * real::atan2(v, d) }
}

/// Ω of the parallelogram (corner, u, v): its two triangles, since the four-corner formula loses every digit at
/// grazing angles.
#[inline]
pub fn parallelogram(corner: DVec3, u: DVec3, v: DVec3) -> f64 {
    let (b, c, d) = (corner + u, corner + u + v, corner + v);
    triangle(corner, b, c) + triangle(corner, c, d)
}

/// 1 − cos α of the cone that a ball of radius r at distance d fills: sin²α / (1 + cos α), sin α = r/d; `None` from
/// inside or on it.
#[inline]
pub fn ball_versin(radius: f64, distance2: f64) -> Option<f64> {
    let sin2 = radius * radius / distance2;
    (sin2 < 1.0).then(|| sin2 / (1.0 + (1.0 - sin2).sqrt()))
}

/// 1 − cos α = 2 sin²(α/2).
#[inline]
pub fn versin(half_angle: f64) -> f64 {
    let s = real::sin(0.5 * half_angle);
    2.0 * s * s
}

/// Ω = 2π (1 − cos α).
#[inline]
pub fn cone(versin: f64) -> f64 {
    2.0 * PI * versin
}
