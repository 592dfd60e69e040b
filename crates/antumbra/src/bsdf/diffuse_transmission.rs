//! Paper, cloth, a leaf: light leaves evenly on both sides of a thin surface (Lambert's law twice).

use antumbra_math::{Local, Rgb, Vec3, real, warp};

use super::{BsdfKind, BsdfSample};
use crate::density::Density;

/// f = ρ/π on the side that light came from, τ/π on the other; alike from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffuseTransmission {
    /// ρ: the share that is reflected, in [0, 1].
    pub reflectance: Rgb,
    /// τ: the share that is let through, in [0, 1].
    pub transmittance: Rgb,
}

impl DiffuseTransmission {
    /// The same that gives back no more than it gets: components with ρ + τ above 1 are scaled down together.
    pub fn kept(self) -> DiffuseTransmission {
        let by = (self.reflectance + self.transmittance).map(|sum| 1.0 / sum.max(1.0));
        DiffuseTransmission { reflectance: self.reflectance * by, transmittance: self.transmittance * by }
    }

    /// Probability that a direction is drawn on the side of ω_o.
    #[inline]
    fn stays(&self) -> f32 {
        let (back, through) = (self.reflectance.mean(), self.transmittance.mean());
        // Black: any share will do.
        back / (back + through).max(f32::MIN_POSITIVE)
    }
}

impl BsdfKind for DiffuseTransmission {
    #[inline]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        if wo.cos() == 0.0 || wi.cos() == 0.0 {
            return Rgb::BLACK;
        }
        let color = if wo.same_side(wi) { self.reflectance } else { self.transmittance };
        color * real::INV_PI
    }

    /// About the normal of the side that the third number chooses, with cosine density.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        let stays = self.stays();
        let Local(up) = warp::cosine_hemisphere([u[0], u[1]]);
        if wo.cos() == 0.0 || up.z <= 0.0 {
            return None;
        }
        let (chance, color, side) = match u[2] < stays {
            true => (stays, self.reflectance, 1.0),
            false => (1.0 - stays, self.transmittance, -1.0),
        };
        let wi = Local(Vec3::new(up.x, up.y, up.z * side * wo.cos().signum()));
        let pdf = chance * up.z * real::INV_PI;
        let throughput = color * (1.0 / chance);
        (pdf > 0.0).then_some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    #[inline]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        if wo.cos() == 0.0 {
            return 0.0;
        }
        let stays = self.stays();
        let chance = if wo.same_side(wi) { stays } else { 1.0 - stays };
        chance * wi.cos().abs() * real::INV_PI
    }

    #[inline]
    fn index_below(&self) -> Option<f32> {
        Some(1.0)
    }

    fn albedo(&self) -> Rgb {
        self.reflectance + self.transmittance
    }

    fn examples() -> Vec<DiffuseTransmission> {
        let of = |reflectance, transmittance| DiffuseTransmission { reflectance, transmittance };
        vec![
            of(Rgb::grey(0.25), Rgb::grey(0.25)),
            of(Rgb([0.5, 0.3, 0.0]), Rgb([0.5, 0.1, 1.0])),
            of(Rgb::BLACK, Rgb::WHITE),
            of(Rgb::WHITE, Rgb::WHITE).kept(),
        ]
    }
}
