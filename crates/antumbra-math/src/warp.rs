//! Area-preserving maps from the unit square: how two numbers in [0, 1) become a point or a direction.

use crate::real::{self, PI};
use crate::{Local, Vec2};

/// A point of the unit disk, density 1/π (Shirley and Chiu 1997: concentric squares onto concentric circles, which
/// keeps strata compact).
#[inline]
pub fn disk(u: [f32; 2]) -> Vec2 {
    let (a, b) = (2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0);
    let wide = a.abs() > b.abs();
    let (r, other) = if wide { (a, b) } else { (b, a) };
    // φ, or π/2 − φ, whose cosine is the sine.
    let phi = if r == 0.0 { 0.0 } else { PI / 4.0 * (other / r) };
    let (along, across) = (r * real::cos_octant(phi), r * real::sin_octant(phi));
    if wide { Vec2::new(along, across) } else { Vec2::new(across, along) }
}

/// The numbers that [`disk`] takes to the point (x, y).
#[inline]
pub fn disk_inverse([x, y]: [f64; 2]) -> [f64; 2] {
    const PER_OCTANT: f64 = 4.0 / std::f64::consts::PI;
    let r = (x * x + y * y).sqrt();
    let (a, b) = if x.abs() > y.abs() {
        let a = r.copysign(x);
        (a, a * PER_OCTANT * real::atan(y / x))
    } else if y == 0.0 {
        (0.0, 0.0)
    } else {
        let b = r.copysign(y);
        (b * PER_OCTANT * real::atan(x / y), b)
    };
    [0.5 * (a + 1.0), 0.5 * (b + 1.0)]
}

/// A point of the triangle as the weights of its second and third corner, density 1 / area (Heitz 2019, "A
/// Low-Distortion Map Between Triangle and Square").
#[inline]
pub fn triangle(u: [f32; 2]) -> [f32; 2] {
    if u[1] > u[0] {
        let half = 0.5 * u[0];
        [half, u[1] - half]
    } else {
        let half = 0.5 * u[1];
        [u[0] - half, half]
    }
}

/// The numbers that [`triangle`] takes to these weights of the second and third corner.
#[inline]
pub fn triangle_inverse([b, c]: [f64; 2]) -> [f64; 2] {
    if c > b { [2.0 * b, b + c] } else { [b + c, 2.0 * c] }
}

/// A direction about n with density cos θ / π: the disk lifted onto the hemisphere (Malley).
#[inline]
pub fn cosine_hemisphere(u: [f32; 2]) -> Local {
    let d = disk(u);
    Local::new(d.x, d.y, real::safe_sqrt(1.0 - d.length_squared()))
}

/// A direction about n with density 1/(2π).
#[inline]
pub fn hemisphere(u: [f32; 2]) -> Local {
    cone(u, 1.0)
}

/// A direction with density 1/(4π).
#[inline]
pub fn sphere(u: [f32; 2]) -> Local {
    cone(u, 2.0)
}

/// A direction within the angle α of n, density 1 / (2π versin), where versin = 1 − cos α in (0, 2]; stable for the
/// smallest cones.
///
/// 1 − cos θ = ρ² versin for ρ² uniform, so sin θ = ρ √(versin (2 − ρ² versin)).
#[inline]
pub fn cone(u: [f32; 2], versin: f32) -> Local {
    let d = disk(u);
    let t = d.length_squared() * versin;
    let stretch = real::safe_sqrt(versin * (2.0 - t));
    Local::new(d.x * stretch, d.y * stretch, 1.0 - t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash;

    const N: u32 = 40_000;

    fn numbers(i: u32) -> [f32; 2] {
        [hash::unit_f32(hash::hash2(i, 1)), hash::unit_f32(hash::hash2(i, 2))]
    }

    /// The mean of N terms of variance `var` is within five of its standard errors (α = 6·10⁻⁷).
    fn mean_is(mean: f64, var: f64, f: impl Fn([f32; 2]) -> f32) {
        let got = (0..N).map(|i| f64::from(f(numbers(i)))).sum::<f64>() / f64::from(N);
        assert!((got - mean).abs() < 5.0 * (var / f64::from(N)).sqrt(), "{got} is not {mean}");
    }

    #[test]
    fn moments_of_the_maps() {
        // ρ² is uniform on the disk: mean 1/2, variance 1/12; x has variance 1/4.
        mean_is(0.5, 1.0 / 12.0, |u| disk(u).length_squared());
        mean_is(0.0, 0.25, |u| disk(u).x);
        // A barycentric weight has mean 1/3 and variance 1/18.
        mean_is(1.0 / 3.0, 1.0 / 18.0, |u| triangle(u)[0]);
        mean_is(1.0 / 3.0, 1.0 / 18.0, |u| 1.0 - triangle(u)[0] - triangle(u)[1]);
        // cos θ: density 2 cos θ has mean 2/3 and variance 1/18; uniform on [0, 1] and [−1, 1].
        mean_is(2.0 / 3.0, 1.0 / 18.0, |u| cosine_hemisphere(u).cos());
        mean_is(0.5, 1.0 / 12.0, |u| hemisphere(u).cos());
        mean_is(0.0, 1.0 / 3.0, |u| sphere(u).cos());
        // 1 − cos θ is uniform on [0, versin].
        mean_is(0.5e-6, 1e-12 / 12.0, |u| {
            let d = cone(u, 1e-6);
            // sin²θ / (1 + cos θ) = 1 − cos θ without its cancellation.
            (d.0.x * d.0.x + d.0.y * d.0.y) / (1.0 + d.cos())
        });
    }

    #[test]
    fn inverses_lead_back() {
        for i in 0..N {
            let u = numbers(i);
            let d = disk(u);
            let disk = disk_inverse([f64::from(d.x), f64::from(d.y)]);
            let triangle = triangle_inverse(triangle(u).map(f64::from));
            for (back, u) in disk.into_iter().chain(triangle).zip(u.into_iter().chain(u)) {
                // Single precision of the maps.
                assert!((back - f64::from(u)).abs() < 1e-6, "{u} → {back}");
            }
        }
    }

    #[test]
    fn directions_are_unit_and_inside() {
        for i in 0..N {
            let u = numbers(i);
            for d in [cosine_hemisphere(u), hemisphere(u), sphere(u), cone(u, 0.3)] {
                // A few roundings.
                assert!((d.0.length() - 1.0).abs() < 1e-6);
            }
            assert!(cone(u, 0.3).cos() >= 0.7 - 1e-6);
            let [b, c] = triangle(u);
            assert!(b >= 0.0 && c >= 0.0 && b + c <= 1.0);
        }
    }
}
