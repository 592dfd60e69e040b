//! Rough plastic: a clear coat of facets over a diffuse base, and the light that the coat sends back to the base.

use antumbra_math::{Local, Rgb, Vec3, real, warp};

use super::facets::Facets;
use super::plastic::{base, internal};
use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// Places of μ at which the share reflected is kept.
const PLACES: usize = 16;

/// A clear coat of facets over a diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughCoat {
    /// n of the coat over n outside.
    eta: f32,
    facets: Facets,
    /// E(μ) along the first and the second tangent where √μ is k/15: the share that the facets reflect of light from outside,
    /// in parts of 65535.
    reflected: [[u16; PLACES]; 2],
    /// Ē: the mean of E over light that is equal from everywhere.
    mean: f32,
    /// The mean of what the facets reflect: Ē, unless light is lost.
    shiny: f32,
    /// R: the share of the base's light that the coat sends back.
    internal: f32,
    /// See [`super::Coat::new`].
    nonlinear: bool,
}

impl RoughCoat {
    /// n of the coat over n outside, taken into [0.1, 10], and its facets; `nonlinear`: the colour deepens with each inner
    /// bounce. What facets do not reflect goes through them: a white base gives back everything.
    pub fn new(eta: f32, facets: Facets, nonlinear: bool) -> RoughCoat {
        let eta = fresnel::index(eta);
        let coat = RoughCoat {
            eta,
            facets,
            reflected: [[0; PLACES]; 2],
            mean: 0.0,
            shiny: 0.0,
            internal: 0.0,
            nonlinear,
        };
        let coat = coat.with(|w| shared(facets, eta, w));
        RoughCoat { shiny: coat.mean, internal: internal(coat.mean, eta), ..coat }
    }

    /// The same with other shares E(ω).
    fn with(self, share: impl Fn(Local) -> f32) -> RoughCoat {
        let along = |phi: f32| {
            std::array::from_fn(|k| {
                let x = k as f32 / (PLACES - 1) as f32;
                (share(direction((x * x).max(1e-4), phi)) * 65535.0 + 0.5) as u16
            })
        };
        let first = along(0.0);
        let second = if self.facets.is_stretched() { along(0.5 * real::PI) } else { first };
        let coat = RoughCoat { reflected: [first, second], ..self };
        RoughCoat { mean: mean(self.facets, 256, |w| coat.share(w)), ..coat }
    }

    /// The same as Mitsuba 3 draws it: T(ω) is only what facets let through that no facet hides on its way on, and R is of
    /// facets seen from inside that reflect once, so that light which bounces between facets is lost and the base comes out
    /// darker. Its R is a mean of 64 places of μ from 0 to 1, both ends among them, which counts the last one in full.
    pub fn losing(self) -> RoughCoat {
        let inside = |w: Local| shared(self.facets, 1.0 / self.eta, w);
        let straight = inside(Local::new(0.0, 0.0, 1.0));
        let once = (63.0 * mean(self.facets, 64, inside) + straight) / 64.0;
        let coat = self.with(|w| 1.0 - let_through(self.facets, self.eta, w));
        RoughCoat { internal: once.min(self.internal), ..coat }
    }

    /// Its facets.
    pub fn facets(&self) -> Facets {
        self.facets
    }

    /// E(ω). Between the tangents of two widths it follows the logarithm of the width along ω, to about 0.01 (α = 0.2 and 0.6).
    #[inline]
    fn share(&self, w: Local) -> f32 {
        let first = self.along(0, w.cos());
        let across2 = w.0.x * w.0.x + w.0.y * w.0.y;
        if !self.facets.is_stretched() || across2 <= 0.0 {
            return first;
        }
        let [u2, v2] = self.facets.alpha().map(|a| a * a);
        let wide2 = (u2 * w.0.x * w.0.x + v2 * w.0.y * w.0.y) / across2;
        let part = (real::logf(wide2 / v2) / real::logf(u2 / v2)).clamp(0.0, 1.0);
        let second = self.along(1, w.cos());
        second + (first - second) * part
    }

