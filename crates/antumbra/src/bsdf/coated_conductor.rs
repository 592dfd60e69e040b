//! Metal under a clear coat, each polished or rough: what the coat mirrors, what the metal sends through it, and what stays
//! between them for a while.

use antumbra_math::{Local, Rgb, Vec3, real, warp};

use super::facets::Facets;
use super::metal::Metal;
use super::{BsdfKind, BsdfSample, fresnel};
use crate::density::Density;

/// Cosines at which the share that stays under the coat is kept, even from 0 to 1.
const PLACES: usize = 8;

/// Both polished: R = F + T² R_m / (1 − F R_m) into the mirrored direction, exact. Else f is the sum of the coat's lobe,
/// T(ω_o) T(ω_i) f_m(ω_o′, ω_i′)/η², and Q(ω_o) Q(ω_i) c/π: ω′ are the directions within the coat (Snell's law), f_m is the
/// metal's own against the coat, and Q the share that the metal sends where the coat reflects it back, which leaves evenly in
/// the end.
///
/// A rough coat lets through T of a polished one, and its facets widen those of the metal: α² + (η−1)² α_coat²/(2η²), the
/// slopes that light straight on finds on its way in and out (Belcour 2018, "Efficient Rendering of Layered Materials using
/// an Atomic Decomposition with Statistical Operators", adds variances in the same way).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoatedConductor {
    /// n of the coat over n outside, at least 1.
    eta: f32,
    /// η + ik over n of the coat.
    metal: Metal,
    /// ρ: a factor of what the metal reflects, in [0, 1].
    pub reflectance: Rgb,
    coat: Option<Facets>,
    /// The metal's facets, widened by those of the coat.
    under: Option<Facets>,
    /// Q/T at even cosines, in parts of 65535.
    trapped: [u16; PLACES],
    /// Mean over light that is equal from everywhere: of Q, of what a perfect metal sends out at once, of the coat's lobe.
    mean_trapped: f32,
    mean_direct: f32,
    mean_coat: f32,
    /// Of light that comes back to the metal from the coat: the share that leaves after it, and that comes back once more.
    later: [f32; 2],
}

impl CoatedConductor {
    /// A coat of index `eta` over that outside, taken into [1, 10], over a metal in the air; without facets a side is polished.
    pub fn new(eta: f32, coat: Option<Facets>, metal: Metal, facets: Option<Facets>) -> CoatedConductor {
        let eta = fresnel::index(eta).max(1.0);
        let metal = Metal { eta: metal.eta * (1.0 / eta), k: metal.k * (1.0 / eta) };
        let mean = fresnel::average_of(eta, |mu| fresnel::dielectric(mu, eta).reflected);
        let plain = CoatedConductor {
            eta,
            metal,
            reflectance: Rgb::WHITE,
            coat,
            under: widened(facets, coat, eta),
            trapped: [0; PLACES],
            mean_trapped: 0.0,
            mean_direct: 1.0 - mean,
            mean_coat: mean * coat.map_or(1.0, Facets::kept),
            later: [0.0; 2],
        };
        let Some(under) = plain.under else { return plain };
        let mut all = CoatedConductor { later: plain.second(under), mean_direct: 0.0, ..plain };
        for (k, kept) in all.trapped.iter_mut().enumerate() {
            *kept = (plain.fate(under, cosine(k))[1] * 65535.0 + 0.5) as u16;
        }
        let n = 32;
        for i in 0..n {
            let mu = ((i as f32 + 0.5) / n as f32).sqrt();
            let through = plain.through(mu) / n as f32;
            all.mean_direct += through * plain.fate(under, mu)[0];
            all.mean_trapped += through * all.stays(mu);
        }
        all
    }

    /// n of the coat over n outside.
    pub fn eta(&self) -> f32 {
        self.eta
    }

    /// The metal as it is in the air.
    pub fn metal(&self) -> Metal {
        Metal { eta: self.metal.eta * self.eta, k: self.metal.k * self.eta }
    }

    /// The facets of the coat.
    pub fn coat(&self) -> Option<Facets> {
        self.coat
    }

    /// The facets of the metal as they are seen through the coat.
    pub fn facets(&self) -> Option<Facets> {
        self.under
    }

