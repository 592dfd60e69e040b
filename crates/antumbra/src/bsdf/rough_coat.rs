//! The clear coat of a rough plastic: what its facets reflect, and what they send back to the base.

use antumbra_math::{Local, Vec3, real};

use super::facets::Facets;
use super::fresnel;
use super::plastic::internal;

/// Places of μ at which the share reflected is kept: 16, along each tangent where the widths differ; 32 along the first over
/// a thinner coat with one width.
const PLACES: usize = 32;

/// A clear coat of facets over a diffuse base.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughCoat {
    /// n of the coat over n outside.
    pub(super) eta: f32,
    pub(super) facets: Facets,
    /// E(μ) at the places of [`Row`], along the first and then along the second tangent: the share that the facets reflect
    /// of light from outside, in parts of 65535.
    reflected: [u16; PLACES],
    /// Ē: the mean of E over light that is equal from everywhere.
    pub(super) mean: f32,
    /// The mean of what the facets reflect: Ē, unless light is lost.
    pub(super) shiny: f32,
    /// R: the share of the base's light that the coat sends back.
    pub(super) internal: f32,
    /// See [`super::Coat::new`].
    pub(super) nonlinear: bool,
    /// See [`RoughCoat::losing`].
    loses: bool,
}

impl RoughCoat {
    /// n of the coat over n outside, taken into [0.1, 10], and its facets; `nonlinear`: the colour deepens with each inner
    /// bounce. What facets do not reflect goes through them: a white base gives back everything.
    pub fn new(eta: f32, facets: Facets, nonlinear: bool) -> RoughCoat {
        let eta = fresnel::index(eta);
        let coat = RoughCoat {
            eta,
            facets,
            reflected: [0; PLACES],
            mean: 0.0,
            shiny: 0.0,
            internal: 0.0,
            nonlinear,
            loses: false,
        };
        let coat = coat.with(|w| shared(facets, eta, w));
        RoughCoat { shiny: coat.mean, internal: internal(coat.mean, eta), ..coat }
    }

    /// The same with other shares E(ω).
    fn with(self, share: impl Fn(Local) -> f32) -> RoughCoat {
        let mut reflected = [0; PLACES];
        for tangent in 0..if self.facets.is_stretched() { 2 } else { 1 } {
            let row = self.row(tangent);
            for k in 0..row.places {
                let w = direction(row.cosine(k), 0.5 * real::PI * tangent as f32);
                reflected[tangent * row.places + k] = (share(w) * 65535.0 + 0.5) as u16;
            }
        }
        let coat = RoughCoat { reflected, ..self };
        let steps = if self.eta < 1.0 { 1 << 13 } else { 256 };
        RoughCoat { mean: mean(self.facets, steps, |w| coat.share(w)), ..coat }
    }

    /// The same with other facets.
    pub(crate) fn with_facets(self, facets: Facets) -> RoughCoat {
        let coat = RoughCoat::new(self.eta, facets, self.nonlinear);
        if self.loses { coat.losing() } else { coat }
    }

    /// The same with `facets` that lie a part `t` of the way from its own to those of `to`.
    pub(crate) fn between(self, to: &RoughCoat, t: f32, facets: Facets) -> RoughCoat {
        let mix = |a: f32, b: f32| a + (b - a) * t;
        RoughCoat {
            facets,
            reflected: std::array::from_fn(|k| {
                (mix(self.reflected[k].into(), to.reflected[k].into()) + 0.5) as u16
            }),
            mean: mix(self.mean, to.mean),
            shiny: mix(self.shiny, to.shiny),
            internal: mix(self.internal, to.internal),
            ..self
        }
    }

    /// The same as Mitsuba 3 draws it: T(ω) is only what facets let through that no facet hides on its way on, and R is of
    /// facets seen from inside that reflect once, so that light which bounces between facets is lost and the base comes out
    /// darker. Its R is a mean of 64 places of μ from 0 to 1, both ends among them, which counts the last one in full.
    pub fn losing(self) -> RoughCoat {
        let inside = |w: Local| shared(self.facets, 1.0 / self.eta, w);
        let straight = inside(Local::new(0.0, 0.0, 1.0));
        let once = (63.0 * mean(self.facets, 64, inside) + straight) / 64.0;
        let coat = self.with(|w| 1.0 - let_through(self.facets, self.eta, w));
        RoughCoat { internal: once.min(self.internal), loses: true, ..coat }
    }

