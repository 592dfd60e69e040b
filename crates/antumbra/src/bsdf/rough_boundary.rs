//! A rough boundary between two media: the facet that turns one direction into another, by reflection or refraction
//! (Walter et al. 2007, equations 13 to 21).

use antumbra_math::{Local, Vec3};

use super::facets::Facets;
use super::fresnel::{self, Boundary};

/// The nearest that n below over n above comes to 1: facets between equal media have no half vector.
const LEAST_STEP: f32 = 1e-3;

/// Facets between two media.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughBoundary {
    /// n below the surface (−z) over n above it.
    pub eta: f32,
    /// The ground.
    pub facets: Facets,
}

/// A pair of directions with the facet that joins them.
pub struct Joined {
    m: Vec3,
    /// ω_o·m; of ω_o's side.
    pub om: f32,
    /// ω_i·m; of opposite sign for refraction.
    im: f32,
    /// Share reflected at the facet.
    pub fresnel: f32,
    /// n on the side of ω_i over n on the side of ω_o; 1 for reflection.
    eta: f32,
}

/// A facet that a direction sees.
pub struct Seen {
    m: Vec3,
    /// |ω_o·m|.
    pub cos: f32,
    /// What it does with light.
    pub boundary: Boundary,
}

impl RoughBoundary {
    /// n below over n above, taken into [0.1, 10] and away from 1.
    pub fn new(eta: f32, facets: Facets) -> RoughBoundary {
        let eta = fresnel::index(eta);
        RoughBoundary { eta: if (eta - 1.0).abs() < LEAST_STEP { 1.0 + LEAST_STEP } else { eta }, facets }
    }

    /// The same boundary seen from its other side.
    pub fn turned(self) -> RoughBoundary {
        RoughBoundary { eta: 1.0 / self.eta, ..self }
    }

    /// n beyond over n on the side of ω_o.
    #[inline]
    pub fn beyond(&self, wo: Local) -> f32 {
        if wo.cos() > 0.0 { self.eta } else { 1.0 / self.eta }
    }

    /// The facet that turns ω_o into ω_i; `None` if there is none that both see.
    #[inline]
    pub fn joined(&self, wo: Local, wi: Local) -> Option<Joined> {
        if wo.cos() == 0.0 || wi.cos() == 0.0 {
            return None;
        }
        let beyond = self.beyond(wo);
        let reflects = wo.same_side(wi);
        let eta = if reflects { 1.0 } else { beyond };
        let v = wo.0 + wi.0 * eta;
        let m = v.normalize_or_zero();
        let m = if m.z < 0.0 { -m } else { m };
        let (om, im) = if reflects {
            // Equal to the last bit, as the angles are.
            let half = 0.5 * v.length().copysign(wo.cos());
            (half, half)
        } else {
            (wo.0.dot(m), wi.0.dot(m))
        };
        // Each direction sees the facet on the side on which it sees the ground.
        if !(om * wo.cos() > 0.0 && im * wi.cos() > 0.0) {
            return None;
        }
        let fresnel = fresnel::dielectric(om.abs().min(1.0), beyond).reflected;
        Some(Joined { m, om, im, fresnel, eta })
    }

    /// f without Fresnel's part and G₁ of ω_i: D G₁(ω_o)/μ_o times the facet's map of solid angles.
    #[inline]
    pub fn spread(&self, wo: Local, wi: Local, j: &Joined) -> f32 {
        let shape = self.facets.d(j.m) * self.facets.seen(wo);
        if wo.same_side(wi) {
            return 0.25 * shape;
        }
        let sum = j.om + j.eta * j.im;
        shape * (j.om * j.im).abs() / (sum * sum)
    }

    /// p(ω_i) within its lobe: of the facet, times |dm/dω_i| (refraction: η² |ω_i·m| / (ω_o·m + η ω_i·m)²).
    #[inline]
    pub fn density(&self, wo: Local, wi: Local, j: &Joined) -> f32 {
        self.spread(wo, wi, j) * j.eta * j.eta
    }

    /// Draws a facet that ω_o, off the horizon, sees.
    #[inline]
    pub fn sample(&self, wo: Local, u: [f32; 2]) -> Seen {
        let up = wo.0 * wo.cos().signum();
        let m = self.facets.sample(Local(up), u);
        let cos = up.dot(m);
        Seen { m, cos, boundary: fresnel::dielectric(cos.clamp(0.0, 1.0), self.beyond(wo)) }
    }

    /// Where a facet sends ω_o; `None` if that is the wrong side of the ground.
    #[inline]
    pub fn sent(&self, wo: Local, seen: &Seen, reflects: bool) -> Option<Local> {
        let side = wo.cos().signum();
        let (m, up) = (seen.m, wo.0 * side);
        let wi = if reflects {
            m * (2.0 * seen.cos) - up
        } else {
            let eta = self.beyond(wo);
            m * (seen.cos / eta - seen.boundary.cos_beyond) - up / eta
        };
        let wi = Local(wi.normalize() * side);
        (wo.same_side(wi) == reflects).then_some(wi)
    }
}
