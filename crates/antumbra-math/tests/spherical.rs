//! Sampling of spherical triangles and rectangles at every size: inside, uniform, area-preserving.

// A missing solid angle should stop the test.
#![allow(clippy::unwrap_used)]

use antumbra_math::hash::{hash3, unit_f32};
use antumbra_math::spherical::{SphericalRectangle, SphericalTriangle};
use antumbra_math::{DVec3, solid_angle};

const N: u32 = 20_000;

fn numbers(i: u32) -> [f64; 2] {
    [0, 1].map(|k| f64::from(unit_f32(hash3(i, k, 5))))
}

/// Tiny, small, plain, huge, slivers along and across, grazing, and from over an edge.
fn triangles() -> Vec<[DVec3; 3]> {
    let v = DVec3::new;
    let small = |s: f64| [v(s, 1.0, 0.0), v(0.0, 1.0, -s), v(-s, 1.0, s)];
    vec![
        small(1e-9),
        small(1e-6),
        small(1e-3),
        small(1.0),
        small(1e6),
        [v(-4.0, 1.0, 0.3), v(4.0, 1.0, 0.3), v(0.0, 1.0, 0.3 - 1e-7)],
        [v(1e-7, 1.0, -3.0), v(-1e-7, 1.0, -3.0), v(0.0, 1.0, 50.0)],
        [v(1.0, 1e-6, 0.0), v(2.0, 1e-6, -1.0), v(3.0, 1e-6, 0.5)],
        [v(-1.0, 1e-3, 0.0), v(1.0, 1e-3, 0.0), v(0.0, 1e-3, -1.0)],
        [v(100.0, 0.01, 100.0), v(0.0, 0.01, -200.0), v(-100.0, 0.01, 100.0)],
    ]
}

/// The triangle with the side that the origin sees counter-clockwise.
fn facing([a, b, c]: [DVec3; 3]) -> [DVec3; 3] {
    if solid_angle::triangle_volume(a, b, c) > 0.0 { [a, b, c] } else { [a, c, b] }
}

/// Ω of a triangle's part is the share of directions that fall into it: cut by the median through each corner, within
/// five standard errors (α = 6·10⁻⁷ each); no direction leaves the triangle by more than a rounding of its extent.
#[test]
fn triangles_are_filled_evenly() {
    for (k, corners) in triangles().into_iter().enumerate() {
        let corners = facing(corners);
        let [a, b, c] = corners;
        let triangle = SphericalTriangle::new(a, b, c).unwrap();
        for turn in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|i| corners[(i + turn) % 3]);
            let middle = 0.5 * (b + c);
            let plane = a.cross(middle).normalize();
            let part = solid_angle::triangle(a, b, middle) / triangle.solid_angle;
            let side = plane.dot(b).signum();
            let inside = (0..N).filter(|i| plane.dot(triangle.sample(numbers(*i))) * side > 0.0).count();
            let se = (part * (1.0 - part) / f64::from(N)).sqrt();
            let share = inside as f64 / f64::from(N);
            // 10⁻⁹: digits that Ω of the part keeps.
            assert!((share - part).abs() < 5.0 * se + 1e-9, "triangle {k}, corner {turn}: {share}, {part}");
        }
        for i in 0..N {
            let d = triangle.sample(numbers(i));
            for (x, y) in [(a, b), (b, c), (c, a)] {
                let out = x.cross(y).normalize().dot(d);
                assert!(out < 1e-15_f64.max(1e-9 * (x - y).length()), "triangle {k}: {d} is {out} outside");
            }
        }
    }
}

/// The share of points in each half (α, β ≤ 1/2) is its share of Ω.
#[test]
fn rectangles_are_filled_evenly() {
    let v = DVec3::new;
    let cases = [
        (v(-1.0, 1.0, -1.0), 2.0, 2.0),
        (v(-1.0, 0.01, -1.0), 2.0, 2.0),
        (v(0.5, 0.01, 0.2), 3.0, 0.1),
        (v(-1e3, 1.0, 2.0), 3e3, 4.0),
        (v(3.0, 2.0, -4.0), 0.01, 0.02),
        (v(0.0, 1.0, 0.0), 1.0, 1.0),
        (v(0.0, 100.0, 0.0), 1.0, 1.0),
    ];
    for (corner, lu, lv) in cases {
        let (u, w) = (DVec3::X * lu, DVec3::Z * lv);
        let rectangle = SphericalRectangle::new(corner, u, w).unwrap();
        let whole = solid_angle::parallelogram(corner, u, w).abs();
        assert!((rectangle.solid_angle / whole - 1.0).abs() < 1e-8, "{corner}: {}", rectangle.solid_angle);
        let points: Vec<[f64; 2]> = (0..N).map(|i| rectangle.sample(numbers(i))).collect();
        assert!(points.iter().flatten().all(|x| (0.0..=1.0).contains(x)), "{corner}");
        for (axis, half) in [(0, (0.5 * u, w)), (1, (u, 0.5 * w))] {
            let part = solid_angle::parallelogram(corner, half.0, half.1).abs() / whole;
            let share = points.iter().filter(|p| p[axis] <= 0.5).count() as f64 / f64::from(N);
            let se = (part * (1.0 - part) / f64::from(N)).sqrt();
            assert!((share - part).abs() < 5.0 * se + 1e-9, "{corner}, axis {axis}: {share}, {part}");
        }
    }
}

/// From behind, from the plane and of nothing there is nothing to draw.
#[test]
fn nothing_to_draw() {
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    let [a, b, c] = facing([x, y, z]);
    assert!(SphericalTriangle::new(a, c, b).is_none());
    assert!(SphericalTriangle::new(x, z, -x - z).is_none());
    assert!(SphericalTriangle::new(x, x, y).is_none());
    assert!(SphericalTriangle::new(DVec3::ZERO, x, y).is_none());
    assert!(SphericalRectangle::new(x, x, z).is_none());
    assert!(SphericalRectangle::new(DVec3::NAN, x, z).is_none());
    assert!(SphericalRectangle::new(y, 1e-6 * x, 1e-6 * z).is_none());
}
