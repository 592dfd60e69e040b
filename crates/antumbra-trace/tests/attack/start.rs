//! LAW §7.6 (T5): what leaves a surface from its start never meets its own triangle nor its coplanar and convex
//! neighbours, and never loses a wall that stands on it; at scales 10⁻⁶ to 10⁶ and offsets to 10³ times the size.

use antumbra_math::{DMat3, DVec3, Transform};
use antumbra_trace::law::{Line, blocks};
use antumbra_trace::start::{start_free, start_on_placed_triangle, start_on_triangle};

use crate::rng::{Rng, amount, cross, dot, mix, to_f32, to_f64, unit};

type Corners = [[f32; 3]; 3];

/// Size and position of a scene.
struct Place {
    size: f64,
    center: [f64; 3],
}

impl Place {
    fn random(r: &mut Rng) -> Place {
        let size = r.signed_power(-6.0, 6.0).abs();
        let away = if r.below(3) == 0 { 0.0 } else { r.signed_power(-1.0, 3.0) * size };
        Place { size, center: r.cube(away.abs()) }
    }

    fn point(&self, x: [f64; 3]) -> [f32; 3] {
        to_f32(mix([1.0, self.size], [self.center, x]))
    }
}

/// The unit normal in f64, unless rounding makes it worse than 2⁻²⁴ / 100.
fn normal(corners: Corners) -> Option<[f64; 3]> {
    let [a, b, c] = corners.map(to_f64);
    let (e0, e1) = (mix([1.0, -1.0], [b, a]), mix([1.0, -1.0], [c, b]));
    let n = cross(e0, e1);
    let product = (dot(e0, e0) * dot(e1, e1)).sqrt();
    // Each component has an error of 3 · 2⁻⁵³ |e0| |e1|.
    (dot(n, n).sqrt() > 1e-6 * product).then(|| unit(n))
}

/// A direction with d·n ≥ 0 in f64, half the time within 10⁻² to 10⁻¹² of the tangent plane.
fn leaving(n: [f64; 3], r: &mut Rng) -> [f64; 3] {
    let tangent = unit(cross(n, r.direction()));
    let rise = match r.below(4) {
        0 => 0.0,
        1 => r.range(0.0, 3.0),
        _ => r.signed_power(-12.0, -2.0).abs(),
    };
    let d = unit(mix([1.0, rise], [tangent, n]));
    if dot(d, n) >= 0.0 { d } else { n }
}

fn largest(points: &[[f32; 3]]) -> f32 {
    points.iter().flatten().fold(0f32, |m, x| m.max(x.abs()))
}

/// A random point of the triangle, its start towards n, and a ray from there.
fn leave(corners: Corners, n: [f64; 3], r: &mut Rng) -> ([f32; 3], Line) {
    let p = mix(r.weights(), corners.map(to_f64));
    let o = start_on_triangle(p, n, corners.map(to_f64));
    (o, Line::ray(o, to_f32(leaving(n, r)), f32::INFINITY))
}

#[test]
fn a_triangle_never_blocks_what_leaves_it() {
    let mut r = Rng::new(3001);
    for _ in 0..amount(100_000, 5_000_000) {
        let place = Place::random(&mut r);
        let width = r.signed_power(-5.0, 0.0);
        let (a, b, u) = (r.cube(1.0), r.cube(1.0), r.unit());
        let c = mix([1.0 - u, u, width], [a, b, r.direction()]);
        let corners = [a, b, c].map(|x| place.point(x));
        let Some(n) = normal(corners) else { continue };
        let n = if r.below(2) == 0 { n } else { n.map(|x| -x) };
        let (_, line) = leave(corners, n, &mut r);
        assert!(!blocks(&line, corners), "{corners:?} blocks {line:?}");
    }
}

