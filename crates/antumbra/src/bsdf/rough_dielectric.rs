//! Ground glass: facets that reflect and refract (Walter et al. 2007, equations 19 to 21).

use antumbra_math::{Local, Rgb};

use super::facets::Facets;
use super::rough_boundary::{Joined, RoughBoundary};
use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// Reflection f = F D G₁G₁ / (4 μ_o μ_i); refraction f = (1−F) D G₁G₁ |ω_o·m| |ω_i·m| / (μ_o μ_i (ω_o·m + η ω_i·m)²),
/// η = n on the side of ω_i over n on the side of ω_o.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDielectric {
    boundary: RoughBoundary,
    /// Factor of what is reflected, in [0, 1].
    pub reflectance: Rgb,
    /// Factor of what is let through, in [0, 1].
    pub transmittance: Rgb,
    /// The share given back of light that is equal from everywhere, if both factors are 1.
    kept: f32,
}

impl RoughDielectric {
    /// n below over n above, taken into [0.1, 10], and the facets; colourless.
    pub fn new(eta: f32, facets: Facets) -> RoughDielectric {
        let boundary = RoughBoundary::new(eta, facets);
        let (reflectance, transmittance) = (Rgb::WHITE, Rgb::WHITE);
        let made = RoughDielectric { boundary, reflectance, transmittance, kept: 1.0 };
        RoughDielectric { kept: made.measured(), ..made }
    }

    /// The mean light of the samples in a furnace (n² below where it is 1 above), by midpoints over their numbers.
    fn measured(&self) -> f32 {
        let n = 8;
        let step = |i: usize| (i as f32 + 0.5) / n as f32;
        let mut sum = 0.0;
        for i in 0..n * n * n * n {
            let (cos, u) = (step(i % n).sqrt(), [i / n, i / n / n, i / n / n / n].map(|i| step(i % n)));
            let across = (0.5 * (1.0 - cos * cos)).sqrt();
            let Some(s) = self.sample(Local::new(across, across, cos), u) else { continue };
            let light = if s.wi.cos() > 0.0 { 1.0 } else { self.boundary.eta * self.boundary.eta };
            sum += light * s.throughput.0[0];
        }
        sum / (n * n * n * n) as f32
    }

    /// Its facets.
    pub fn facets(&self) -> Facets {
        self.boundary.facets
    }

    /// The same with other facets.
    pub(crate) fn with_facets(self, facets: Facets) -> RoughDielectric {
        let RoughDielectric { boundary, kept, .. } = RoughDielectric::new(self.boundary.eta, facets);
        RoughDielectric { boundary, kept, ..self }
    }

    /// The same with `facets` that lie a part `t` of the way from its own to those of `to`.
    pub(crate) fn between(self, to: &RoughDielectric, t: f32, facets: Facets) -> RoughDielectric {
        let boundary = RoughBoundary { facets, ..self.boundary };
        RoughDielectric { boundary, kept: self.kept + (to.kept - self.kept) * t, ..self }
    }

    /// The same surface seen from its other side.
    pub fn turned(self) -> RoughDielectric {
        RoughDielectric { boundary: self.boundary.turned(), ..self }
    }

    /// p(ω_i): of its lobe, times the lobe's share.
    #[inline]
    fn density(&self, wo: Local, wi: Local, j: &Joined) -> f32 {
        let share = if wo.same_side(wi) { j.fresnel } else { 1.0 - j.fresnel };
        share * self.boundary.density(wo, wi, j)
    }
}

impl BsdfKind for RoughDielectric {
    #[inline(never)]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        let Some(j) = self.boundary.joined(wo, wi) else { return Rgb::BLACK };
        let f = self.boundary.spread(wo, wi, &j) * self.facets().seen(wi);
        if wo.same_side(wi) {
            self.reflectance * (j.fresnel * f)
        } else {
            self.transmittance * ((1.0 - j.fresnel) * f)
        }
    }

    /// A visible facet; then reflection with probability F, else refraction.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() == 0.0 {
            return None;
        }
        let seen = self.boundary.sample(wo, [u[0], u[1]]);
        let wi = self.boundary.sent(wo, &seen, u[2] < seen.boundary.reflected)?;
        let j = self.boundary.joined(wo, wi)?;
        let pdf = self.density(wo, wi, &j);
        let left = self.facets().seen(wi) * wi.cos().abs();
        let throughput = if wo.same_side(wi) {
            self.reflectance * left
        } else {
            let eta = self.boundary.beyond(wo);
            self.transmittance * (left / (eta * eta))
        };
        (pdf > 0.0).then_some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    #[inline(never)]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        self.boundary.joined(wo, wi).map_or(0.0, |j| self.density(wo, wi, &j))
    }

    #[inline]
    fn index_below(&self) -> Option<f32> {
        Some(self.boundary.eta)
    }

    /// What masking leaves of reflection and refraction together.
    fn albedo(&self) -> Rgb {
        let eta = self.boundary.eta;
        let mean = Rgb::grey(fresnel::average_of(eta, |mu| fresnel::dielectric(mu, eta).reflected));
        (self.reflectance * mean + self.transmittance * (Rgb::WHITE - mean)) * self.kept
    }

    fn examples() -> Vec<RoughDielectric> {
        let of = |eta, u, v| RoughDielectric::new(eta, Facets::new(u, v));
        let tinted = RoughDielectric { transmittance: Rgb([1.0, 0.5, 0.0]), ..of(1.33, 0.4, 0.4) };
        vec![of(1.5, 0.1, 0.1), of(1.5, 0.5, 0.5), of(1.0 / 1.5, 0.3, 0.3), of(2.4, 0.2, 0.6), tinted]
    }
}
