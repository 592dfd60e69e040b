//! A rough pane without thickness: facets mirror light, or send it on as if they had mirrored it below the pane.

use antumbra_math::{Local, Rgb, Vec3};

use super::facets::Facets;
use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// f = R D G₁G₁ / (4 μ_o μ_i) above; below the same of ω_i mirrored there, with 1 − R for R = 2F/(1+F): what a facet does
/// not reflect it spreads about the straight direction as widely (glTF's KHR_materials_transmission).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughThinDielectric {
    /// n of the pane over n around it.
    eta: f32,
    facets: Facets,
    /// Factor of what is reflected, in [0, 1].
    pub reflectance: Rgb,
    /// Factor of what is let through, in [0, 1].
    pub transmittance: Rgb,
    /// See [`Facets::kept`].
    kept: f32,
}

impl RoughThinDielectric {
    /// n of the pane over n around it, taken into [0.1, 10], and the facets; colourless.
    pub fn new(eta: f32, facets: Facets) -> RoughThinDielectric {
        let (reflectance, transmittance) = (Rgb::WHITE, Rgb::WHITE);
        let eta = fresnel::index(eta);
        RoughThinDielectric { eta, facets, reflectance, transmittance, kept: facets.kept() }
    }

    /// n of the pane over n around it.
    pub fn eta(&self) -> f32 {
        self.eta
    }

    /// Its facets.
    pub fn facets(&self) -> Facets {
        self.facets
    }

    /// The same with other facets.
    pub(crate) fn with_facets(self, facets: Facets) -> RoughThinDielectric {
        RoughThinDielectric { facets, kept: facets.kept(), ..self }
    }

    /// The same with `facets` that lie a part `t` of the way from its own to those of `to`.
    pub(crate) fn between(self, to: &RoughThinDielectric, t: f32, facets: Facets) -> RoughThinDielectric {
        RoughThinDielectric { facets, kept: self.kept + (to.kept - self.kept) * t, ..self }
    }

    /// R of a facet for light that meets it with this cosine.
    #[inline]
    fn reflected(&self, cos: f32) -> f32 {
        let f = fresnel::dielectric(cos.min(1.0), self.eta).reflected;
        2.0 * f / (1.0 + f)
    }

    /// Both directions turned above the pane, and the share of the lobe that joins them with its factor.
    #[inline]
    fn joined(&self, wo: Local, wi: Local) -> Option<(Local, Local, f32, Rgb)> {
        if wo.cos() == 0.0 || wi.cos() == 0.0 {
            return None;
        }
        let (up, into) = (above(wo), above(wi));
        let reflected = self.reflected(0.5 * (up.0 + into.0).length());
        Some(match wo.same_side(wi) {
            true => (up, into, reflected, self.reflectance),
            false => (up, into, 1.0 - reflected, self.transmittance),
        })
    }
}

/// The direction on the upper side.
#[inline]
fn above(w: Local) -> Local {
    Local(Vec3::new(w.0.x, w.0.y, w.0.z.abs()))
}

impl BsdfKind for RoughThinDielectric {
    #[inline(never)]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        let Some((up, into, share, factor)) = self.joined(wo, wi) else { return Rgb::BLACK };
        let shape = 0.25 * self.facets.d(up.0 + into.0) * (self.facets.seen(up) * self.facets.seen(into));
        factor * (share * shape)
    }

    /// A visible facet; then reflection with probability R, else on through the pane.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() == 0.0 {
            return None;
        }
        let up = above(wo);
        let m = self.facets.sample(up, [u[0], u[1]]);
        let om = up.0.dot(m);
        let into = Local((m * (2.0 * om) - up.0).normalize());
        if into.cos() <= 0.0 {
            return None;
        }
        let reflects = u[2] < self.reflected(om);
        let side = if reflects == (wo.cos() > 0.0) { 1.0 } else { -1.0 };
        let wi = Local(Vec3::new(into.0.x, into.0.y, side * into.0.z));
        let pdf = self.pdf(wo, wi);
        let factor = if reflects { self.reflectance } else { self.transmittance };
        let throughput = factor * (self.facets.seen(into) * into.cos());
        (pdf > 0.0).then_some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    /// p(ω_i) = D G₁(ω_o) / (4 cos θ_o) times the share of its lobe.
    #[inline(never)]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        let Some((up, into, share, _)) = self.joined(wo, wi) else { return 0.0 };
        share * 0.25 * self.facets.d(up.0 + into.0) * self.facets.seen(up)
    }

    #[inline]
    fn index_below(&self) -> Option<f32> {
        Some(1.0)
    }

    /// What masking leaves of both sides.
    fn albedo(&self) -> Rgb {
        let mean = Rgb::grey(fresnel::average_of(self.eta, |mu| self.reflected(mu)));
        (self.reflectance * mean + self.transmittance * (Rgb::WHITE - mean)) * self.kept
    }

    fn examples() -> Vec<RoughThinDielectric> {
        let of = |eta, u, v| RoughThinDielectric::new(eta, Facets::new(u, v));
        let tinted = RoughThinDielectric { transmittance: Rgb([1.0, 0.5, 0.0]), ..of(1.5, 0.4, 0.4) };
        vec![of(1.5, 0.05, 0.05), of(1.0 / 1.5, 0.2, 0.6), tinted]
    }
}