    /// E(μ) along a tangent: a cubic through the four nearest places.
    #[inline]
    fn along(&self, tangent: usize, mu: f32) -> f32 {
        let x = mu.clamp(0.0, 1.0).sqrt() * (PLACES - 1) as f32;
        let first = (x as usize).clamp(1, PLACES - 3) - 1;
        let t = x - (first + 1) as f32;
        let at = |k: usize| f32::from(self.reflected[tangent][first + k]);
        let (down, up) = (t * (t - 1.0), (t + 1.0) * (t - 2.0));
        let sum = at(0) * (-down * (t - 2.0) / 6.0) + at(1) * (up * (t - 1.0) / 2.0) - at(2) * (up * t / 2.0)
            + at(3) * (down * (t + 1.0) / 6.0);
        (sum / 65535.0).clamp(0.0, 1.0)
    }
}

/// The direction of cosine `mu` and azimuth `phi`.
fn direction(mu: f32, phi: f32) -> Local {
    let sin = real::safe_sqrt((1.0 - mu) * (1.0 + mu));
    Local(Vec3::new(sin * real::cosf(phi), sin * real::sinf(phi), mu))
}

/// The mean of `share` over light that is equal from everywhere: midpoints in cos², and for two widths over a quarter turn
/// (the others are its mirror images).
fn mean(facets: Facets, n: usize, share: impl Fn(Local) -> f32) -> f32 {
    let turns = if facets.is_stretched() { 8 } else { 1 };
    let at = |i: usize| {
        let phi = 0.5 * real::PI * ((i % turns) as f32 + 0.5) / turns as f32;
        share(direction((((i / turns) as f32 + 0.5) / (n / turns) as f32).sqrt(), phi))
    };
    (0..n).map(at).sum::<f32>() / n as f32
}

/// The share that facets reflect of light from ω_o: the mean of F G₁(ω_i) over visible facets, by midpoints (Beckmann: to 6e-4).
fn shared(facets: Facets, eta: f32, wo: Local) -> f32 {
    let (along, across) = facets.steps();
    let mut sum = 0.0;
    for i in 0..along * across {
        let u = [((i % along) as f32 + 0.5) / along as f32, ((i / along) as f32 + 0.5) / across as f32];
        let m = facets.sample(wo, u);
        let om = wo.0.dot(m);
        let wi = Local(m * (2.0 * om) - wo.0);
        if wi.cos() > 0.0 {
            sum += fresnel::dielectric(om.clamp(0.0, 1.0), eta).reflected * facets.seen(wi) * wi.cos();
        }
    }
    sum / (along * across) as f32
}

/// The share that facets let through of light from ω_o and no other facet hides below: the mean of (1 − F) G₁(ω_t) over
/// visible facets, by midpoints.
fn let_through(facets: Facets, eta: f32, wo: Local) -> f32 {
    let (along, across) = facets.steps();
    let mut sum = 0.0;
    for i in 0..along * across {
        let u = [((i % along) as f32 + 0.5) / along as f32, ((i / along) as f32 + 0.5) / across as f32];
        let m = facets.sample(wo, u);
        let om = wo.0.dot(m).clamp(0.0, 1.0);
        let boundary = fresnel::dielectric(om, eta);
        let wt = Local(m * (om / eta - boundary.cos_beyond) - wo.0 / eta);
        if wt.cos() < 0.0 {
            sum += (1.0 - boundary.reflected) * facets.seen(wt) * -wt.cos();
        }
    }
    (sum / (along * across) as f32).min(1.0)
}

/// f = F D G₁G₁ / (4 μ_o μ_i) + T(ω_o) T(ω_i) ρ / (π η² (1 − ρ R)), T = 1 − E, R = 1 − (1−Ē)/η².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughPlastic {
    coat: RoughCoat,
    /// ρ / (π η² (1 − ρ R)).
    base: Rgb,
}

impl RoughPlastic {
    /// A coat over a base of albedo ρ in [0, 1].
    pub fn new(coat: RoughCoat, albedo: Rgb) -> RoughPlastic {
        RoughPlastic { coat, base: base(albedo, coat.eta, coat.internal, coat.nonlinear) }
    }

    /// f for directions above the horizon; `through_o` = T(ω_o).
    #[inline]
    fn reflected(&self, wo: Local, wi: Local, through_o: f32) -> Rgb {
        let v = wo.0 + wi.0;
        let facets = self.coat.facets;
        let fresnel = fresnel::dielectric((0.5 * v.length()).min(1.0), self.coat.eta).reflected;
        let glossy = 0.25 * fresnel * facets.d(v) * (facets.seen(wo) * facets.seen(wi));
        Rgb::grey(glossy) + self.base * (through_o * (1.0 - self.coat.share(wi)))
    }

