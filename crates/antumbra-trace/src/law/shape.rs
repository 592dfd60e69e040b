//! Sphere, disk and open cylinder: one f64 formula each, in a fixed order, which *is* the law (LAW §6).

use super::line::Line;
use super::stage1::{dot, sub};
use crate::Shape;

/// 2⁻³² of the largest coordinate: how far rule G grows a shape's box.
const GROW: f64 = 1.0 / 4_294_967_296.0;
/// 2⁻⁴⁰: widening of the interval of rule G, and the parallel rules of disk and cylinder.
const TINY: f64 = 1.0 / 1_099_511_627_776.0;
/// 2⁻⁵⁰: more than the rounding of a half-width below.
const SLACK: f64 = 1.0 / 1_125_899_906_842_624.0;

/// The smallest valid t of a line on a shape: in (0, tmax) and inside the shape's box by rule G.
#[inline]
pub fn shape(line: &Line, shape: &Shape) -> Option<f64> {
    let inside = interval(line, shape_box(shape))?;
    match *shape {
        Shape::Sphere { center, radius } => sphere(line, center.map(f64::from), radius.into(), inside),
        Shape::Disk { center, normal, radius } => {
            disk(line, center.map(f64::from), normal.map(f64::from), radius.into(), inside)
        }
        Shape::Cylinder { p, q, radius } => {
            cylinder(line, p.map(f64::from), q.map(f64::from), radius.into(), inside)
        }
    }
}

/// The box of a shape, rounded outward: (low, high).
pub fn shape_box(shape: &Shape) -> ([f32; 3], [f32; 3]) {
    let (p, q, half) = match *shape {
        Shape::Sphere { center, radius } => (center, center, [f64::from(radius); 3]),
        Shape::Disk { center, normal, radius } => {
            let n = normal.map(f64::from);
            let nn = dot(n, n);
            (center, center, n.map(|x| f64::from(radius) * ((nn - x * x) / nn).max(0.0).sqrt()))
        }
        Shape::Cylinder { p, q, radius } => {
            let x = sub(q.map(f64::from), p.map(f64::from));
            let g = dot(x, x);
            (p, q, x.map(|x| f64::from(radius) * ((g - x * x) / g).max(0.0).sqrt()))
        }
    };
    // The slack covers the f64 rounding of half-width and sum, so that the f32 rounding starts outside.
    let low = |k: usize| {
        let c = f64::from(p[k].min(q[k]));
        round_down(c - half[k] - SLACK * (c.abs() + half[k]))
    };
    let high = |k: usize| {
        let c = f64::from(p[k].max(q[k]));
        -round_down(-(c + half[k] + SLACK * (c.abs() + half[k])))
    };
    ([low(0), low(1), low(2)], [high(0), high(1), high(2)])
}

/// The largest f32 at or below x, finite.
fn round_down(x: f64) -> f32 {
    let nearest = x as f32;
    let below = if f64::from(nearest) > x { nearest.next_down() } else { nearest };
    below.clamp(f32::MIN, f32::MAX)
}

/// The t that may be a hit: inside the grown box, and the line's own end.
#[derive(Clone, Copy)]
struct Interval {
    t0: f64,
    t1: f64,
    tmax: f64,
}

impl Interval {
    /// False for NaN.
    #[inline]
    fn contains(self, t: f64) -> bool {
        0.0 < t && t < self.tmax && self.t0 <= t && t <= self.t1
    }
}

/// Rule G: where the line is inside the box grown by 2⁻³² of its largest coordinate.
#[inline]
fn interval(line: &Line, (low, high): ([f32; 3], [f32; 3])) -> Option<Interval> {
    let (low, high) = (low.map(f64::from), high.map(f64::from));
    let m = low.iter().chain(&high).fold(0f64, |m, c| m.max(c.abs()));
    let g = GROW * m;
    let (mut t0, mut t1) = (f64::NEG_INFINITY, f64::INFINITY);
    for k in 0..3 {
        let (near, far) = (low[k] - g, high[k] + g);
        let (o, d) = (line.o[k], line.d[k]);
        if d == 0.0 {
            if !(near <= o && o <= far) {
                return None;
            }
            continue;
        }
        let (x, y) = ((near - o) / d, (far - o) / d);
        t0 = t0.max(x.min(y));
        t1 = t1.min(x.max(y));
    }
    Some(Interval { t0: t0 - TINY * t0.abs(), t1: t1 + TINY * t1.abs(), tmax: line.tmax })
}

/// |o + t d − c| = r.
#[inline]
fn sphere(line: &Line, c: [f64; 3], r: f64, inside: Interval) -> Option<f64> {
    let d = line.d;
    let l = sub(c, line.o);
    let dd = dot(d, d);
    let tc = dot(l, d) / dd;
    let q = [l[0] - tc * d[0], l[1] - tc * d[1], l[2] - tc * d[2]];
    let disc = r * r - dot(q, q);
    if !(disc >= 0.0) {
        return None;
    }
    let k = (disc / dd).sqrt();
    [tc - k, tc + k].into_iter().find(|&t| inside.contains(t))
}

/// The point of the plane within r of c.
#[inline]
fn disk(line: &Line, c: [f64; 3], n: [f64; 3], r: f64, inside: Interval) -> Option<f64> {
    let d = line.d;
    let a = sub(c, line.o);
    let det = dot(d, n);
    let norm1 = |x: [f64; 3]| (x[0].abs() + x[1].abs()) + x[2].abs();
    if !(det.abs() > TINY * (norm1(n) * norm1(d))) {
        return None;
    }
    let t = dot(a, n) / det;
    let p = [t * d[0] - a[0], t * d[1] - a[1], t * d[2] - a[2]];
    (dot(p, p) <= r * r && inside.contains(t)).then_some(t)
}

/// The points at distance r from the axis p q, between its ends.
#[inline]
fn cylinder(line: &Line, p: [f64; 3], q: [f64; 3], r: f64, inside: Interval) -> Option<f64> {
    let d = line.d;
    let x = sub(q, p);
    let g = dot(x, x);
    let w = sub(line.o, p);
    let (al, be) = (dot(d, x) / g, dot(w, x) / g);
    // Direction and origin without their parts along the axis.
    let across = |v: [f64; 3], s: f64| [v[0] - s * x[0], v[1] - s * x[1], v[2] - s * x[2]];
    let (d1, w1) = (across(d, al), across(w, be));
    let k = dot(d1, d1);
    if !(k > TINY * dot(d, d)) {
        return None;
    }
    let tc = -dot(w1, d1) / k;
    let s = [w1[0] + tc * d1[0], w1[1] + tc * d1[1], w1[2] + tc * d1[2]];
    let disc = r * r - dot(s, s);
    if !(disc >= 0.0) {
        return None;
    }
    let h = (disc / k).sqrt();
    [tc - h, tc + h].into_iter().find(|&t| inside.contains(t) && (0.0..=1.0).contains(&(be + t * al)))
}