    /// Facets of the coat or the metal are wider along one tangent than along the other.
    pub fn is_stretched(&self) -> bool {
        [self.coat, self.under].into_iter().flatten().any(Facets::is_stretched)
    }

    /// The shares of light of this cosine outside that a perfect metal sends out through the coat at once, and back to it.
    fn fate(&self, under: Facets, mu: f32) -> [f32; 2] {
        let turns = if under.is_stretched() { 4 } else { 1 };
        let (along, across) = under.steps();
        let count = along * across;
        let mut fate = [0.0; 2];
        for turn in 0..turns {
            let phi = 0.5 * real::PI * (turn as f32 + 0.5) / turns as f32;
            let sin = real::safe_sqrt((1.0 - mu) * (1.0 + mu));
            let wo = self.within(Local::new(sin * real::cosf(phi), sin * real::sinf(phi), mu));
            for i in 0..count {
                let u =
                    [((i % along) as f32 + 0.5) / along as f32, ((i / along) as f32 + 0.5) / across as f32];
                let m = under.sample(wo, u);
                let wi = Local(m * (2.0 * wo.0.dot(m)) - wo.0);
                if wi.cos() <= 0.0 {
                    continue;
                }
                let share = under.seen(wi) * wi.cos() / (count * turns) as f32;
                let back = fresnel::dielectric(wi.cos().min(1.0), 1.0 / self.eta).reflected;
                fate[0] += share * (1.0 - back);
                fate[1] += share * back;
            }
        }
        fate.map(|share| share.min(1.0))
    }

    /// See `later`: the shares at the second meeting with the metal, the mean over equal light from outside.
    fn second(&self, under: Facets) -> [f32; 2] {
        const SIDE: usize = 8;
        let number = |k: usize| [k % SIDE, k / SIDE].map(|i| (i as f32 + 0.5) / SIDE as f32);
        let met = |wo: Local, k: usize| {
            let m = under.sample(wo, number(k));
            let wi = Local(m * (2.0 * wo.0.dot(m)) - wo.0);
            let share = (under.seen(wi) * wi.cos()).max(0.0);
            let back = fresnel::dielectric(wi.cos().clamp(0.0, 1.0), 1.0 / self.eta).reflected;
            (wi, if wi.cos() > 0.0 { [share * (1.0 - back), share * back] } else { [0.0; 2] })
        };
        let (mut sum, mut all) = ([0.0; 2], 0.0);
        for i in 0..SIDE {
            let mu = ((i as f32 + 0.5) / SIDE as f32).sqrt();
            let wo = self.within(Local::new(real::safe_sqrt(1.0 - mu * mu), 0.0, mu));
            for first in 0..SIDE * SIDE {
                let (wi, [_, back]) = met(wo, first);
                let weight = self.through(mu) * back;
                if weight <= 0.0 {
                    continue;
                }
                all += weight;
                let again = Local(Vec3::new(-wi.0.x, -wi.0.y, wi.0.z).normalize());
                for k in 0..SIDE * SIDE {
                    let (_, fate) = met(again, k);
                    (0..2).for_each(|c| sum[c] += weight * fate[c] / (SIDE * SIDE) as f32);
                }
            }
        }
        sum.map(|s| s / f32::max(all, 1e-20))
    }

    /// The direction within the coat of one outside.
    #[inline]
    fn within(&self, w: Local) -> Local {
        let (x, y) = (w.0.x / self.eta, w.0.y / self.eta);
        Local(Vec3::new(x, y, real::safe_sqrt(1.0 - x * x - y * y)))
    }

    /// T(ω).
    #[inline]
    fn through(&self, mu: f32) -> f32 {
        1.0 - fresnel::dielectric(mu.clamp(0.0, 1.0), self.eta).reflected
    }

    /// Q/T, by lines between the places.
    #[inline]
    fn stays(&self, mu: f32) -> f32 {
        let x = mu.clamp(0.0, 1.0) * (PLACES - 1) as f32;
        let first = (x as usize).min(PLACES - 2);
        let [a, b] = [first, first + 1].map(|k| f32::from(self.trapped[k]) / 65535.0);
        a + (b - a) * (x - first as f32)
    }