    /// Probability of the facets' lobe: the share of light that it carries.
    #[inline]
    fn glossy(&self, through_o: f32) -> f32 {
        let reflected = (1.0 - through_o).max(1e-6);
        let spread = through_o * self.base.mean() * real::PI * (1.0 - self.coat.mean);
        reflected / (reflected + spread)
    }

    #[inline]
    fn density(&self, wo: Local, wi: Local, glossy: f32) -> f32 {
        let facets = self.coat.facets;
        let of_facets = 0.25 * facets.d(wo.0 + wi.0) * facets.seen(wo);
        glossy * of_facets + (1.0 - glossy) * wi.cos() * real::INV_PI
    }
}

impl BsdfKind for RoughPlastic {
    #[inline(never)]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return Rgb::BLACK;
        }
        self.reflected(wo, wi, 1.0 - self.coat.share(wo))
    }

    /// A visible facet's mirrored direction, or about the normal with cosine density; the density is of both.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() <= 0.0 {
            return None;
        }
        let through_o = 1.0 - self.coat.share(wo);
        let glossy = self.glossy(through_o);
        let wi = if u[2] < glossy {
            let m = self.coat.facets.sample(wo, [u[0], u[1]]);
            Local((m * (2.0 * wo.0.dot(m)) - wo.0).normalize())
        } else {
            warp::cosine_hemisphere([u[0], u[1]])
        };
        let pdf = self.density(wo, wi, glossy);
        if wi.cos() <= 0.0 || pdf <= 0.0 {
            return None;
        }
        let throughput = self.reflected(wo, wi, through_o) * (wi.cos() / pdf);
        Some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    #[inline(never)]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        if wo.cos() <= 0.0 || wi.cos() <= 0.0 {
            return 0.0;
        }
        self.density(wo, wi, self.glossy(1.0 - self.coat.share(wo)))
    }

    fn albedo(&self) -> Rgb {
        let through = 1.0 - self.coat.mean;
        Rgb::grey(self.coat.shiny) + self.base * (real::PI * through * through)
    }

    fn examples() -> Vec<RoughPlastic> {
        let of = |eta, facets| RoughCoat::new(eta, facets, true);
        let coat = |eta, alpha| of(eta, Facets::isotropic(alpha));
        vec![
            RoughPlastic::new(coat(1.5, 0.05), Rgb::WHITE),
            RoughPlastic::new(coat(1.5, 0.3), Rgb::WHITE),
            RoughPlastic::new(coat(1.9, 1.0), Rgb([1.0, 0.5, 0.0])),
            RoughPlastic::new(of(1.5, Facets::beckmann(0.3, 0.3)), Rgb::WHITE),
            RoughPlastic::new(of(1.5, Facets::new(0.2, 0.6)), Rgb([1.0, 0.5, 0.1])),
            RoughPlastic::new(of(1.5, Facets::beckmann(0.5, 0.1)), Rgb([1.0, 0.5, 0.1])),
            RoughPlastic::new(coat(1.5, 0.2).losing(), Rgb([1.0, 0.5, 0.1])),
            RoughPlastic::new(RoughCoat { nonlinear: false, ..coat(1.5, 0.1) }, Rgb([1.0, 0.5, 0.1])),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mitsuba 3.9.1's `roughplastic` (GGX, 1.5 in air of 1.000277, nonlinear): R, and T at μ = 0.105, 0.3 and 0.6, from its
    /// values for two albedos.
    #[test]
    fn the_losing_coat_is_that_of_mitsuba() {
        let published = [
            (0.05, 0.57585, [0.52061, 0.79650, 0.93412]),
            (0.1, 0.55164, [0.61489, 0.80524, 0.93103]),
            (0.2, 0.48605, [0.71106, 0.82047, 0.92221]),
            (0.4, 0.34794, [0.68020, 0.79448, 0.89251]),
        ];
        for (alpha, internal, through) in published {
            let coat = RoughCoat::new(1.5 / 1.000277, Facets::isotropic(alpha), true).losing();
            // Midpoints over the edge of total reflection are right to about this.
            assert!((coat.internal - internal).abs() < 2e-3, "{alpha}: {} {internal}", coat.internal);
            for (mu, t) in [0.105f32, 0.3, 0.6].into_iter().zip(through) {
                let told = 1.0 - coat.share(direction(mu, 0.0));
                assert!((told - t).abs() < 3e-3, "{alpha} {mu}: {told} {t}");
            }
        }
    }
}
