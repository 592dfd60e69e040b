//! glTF's metallic-roughness model: GGX over a diffuse base that gets what the dielectric interface lets through.
//!
//! f = f_spec + f_diff, with F0 = lerp(0.04, base, metallic), α = roughness² and
//! f_spec = D·G₂·F / (4 μ_o μ_i), f_diff = ρ/π · (1−E(μ_o)) (1−E(μ_i)) / (1−Ē), ρ = base·(1−metallic).
//! E is the share that the interface of F0 = 0.04 reflects, Ē its mean (Ashikhmin and Shirley 2000; Kulla and Conty
//! 2017 use the form for coats). glTF's own weight 1−F(ω_o·h) would give out more light than came in at grazing angles;
//! this one is reciprocal and exact: albedo(μ) = E + ρ(1−E). Light that bounces between facets is lost.

use antumbra_math::{Local, Rgb, real, warp};

use super::ggx::{Ggx, MIN_ALPHA, Pair};
use super::ggx_albedo::{DIELECTRIC_F0, Row};
use super::{BsdfKind, BsdfSample};
use crate::density::Density;

/// Base colour, metallic and roughness of glTF 2.0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughness {
    f0: Rgb,
    /// ρ = base·(1−metallic).
    diffuse: Rgb,
    ggx: Ggx,
    row: Row,
    /// 1 / (π (1−Ē)).
    normalisation: f32,
}

impl MetallicRoughness {
    /// Of base colour, metallic and perceptual roughness, each taken into [0, 1] (not-a-number becomes 0).
    /// α = roughness², at least [`MIN_ALPHA`].
    pub fn new(base: Rgb, metallic: f32, roughness: f32) -> MetallicRoughness {
        let (base, metallic) = (base.map(unit), unit(metallic));
        let roughness = unit(roughness).max(MIN_ALPHA.sqrt());
        let row = Row::of_roughness(roughness);
        MetallicRoughness {
            f0: Rgb::grey(DIELECTRIC_F0).lerp(base, metallic),
            diffuse: base * (1.0 - metallic),
            ggx: Ggx { alpha: (roughness * roughness).max(MIN_ALPHA) },
            row,
            normalisation: real::INV_PI / (1.0 - row.average().at(DIELECTRIC_F0)),
        }
    }

    /// f_r for directions above the horizon.
    #[inline]
    fn reflected(&self, mu_o: f32, mu_i: f32, through_o: f32, pair: Option<Pair>) -> Rgb {
        let f_spec = pair.map_or(Rgb::BLACK, |pair| {
            let fresnel = self.f0 + (Rgb::WHITE - self.f0) * pair.schlick;
            fresnel * (pair.d * self.ggx.visibility(mu_o, mu_i))
        });
        if self.diffuse.is_black() {
            return f_spec;
        }
        let through_i = 1.0 - self.row.directional(mu_i).at(DIELECTRIC_F0);
        f_spec + self.diffuse * (self.normalisation * through_o * through_i)
    }

    /// p(ω_i) of `sample` for directions above the horizon.
    #[inline]
    fn density(&self, mu_o: f32, mu_i: f32, specular: f32, pair: Option<Pair>) -> f32 {
        let p_spec = pair.map_or(0.0, |pair| self.ggx.pdf(mu_o, pair.d));
        specular * p_spec + (1.0 - specular) * mu_i * real::INV_PI
    }

    /// How `sample` chooses its lobe: by the share of light that each reflects from ω_o.
    #[inline]
    fn lobes(&self, mu_o: f32) -> Lobes {
        let share = self.row.directional(mu_o);
        let through = 1.0 - share.at(DIELECTRIC_F0);
        // The floor keeps black metal, seen straight on, from dividing 0 by 0.
        let specular = share.at(self.f0.mean()).max(1e-6);
        Lobes { specular: specular / (specular + self.diffuse.mean() * through), through }
    }
}

/// What depends on ω_o alone.
#[derive(Clone, Copy)]
struct Lobes {
    /// Probability of the specular lobe.
    specular: f32,
    /// 1 − E(μ_o).
    through: f32,
}

impl BsdfKind for MetallicRoughness {
    #[inline]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return Rgb::BLACK;
        }
        let through_o = 1.0 - self.row.directional(wo.cos()).at(DIELECTRIC_F0);
        self.reflected(wo.cos(), wi.cos(), through_o, self.ggx.pair(wo, wi))
    }

    /// u\[2\] chooses the lobe; the density is that of the mixture. `None` where the facet sends light downwards.
    #[inline]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() <= 0.0 {
            return None;
        }
        let lobes = self.lobes(wo.cos());
        let uv = [u[0], u[1]];
        let wi = if u[2] < lobes.specular { self.ggx.sample(wo, uv) } else { warp::cosine_hemisphere(uv) };
        if wi.cos() <= 0.0 {
            return None;
        }
        let (mu_o, mu_i, pair) = (wo.cos(), wi.cos(), self.ggx.pair(wo, wi));
        let pdf = self.density(mu_o, mu_i, lobes.specular, pair);
        if pdf <= 0.0 {
            return None;
        }
        let f = self.reflected(mu_o, mu_i, lobes.through, pair);
        Some(BsdfSample { wi, throughput: f * (mu_i / pdf), density: Density::SolidAngle(pdf) })
    }

    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return 0.0;
        }
        self.density(wo.cos(), wi.cos(), self.lobes(wo.cos()).specular, self.ggx.pair(wo, wi))
    }

    /// The share reflected of light that is equal from everywhere.
    fn albedo(&self) -> Rgb {
        let share = self.row.average();
        self.f0.map(|f0| share.at(f0)) + self.diffuse * (1.0 - share.at(DIELECTRIC_F0))
    }

    fn examples() -> Vec<MetallicRoughness> {
        let of = MetallicRoughness::new;
        let copper = Rgb([0.95, 0.64, 0.54]);
        vec![
            of(Rgb::WHITE, 0.0, 0.0),
            of(Rgb::WHITE, 0.0, 0.5),
            of(Rgb::WHITE, 0.0, 1.0),
            of(Rgb::WHITE, 1.0, 0.0),
            of(Rgb::WHITE, 1.0, 0.3),
            of(Rgb::WHITE, 1.0, 1.0),
            of(Rgb::BLACK, 0.0, 0.2),
            of(Rgb::BLACK, 1.0, 0.1),
            of(copper, 0.5, 0.4),
            of(copper, 1.0, 0.7),
        ]
    }
}

/// Into [0, 1]; not-a-number becomes 0.
fn unit(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}