    /// ρ F̄ of the metal, over light that is equal from everywhere outside.
    #[inline]
    fn mean_metal(&self) -> Rgb {
        let within = |mu: f32| fresnel::dielectric(mu, self.eta).cos_beyond;
        let metal = &self.metal;
        self.reflectance * fresnel::average(|mu| fresnel::conductor(within(mu), metal.eta, metal.k))
    }

    /// What comes of light that stays: the metal reflected it once, and does so at each meeting until it is let out.
    #[inline]
    fn leaves_late(&self) -> Rgb {
        let [out, back] = self.later;
        let again = fresnel::average(|mu| fresnel::conductor(mu, self.metal.eta, self.metal.k));
        let again = (self.reflectance * again).map(|r| r * out / (1.0 - (r * back).min(0.999)));
        self.mean_metal() * again
    }

    /// R where both are polished.
    fn mirrored(&self, mu: f32) -> Rgb {
        let boundary = fresnel::dielectric(mu.min(1.0), self.eta);
        let (f, t) = (boundary.reflected, 1.0 - boundary.reflected);
        let metal = self.reflectance * fresnel::conductor(boundary.cos_beyond, self.metal.eta, self.metal.k);
        metal.map(|r| f + t * t * r / (1.0 - f * r).max(1e-6))
    }

    /// Probabilities of the coat's lobe and of the metal's: about the shares of light that they carry.
    #[inline]
    fn chances(&self, mu: f32) -> [f32; 2] {
        let (through, stays) = (self.through(mu), self.stays(mu));
        let coat = (1.0 - through).max(1e-3);
        let metal = (through * (1.0 - stays) * self.mean_metal().mean()).max(1e-3);
        let late = (through * stays * self.leaves_late().mean()).max(1e-3);
        let sum = coat + metal + late;
        [coat / sum, metal / sum]
    }

    #[inline]
    fn density(&self, under: Facets, wo: Local, wi: Local, [coat, metal]: [f32; 2]) -> f32 {
        let (up, down) = (self.within(wo), self.within(wi));
        let of_coat = self.coat.map_or(0.0, |f| 0.25 * f.d(wo.0 + wi.0) * f.seen(wo));
        // dω′/dω = cos θ / (η² cos θ′).
        let narrowed = wi.cos() / (self.eta * self.eta * down.cos());
        let of_metal = 0.25 * under.d(up.0 + down.0) * under.seen(up) * narrowed;
        coat * of_coat + metal * of_metal + (1.0 - coat - metal) * wi.cos() * real::INV_PI
    }

    #[inline]
    fn reflected(&self, under: Facets, wo: Local, wi: Local) -> Rgb {
        let v = wo.0 + wi.0;
        let of_coat = self.coat.map_or(0.0, |f| {
            let fresnel = fresnel::dielectric((0.5 * v.length()).min(1.0), self.eta).reflected;
            0.25 * fresnel * f.d(v) * (f.seen(wo) * f.seen(wi))
        });
        let through = [wo.cos(), wi.cos()].map(|mu| self.through(mu));
        let (up, down) = (self.within(wo), self.within(wi));
        let half = up.0 + down.0;
        let metal = fresnel::conductor((0.5 * half.length()).min(1.0), self.metal.eta, self.metal.k)
            * self.reflectance;
        let shape = 0.25 * under.d(half) * (under.seen(up) * under.seen(down));
        let metal = metal * (through[0] * through[1] * shape / (self.eta * self.eta));
        let stays = through[0] * self.stays(wo.cos()) * through[1] * self.stays(wi.cos());
        let late = self.leaves_late() * (stays * real::INV_PI / self.mean_trapped.max(1e-6));
        Rgb::grey(of_coat) + metal + late
    }
}

/// The cosine of a place.
fn cosine(k: usize) -> f32 {
    (k as f32 / (PLACES - 1) as f32).max(1e-3)
}

