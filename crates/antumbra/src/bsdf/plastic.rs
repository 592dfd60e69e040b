//! Polished plastic: a smooth clear coat over a diffuse base, and the light that the coat sends back to the base.

use antumbra_math::{Local, Rgb, real, warp};

use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// A clear coat over a diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat {
    /// n of the coat over n outside.
    eta: f32,
    /// F̄: share reflected of light that is equal from everywhere outside.
    mean: f32,
    /// Light that bounces between coat and base takes the base's colour at each bounce; else the colour stays as given.
    nonlinear: bool,
}

impl Coat {
    /// n of the coat over n outside, taken into [0.1, 10]; `nonlinear`: the colour deepens with each inner bounce.
    pub fn new(eta: f32, nonlinear: bool) -> Coat {
        let eta = fresnel::index(eta);
        let mean = fresnel::average_of(eta, |mu| fresnel::dielectric(mu, eta).reflected);
        Coat { eta, mean, nonlinear }
    }

    /// n of the coat over n outside.
    pub fn eta(&self) -> f32 {
        self.eta
    }

    /// See [`Coat::new`].
    pub fn is_nonlinear(&self) -> bool {
        self.nonlinear
    }
}

/// f = F δ/cos + T(ω_o) T(ω_i) ρ / (π η² (1 − ρ R)), T = 1 − F; R = 1 − (1−F̄)/η², the share that the coat sends back
/// inside. A white base gives back everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plastic {
    coat: Coat,
    /// ρ / (π η² (1 − ρ R)).
    base: Rgb,
    /// Factor of what the coat reflects outside, in [0, 1].
    gloss: Rgb,
}

/// ρ / (π η² (1 − ρ R)), or with 1 for the second ρ if light does not take the base's colour at inner bounces.
pub(super) fn base(albedo: Rgb, eta: f32, internal: f32, nonlinear: bool) -> Rgb {
    let scale = real::INV_PI / (eta * eta);
    albedo.map(|rho| scale * rho / (1.0 - internal * if nonlinear { rho } else { 1.0 }))
}

/// R of a coat that loses nothing: 1 − (1−F̄)/η².
pub(super) fn internal(mean: f32, eta: f32) -> f32 {
    1.0 - (1.0 - mean) / (eta * eta)
}

impl Plastic {
    /// A coat over a base of albedo ρ in [0, 1].
    pub fn new(coat: Coat, albedo: Rgb) -> Plastic {
        let internal = internal(coat.mean, coat.eta);
        Plastic { coat, base: base(albedo, coat.eta, internal, coat.nonlinear), gloss: Rgb::WHITE }
    }

    /// The same whose coat mirrors `gloss` times as much; what it lets through stays.
    pub fn with_gloss(self, gloss: Rgb) -> Plastic {
        Plastic { gloss, ..self }
    }

    #[inline]
    fn reflected(&self, cos: f32) -> f32 {
        fresnel::dielectric(cos.min(1.0), self.coat.eta).reflected
    }

    /// Probability of the mirrored direction: the share of light that it carries.
    #[inline]
    fn mirrors(&self, reflected: f32) -> f32 {
        // The floor keeps a black base without a coat (η = 1) from dividing 0 by 0.
        let spread = (1.0 - reflected) * self.base.mean() * real::PI * (1.0 - self.coat.mean);
        let mirrored = reflected * self.gloss.mean();
        mirrored / (mirrored + spread).max(1e-20)
    }
}

impl BsdfKind for Plastic {
    /// The diffuse part.
    #[inline(never)]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return Rgb::BLACK;
        }
        self.base * ((1.0 - self.reflected(wo.cos())) * (1.0 - self.reflected(wi.cos())))
    }

    /// Mirrored, or about the normal with cosine density.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() <= 0.0 {
            return None;
        }
        let reflected = self.reflected(wo.cos());
        let mirrors = self.mirrors(reflected);
        if u[2] < mirrors {
            let throughput = self.gloss * (reflected / mirrors);
            return Some(BsdfSample { wi: wo.mirrored(), throughput, density: Density::Delta });
        }
        let wi = warp::cosine_hemisphere([u[0], u[1]]);
        let pdf = (1.0 - mirrors) * wi.cos() * real::INV_PI;
        if pdf <= 0.0 {
            return None;
        }
        let through = (1.0 - reflected) * (1.0 - self.reflected(wi.cos()));
        let throughput = self.base * (through * real::PI / (1.0 - mirrors));
        Some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    #[inline(never)]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return 0.0;
        }
        (1.0 - self.mirrors(self.reflected(wo.cos()))) * wi.cos() * real::INV_PI
    }

    /// The coat mirrors.
    #[inline]
    fn has_single_directions(&self) -> bool {
        true
    }

    fn albedo(&self) -> Rgb {
        let through = 1.0 - self.coat.mean;
        self.gloss * self.coat.mean + self.base * (real::PI * through * through)
    }

    fn examples() -> Vec<Plastic> {
        let of = |eta, nonlinear, albedo| Plastic::new(Coat::new(eta, nonlinear), albedo);
        vec![
            of(1.5, true, Rgb::WHITE),
            of(1.5, false, Rgb([1.0, 0.5, 0.1])),
            of(1.9, true, Rgb([0.8, 0.3, 0.0])),
            of(1.49, true, Rgb::BLACK),
            of(1.0 / 1.5, true, Rgb([1.0, 0.5, 0.1])),
            of(0.3, true, Rgb([1.0, 0.5, 0.1])),
            of(0.3, false, Rgb([1.0, 0.5, 0.1])),
            of(1.5, true, Rgb([1.0, 0.5, 0.1])).with_gloss(Rgb([0.0, 0.5, 1.0])),
        ]
    }
}
