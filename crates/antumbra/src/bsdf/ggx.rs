//! GGX microfacets: distribution D, Smith's visibility with correlated heights, and sampling of visible normals.
//!
//! Everything is written with v = ω_o + ω_i (the half vector h before normalisation) and stays finite for all unit
//! vectors above the horizon. Sources: Walter et al. 2007 (D), Heitz 2014 (the masking functions),
//! Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".

use antumbra_math::{Local, Vec3, real};

/// The smallest α: roughness 0 is drawn as a lobe of about a thousandth of a radian, still finite in f32.
pub const MIN_ALPHA: f32 = 1e-3;

/// A GGX surface of one α, the same in every tangent direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx {
    /// Width of the slopes' distribution, in [`MIN_ALPHA`, 1].
    pub alpha: f32,
}

/// What a pair of directions has in common.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    /// D(h).
    pub d: f32,
    /// (1 − ω_o·h)⁵, the weight of Schlick's rise to 1.
    pub schlick: f32,
}

impl Ggx {
    /// Λ'(μ) = √(α² + (1−α²)μ²), with which G₁ = 2μ/(μ + Λ').
    #[inline]
    pub fn slant(self, mu: f32) -> f32 {
        let a2 = self.alpha * self.alpha;
        (a2 + (1.0 - a2) * mu * mu).sqrt()
    }

    /// D(h) = (|v|² / (v_t²/α² + v_n²))² / (π α²) and Schlick's weight with ω_o·h = |v|/2.
    ///
    /// `None` where ω_o = −ω_i to the last bit: no half vector.
    #[inline]
    pub fn pair(self, wo: Local, wi: Local) -> Option<Pair> {
        let v = wo.0 + wi.0;
        let tangential = v.x * v.x + v.y * v.y;
        let normal = v.z * v.z;
        let square = tangential + normal;
        if square < f32::MIN_POSITIVE {
            return None;
        }
        let a2 = self.alpha * self.alpha;
        let r = square / (tangential / a2 + normal);
        let miss = (1.0 - 0.5 * square.sqrt()).max(0.0);
        let miss2 = miss * miss;
        Some(Pair { d: r * r * real::INV_PI / a2, schlick: miss2 * miss2 * miss })
    }

    /// G₂/(4 μ_o μ_i) = 1/(2 (μ_o Λ'(μ_i) + μ_i Λ'(μ_o))), heights correlated.
    #[inline]
    pub fn visibility(self, mu_o: f32, mu_i: f32) -> f32 {
        // The floor keeps D·visibility below 1e26 where both cosines vanish.
        0.5 / (mu_o * self.slant(mu_i) + mu_i * self.slant(mu_o)).max(1e-20)
    }

    /// p(ω_i) = G₁(μ_o) D / (4 μ_o) = D / (2 (μ_o + Λ'(μ_o))) of [`Ggx::sample`].
    #[inline]
    pub fn pdf(self, mu_o: f32, d: f32) -> f32 {
        0.5 * d / (mu_o + self.slant(mu_o))
    }

    /// ω_o mirrored about a normal drawn from those that ω_o sees; it may lie below the horizon.
    #[inline]
    pub fn sample(self, wo: Local, u: [f32; 2]) -> Local {
        let phi = 2.0 * real::PI * u[0];
        let m = visible_normal(wo.0, [self.alpha; 2], u[1], real::cosf(phi), real::sinf(phi));
        Local((m * (2.0 * wo.0.dot(m)) - wo.0).normalize())
    }
}

/// A visible normal of widths α along the two tangents: stretch ω_o to α = 1, add a point of the cap that reflects there, stretch back.
#[inline]
pub(super) fn visible_normal(wo: Vec3, [ax, ay]: [f32; 2], u: f32, cos_phi: f32, sin_phi: f32) -> Vec3 {
    let w = Vec3::new(ax * wo.x, ay * wo.y, wo.z).normalize();
    // z of the sum, 1−u times the cap's height, is formed before z of the cap: it never cancels.
    let sum_z = (1.0 - u) * (1.0 + w.z);
    let z = sum_z - w.z;
    let r = real::safe_sqrt(1.0 - z * z);
    let sum = Vec3::new(r * cos_phi + w.x, r * sin_phi + w.y, sum_z);
    Vec3::new(ax * sum.x, ay * sum.y, sum.z).normalize_or(Vec3::Z)
}
