//! Lambert's reflection: f_r = ρ/π, the same in every direction.

use antumbra_math::{Local, Rgb, real, warp};

use super::{BsdfKind, BsdfSample};
use crate::density::Density;

/// f_r = ρ/π on the side of n; black seen from below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse {
    /// ρ: share of the light that is reflected, per component in [0, 1].
    pub albedo: Rgb,
}

impl BsdfKind for Diffuse {
    #[inline]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return Rgb::BLACK;
        }
        self.albedo * real::INV_PI
    }

    /// p(ω) = cos θ / π, so f·cos/p = ρ.
    #[inline]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() <= 0.0 {
            return None;
        }
        let wi = warp::cosine_hemisphere([u[0], u[1]]);
        let z = wi.cos();
        if z <= 0.0 {
            return None;
        }
        Some(BsdfSample { wi, throughput: self.albedo, density: Density::SolidAngle(z * real::INV_PI) })
    }

    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        if wo.cos() <= 0.0 { 0.0 } else { wi.cos().max(0.0) * real::INV_PI }
    }

    fn has_lobes(&self) -> bool {
        false
    }

    fn albedo(&self) -> Rgb {
        self.albedo
    }

    fn examples() -> Vec<Diffuse> {
        vec![Diffuse { albedo: Rgb::grey(0.5) }, Diffuse { albedo: Rgb::WHITE }]
    }
}