#[test]
fn coplanar_neighbours_never_block() {
    let mut r = Rng::new(3002);
    let mut asked = 0;
    for _ in 0..amount(150_000, 5_000_000) {
        let place = Place::random(&mut r);
        let ideal = r.direction();
        let x = unit(cross(ideal, r.direction()));
        let y = cross(ideal, x);
        let mut point = || place.point(mix([r.range(-1.0, 1.0), r.range(-1.0, 1.0)], [x, y]));
        let (own, other) = ([point(), point(), point()], [point(), point(), point()]);
        let Some(n) = normal(own) else { continue };
        let n = if dot(n, ideal) < 0.0 { n.map(|x| -x) } else { n };
        if dot(n, ideal) <= 0.65 || largest(&other) > largest(&own) {
            continue;
        }
        asked += 1;
        let p = mix(r.weights(), own.map(to_f64));
        let o = start_on_triangle(p, n, own.map(to_f64));
        let line = Line::ray(o, to_f32(leaving(ideal, &mut r)), f32::INFINITY);
        assert!(!blocks(&line, other), "{other:?} blocks {line:?} from {own:?}");
    }
    assert!(asked > 10_000);
}

#[test]
fn coplanar_neighbours_in_an_instance_never_block() {
    let mut r = Rng::new(3006);
    let mut asked = 0;
    for _ in 0..amount(60_000, 2_000_000) {
        // Object numbers up to 10³ times the size, brought back near the world's origin: R a and t nearly cancel.
        let place = Place::random(&mut r);
        let ideal = r.direction();
        let x = unit(cross(ideal, r.direction()));
        let y = cross(ideal, x);
        let mut point = || place.point(mix([r.range(-1.0, 1.0), r.range(-1.0, 1.0)], [x, y]));
        let (own, other) = ([point(), point(), point()], [point(), point(), point()]);
        let Some(n) = normal(own).filter(|n| dot(*n, ideal).abs() > 0.8) else { continue };
        let turn = unit(cross(ideal, r.direction()));
        let rotation = DMat3::from_cols_array_2d(&[turn, cross(turn, ideal), ideal]).transpose();
        let linear = rotation * r.signed_power(-2.0, 2.0);
        let near = DVec3::from_array(r.cube(place.size));
        let placement = Transform { linear, translation: near - linear * DVec3::from_array(place.center) };
        let Some(object_from_world) = placement.inverse() else { continue };

        let world = |p: [f64; 3]| placement.point(DVec3::from_array(p)).to_array();
        let outward = |n: [f64; 3]| unit(placement.normal(DVec3::from_array(n)).to_array());
        let (m, n) = (outward(ideal), outward(n));
        let n = if dot(n, m) < 0.0 { n.map(|x| -x) } else { n };
        let p = world(mix(r.weights(), own.map(to_f64)));
        let o = start_on_placed_triangle(
            p,
            n,
            own.map(|c| world(to_f64(c))),
            extent(&placement, &[own, other].concat()),
        );
        let d = to_f32(leaving(m, &mut r));
        let line = Line::ray(o, d, f32::INFINITY).to_object(&object_from_world);
        asked += 1;
        assert!(!blocks(&line, other), "{other:?} blocks {line:?} from {own:?}");
        assert!(dot(to_f64(d), n) < 0.0 || !blocks(&line, own), "{own:?} blocks {line:?}");
    }
    assert!(asked > 10_000);
}

/// max(‖R‖∞ |a|∞, |t|∞).
fn extent(placement: &Transform, points: &[[f32; 3]]) -> f64 {
    let rows = placement.linear.transpose();
    let norm =
        [rows.x_axis, rows.y_axis, rows.z_axis].iter().fold(0f64, |m, row| m.max(row.abs().element_sum()));
    (norm * f64::from(largest(points))).max(placement.translation.abs().max_element())
}

/// A floor in z = 0 with the crease x = 0 as its edge, and a wall on that crease at `angle`, in a random frame.
struct Corner {
    floor: Corners,
    wall: Corners,
    n: [f64; 3],
}

impl Corner {
    /// `angle` from the floor to the wall: below π the wall stands up, above it falls off.
    fn random(angle: f64, place: &Place, r: &mut Rng) -> Option<Corner> {
        let (ex, t) = (r.direction(), r.direction());
        let ey = unit(cross(ex, t));
        let ez = cross(ex, ey);
        let at = |x: f64, y: f64, z: f64| place.point(mix([x, y, z], [ex, ey, ez]));
        let (cos, sin) = (antumbra_math::real::cos(angle), antumbra_math::real::sin(angle));
        let (a, b) = (at(0.0, -1.0, 0.0), at(0.0, 1.0, 0.0));
        let (floor, wall) = ([a, at(1.0, 0.0, 0.0), b], [a, b, at(cos, 0.0, sin)]);
        let n = normal(floor)?;
        let n = if dot(n, ez) < 0.0 { n.map(|x| -x) } else { n };
        Some(Corner { floor, wall, n })
    }
}

