//! The area form over *all* surfaces: points drawn evenly on everything there is; most of them are dark. Direct light.

use antumbra_math::{Rgb, Vec3, World};

use super::lights::blind_to_single_directions;
use super::proposals::plane_of;
use super::{Draws, Estimator, Nth, Options, Proposals};
use crate::density::Density;
use crate::light::{End, LightSample};
use crate::receiver::Receiver;
use crate::sampler::Use;
use crate::scene::{Scene, SurfaceAreas};

/// N points on all surfaces.
pub struct Surfaces {
    areas: SurfaceAreas,
    opaque: bool,
}

impl Surfaces {
    /// Measures the surfaces of a scene.
    pub fn new(scene: &Scene, options: Options) -> Surfaces {
        Surfaces { areas: SurfaceAreas::of(scene), opaque: options.opaque }
    }
}

impl Estimator for Surfaces {
    /// L ≈ f_r L_e cos θ cos θ′ / r² · A / N, short of V: p(p′) = 1/A.
    fn propose(&self, scene: &Scene, at: &[Receiver], u: &Draws<'_>, out: &mut Proposals) {
        for at in at {
            let n = u.count(at);
            let behind = at.spreads_through().then(|| at.from_behind());
            for nth in Nth::of(n) {
                let point = u.pair(at, Use::LightPoint, nth);
                let Some(q) = self.areas.point(scene, u.one(at, Use::LightChoice, nth), point) else {
                    continue;
                };
                let to = q.p - at.p;
                let distance2 = to.length_squared();
                let distance = distance2.sqrt();
                let wi: World = to / distance;
                let facing = -q.n.dot(wi);
                let covered = if self.opaque { 1.0 } else { scene.coverage(q.prim, q.p) };
                let radiance = scene.emitted_at(q.prim, wi, facing > 0.0) * covered;
                if radiance.is_black() || facing == 0.0 || distance2 == 0.0 {
                    continue;
                }
                let at = if at.sees_side(wi) { at } else { behind.as_ref().unwrap_or(at) };
                let Some(local) = at.local_in_sight(wi) else { continue };
                // G without V: cos θ cos θ′ / r².
                let g = local.cos().abs() * facing.abs() / distance2;
                let carried = at.bsdf.eval(at.wo, local) * radiance * (g * self.areas.total() / n as f32);
                let end = End::Point(Vec3::from(q.end_toward(-wi)));
                let density = Density::SolidAngle(distance2 / (facing.abs() * self.areas.total()));
                let sample =
                    LightSample { wi, end, distance, radiance, density, prim: q.prim, cos: facing.abs() };
                let carried: Rgb = carried * at.throughput;
                if carried.is_finite() && !carried.is_black() {
                    out.segment(at, nth.j, &sample, plane_of(at), carried);
                }
            }
        }
    }

    fn blind_to(&self, scene: &Scene) -> Vec<String> {
        let n = scene.lights().iter().filter(|l| l.is_delta() || l.is_infinite()).count();
        let text = format!(
            "estimator surfaces does not see lights without a surface ({n} here: points, sun or sky)"
        );
        let unseen = (n > 0).then_some(text);
        unseen.into_iter().chain(blind_to_single_directions(scene, "surfaces")).collect()
    }
}
