//! Clear glass: a smooth boundary that reflects and refracts.

use antumbra_math::{Local, Rgb};

use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// F of the light leaves mirrored, the rest refracted by Snell's law; radiance changes by (n_o/n_i)² on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// n below the surface (−z) over n above it.
    eta: f32,
    /// Factor of what is reflected, in [0, 1].
    pub reflectance: Rgb,
    /// Factor of what is let through, in [0, 1].
    pub transmittance: Rgb,
}

impl Dielectric {
    /// Colourless; n below the surface over n above it, taken into [0.1, 10].
    pub fn clear(eta: f32) -> Dielectric {
        let eta = fresnel::index(eta);
        Dielectric { eta, reflectance: Rgb::WHITE, transmittance: Rgb::WHITE }
    }

    /// The same surface seen from its other side.
    pub fn turned(self) -> Dielectric {
        Dielectric { eta: 1.0 / self.eta, ..self }
    }
}

impl BsdfKind for Dielectric {
    /// Reflected with probability F, else refracted: throughput 1 or (n_o/n_i)², times its factor.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        let cos = wo.cos().abs().min(1.0);
        if cos == 0.0 {
            return None;
        }
        let eta = if wo.cos() > 0.0 { self.eta } else { 1.0 / self.eta };
        let boundary = fresnel::dielectric(cos, eta);
        let (wi, throughput) = if u[2] < boundary.reflected {
            (wo.mirrored(), self.reflectance)
        } else {
            let down = -boundary.cos_beyond.copysign(wo.cos());
            (Local::new(-wo.0.x / eta, -wo.0.y / eta, down), self.transmittance / (eta * eta))
        };
        Some(BsdfSample { wi, throughput, density: Density::Delta })
    }

    #[inline]
    fn is_delta(&self) -> bool {
        true
    }

    #[inline]
    fn index_below(&self) -> Option<f32> {
        Some(self.eta)
    }

    fn albedo(&self) -> Rgb {
        let mean = Rgb::grey(fresnel::average_of(self.eta, |mu| fresnel::dielectric(mu, self.eta).reflected));
        self.reflectance * mean + self.transmittance * (Rgb::WHITE - mean)
    }

    fn examples() -> Vec<Dielectric> {
        let tinted = Dielectric { transmittance: Rgb([1.0, 0.5, 0.0]), ..Dielectric::clear(1.33) };
        vec![Dielectric::clear(1.5), Dielectric::clear(1.0 / 1.5), Dielectric::clear(1.0), tinted]
    }
}
