//! Rough plastic: a clear coat of facets over a diffuse base.

use antumbra_math::{Local, Rgb, real, warp};

use super::facets::Facets;
use super::plastic::base;
use super::rough_coat::RoughCoat;
use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// f = F D G₁G₁ / (4 μ_o μ_i) + T(ω_o) T(ω_i) ρ / (π η² (1 − ρ R)), T = 1 − E, R = 1 − (1−Ē)/η².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughPlastic {
    coat: RoughCoat,
    /// ρ / (π η² (1 − ρ R)).
    base: Rgb,
    /// Factor of what the facets reflect outside, in [0, 1].
    gloss: Rgb,
}

impl RoughPlastic {
    /// A coat over a base of albedo ρ in [0, 1].
    pub fn new(coat: RoughCoat, albedo: Rgb) -> RoughPlastic {
        let base = base(albedo, coat.eta, coat.internal, coat.nonlinear);
        RoughPlastic { coat, base, gloss: Rgb::WHITE }
    }

    /// The same whose facets reflect `gloss` times as much; what they let through stays.
    pub fn with_gloss(self, gloss: Rgb) -> RoughPlastic {
        RoughPlastic { gloss, ..self }
    }

    /// f for directions above the horizon; `through_o` = T(ω_o).
    #[inline]
    fn reflected(&self, wo: Local, wi: Local, through_o: f32) -> Rgb {
        let v = wo.0 + wi.0;
        let facets = self.coat.facets;
        let fresnel = fresnel::dielectric((0.5 * v.length()).min(1.0), self.coat.eta).reflected;
        let glossy = 0.25 * fresnel * facets.d(v) * (facets.seen(wo) * facets.seen(wi));
        self.gloss * glossy + self.base * (through_o * (1.0 - self.coat.share(wi)))
    }

    /// Probability of the facets' lobe: the share of light that it carries.
    #[inline]
    fn glossy(&self, through_o: f32) -> f32 {
        let reflected = ((1.0 - through_o) * self.gloss.mean()).max(1e-6);
        let spread = through_o * self.base.mean() * real::PI * (1.0 - self.coat.mean);
        reflected / (reflected + spread)
    }

    #[inline]
    fn density(&self, wo: Local, wi: Local, glossy: f32) -> f32 {
        let facets = self.coat.facets;
        let of_facets = 0.25 * facets.d(wo.0 + wi.0) * facets.seen(wo);
        glossy * of_facets + (1.0 - glossy) * wi.cos() * real::INV_PI
    }
}

impl BsdfKind for RoughPlastic {
    #[inline(never)]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return Rgb::BLACK;
        }
        self.reflected(wo, wi, 1.0 - self.coat.share(wo))
    }

    /// A visible facet's mirrored direction, or about the normal with cosine density; the density is of both.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() <= 0.0 {
            return None;
        }
        let through_o = 1.0 - self.coat.share(wo);
        let glossy = self.glossy(through_o);
        let wi = if u[2] < glossy {
            let m = self.coat.facets.sample(wo, [u[0], u[1]]);
            Local((m * (2.0 * wo.0.dot(m)) - wo.0).normalize())
        } else {
            warp::cosine_hemisphere([u[0], u[1]])
        };
        let pdf = self.density(wo, wi, glossy);
        if wi.cos() <= 0.0 || pdf <= 0.0 {
            return None;
        }
        let throughput = self.reflected(wo, wi, through_o) * (wi.cos() / pdf);
        Some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    #[inline(never)]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return 0.0;
        }
        self.density(wo, wi, self.glossy(1.0 - self.coat.share(wo)))
    }

    fn albedo(&self) -> Rgb {
        let through = 1.0 - self.coat.mean;
        self.gloss * self.coat.shiny + self.base * (real::PI * through * through)
    }

    fn examples() -> Vec<RoughPlastic> {
        let of = |eta, facets| RoughCoat::new(eta, facets, true);
        let coat = |eta, alpha| of(eta, Facets::isotropic(alpha));
        vec![
            RoughPlastic::new(coat(1.5, 0.05), Rgb::WHITE),
            RoughPlastic::new(coat(1.5, 0.3), Rgb::WHITE),
            RoughPlastic::new(coat(1.9, 1.0), Rgb([1.0, 0.5, 0.0])),
            RoughPlastic::new(of(1.5, Facets::beckmann(0.3, 0.3)), Rgb::WHITE),
            RoughPlastic::new(of(1.5, Facets::new(0.2, 0.6)), Rgb([1.0, 0.5, 0.1])),
            RoughPlastic::new(of(1.5, Facets::beckmann(0.5, 0.1)), Rgb([1.0, 0.5, 0.1])),
            RoughPlastic::new(coat(1.5, 0.2).losing(), Rgb([1.0, 0.5, 0.1])),
            RoughPlastic::new(RoughCoat::new(1.5, Facets::isotropic(0.1), false), Rgb([1.0, 0.5, 0.1])),
            RoughPlastic::new(coat(1.0 / 1.5, 0.05), Rgb::WHITE),
            RoughPlastic::new(coat(1.5, 0.2), Rgb([1.0, 0.5, 0.1])).with_gloss(Rgb([0.0, 0.5, 1.0])),
        ]
    }
}
