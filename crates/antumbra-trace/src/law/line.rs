//! A ray or an open segment, in the space where its primitives have their numbers.

use antumbra_math::{DVec3, Transform};

use super::expansion::two_diff;
use crate::{Segments, TO_POINT};

/// 2²⁰⁰ and 2⁻²⁰⁰: between them no product of the law overflows or loses a bit.
const LARGEST: f64 = f64::from_bits((1023 + 200) << 52);
const SMALLEST: f64 = f64::from_bits((1023 - 200) << 52);

/// The points o + t·d, 0 < t < `tmax`, with d = `d` + `d_lo` exactly.
///
/// Made by its constructors, which turn an invalid question (a number that is NaN, infinite or above 2²⁰⁰, a
/// direction 0, equal end points, `tmax` not above 0) into [`Line::NOWHERE`]: it hits nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Origin.
    pub o: [f64; 3],
    /// Direction of any length, rounded.
    pub d: [f64; 3],
    /// What the rounding of `d` left; 0 for a ray.
    pub d_lo: [f64; 3],
    /// End of the open interval of t: 1 for a segment, may be +∞ for a ray.
    pub tmax: f64,
    /// The end point, if this is a segment: instances map points, not differences.
    end: Option<[f64; 3]>,
}

impl Line {
    /// No points at all: what an invalid question becomes.
    pub const NOWHERE: Line = Line { o: [0.0; 3], d: [0.0; 3], d_lo: [0.0; 3], tmax: 0.0, end: None };

    /// The open segment from p to q; its direction q − p is exact.
    #[inline]
    pub fn segment(p: [f32; 3], q: [f32; 3]) -> Line {
        Line::between(widened(p), widened(q))
    }

    /// The ray o + t·d, 0 < t < `tmax`.
    #[inline]
    pub fn ray(o: [f32; 3], d: [f32; 3], tmax: f32) -> Line {
        Line::along(widened(o), widened(d), f64::from(tmax))
    }

    /// Entry i of a batch.
    #[inline]
    pub fn of(segments: &Segments<'_>, i: usize) -> Line {
        let (o, end, reach) = (segments.origin_at(i), segments.end_at(i), segments.reach[i]);
        if reach == TO_POINT { Line::segment(o, end) } else { Line::ray(o, end, reach) }
    }

    /// The same points in the space of an instance: a ray by origin and direction, a segment by both end points, so
    /// that swapping them changes nothing; t is unchanged. Numbers below 2⁻²⁰⁰ become 0.
    #[inline]
    pub fn to_object(&self, object_from_world: &Transform) -> Line {
        let point = |p: [f64; 3]| flush(object_from_world.point(DVec3::from_array(p)));
        if !self.is_valid() {
            return Line::NOWHERE;
        }
        match self.end {
            Some(q) => Line::between(point(self.o), point(q)),
            None => {
                let d = flush(object_from_world.vector(DVec3::from_array(self.d)));
                Line::along(point(self.o), d, self.tmax)
            }
        }
    }

    /// There is something to ask: not [`Line::NOWHERE`].
    #[inline]
    pub fn is_valid(&self) -> bool {
        self.tmax > 0.0
    }

    /// This is a segment with two end points, not a ray.
    #[inline]
    pub fn is_segment(&self) -> bool {
        self.end.is_some()
    }

    #[inline]
    fn between(p: [f64; 3], q: [f64; 3]) -> Line {
        if !in_range(p) || !in_range(q) || p == q {
            return Line::NOWHERE;
        }
        let d = [two_diff(q[0], p[0]), two_diff(q[1], p[1]), two_diff(q[2], p[2])];
        let [(x, x_lo), (y, y_lo), (z, z_lo)] = d;
        Line { o: p, d: [x, y, z], d_lo: [x_lo, y_lo, z_lo], tmax: 1.0, end: Some(q) }
    }

    #[inline]
    fn along(o: [f64; 3], d: [f64; 3], tmax: f64) -> Line {
        if !in_range(o) || !in_range(d) || d == [0.0; 3] || !(tmax > 0.0) {
            return Line::NOWHERE;
        }
        Line { o, d, d_lo: [0.0; 3], tmax, end: None }
    }
}

#[inline(always)]
fn widened(v: [f32; 3]) -> [f64; 3] {
    [f64::from(v[0]), f64::from(v[1]), f64::from(v[2])]
}

/// All finite and at most 2²⁰⁰ (false for NaN).
#[inline]
fn in_range(x: [f64; 3]) -> bool {
    (x[0].abs() <= LARGEST) & (x[1].abs() <= LARGEST) & (x[2].abs() <= LARGEST)
}

#[inline]
fn flush(x: DVec3) -> [f64; 3] {
    x.to_array().map(|c| if c.abs() < SMALLEST { 0.0 } else { c })
}
