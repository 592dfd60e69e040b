//! f_r: how a surface reflects. Floor 2. To add one: a file here and a line in `kinds!`.
//!
//! Local frame, n = +z, ω_o and ω_i point away from the surface; `eval` is WITHOUT the cosine.
//! Laws of every kind: f(ω_o, ω_i) n_i² = f(ω_i, ω_o) n_o² (n the index of refraction on the side of each direction),
//! albedo ≤ 1, `sample` agrees with `pdf` (χ²), finite at grazing.

mod clear_coat;
mod coated_conductor;
mod conductor;
mod dielectric;
mod diffuse;
mod diffuse_transmission;
mod facets;
mod fresnel;
mod ggx;
mod ggx_albedo;
mod metal;
mod metallic_roughness;
mod mirror;
mod plastic;
mod principled;
mod rough_boundary;
mod rough_coat;
mod rough_conductor;
mod rough_dielectric;
mod rough_plastic;
mod rough_thin_dielectric;
mod thin_dielectric;

pub use clear_coat::ClearCoat;
pub use coated_conductor::CoatedConductor;
pub use conductor::Conductor;
pub use dielectric::Dielectric;
pub use diffuse::Diffuse;
pub use diffuse_transmission::DiffuseTransmission;
pub use facets::Facets;
pub use ggx::MIN_ALPHA;
pub use metal::Metal;
pub use metallic_roughness::MetallicRoughness;
pub use mirror::Mirror;
pub use plastic::{Coat, Plastic};
pub use principled::Principled;
pub use rough_coat::RoughCoat;
pub use rough_conductor::RoughConductor;
pub use rough_dielectric::RoughDielectric;
pub use rough_plastic::RoughPlastic;
pub use rough_thin_dielectric::RoughThinDielectric;
pub use thin_dielectric::ThinDielectric;

use antumbra_math::{Local, Rgb};

use crate::density::Density;

/// A direction drawn from the BSDF.
#[derive(Clone, Copy, Debug)]
pub struct BsdfSample {
    /// ω_i.
    pub wi: Local,
    /// f_r · |cos θ_i| / p(ω_i).
    pub throughput: Rgb,
    /// p(ω_i).
    pub density: Density,
}

/// What each kind of reflection answers.
pub trait BsdfKind {
    /// f_r(ω_o, ω_i) [1/sr], without the cosine. 0, as it stands here, where all light leaves into single directions: two
    /// given directions never meet one.
    #[inline]
    fn eval(&self, _wo: Local, _wi: Local) -> Rgb {
        Rgb::BLACK
    }
    /// Draws ω_i; `None` if nothing is reflected.
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample>;
    /// `sample` looks at its third number.
    fn has_lobes(&self) -> bool {
        true
    }
    /// p(ω_i) of `sample` [1/sr]; 0 for single directions.
    #[inline]
    fn pdf(&self, _wo: Local, _wi: Local) -> f32 {
        0.0
    }
    /// Reflects only into single directions: light sampling cannot see it.
    fn is_delta(&self) -> bool {
        false
    }
    /// A part of its light, or all, leaves into single directions: those of light sampling or of other densities miss it.
    fn has_single_directions(&self) -> bool {
        self.is_delta()
    }
    /// n below the surface over n above it, for kinds that let light through; `None` for those that are black from below.
    fn index_below(&self) -> Option<f32> {
        None
    }
    /// About the share of light that is reflected or let through (for the albedo picture, roulette).
    fn albedo(&self) -> Rgb;
    /// Examples for the contract tests.
    fn examples() -> Vec<Self>
    where
        Self: Sized;
}

/// Kinds that compute more than a few lines stay calls of their own (`inline(never)`): taken into the loop of the
/// estimators they would slow down the diffuse ones.
///
/// One enum of all kinds, its delegation, and the list that the contract tests walk through.
macro_rules! kinds {
    ($($kind:ident),* $(,)?) => {
        /// How a surface reflects, one of the closed list of kinds.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Bsdf {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind($kind)),*
        }
        impl Bsdf {
            /// See [`BsdfKind::eval`].
            #[inline]
            pub fn eval(&self, wo: Local, wi: Local) -> Rgb {
                match self { $(Bsdf::$kind(b) => b.eval(wo, wi)),* }
            }
            /// See [`BsdfKind::sample`].
            #[inline]
            pub fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
                match self { $(Bsdf::$kind(b) => b.sample(wo, u)),* }
            }
            /// See [`BsdfKind::has_lobes`].
            #[inline]
            pub fn has_lobes(&self) -> bool {
                match self { $(Bsdf::$kind(b) => b.has_lobes()),* }
            }
            /// See [`BsdfKind::pdf`].
            #[inline]
            pub fn pdf(&self, wo: Local, wi: Local) -> f32 {
                match self { $(Bsdf::$kind(b) => b.pdf(wo, wi)),* }
            }
            /// See [`BsdfKind::is_delta`].
            #[inline]
            pub fn is_delta(&self) -> bool {
                match self { $(Bsdf::$kind(b) => b.is_delta()),* }
            }
            /// See [`BsdfKind::has_single_directions`].
            #[inline]
            pub fn has_single_directions(&self) -> bool {
                match self { $(Bsdf::$kind(b) => b.has_single_directions()),* }
            }
            /// See [`BsdfKind::index_below`].
            #[inline]
            pub fn index_below(&self) -> Option<f32> {
                match self { $(Bsdf::$kind(b) => b.index_below()),* }
            }
            /// See [`BsdfKind::albedo`].
            #[inline]
            pub fn albedo(&self) -> Rgb {
                match self { $(Bsdf::$kind(b) => b.albedo()),* }
            }
            /// Every kind's examples, with the kind's name.
            pub fn examples() -> Vec<(&'static str, Bsdf)> {
                let mut all = Vec::new();
                $(all.extend($kind::examples().into_iter().map(|b| (stringify!($kind), Bsdf::$kind(b))));)*
                all
            }
        }
    };
}

kinds!(
    Diffuse,
    DiffuseTransmission,
    Mirror,
    MetallicRoughness,
    Conductor,
    RoughConductor,
    CoatedConductor,
    Dielectric,
    ThinDielectric,
    RoughDielectric,
    RoughThinDielectric,
    Plastic,
    RoughPlastic,
    Principled,
    ClearCoat,
);