#[test]
fn convex_neighbours_never_block() {
    let mut r = Rng::new(3003);
    for _ in 0..amount(100_000, 3_000_000) {
        let place = Place::random(&mut r);
        let angle = std::f64::consts::PI * r.range(1.0, 1.95) + 1e-4;
        let Some(c) = Corner::random(angle, &place, &mut r) else { continue };
        // Strictly below, after rounding, and not larger than what M was taken from.
        let below = dot(mix([1.0, -1.0], [to_f64(c.wall[2]), to_f64(c.wall[0])]), c.n) < 0.0;
        if below && largest(&c.wall) <= largest(&c.floor) {
            let (_, line) = leave(c.floor, c.n, &mut r);
            assert!(!blocks(&line, c.wall), "{:?} blocks {line:?} from {:?}", c.wall, c.floor);
        }
    }
}

#[test]
fn concave_neighbours_keep_contact() {
    let mut r = Rng::new(3004);
    let mut asked = 0;
    for _ in 0..amount(100_000, 3_000_000) {
        let place = Place::random(&mut r);
        let angle = r.range(0.1, 3.0);
        let Some(c) = Corner::random(angle, &place, &mut r) else { continue };
        let (sin, cot) = (antumbra_math::real::sin(angle), 1.0 / antumbra_math::real::tan(angle));
        let m = f64::from(largest(&c.floor).max(largest(&c.wall)));
        // Beyond this distance from the crease the start is in front of the wall (LAW §5, twice for the rounded corners).
        let lost = 2.0 * (2f64.powi(-21) * m * cot.max(0.0) + 2.0 * 2f64.powi(-24) * m / sin);
        let s = lost / place.size + r.signed_power(-7.0, -0.5).abs();
        let y = r.range(-0.5, 0.5);
        if s > 0.4 {
            continue;
        }
        // (s, y) on the floor and a point well inside the wall, by their corners' weights.
        let p = mix([(1.0 - s - y) / 2.0, s, (1.0 - s + y) / 2.0], c.floor.map(to_f64));
        let (u, z) = (r.range(-0.3, 0.3), r.range(0.05, 0.6));
        let q = mix([(1.0 - z - u) / 2.0, (1.0 - z + u) / 2.0, z], c.wall.map(to_f64));
        let o = start_on_triangle(p, c.n, c.floor.map(to_f64));
        let d = to_f32(mix([1.0, -1.0], [q, to_f64(o)]));
        asked += 1;
        assert!(
            blocks(&Line::ray(o, d, f32::INFINITY), c.wall),
            "{:?} at {angle} is lost from {p:?}, start {o:?}",
            c.wall
        );
    }
    assert!(asked > 10_000);
}

#[test]
fn a_start_lies_on_its_side_and_close() {
    let mut r = Rng::new(3005);
    for _ in 0..amount(50_000, 1_000_000) {
        let place = Place::random(&mut r);
        let corners = [0; 3].map(|_| place.point(r.cube(1.0)));
        let Some(n) = normal(corners) else { continue };
        let p = mix(r.weights(), corners.map(to_f64));
        for n in [n, n.map(|x| -x)] {
            let m = f64::from(largest(&corners));
            let starts = [
                (start_on_triangle(p, n, corners.map(to_f64)), m),
                (start_free(p, n), largest(&[to_f32(p)]).into()),
            ];
            for (o, m) in starts {
                let lift = mix([1.0, -1.0], [to_f64(o), p]);
                // h = 2⁻²¹ M and one rounding of each coordinate to f32.
                assert!(dot(lift, n) > 0.0, "{o:?} above {p:?}");
                assert!(dot(lift, lift).sqrt() <= 1.3 * 2f64.powi(-21) * m, "{o:?} above {p:?}");
            }
        }
    }
}

#[test]
fn a_start_without_size_does_not_move() {
    let (o, n) = ([0.0; 3], [0.0, 0.0, 1.0]);
    assert_eq!(start_free(o, n), [0.0; 3]);
    assert_eq!(start_on_triangle(o, n, [o; 3]), [0.0; 3]);
    assert!(start_on_triangle([f64::NAN; 3], n, [[0.0; 3], [1.0; 3], n])[0].is_nan());
}
