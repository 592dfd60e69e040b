//! Bins on the sphere about an axis, and what a density puts into each: the two sides of a χ² test of directions.

use glam::{DVec3, Vec3};

use crate::real;

/// Rings of polar angle about an axis, each cut into equal sectors of azimuth, and one bin for all the rest.
#[derive(Clone, Debug)]
pub struct SphereBins {
    s: DVec3,
    t: DVec3,
    axis: DVec3,
    edges: Vec<f64>,
    sectors: usize,
}

impl SphereBins {
    /// Bins about the unit vector `axis` between the ascending polar angles `edges` [rad, from 0 to at most π].
    pub fn new(axis: Vec3, edges: Vec<f64>, sectors: usize) -> SphereBins {
        let axis = axis.as_dvec3().normalize();
        let (s, t) = axis.any_orthonormal_pair();
        SphereBins { s, t, axis, edges, sectors }
    }

    /// The whole sphere in `rings` bands of equal area.
    pub fn uniform(axis: Vec3, rings: usize, sectors: usize) -> SphereBins {
        SphereBins::cap(axis, std::f64::consts::PI, rings, sectors)
    }

    /// The cap of half angle `half_angle` [rad] in `rings` bands of equal area.
    pub fn cap(axis: Vec3, half_angle: f64, rings: usize, sectors: usize) -> SphereBins {
        // Equal area: sin²(θ/2) in equal steps.
        let top = real::sin(0.5 * half_angle);
        let edge = |k: usize| match k {
            k if k == rings => half_angle,
            k => 2.0 * real::asin(top * (k as f64 / rings as f64).sqrt()),
        };
        SphereBins::new(axis, (0..=rings).map(edge).collect(), sectors)
    }

    /// Bins, the one for the rest included (it is the last).
    pub fn len(&self) -> usize {
        self.rest() + 1
    }

    /// Never: the bin for the rest is always there.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Index of the bin for directions outside the rings and for draws that give no direction.
    pub fn rest(&self) -> usize {
        (self.edges.len() - 1) * self.sectors
    }

    /// The bin of a direction.
    pub fn index(&self, direction: Vec3) -> usize {
        let d = direction.as_dvec3();
        let (x, y) = (d.dot(self.s), d.dot(self.t));
        let theta = real::atan2((x * x + y * y).sqrt(), d.dot(self.axis));
        // Rings are half open; the last one of a whole sphere takes the pole too.
        let ring = self.edges.partition_point(|&e| e <= theta);
        let whole = self.edges.last().is_some_and(|&e| e >= std::f64::consts::PI);
        let ring = if ring == self.edges.len() && whole { ring - 1 } else { ring };
        if ring == 0 || ring == self.edges.len() {
            return self.rest();
        }
        let turn = real::atan2(y, x) / std::f64::consts::TAU;
        let sector = ((turn - real::floor(turn)) * self.sectors as f64) as usize;
        (ring - 1) * self.sectors + sector.min(self.sectors - 1)
    }

    /// Counts of `n` draws.
    pub fn count(&self, n: u32, mut draw: impl FnMut(u32) -> Option<Vec3>) -> Vec<u64> {
        let mut counts = vec![0; self.len()];
        for i in 0..n {
            counts[draw(i).map_or(self.rest(), |d| self.index(d))] += 1;
        }
        counts
    }

    /// ∫ `f` dω over each bin, to about `tolerance` per bin; the rest gets 1 − their sum (right if `f` is a density).
    pub fn integrate(&self, tolerance: f64, f: impl Fn(Vec3) -> f64) -> Vec<f64> {
        let at = |theta: f64, phi: f64| {
            let (sin, cos) = (real::sin(theta), real::cos(theta));
            let d = self.s * (sin * real::cos(phi)) + self.t * (sin * real::sin(phi)) + self.axis * cos;
            f(d.as_vec3()) * sin
        };
        let width = std::f64::consts::TAU / self.sectors as f64;
        let mut bins = Vec::with_capacity(self.len());
        for ring in self.edges.windows(2) {
            for k in 0..self.sectors {
                let phi = [k as f64 * width, (k + 1) as f64 * width];
                bins.push(integrate2(&at, [ring[0], ring[1]], phi, tolerance));
            }
        }
        let sum: f64 = bins.iter().sum();
        bins.push(1.0 - sum);
        bins
    }
}

