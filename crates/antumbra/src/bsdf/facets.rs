//! A rough surface as facets: GGX or Beckmann slopes of two widths, Smith's masking with heights uncorrelated, visible
//! normals.
//!
//! Sources: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding
//! the Masking-Shadowing Function"; for the sampling Dupuy and Benyoub 2023 (GGX), Heitz and d'Eon 2014 (Beckmann). Nothing is gathered of light that bounces
//! between facets. (`ggx.rs` has one width and correlated heights, as glTF asks.)

use antumbra_math::{Local, Vec3, real};

use super::ggx::{MIN_ALPHA, visible_normal};

/// How the slopes of facets are distributed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slopes {
    /// Long tails (Trowbridge and Reitz 1975).
    Ggx,
    /// A Gaussian: α is √2 times the root mean square slope.
    Beckmann,
}

/// Facets, with the widths of their slopes along the two tangents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facets {
    alpha: [f32; 2],
    slopes: Slopes,
}

impl Facets {
    /// GGX of the widths α along the first and second tangent, taken into [[`MIN_ALPHA`], 1].
    pub fn new(alpha_u: f32, alpha_v: f32) -> Facets {
        let into = |a: f32| if a > MIN_ALPHA { a.min(1.0) } else { MIN_ALPHA };
        Facets { alpha: [into(alpha_u), into(alpha_v)], slopes: Slopes::Ggx }
    }

    /// Beckmann's distribution of the same widths.
    pub fn beckmann(alpha_u: f32, alpha_v: f32) -> Facets {
        Facets { slopes: Slopes::Beckmann, ..Facets::new(alpha_u, alpha_v) }
    }

    /// GGX of the same width in every direction.
    pub fn isotropic(alpha: f32) -> Facets {
        Facets::new(alpha, alpha)
    }

    /// The same slopes, their widths times `by`.
    #[inline]
    pub(crate) fn scaled(self, by: f32) -> Facets {
        let [u, v] = self.alpha;
        Facets { slopes: self.slopes, ..Facets::new(u * by, v * by) }
    }

    /// α along the first and second tangent.
    pub fn alpha(self) -> [f32; 2] {
        self.alpha
    }

    /// Their slopes are Beckmann's.
    pub fn is_beckmann(self) -> bool {
        self.slopes == Slopes::Beckmann
    }

    /// The two widths differ.
    #[inline]
    pub fn is_stretched(self) -> bool {
        self.alpha[0] != self.alpha[1]
    }

    /// D(m) of the direction of `v`, any length. GGX: (|v|² / (v_x²/α_x² + v_y²/α_y² + v_z²))² / (π α_x α_y). Beckmann:
    /// (|v|²/v_z²)² exp(−(v_x²/α_x² + v_y²/α_y²)/v_z²) / (π α_x α_y).
    #[inline]
    pub fn d(self, v: Vec3) -> f32 {
        let [ax, ay] = self.alpha;
        let (x, y) = (v.x / ax, v.y / ay);
        if self.slopes == Slopes::Beckmann {
            let slope2 = (x * x + y * y) / (v.z * v.z);
            // Beyond e⁻⁸⁰ there is no facet in f32; not-a-number where there is no half vector.
            if slope2.is_nan() || slope2 > 80.0 {
                return 0.0;
            }
            let r = v.length_squared() / (v.z * v.z);
            return r * r * real::expf(-slope2) * real::INV_PI / (ax * ay);
        }
        // The floor: 0 where ω_o = −ω_i to the last bit and there is no half vector.
        let r = v.length_squared() / (x * x + y * y + v.z * v.z).max(f32::MIN_POSITIVE);
        r * r * real::INV_PI / (ax * ay)
    }

    /// G₁(ω)/|cos θ|: how much a direction sees of each facet. GGX: 2 / (|cos θ| + √(α_x² x² + α_y² y² + z²)). Beckmann:
    /// 1 / (|cos θ| (1 + Λ)), Λ = (exp(−a²)/(a√π) − erfc a) / 2, a = |z| / √(α_x² x² + α_y² y²).
    #[inline]
    pub fn seen(self, w: Local) -> f32 {
        let [ax, ay] = self.alpha;
        let (x, y, z) = (ax * w.0.x, ay * w.0.y, w.0.z);
        if self.slopes == Slopes::Beckmann {
            let (z, across) = (z.abs(), (x * x + y * y).sqrt());
            let a = z / across.max(f32::MIN_POSITIVE);
            let shaded = across * (real::expf(-a * a) * INV_SQRT_PI) - z * real::erfcf(a);
            return 1.0 / (z + 0.5 * shaded.max(0.0));
        }
        2.0 / (z.abs() + (x * x + y * y + z * z).sqrt())
    }

