//! The perfect mirror: all light leaves in the one direction of equal angle.

use antumbra_math::{Local, Rgb};

use super::{BsdfKind, BsdfSample};
use crate::density::Density;

/// f_r = ρ · δ(ω_i − mirrored ω_o) / cos θ_i on the side of n; black seen from below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// ρ: share of the light that is reflected, per component in [0, 1], at every angle.
    pub reflectance: Rgb,
}

impl BsdfKind for Mirror {
    /// The mirrored direction; throughput ρ.
    #[inline]
    fn sample(&self, wo: Local, _u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() <= 0.0 {
            return None;
        }
        Some(BsdfSample { wi: wo.mirrored(), throughput: self.reflectance, density: Density::Delta })
    }

    #[inline]
    fn is_delta(&self) -> bool {
        true
    }

    fn has_lobes(&self) -> bool {
        false
    }

    #[inline]
    fn albedo(&self) -> Rgb {
        self.reflectance
    }

    fn examples() -> Vec<Mirror> {
        vec![Mirror { reflectance: Rgb::WHITE }, Mirror { reflectance: Rgb([0.9, 0.5, 0.1]) }]
    }
}
