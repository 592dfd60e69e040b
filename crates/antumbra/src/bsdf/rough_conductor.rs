//! A rough metal: facets that reflect by Fresnel's equations (Walter et al. 2007).

use antumbra_math::{Local, Rgb};

use super::facets::Facets;
use super::metal::Metal;
use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// f_r = ρ F(ω_o·m) D(m) G₁(ω_o) G₁(ω_i) / (4 cos θ_o cos θ_i), m the half vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughConductor {
    /// η + ik.
    pub metal: Metal,
    /// ρ: a factor in [0, 1]; 1 for a metal as it is.
    pub reflectance: Rgb,
    facets: Facets,
    /// See [`Facets::kept`].
    kept: f32,
}

impl RoughConductor {
    /// A metal with facets.
    pub fn new(metal: Metal, reflectance: Rgb, facets: Facets) -> RoughConductor {
        RoughConductor { metal, reflectance, facets, kept: facets.kept() }
    }

    /// Its facets.
    pub fn facets(&self) -> Facets {
        self.facets
    }

    /// The same with other facets.
    pub(crate) fn with_facets(self, facets: Facets) -> RoughConductor {
        RoughConductor::new(self.metal, self.reflectance, facets)
    }

    /// The same with `facets` that lie a part `t` of the way from its own to those of `to`.
    pub(crate) fn between(self, to: &RoughConductor, t: f32, facets: Facets) -> RoughConductor {
        RoughConductor { facets, kept: self.kept + (to.kept - self.kept) * t, ..self }
    }

    /// F of a facet whose normal halves the directions; `v` = ω_o + ω_i, so that ω_o·m = |v|/2.
    #[inline]
    fn fresnel(&self, half_length: f32) -> Rgb {
        self.reflectance * fresnel::conductor(half_length.min(1.0), self.metal.eta, self.metal.k)
    }
}

impl BsdfKind for RoughConductor {
    #[inline(never)]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return Rgb::BLACK;
        }
        let v = wo.0 + wi.0;
        let shape = 0.25 * self.facets.d(v) * (self.facets.seen(wo) * self.facets.seen(wi));
        self.fresnel(0.5 * v.length()) * shape
    }

    /// ω_o mirrored about a visible normal: throughput F G₁(ω_i). `None` where the facet sends light downwards.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() <= 0.0 {
            return None;
        }
        let m = self.facets.sample(wo, [u[0], u[1]]);
        let wi = Local((m * (2.0 * wo.0.dot(m)) - wo.0).normalize());
        let pdf = self.pdf(wo, wi);
        if wi.cos() <= 0.0 || pdf <= 0.0 {
            return None;
        }
        let half_length = 0.5 * (wo.0 + wi.0).length();
        let throughput = self.fresnel(half_length) * (self.facets.seen(wi) * wi.cos());
        Some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    /// p(ω_i) = p(m) / (4 ω_o·m) = D G₁(ω_o) / (4 cos θ_o).
    #[inline(never)]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return 0.0;
        }
        0.25 * self.facets.d(wo.0 + wi.0) * self.facets.seen(wo)
    }

    fn has_lobes(&self) -> bool {
        false
    }

    /// The mean of F times what masking leaves.
    fn albedo(&self) -> Rgb {
        let mean = fresnel::average(|mu| fresnel::conductor(mu, self.metal.eta, self.metal.k));
        self.reflectance * mean * self.kept
    }

    fn examples() -> Vec<RoughConductor> {
        let of = |name, u, v| {
            Metal::named(name).map(|metal| RoughConductor::new(metal, Rgb::WHITE, Facets::new(u, v)))
        };
        let perfect = Metal { eta: Rgb::grey(1e-3), k: Rgb::grey(1e3) };
        let mut all: Vec<_> =
            [of("Au", 0.1, 0.1), of("Cr", 0.5, 0.5), of("Al", 0.05, 0.3)].into_iter().flatten().collect();
        all.push(RoughConductor::new(perfect, Rgb::WHITE, Facets::beckmann(0.3, 0.3)));
        all.push(RoughConductor::new(perfect, Rgb::WHITE, Facets::beckmann(0.05, 0.5)));
        for alpha in [0.0, 0.25, 1.0] {
            all.push(RoughConductor::new(perfect, Rgb([1.0, 0.5, 0.0]), Facets::isotropic(alpha)));
        }
        all
    }
}