    /// A facet's normal, drawn from those that ω_o (above the horizon) sees: p(m) = D(m) G₁(ω_o) (ω_o·m) / cos θ_o.
    #[inline]
    pub fn sample(self, wo: Local, u: [f32; 2]) -> Vec3 {
        if self.slopes == Slopes::Beckmann {
            return self.sample_beckmann(wo, u);
        }
        let phi = 2.0 * real::PI * u[0];
        visible_normal(wo.0, self.alpha, u[1], real::cosf(phi), real::sinf(phi))
    }

    /// Steps of the two numbers of `sample` for integrals by midpoints: GGX turns with the first and widens with the second;
    /// Beckmann's slopes follow ω_o with the first.
    pub fn steps(self) -> (usize, usize) {
        if self.slopes == Slopes::Beckmann { (64, 24) } else { (32, 48) }
    }

    /// Slopes seen from ω_o after stretching it to α = 1: along ω_o by the inverse of their distribution, across it a
    /// Gaussian.
    fn sample_beckmann(self, wo: Local, u: [f32; 2]) -> Vec3 {
        let [ax, ay] = self.alpha;
        let w = Vec3::new(ax * wo.0.x, ay * wo.0.y, wo.0.z).normalize();
        let sin = (w.x * w.x + w.y * w.y).sqrt();
        let (cos_phi, sin_phi) = if sin > 0.0 { (w.x / sin, w.y / sin) } else { (1.0, 0.0) };
        let along = visible_slope(sin, w.z, u[0]);
        // The Gaussian's inverse is that of a direction straight on.
        let across = visible_slope(0.0, 1.0, u[1]);
        let (x, y) = (cos_phi * along - sin_phi * across, sin_phi * along + cos_phi * across);
        Vec3::new(-ax * x, -ay * y, 1.0).normalize()
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

/// 1/√π.
const INV_SQRT_PI: f32 = 0.564_189_6;
/// Slopes of α = 1 end here: e⁻²⁵ of them lie beyond.
const STEEPEST: f32 = 5.0;

/// The slope x below which the part `u` of the visible slopes lies, of density ∝ (cos θ − x sin θ) e^(−x²) for x < cot θ:
/// the root of cos θ (1 + erf x)/2 + sin θ e^(−x²)/(2√π) = u times its value at the end. Newton's steps within a bracket.
fn visible_slope(sin: f32, cos: f32, u: f32) -> f32 {
    let below = |x: f32| {
        let gauss = real::expf(-x * x) * INV_SQRT_PI;
        (0.5 * (cos * real::erfcf(-x) + sin * gauss), (cos - x * sin) * gauss)
    };
    let (mut low, mut high) = (-STEEPEST, (cos / sin.max(1e-6)).min(STEEPEST));
    let target = u * below(high).0;
    let mut x = 0.5 * (low + high);
    for _ in 0..32 {
        let (sum, density) = below(x);
        if sum > target {
            high = x
        } else {
            low = x
        }
        let step = x - (sum - target) / density;
        let next = if step > low && step < high { step } else { 0.5 * (low + high) };
        if (next - x).abs() <= 1e-6 {
            return next;
        }
        x = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_cover_the_ground_once() {
        // ∫ D(m) cos θ dm = 1, and seen from ω_o the visible facets have ω_o's own area: ∫ D G₁ (ω_o·m)⁺ dm = cos θ_o.
        // Midpoints over 400 × 400 cells of (cos θ_m, φ): 1e-3.
        let kinds = [
            Facets::isotropic(0.5),
            Facets::new(0.3, 0.9),
            Facets::beckmann(0.4, 0.4),
            Facets::beckmann(0.3, 0.9),
        ];
        for facets in kinds {
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
