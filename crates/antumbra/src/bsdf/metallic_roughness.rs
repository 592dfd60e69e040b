//! glTF's metallic-roughness model: GGX over a diffuse base that gets what the dielectric interface lets through.
//!
//! f = f_spec + f_diff + f_more, with F0 = lerp(0.04, base, metallic), α = roughness² and
//! f_spec = D·G₂·F / (4 μ_o μ_i), f_diff = ρ/π · (1−E(μ_o)) (1−E(μ_i)) / (1−Ē), ρ = base·(1−metallic).
//! E is the share that the interface of F0 = 0.04 reflects, Ē its mean (Ashikhmin and Shirley 2000; Kulla and Conty
//! 2017 use the form for coats). glTF's own weight 1−F(ω_o·h) would give out more light than came in at grazing angles;
//! this one is reciprocal and exact: albedo(μ) = E + ρ(1−E).
//! f_more is light that bounces between facets of metal more than once, in the same form: metallic · M/π ·
//! (1−E₁(μ_o)) (1−E₁(μ_i)) / (1−Ē₁), E₁ the share of facets that reflect all light, M = F̄² Ē₁ / (1 − F̄ (1−Ē₁)) and
//! F̄ = F0 + (1−F0)/21 (Kulla and Conty 2017). White metal gives back everything.

use antumbra_math::{Local, Rgb, real, warp};

use super::ggx::{Ggx, MIN_ALPHA, Pair};
use super::ggx_albedo::{DIELECTRIC_F0, Row, Share};
use super::{BsdfKind, BsdfSample};
use crate::density::Density;

/// Base colour, metallic and roughness of glTF 2.0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetallicRoughness {
    f0: Rgb,
    /// ρ = base·(1−metallic).
    diffuse: Rgb,
    /// metallic · M / (π (1−Ē₁)).
    more: Rgb,
    ggx: Ggx,
    row: Row,
    /// F0 of the interface.
    interface: f32,
    /// 1 / (π (1−Ē)).
    normalisation: f32,
}

/// Where facets lose less than this, nothing is given back: the table knows it to about as much.
const LEAST_LOSS: f32 = 1e-3;

impl MetallicRoughness {
    /// Of base colour, metallic and perceptual roughness, each taken into [0, 1] (not-a-number becomes 0).
    /// α = roughness², at least [`MIN_ALPHA`].
    pub fn new(base: Rgb, metallic: f32, roughness: f32) -> MetallicRoughness {
        MetallicRoughness::of_index(base, metallic, roughness, DIELECTRIC_F0)
    }

    /// The same with another reflectance straight on of what is not metal: ((n−1)/(n+1))² for the index n.
    pub fn of_index(base: Rgb, metallic: f32, roughness: f32, interface: f32) -> MetallicRoughness {
        let (base, metallic, interface) = (base.map(unit), unit(metallic), unit(interface).min(0.9));
        let roughness = unit(roughness).max(MIN_ALPHA.sqrt());
        let row = Row::of_roughness(roughness);
        let f0 = Rgb::grey(interface).lerp(base, metallic);
        let lost = 1.0 - row.average().at(1.0);
        let more = if metallic > 0.0 && lost > LEAST_LOSS {
            let again = |f0: f32| {
                let mean = f0 + (1.0 - f0) / 21.0;
                mean * mean * (1.0 - lost) / (1.0 - mean * lost)
            };
            base.map(again) * (metallic * real::INV_PI / lost)
        } else {
            Rgb::BLACK
        };
        MetallicRoughness {
            f0,
            diffuse: base * (1.0 - metallic),
            more,
            ggx: Ggx { alpha: (roughness * roughness).max(MIN_ALPHA) },
            row,
            interface,
            normalisation: real::INV_PI / (1.0 - row.average().at(interface)),
        }
    }

    /// f_r for directions above the horizon.
    #[inline]
    fn reflected(&self, mu_o: f32, mu_i: f32, from_o: Share, pair: Option<Pair>) -> Rgb {
        let f_spec = pair.map_or(Rgb::BLACK, |pair| {
            let fresnel = self.f0 + (Rgb::WHITE - self.f0) * pair.schlick;
            fresnel * (pair.d * self.ggx.visibility(mu_o, mu_i))
        });
        if self.diffuse.is_black() && self.more.is_black() {
            return f_spec;
        }
        let from_i = self.row.directional(mu_i);
        let through = (1.0 - from_o.at(self.interface)) * (1.0 - from_i.at(self.interface));
        f_spec + self.diffuse * (self.normalisation * through) + self.more * (lost(from_o) * lost(from_i))
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
        // The floor keeps black metal, seen straight on, from dividing 0 by 0.
        let specular = share.at(self.f0.mean()).max(1e-6);
        let more = self.more.mean() * real::PI * (1.0 - self.row.average().at(1.0)) * lost(share);
        let rest = self.diffuse.mean() * (1.0 - share.at(self.interface)) + more;
        Lobes { specular: specular / (specular + rest), share }
    }
}

/// What depends on ω_o alone.
#[derive(Clone, Copy)]
struct Lobes {
    /// Probability of the specular lobe.
    specular: f32,
    /// What facets reflect from ω_o.
    share: Share,
}

/// 1 − E₁: what facets that reflect all light send to other facets.
#[inline]
fn lost(share: Share) -> f32 {
    (1.0 - share.at(1.0)).max(0.0)
}

impl BsdfKind for MetallicRoughness {
    #[inline]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return Rgb::BLACK;
        }
        self.reflected(wo.cos(), wi.cos(), self.row.directional(wo.cos()), self.ggx.pair(wo, wi))
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
        let f = self.reflected(mu_o, mu_i, lobes.share, pair);
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
        let lost = 1.0 - share.at(1.0);
        self.f0.map(|f0| share.at(f0))
            + self.diffuse * (1.0 - share.at(self.interface))
            + self.more * (real::PI * lost * lost)
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
            MetallicRoughness::of_index(Rgb::WHITE, 0.2, 0.6, 0.17),
        ]
    }
}

/// Into [0, 1]; not-a-number becomes 0.
pub(super) fn unit(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}
