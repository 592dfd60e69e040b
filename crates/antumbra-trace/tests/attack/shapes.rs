//! LAW §7.7: shapes hit where they are, inside their boxes, and never next to where a segment leaves them.

use antumbra_trace::Shape;
use antumbra_trace::law::{Line, shape, shape_box};
use antumbra_trace::start::start_on_shape;

use crate::rng::{Rng, amount, cross, dot, mix, to_f32, to_f64, unit};

/// A shape of size 10⁻⁶..10⁶ at up to 10³ times its size from the origin.
fn random_shape(r: &mut Rng) -> Shape {
    let radius = r.signed_power(-6.0, 6.0).abs() as f32;
    let away = r.signed_power(-1.0, 3.0) * f64::from(radius);
    let center = to_f32(r.cube(away.abs()));
    match r.below(3) {
        0 => Shape::Sphere { center, radius },
        1 => Shape::Disk { center, normal: to_f32(axis(r).map(|x| x * 3.0)), radius },
        _ => {
            let along = axis(r).map(|x| x * f64::from(radius) * 2.0);
            Shape::Cylinder { p: center, q: to_f32(mix([1.0, 1.0], [to_f64(center), along])), radius }
        }
    }
}

/// A direction, often exactly along an axis.
fn axis(r: &mut Rng) -> [f64; 3] {
    let mut v = [0.0; 3];
    v[r.below(3) as usize] = 1.0;
    if r.below(2) == 0 { v } else { r.direction() }
}

/// A point on the shape and its unit normal there (outward; the disk's own).
fn point_on(shape: &Shape, r: &mut Rng) -> ([f64; 3], [f64; 3]) {
    match *shape {
        Shape::Sphere { center, radius } => {
            let n = axis(r);
            (mix([1.0, radius.into()], [to_f64(center), n]), n)
        }
        Shape::Disk { center, normal, radius } => {
            let n = unit(to_f64(normal));
            let rim = unit(cross(n, r.direction()));
            (mix([1.0, f64::from(radius) * 0.99 * r.unit()], [to_f64(center), rim]), n)
        }
        Shape::Cylinder { p, q, radius } => {
            let (p, q) = (to_f64(p), to_f64(q));
            let n = unit(cross(mix([1.0, -1.0], [q, p]), r.direction()));
            let s = r.range(0.01, 0.99);
            (mix([1.0 - s, s, radius.into()], [p, q, n]), n)
        }
    }
}

/// The size of the numbers that a point of the shape is computed from.
fn extent(shape: &Shape) -> f64 {
    let largest = |p: [f32; 3]| to_f64(p).iter().fold(0f64, |m, x| m.max(x.abs()));
    match *shape {
        Shape::Sphere { center, radius } | Shape::Disk { center, radius, .. } => {
            largest(center) + f64::from(radius)
        }
        Shape::Cylinder { p, q, radius } => largest(p).max(largest(q)) + f64::from(radius),
    }
}

#[test]
fn a_line_at_a_point_of_a_shape_hits_it_there_or_before() {
    let mut r = Rng::new(2001);
    for _ in 0..amount(50_000, 2_000_000) {
        let s = random_shape(&mut r);
        let (p, n) = point_on(&s, &mut r);
        let reach = extent(&s);
        let o = to_f32(mix([1.0, reach * r.range(0.5, 20.0)], [p, r.direction()]));
        let to_p = mix([1.0, -1.0], [p, to_f64(o)]);
        let d = to_f32(to_p);
        let cosine = dot(unit(to_f64(d)), n).abs();
        if cosine < 0.05 {
            continue;
        }
        let line = Line::ray(o, d, f32::INFINITY);
        let Some(t) = shape(&line, &s) else { panic!("{s:?} is missed by {line:?}") };
        // d points at p within 2^-24 of its length, and the point of a shape that far away moves by that / cosine;
        // a curved shape may be met before.
        let slack = 4.0 * 2f64.powi(-24) / (cosine * cosine) * (1.0 + reach / dot(to_p, to_p).sqrt());
        assert!(t <= 1.0 + slack, "{s:?} {line:?}: t = {t}");
        if matches!(s, Shape::Disk { .. }) {
            assert!(t >= 1.0 - slack, "{s:?} {line:?}: t = {t}");
        }
        let x = mix([1.0, t], [to_f64(o), line.d]);
        assert_on_shape(&s, x, 2f64.powi(-44) * 40.0 * reach / cosine);
    }
}