/// The facets of the metal as they are seen through a rough coat.
fn widened(facets: Option<Facets>, coat: Option<Facets>, eta: f32) -> Option<Facets> {
    let Some(coat) = coat else { return facets };
    let by = (eta - 1.0) * (eta - 1.0) / (2.0 * eta * eta);
    let own = facets.map_or([0.0; 2], Facets::alpha);
    let [u, v] = [0, 1].map(|i| (own[i] * own[i] + by * coat.alpha()[i] * coat.alpha()[i]).sqrt());
    let beckmann = facets.unwrap_or(coat).is_beckmann();
    Some(if beckmann { Facets::beckmann(u, v) } else { Facets::new(u, v) })
}

impl BsdfKind for CoatedConductor {
    #[inline(never)]
    fn eval(&self, wo: Local, wi: Local) -> Rgb {
        match self.under {
            Some(under) if wo.cos() > 0.0 && wi.cos() > 0.0 => self.reflected(under, wo, wi),
            _ => Rgb::BLACK,
        }
    }

    /// Mirrored by the coat, by a facet of the metal with the way in and out refracted, or about the normal.
    #[inline(never)]
    fn sample(&self, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
        if wo.cos() <= 0.0 {
            return None;
        }
        let delta = |throughput| Some(BsdfSample { wi: wo.mirrored(), throughput, density: Density::Delta });
        let Some(under) = self.under else { return delta(self.mirrored(wo.cos())) };
        let chances = self.chances(wo.cos());
        let about = |facets: Facets, w: Local| {
            let m = facets.sample(w, [u[0], u[1]]);
            Local((m * (2.0 * w.0.dot(m)) - w.0).normalize())
        };
        let wi = if u[2] < chances[0] {
            let Some(coat) = self.coat else {
                return delta(Rgb::grey((1.0 - self.through(wo.cos())) / chances[0]));
            };
            about(coat, wo)
        } else if u[2] < chances[0] + chances[1] {
            let down = about(under, self.within(wo));
            let (x, y) = (down.0.x * self.eta, down.0.y * self.eta);
            let cos2 = 1.0 - x * x - y * y;
            if down.cos() <= 0.0 || cos2 <= 0.0 {
                return None;
            }
            Local(Vec3::new(x, y, cos2.sqrt()).normalize())
        } else {
            warp::cosine_hemisphere([u[0], u[1]])
        };
        if wi.cos() <= 0.0 {
            return None;
        }
        let pdf = self.density(under, wo, wi, chances);
        let throughput = self.reflected(under, wo, wi) * (wi.cos() / pdf);
        (pdf > 0.0).then_some(BsdfSample { wi, throughput, density: Density::SolidAngle(pdf) })
    }

    #[inline(never)]
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        match self.under {
            Some(under) if wo.cos() > 0.0 && wi.cos() > 0.0 => {
                self.density(under, wo, wi, self.chances(wo.cos()))
            }
            _ => 0.0,
        }
    }

    fn is_delta(&self) -> bool {
        self.under.is_none()
    }

    /// A polished coat mirrors.
    fn has_single_directions(&self) -> bool {
        self.coat.is_none()
    }

    fn albedo(&self) -> Rgb {
        if self.under.is_none() {
            return fresnel::average(|mu| self.mirrored(mu));
        }
        let late = self.leaves_late() * self.mean_trapped;
        Rgb::grey(self.mean_coat) + self.mean_metal() * self.mean_direct + late
    }

    fn examples() -> Vec<CoatedConductor> {
        let gold = Metal { eta: Rgb([0.14, 0.37, 1.44]), k: Rgb([3.98, 2.39, 1.6]) };
        let perfect = Metal { eta: Rgb::grey(1e-3), k: Rgb::grey(1e3) };
        let rough = |u, v| Some(Facets::new(u, v));
        vec![
            CoatedConductor::new(1.5, None, gold, None),
            CoatedConductor::new(1.5, None, gold, rough(0.2, 0.2)),
            CoatedConductor::new(1.5, None, perfect, rough(0.6, 0.6)),
            CoatedConductor::new(1.8, rough(0.2, 0.2), gold, rough(0.1, 0.4)),
            CoatedConductor::new(1.3, rough(0.5, 0.5), perfect, None),
            CoatedConductor {
                reflectance: Rgb([1.0, 0.5, 0.0]),
                ..CoatedConductor::new(1.0, None, gold, None)
            },
        ]
    }
}
