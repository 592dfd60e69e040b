//! A polished metal: a mirror that reflects by Fresnel's equations.

use antumbra_math::{Local, Rgb};

use super::metal::Metal;
use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// f_r = ρ F(cos θ) · δ(ω_i − mirrored ω_o) / cos θ_i on the side of n; black seen from below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// η + ik.
    pub metal: Metal,
    /// ρ: a factor in [0, 1]; 1 for a metal as it is.
    pub reflectance: Rgb,
}

impl BsdfKind for Conductor {
    /// The mirrored direction; throughput ρ F.
    #[inline(never)]
    fn sample(&self, wo: Local, _u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() <= 0.0 {
            return None;
        }
        let fresnel = fresnel::conductor(wo.cos().min(1.0), self.metal.eta, self.metal.k);
        let throughput = self.reflectance * fresnel;
        Some(BsdfSample { wi: wo.mirrored(), throughput, density: Density::Delta })
    }

    #[inline]
    fn is_delta(&self) -> bool {
        true
    }

    fn has_lobes(&self) -> bool {
        false
    }

    fn albedo(&self) -> Rgb {
        self.reflectance * fresnel::average(|mu| fresnel::conductor(mu, self.metal.eta, self.metal.k))
    }

    fn examples() -> Vec<Conductor> {
        let of = |name| Metal::named(name).map(|metal| Conductor { metal, reflectance: Rgb::WHITE });
        let perfect = Conductor {
            metal: Metal { eta: Rgb::grey(1e-3), k: Rgb::grey(1e3) },
            reflectance: Rgb([1.0, 0.5, 0.0]),
        };
        of("Au").into_iter().chain(of("Cr")).chain([perfect]).collect()
    }
}