/// x is within `tolerance` of the shape's surface.
fn assert_on_shape(s: &Shape, x: [f64; 3], tolerance: f64) {
    let off = match *s {
        Shape::Sphere { center, radius } => {
            let v = mix([1.0, -1.0], [x, to_f64(center)]);
            dot(v, v).sqrt() - f64::from(radius)
        }
        Shape::Disk { center, normal, .. } => {
            dot(mix([1.0, -1.0], [x, to_f64(center)]), unit(to_f64(normal)))
        }
        Shape::Cylinder { p, q, radius } => {
            let axis = unit(mix([1.0, -1.0], [to_f64(q), to_f64(p)]));
            let v = cross(axis, mix([1.0, -1.0], [x, to_f64(p)]));
            dot(v, v).sqrt() - f64::from(radius)
        }
    };
    // A tangent root has a square-root error; the caller stays away from tangents.
    assert!(off.abs() <= tolerance, "{s:?}: {off} off, allowed {tolerance}");
}

#[test]
fn every_hit_lies_in_the_box() {
    let mut r = Rng::new(2002);
    for _ in 0..amount(100_000, 5_000_000) {
        let s = random_shape(&mut r);
        let (low, high) = shape_box(&s);
        let reach = extent(&s);
        let (p, n) = point_on(&s, &mut r);
        assert!(
            (0..3)
                .all(|k| f64::from(low[k]) - 1e-15 * reach <= p[k]
                    && p[k] <= f64::from(high[k]) + 1e-15 * reach)
        );
        // Tangents and their neighbours as well.
        let tangent = cross(n, r.direction());
        let height = reach * [0.0, 1e-16, -1e-12, 1e-7, -1e-3][r.below(5) as usize];
        let o = mix([1.0, height, r.signed_power(-3.0, 10.0) * reach], [p, n, tangent]);
        let line = Line::ray(to_f32(o), to_f32(tangent), f32::INFINITY);
        let Some(t) = shape(&line, &s) else { continue };
        for k in 0..3 {
            let x = line.o[k] + t * line.d[k];
            // Rule G grows by 2^-32 of the box and 2^-40 of t; the rest is f64 rounding of x.
            let m = 2f64.powi(-32) * reach + 2f64.powi(-39) * (t * line.d[k]).abs() + 1e-15 * line.o[k].abs();
            assert!(f64::from(low[k]) - m <= x && x <= f64::from(high[k]) + m, "{s:?} {line:?} axis {k}");
        }
    }
}

#[test]
fn a_segment_that_leaves_a_shape_does_not_meet_it() {
    let mut r = Rng::new(2003);
    for _ in 0..amount(100_000, 5_000_000) {
        let s = random_shape(&mut r);
        let (p, n) = point_on(&s, &mut r);
        let o = start_on_shape(p, n, extent(&s));
        let tangent = unit(cross(n, r.direction()));
        let rise = if r.below(2) == 0 { r.unit() } else { r.signed_power(-12.0, -2.0).abs() };
        let d = mix([1.0, rise], [tangent, n]);
        assert!(dot(d, n) >= 0.0);
        let line = Line::ray(o, to_f32(d), f32::INFINITY);
        assert_eq!(shape(&line, &s), None, "{s:?} meets itself from {p:?} along {d:?}");
    }
}

#[test]
fn a_segment_inside_a_sphere_meets_its_other_side() {
    let mut r = Rng::new(2004);
    for _ in 0..amount(50_000, 1_000_000) {
        let radius = r.signed_power(-6.0, 6.0).abs();
        let s = Shape::Sphere { center: to_f32(r.cube(radius)), radius: radius as f32 };
        let (p, n) = point_on(&s, &mut r);
        let inward = n.map(|x| -x);
        let o = start_on_shape(p, inward, extent(&s));
        let cosine = r.range(0.01, 1.0);
        let tangent = unit(cross(n, r.direction()));
        let d = mix([(1.0 - cosine * cosine).sqrt(), cosine], [tangent, inward]);
        let Some(t) = shape(&Line::ray(o, to_f32(d), f32::INFINITY), &s) else {
            panic!("{s:?} leaks at {p:?}")
        };
        // Chord 2 r cos; start and direction are off by a few 2^-21 of the extent, over the cosine.
        let chord = 2.0 * radius * cosine;
        assert!(
            (t - chord).abs() <= 8.0 * 2f64.powi(-21) * extent(&s) / cosine,
            "{s:?} t = {t}, chord {chord}"
        );
    }
}

#[test]
fn shapes_without_size_are_missed() {
    let up = Line::ray([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], f32::INFINITY);
    let (o, z) = ([0.0; 3], [0.0, 0.0, 1.0]);
    for s in [
        Shape::Disk { center: o, normal: o, radius: 1.0 },
        Shape::Cylinder { p: o, q: o, radius: 1.0 },
        Shape::Cylinder { p: o, q: z, radius: 0.5 },
        Shape::Sphere { center: [f32::NAN; 3], radius: 1.0 },
    ] {
        assert_eq!(shape(&up, &s), None, "{s:?}");
    }
}
