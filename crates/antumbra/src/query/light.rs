//! How much light arrives at points, how open they are, what part of a light they see.

use crate::estimator::{Estimator, EstimatorKind, Options, VisibleFraction};
use crate::film::Planes;
use crate::illuminate::{Job, LightPlanes};
use crate::light::LightId;
use crate::scene::Scene;
use crate::schedule::{self, Flow, Progress};
use crate::sensor::{PointSensor, Query, Seen};
use crate::settings::{Masks, Settings};

/// An estimate for each point, with its own error.
#[derive(Clone, Debug, Default)]
pub struct Estimated {
    /// The estimates.
    pub values: Vec<[f32; 3]>,
    /// Their standard errors; NaN below two replicates (fewer than two rays).
    pub standard_error: Vec<[f32; 3]>,
    /// Rays that were finished for every point.
    pub rays_done: u32,
}

/// E = ∫ L cos θ dω at each point [W/m²]: light of the estimator of `settings` with `shadow_rays` samples a point.
pub fn irradiance(
    scene: &Scene,
    queries: &[Query],
    settings: &Settings,
    watch: &mut dyn FnMut(Progress) -> Flow,
) -> Estimated {
    // The points are white (ρ = 1): L = E/π.
    named(settings.estimator, scene, queries, settings, Seen::Light, watch).scaled(std::f32::consts::PI)
}

/// (1/π) ∫ V cos θ dω at each point; 1 = open.
pub fn ambient_occlusion(
    scene: &Scene,
    queries: &[Query],
    settings: &Settings,
    watch: &mut dyn FnMut(Progress) -> Flow,
) -> Estimated {
    named(EstimatorKind::AmbientOcclusion, scene, queries, settings, Seen::Open, watch)
}

/// Mean V of one light from each point: uniform area for flat lights, solid angle for sphere, sun and sky. A light
/// point below the point's horizon is not seen.
pub fn visible_fraction(
    scene: &Scene,
    queries: &[Query],
    light: LightId,
    settings: &Settings,
    watch: &mut dyn FnMut(Progress) -> Flow,
) -> Estimated {
    estimate(&VisibleFraction::of(light), 1, scene, queries, settings, Seen::Open, watch)
}

fn named(
    kind: EstimatorKind,
    scene: &Scene,
    queries: &[Query],
    settings: &Settings,
    seen: Seen,
    watch: &mut dyn FnMut(Progress) -> Flow,
) -> Estimated {
    let estimator = kind.make(scene, Options { shadow_rays: 1, ..settings.options() });
    let paths = matches!(kind, EstimatorKind::Path | EstimatorKind::PathHemisphere);
    let bounces = if paths { settings.bounces } else { 1 };
    estimate(estimator.as_ref(), bounces, scene, queries, settings, seen, watch)
}

/// The loop over points: each of the `shadow_rays` samples is a pass.
fn estimate(
    estimator: &dyn Estimator,
    bounces: u32,
    scene: &Scene,
    queries: &[Query],
    settings: &Settings,
    seen: Seen,
    watch: &mut dyn FnMut(Progress) -> Flow,
) -> Estimated {
    let job = Job {
        scene,
        visibility: &scene.visibility(settings.masks == Masks::Opaque),
        sensor: &PointSensor { queries },
        estimator,
        sampler: settings.sampler(),
        seed: settings.seed,
        shadow_rays: 1,
        bounces,
        passes: settings.passes_of(settings.shadow_rays),
        planes: Planes::NONE,
        light_planes: LightPlanes::default(),
        look: settings.look(),
        seen,
        shadows: settings.shadows,
        distance_test: settings.distance_test,
    };
    let finished = schedule::run(&job, settings.threads, watch);
    let mut out = Estimated { rays_done: finished.passes_done, ..Estimated::default() };
    for (_, film) in &finished.tiles {
        for cell in 0..film.cells() {
            let single = |v: [f64; 3]| v.map(|c| c as f32);
            out.values.push(single(film.mean(Planes::BEAUTY, cell)));
            out.standard_error.push(film.standard_error(cell).map_or([f32::NAN; 3], single));
        }
    }
    out
}

impl Estimated {
    fn scaled(mut self, unit: f32) -> Estimated {
        let all = self.values.iter_mut().chain(&mut self.standard_error);
        all.flatten().for_each(|v| *v *= unit);
        self
    }
}