    /// Its facets.
    pub fn facets(&self) -> Facets {
        self.facets
    }

    /// n of the coat over n outside.
    pub fn eta(&self) -> f32 {
        self.eta
    }

    /// See [`RoughCoat::new`].
    pub fn is_nonlinear(&self) -> bool {
        self.nonlinear
    }

    /// E(ω). Between the tangents of two widths it follows the logarithm of the width along ω, to about 0.01 (α = 0.2 and 0.6).
    #[inline]
    pub(super) fn share(&self, w: Local) -> f32 {
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

    /// E(μ) along a tangent.
    #[inline]
    fn along(&self, tangent: usize, mu: f32) -> f32 {
        let row = self.row(tangent);
        row.between(&self.reflected[tangent * row.places..], mu.clamp(0.0, 1.0))
    }

    #[inline]
    fn row(&self, tangent: usize) -> Row {
        let many = self.eta < 1.0 && !self.facets.is_stretched();
        let places = if many { PLACES } else { PLACES / 2 };
        let alpha = self.facets.alpha()[tangent];
        let edge = Edge { mu: real::safe_sqrt((1.0 - self.eta) * (1.0 + self.eta)), width: self.eta * alpha };
        Row { places, edge: (self.eta < 1.0).then_some((edge, 0.5 * alpha)) }
    }
}

/// Where E(μ) is kept along one tangent: even in √μ, for E is steep at the horizon. Over a thinner coat it is steep where
/// total reflection begins, too, over a width that goes with that of the facets: there even in the sum of two inverse
/// hyperbolic sines, linear within the width and logarithmic beyond.
#[derive(Clone, Copy)]
struct Row {
    places: usize,
    /// Over a thinner coat; and the width at the horizon.
    edge: Option<(Edge, f32)>,
}

/// Where total reflection begins.
#[derive(Clone, Copy)]
struct Edge {
    /// Its cosine.
    mu: f32,
    /// Over which facets blur it.
    width: f32,
}

impl Row {
    /// Where μ lies, not scaled.
    #[inline]
    fn place(self, mu: f32) -> f32 {
        match self.edge {
            None => mu.sqrt(),
            Some((edge, horizon)) => asinh((mu - edge.mu) / edge.width) + asinh(mu / horizon),
        }
    }

    /// μ of a place.
    fn cosine(self, k: usize) -> f32 {
        let (low, high) = (self.place(0.0), self.place(1.0));
        let x = low + (high - low) * k as f32 / (self.places - 1) as f32;
        let (mut least, mut most) = (0.0, 1.0);
        for _ in 0..32 {
            let middle = 0.5 * (least + most);
            if self.place(middle) < x { least = middle } else { most = middle }
        }
        most.clamp(1e-4, 1.0)
    }

    /// A cubic through the four nearest places.
    #[inline]
    fn between(self, kept: &[u16], mu: f32) -> f32 {
        let (low, high) = (self.place(0.0), self.place(1.0));
        let x = (self.place(mu) - low) / (high - low) * (self.places - 1) as f32;
        let first = (x as usize).clamp(1, self.places - 3) - 1;
        let t = x - (first + 1) as f32;
        let at = |k: usize| f32::from(kept[first + k]);
        let (down, up) = (t * (t - 1.0), (t + 1.0) * (t - 2.0));
        let sum = at(0) * (-down * (t - 2.0) / 6.0) + at(1) * (up * (t - 1.0) / 2.0) - at(2) * (up * t / 2.0)
            + at(3) * (down * (t + 1.0) / 6.0);
        (sum / 65535.0).clamp(0.0, 1.0)
    }
}

/// The inverse hyperbolic sine.
#[inline]
fn asinh(x: f32) -> f32 {
    real::logf(x.abs() + (x * x + 1.0).sqrt()).copysign(x)
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
    // Facets over a thinner coat begin to reflect all light at once.
    let finer = if eta < 1.0 { 2 } else { 1 };
    let (along, across) = facets.steps();
    let (along, across) = (finer * along, finer * across);
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
