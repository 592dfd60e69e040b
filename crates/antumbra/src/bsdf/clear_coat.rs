//! A clear coat over metallic-roughness, glTF's KHR_materials_clearcoat.
//!
//! f = c f_coat + (1 − c E(μ_o)) (1 − c E(μ_i)) f_base, f_coat = D·G₂·F / (4 μ_o μ_i) of F0 = 0.04 and E the share that it
//! reflects. glTF's own weight of the base, 1 − c F(μ_o), leaves out what the coat takes on the way out. What goes back and forth
//! between coat and base is lost, as in glTF: albedo ≤ 1, and reciprocal.

use antumbra_math::{Local, Rgb};

use super::ggx::{Ggx, MIN_ALPHA};
use super::ggx_albedo::{DIELECTRIC_F0, Row};
use super::metallic_roughness::{MetallicRoughness, unit};
use super::{BsdfKind, BsdfSample};
use crate::density::Density;

/// Metallic-roughness under a coat of the index of refraction 1.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearCoat {
    base: MetallicRoughness,
    /// c.
    strength: f32,
    ggx: Ggx,
    row: Row,
}

impl ClearCoat {
    /// The base, c and the perceptual roughness of the coat, each taken into [0, 1].
    pub fn new(base: MetallicRoughness, strength: f32, roughness: f32) -> ClearCoat {
        let roughness = unit(roughness).max(MIN_ALPHA.sqrt());
        let ggx = Ggx { alpha: (roughness * roughness).max(MIN_ALPHA) };
        ClearCoat { base, strength: unit(strength), ggx, row: Row::of_roughness(roughness) }
    }

    /// c E(μ).
    #[inline]
    fn taken(&self, mu: f32) -> f32 {
        self.strength * self.row.directional(mu).at(DIELECTRIC_F0)
    }

    /// How likely `sample` draws from the coat: by about what each reflects from ω_o.
    #[inline]
    fn chosen(&self, mu_o: f32) -> f32 {
        let coat = self.taken(mu_o);
        let base = (1.0 - coat) * self.base.albedo().mean();
        coat / (coat + base).max(f32::MIN_POSITIVE)
    }
}

impl BsdfKind for ClearCoat {
    #[inline(never)]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        let (mu_o, mu_i) = (wo.cos(), wi.cos());
        if mu_o <= 0.0 || mu_i <= 0.0 {
            return Rgb::BLACK;
        }
        let coat = self.ggx.pair(wo, wi).map_or(0.0, |pair| {
            let fresnel = DIELECTRIC_F0 + (1.0 - DIELECTRIC_F0) * pair.schlick;
            fresnel * pair.d * self.ggx.visibility(mu_o, mu_i)
        });
        let through = (1.0 - self.taken(mu_o)) * (1.0 - self.taken(mu_i));
        Rgb::grey(self.strength * coat) + self.base.eval(wo, wi) * through
    }

    /// The coat or the base; the density is that of both.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() <= 0.0 {
            return None;
        }
        let chosen = self.chosen(wo.cos());
        let wi = if u[2] < chosen {
            self.ggx.sample(wo, [u[0], u[1]])
        } else {
            let left = ((u[2] - chosen) / (1.0 - chosen)).min(1.0);
            self.base.sample(wo, [u[0], u[1], left])?.wi
        };
        let pdf = self.pdf(wo, wi);
        let throughput = self.eval(wo, wi) * (wi.cos() / pdf);
        (pdf > 0.0).then_some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    #[inline(never)]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return 0.0;
        }
        let chosen = self.chosen(wo.cos());
        let coat = self.ggx.pair(wo, wi).map_or(0.0, |pair| self.ggx.pdf(wo.cos(), pair.d));
        chosen * coat + (1.0 - chosen) * self.base.pdf(wo, wi)
    }

    /// With what the coat takes on the mean, in and out.
    fn albedo(&self) -> Rgb {
        let taken = self.strength * self.row.average().at(DIELECTRIC_F0);
        Rgb::grey(taken) + self.base.albedo() * ((1.0 - taken) * (1.0 - taken))
    }

    fn examples() -> Vec<ClearCoat> {
        let of = MetallicRoughness::new;
        let copper = Rgb([0.95, 0.64, 0.54]);
        vec![
            ClearCoat::new(of(Rgb::WHITE, 0.0, 0.5), 1.0, 0.0),
            ClearCoat::new(of(Rgb::WHITE, 0.0, 1.0), 1.0, 0.6),
            ClearCoat::new(of(copper, 1.0, 0.4), 0.5, 0.2),
            ClearCoat::new(of(Rgb::BLACK, 0.0, 0.7), 1.0, 0.1),
        ]
    }
}