/// Gauss–Legendre nodes and weights on [0, 1], five points (exact to degree 9).
const NODES: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_4, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_6, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

/// Halvings of each side at most: a jump along a curve is then known to about 2⁻⁹ of the side.
const DEPTH: u32 = 9;

/// ∫∫ f(x, y) over a rectangle by halving both sides until the five-point rule changes by less than `tolerance`.
///
/// A peak that falls between all nodes is missed: choose rectangles of about its width.
pub fn integrate2(f: &impl Fn(f64, f64) -> f64, x: [f64; 2], y: [f64; 2], tolerance: f64) -> f64 {
    refine(f, x, y, gauss(f, x, y), tolerance, DEPTH)
}

fn refine(
    f: &impl Fn(f64, f64) -> f64,
    x: [f64; 2],
    y: [f64; 2],
    whole: f64,
    tolerance: f64,
    depth: u32,
) -> f64 {
    let (mx, my) = (0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1]));
    let parts = [
        ([x[0], mx], [y[0], my]),
        ([mx, x[1]], [y[0], my]),
        ([x[0], mx], [my, y[1]]),
        ([mx, x[1]], [my, y[1]]),
    ]
    .map(|(x, y)| (x, y, gauss(f, x, y)));
    let sum: f64 = parts.iter().map(|p| p.2).sum();
    if depth == 0 || (sum - whole).abs() <= tolerance {
        return sum;
    }
    parts.iter().map(|p| refine(f, p.0, p.1, p.2, 0.5 * tolerance, depth - 1)).sum()
}

fn gauss(f: &impl Fn(f64, f64) -> f64, x: [f64; 2], y: [f64; 2]) -> f64 {
    let (dx, dy) = (x[1] - x[0], y[1] - y[0]);
    let row = |u: f64| NODES.iter().map(|(v, w)| w * f(x[0] + u * dx, y[0] + v * dy)).sum::<f64>();
    dx * dy * NODES.iter().map(|(u, w)| w * row(*u)).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::{hash2, unit_f32};

    fn uniform(seed: u32) -> impl Fn(u32) -> Option<Vec3> {
        move |i| {
            let z = 1.0 - 2.0 * unit_f32(hash2(i, seed));
            let (r, phi) = (real::safe_sqrt(1.0 - z * z), 2.0 * real::PI * unit_f32(hash2(i, seed + 1)));
            Some(Vec3::new(r * real::cosf(phi), r * real::sinf(phi), z))
        }
    }

    /// α = 1e-3, fixed seed.
    #[test]
    fn uniform_directions_fill_bins_of_equal_area() {
        let n = 100_000;
        let p = 0.25 / std::f64::consts::PI;
        for axis in [Vec3::Z, Vec3::new(0.6, 0.0, -0.8)] {
            let bins = SphereBins::uniform(axis, 8, 16);
            let expected: Vec<f64> = bins.integrate(1e-9, |_| p).iter().map(|e| e * f64::from(n)).collect();
            assert!(expected[..128].iter().all(|e| (e * 128.0 / f64::from(n) - 1.0).abs() < 1e-6));
            let observed = bins.count(n, uniform(7));
            assert_eq!(observed[bins.rest()], 0);
            let found = super::super::chi_square_test(&observed, &expected);
            assert!(found.p > 1e-3, "{found:?}");
        }
    }

    #[test]
    fn a_cap_leaves_the_rest_to_the_last_bin() {
        let bins = SphereBins::cap(Vec3::Y, 0.5, 2, 3);
        assert_eq!(bins.len(), 7);
        assert_eq!(bins.index(-Vec3::Y), bins.rest());
        assert!(bins.index(Vec3::Y) < 3);
        let area = 2.0 * std::f64::consts::PI * (1.0 - real::cos(0.5));
        let inside: f64 = bins.integrate(1e-9, |_| 1.0 / area)[..6].iter().sum();
        assert!((inside - 1.0).abs() < 1e-8, "six bins of tolerance 1e-9");
    }

    #[test]
    fn a_jump_is_integrated() {
        // The quarter disk: cut cells are known to 2⁻⁹ of the side along an arc of length π/2.
        let quarter = integrate2(&|x, y| f64::from(x * x + y * y < 1.0), [0.0, 1.0], [0.0, 1.0], 1e-7);
        assert!((quarter - std::f64::consts::FRAC_PI_4).abs() < 1e-4);
    }
}
