//! Ground glass: facets that reflect and refract (Walter et al. 2007, equations 19 to 21).

use antumbra_math::{Local, Rgb, Vec3};

use super::facets::Facets;
use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// The nearest that n below over n above comes to 1: facets between equal media have no half vector.
const LEAST_STEP: f32 = 1e-3;

/// Reflection f = F D G₁G₁ / (4 μ_o μ_i); refraction f = (1−F) D G₁G₁ |ω_o·m| |ω_i·m| / (μ_o μ_i (ω_o·m + η ω_i·m)²),
/// η = n on the side of ω_i over n on the side of ω_o.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughDielectric {
    /// n below the surface (−z) over n above it.
    eta: f32,
    facets: Facets,
    /// Factor of what is reflected, in [0, 1].
    pub reflectance: Rgb,
    /// Factor of what is let through, in [0, 1].
    pub transmittance: Rgb,
    /// The share given back of light that is equal from everywhere, if both factors are 1.
    kept: f32,
}

/// A pair of directions with the facet that joins them.
struct Joined {
    m: Vec3,
    /// ω_o·m and ω_i·m; of opposite sign for refraction.
    om: f32,
    im: f32,
    /// Share reflected at the facet.
    fresnel: f32,
    /// n on the side of ω_i over n on the side of ω_o; 1 for reflection.
    eta: f32,
}

impl RoughDielectric {
    /// n below over n above, taken into [0.1, 10], and the facets; colourless.
    pub fn new(eta: f32, facets: Facets) -> RoughDielectric {
        let eta = fresnel::index(eta);
        let eta = if (eta - 1.0).abs() < LEAST_STEP { 1.0 + LEAST_STEP } else { eta };
        let (reflectance, transmittance) = (Rgb::WHITE, Rgb::WHITE);
        let made = RoughDielectric { eta, facets, reflectance, transmittance, kept: 1.0 };
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
            let light = if s.wi.cos() > 0.0 { 1.0 } else { self.eta * self.eta };
            sum += light * s.throughput.0[0];
        }
        sum / (n * n * n * n) as f32
    }

    /// Its facets.
    pub fn facets(&self) -> Facets {
        self.facets
    }

    /// The same with other facets.
    pub(crate) fn with_facets(self, facets: Facets) -> RoughDielectric {
        let RoughDielectric { kept, .. } = RoughDielectric::new(self.eta, facets);
        RoughDielectric { facets, kept, ..self }
    }

    /// The same with `facets` that lie a part `t` of the way from its own to those of `to`.
    pub(crate) fn between(self, to: &RoughDielectric, t: f32, facets: Facets) -> RoughDielectric {
        RoughDielectric { facets, kept: self.kept + (to.kept - self.kept) * t, ..self }
    }

    /// The same surface seen from its other side.
    pub fn turned(self) -> RoughDielectric {
        RoughDielectric { eta: 1.0 / self.eta, ..self }
    }

    /// n beyond over n on the side of ω_o.
    #[inline]
    fn beyond(&self, wo: Local) -> f32 {
        if wo.cos() > 0.0 { self.eta } else { 1.0 / self.eta }
    }

    /// The facet that turns ω_o into ω_i; `None` if there is none that both see.
    #[inline]
    fn joined(&self, wo: Local, wi: Local) -> Option<Joined> {
        if wo.cos() == 0.0 || wi.cos() == 0.0 {
            return None;
        }
        let beyond = self.beyond(wo);
        let reflects = wo.same_side(wi);
        let eta = if reflects { 1.0 } else { beyond };
        let v = wo.0 + wi.0 * eta;
        let m = v.normalize_or_zero();
        let m = if m.z < 0.0 { -m } else { m };
        let (om, im) = if reflects {
            // Equal to the last bit, as the angles are.
            let half = 0.5 * v.length().copysign(wo.cos());
            (half, half)
        } else {
            (wo.0.dot(m), wi.0.dot(m))
        };
        // Each direction sees the facet on the side on which it sees the ground.
        if !(om * wo.cos() > 0.0 && im * wi.cos() > 0.0) {
            return None;
        }
        let fresnel = fresnel::dielectric(om.abs().min(1.0), beyond).reflected;
        Some(Joined { m, om, im, fresnel, eta })
    }

    /// f without Fresnel's part and G₁ of ω_i: D G₁(ω_o)/μ_o times the facet's map of solid angles.
    #[inline]
    fn spread(&self, wo: Local, wi: Local, j: &Joined) -> f32 {
        let shape = self.facets.d(j.m) * self.facets.seen(wo);
        if wo.same_side(wi) {
            return 0.25 * shape;
        }
        let sum = j.om + j.eta * j.im;
        shape * (j.om * j.im).abs() / (sum * sum)
    }
}

impl BsdfKind for RoughDielectric {
    #[inline(never)]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        let Some(j) = self.joined(wo, wi) else { return Rgb::BLACK };
        let f = self.spread(wo, wi, &j) * self.facets.seen(wi);
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
        let up = if wo.cos() > 0.0 { wo } else { Local(-wo.0) };
        let m = self.facets.sample(up, [u[0], u[1]]);
        let om = up.0.dot(m);
        let eta = self.beyond(wo);
        let boundary = fresnel::dielectric(om.clamp(0.0, 1.0), eta);
        let wi = if u[2] < boundary.reflected {
            m * (2.0 * om) - up.0
        } else {
            m * (om / eta - boundary.cos_beyond) - up.0 / eta
        };
        let wi = Local(if wo.cos() > 0.0 { wi.normalize() } else { -wi.normalize() });
        // The facet may send light to the wrong side of the ground.
        if wo.same_side(wi) != (u[2] < boundary.reflected) {
            return None;
        }
        let j = self.joined(wo, wi)?;
        let pdf = self.density(wo, wi, &j);
        let left = self.facets.seen(wi) * wi.cos().abs();
        let throughput = if wo.same_side(wi) {
            self.reflectance * left
        } else {
            self.transmittance * (left / (eta * eta))
        };
        (pdf > 0.0).then_some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    #[inline(never)]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        self.joined(wo, wi).map_or(0.0, |j| self.density(wo, wi, &j))
    }

    #[inline]
    fn index_below(&self) -> Option<f32> {
        Some(self.eta)
    }

    /// What masking leaves of reflection and refraction together.
    fn albedo(&self) -> Rgb {
        let mean = Rgb::grey(fresnel::average_of(self.eta, |mu| fresnel::dielectric(mu, self.eta).reflected));
        (self.reflectance * mean + self.transmittance * (Rgb::WHITE - mean)) * self.kept
    }

    fn examples() -> Vec<RoughDielectric> {
        let of = |eta, u, v| RoughDielectric::new(eta, Facets::new(u, v));
        let tinted = RoughDielectric { transmittance: Rgb([1.0, 0.5, 0.0]), ..of(1.33, 0.4, 0.4) };
        vec![of(1.5, 0.1, 0.1), of(1.5, 0.5, 0.5), of(1.0 / 1.5, 0.3, 0.3), of(2.4, 0.2, 0.6), tinted]
    }
}

impl RoughDielectric {
    /// p(ω_i): of the facet, times the share of its lobe, times |dm/dω_i| (refraction: η² |ω_i·m| / (ω_o·m + η ω_i·m)²).
    #[inline]
    fn density(&self, wo: Local, wi: Local, j: &Joined) -> f32 {
        let share = if wo.same_side(wi) { j.fresnel } else { 1.0 - j.fresnel };
        share * self.spread(wo, wi, j) * j.eta * j.eta
    }
}
