//! A rough surface as facets: GGX slopes of two widths, Smith's masking with heights uncorrelated, visible normals.
//!
//! Sources: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding
//! the Masking-Shadowing Function"; Dupuy and Benyoub 2023 for the sampling. Nothing is gathered of light that bounces
//! between facets. (`ggx.rs` has one width and correlated heights, as glTF asks.)

use antumbra_math::{Local, Vec3, real};

use super::ggx::{MIN_ALPHA, visible_normal};

/// GGX facets; the widths of their slopes along the two tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facets {
    alpha: [f32; 2],
}

impl Facets {
    /// Of the widths α along the first and second tangent, taken into [[`MIN_ALPHA`], 1].
    pub fn new(alpha_u: f32, alpha_v: f32) -> Facets {
        let into = |a: f32| if a > MIN_ALPHA { a.min(1.0) } else { MIN_ALPHA };
        Facets { alpha: [into(alpha_u), into(alpha_v)] }
    }

    /// The same width in every direction.
    pub fn isotropic(alpha: f32) -> Facets {
        Facets::new(alpha, alpha)
    }

    /// α along the first and second tangent.
    pub fn alpha(self) -> [f32; 2] {
        self.alpha
    }

    /// D(m) of the direction of `v`, any length: (|v|² / (v_x²/α_x² + v_y²/α_y² + v_z²))² / (π α_x α_y).
    #[inline]
    pub fn d(self, v: Vec3) -> f32 {
        let [ax, ay] = self.alpha;
        let (x, y) = (v.x / ax, v.y / ay);
        // The floor: 0 where ω_o = −ω_i to the last bit and there is no half vector.
        let r = v.length_squared() / (x * x + y * y + v.z * v.z).max(f32::MIN_POSITIVE);
        r * r * real::INV_PI / (ax * ay)
    }

    /// G₁(ω)/|cos θ| = 2 / (|cos θ| + √(α_x² x² + α_y² y² + z²)): how much a direction sees of each facet.
    #[inline]
    pub fn seen(self, w: Local) -> f32 {
        let [ax, ay] = self.alpha;
        let (x, y, z) = (ax * w.0.x, ay * w.0.y, w.0.z);
        2.0 / (z.abs() + (x * x + y * y + z * z).sqrt())
    }

    /// A facet's normal, drawn from those that ω_o (above the horizon) sees: p(m) = D(m) G₁(ω_o) (ω_o·m) / cos θ_o.
    #[inline]
    pub fn sample(self, wo: Local, u: [f32; 2]) -> Vec3 {
        let phi = 2.0 * real::PI * u[0];
        visible_normal(wo.0, self.alpha, u[1], real::cosf(phi), real::sinf(phi))
    }

    /// The share that perfectly reflecting facets give back of light that is equal from everywhere: what is left after
    /// masking, by midpoints over the numbers that `sample` takes.
    pub fn kept(self) -> f32 {
        let (directions, across) = (8, 8);
        let step = |i: usize, n: usize| (i as f32 + 0.5) / n as f32;
        let mut sum = 0.0;
        for i in 0..directions {
            // Every direction of equal light counts the same: cos² in equal steps.
            let cos = step(i, directions).sqrt();
            for turn in 0..across {
                let (sin, phi) = (real::safe_sqrt(1.0 - cos * cos), 0.5 * real::PI * step(turn, across));
                let wo = Local::new(sin * real::cosf(phi), sin * real::sinf(phi), cos);
                sum += self.kept_of(wo, across);
            }
        }
        sum / (directions * across) as f32
    }

    /// [`Facets::kept`] of one direction: the mean of G₁(ω_i).
    fn kept_of(self, wo: Local, n: usize) -> f32 {
        let mut sum = 0.0;
        for k in 0..n * n {
            let u = [(k % n) as f32, (k / n) as f32].map(|i| (i + 0.5) / n as f32);
            let m = self.sample(wo, u);
            let wi = Local(m * (2.0 * wo.0.dot(m)) - wo.0);
            sum += if wi.cos() > 0.0 { self.seen(wi) * wi.cos() } else { 0.0 };
        }
        sum / (n * n) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_cover_the_ground_once() {
        // ∫ D(m) cos θ dm = 1, and seen from ω_o the visible facets have ω_o's own area: ∫ D G₁ (ω_o·m)⁺ dm = cos θ_o.
        // Midpoints over 400 × 400 cells of (cos θ_m, φ): 1e-3.
        for facets in [Facets::isotropic(0.5), Facets::new(0.3, 0.9)] {
            let wo = Local(Vec3::new(0.7, -0.2, 0.4).normalize());
            let n = 400;
            let (mut ground, mut visible) = (0.0f64, 0.0f64);
            for i in 0..n * n {
                let (z, phi) =
                    (((i % n) as f32 + 0.5) / n as f32, (i / n) as f32 * 2.0 * real::PI / n as f32);
                let r = (1.0 - z * z).sqrt();
                let m = Vec3::new(r * real::cosf(phi), r * real::sinf(phi), z);
                let d = f64::from(facets.d(m)) * std::f64::consts::TAU / f64::from(n * n);
                ground += d * f64::from(z);
                visible += d * f64::from(facets.seen(wo) * wo.0.dot(m).max(0.0));
            }
            assert!((ground - 1.0).abs() < 1e-3 && (visible - 1.0).abs() < 1e-3, "{ground} {visible}");
        }
    }

    #[test]
    fn smooth_facets_lose_nothing() {
        assert!((Facets::isotropic(0.0).kept() - 1.0).abs() < 0.01);
        let kept = [0.1, 0.3, 0.6, 1.0].map(|a| Facets::isotropic(a).kept());
        assert!(kept.windows(2).all(|w| w[1] < w[0]), "{kept:?}");
    }
}
