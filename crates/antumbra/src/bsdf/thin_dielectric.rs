//! A pane of clear glass without thickness: light that bounces between its two faces is summed up.

use antumbra_math::{Local, Rgb};

use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// Reflects R = F + F(1−F)² + F³(1−F)² + … = 2F/(1+F); the rest goes straight on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinDielectric {
    /// n of the pane over n around it.
    eta: f32,
    /// Factor of what is reflected, in [0, 1].
    pub reflectance: Rgb,
    /// Factor of what is let through, in [0, 1].
    pub transmittance: Rgb,
}

impl ThinDielectric {
    /// Colourless; n of the pane over n around it, taken into [0.1, 10].
    pub fn clear(eta: f32) -> ThinDielectric {
        let eta = fresnel::index(eta);
        ThinDielectric { eta, reflectance: Rgb::WHITE, transmittance: Rgb::WHITE }
    }

    /// n of the pane over n around it.
    pub fn eta(&self) -> f32 {
        self.eta
    }

    /// R for light that meets the pane with this cosine.
    #[inline]
    fn reflected(&self, cos: f32) -> f32 {
        let f = fresnel::dielectric(cos, self.eta).reflected;
        2.0 * f / (1.0 + f)
    }
}

impl BsdfKind for ThinDielectric {
    /// Mirrored with probability R, else straight on.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        let cos = wo.cos().abs().min(1.0);
        if cos == 0.0 {
            return None;
        }
        let (wi, throughput) = if u[2] < self.reflected(cos) {
            (wo.mirrored(), self.reflectance)
        } else {
            (Local(-wo.0), self.transmittance)
        };
        Some(BsdfSample { wi, throughput, density: Density::Delta })
    }

    #[inline]
    fn is_delta(&self) -> bool {
        true
    }

    #[inline]
    fn index_below(&self) -> Option<f32> {
        Some(1.0)
    }

    fn albedo(&self) -> Rgb {
        let mean = Rgb::grey(fresnel::average_of(self.eta, |mu| self.reflected(mu)));
        self.reflectance * mean + self.transmittance * (Rgb::WHITE - mean)
    }

    fn examples() -> Vec<ThinDielectric> {
        let tinted = ThinDielectric { transmittance: Rgb([1.0, 0.5, 0.0]), ..ThinDielectric::clear(2.4) };
        vec![ThinDielectric::clear(1.5), ThinDielectric::clear(0.5), tinted]
    }
}
