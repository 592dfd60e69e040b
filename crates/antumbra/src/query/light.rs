//! How much light arrives at points, how open they are, what part of a light they see.

use antumbra_math::Vec3;

use crate::estimator::{Estimator, EstimatorKind, LightChoice, Options, VisibleFraction};
use crate::film::Planes;
use crate::illuminate::{Job, LightPlanes};
use crate::light::sampler::{Choose, LightSampler, Pick, Scratch};
use crate::light::{End, LightId};
use crate::receiver::Receiver;
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

/// One light point for a receiver: what a student's own estimator of the area form needs.
#[derive(Clone, Copy, Debug)]
pub struct LightDraw {
    /// ω_i, a unit vector; 0 where there is no light point.
    pub direction: [f32; 3],
    /// Where the shadow ray ends, or a point far along ω_i for lights at infinity.
    pub target: [f32; 3],
    /// Distance to the light point; +∞ at infinity.
    pub distance: f32,
    /// L_e; for lights without size the irradiance at normal incidence.
    pub radiance: [f32; 3],
    /// p(light) · p(ω_i) [1/sr]; lights without size: p(light).
    pub pdf: f32,
    /// Which light.
    pub light: LightId,
}

impl LightDraw {
    /// No light can reach.
    pub const NONE: LightDraw = LightDraw {
        direction: [0.0; 3],
        target: [0.0; 3],
        distance: 0.0,
        radiance: [0.0; 3],
        pdf: 1.0,
        light: 0,
    };
}

/// Draws a light point for every query, from three numbers each (which light, where on it).
pub fn sample_light(
    scene: &Scene,
    queries: &[Query],
    u: &[[f32; 3]],
    settings: &Settings,
    watch: &mut dyn FnMut(u64) -> Flow,
) -> Vec<LightDraw> {
    const CHUNK: usize = 1024;
    let choose = match settings.lights {
        LightChoice::Power => Choose::Power,
        LightChoice::Contribution => Choose::Contribution,
        _ => Choose::Uniform,
    };
    let sampler = LightSampler::new(choose, scene.lights(), scene.radius());
    let mut out = vec![LightDraw::NONE; queries.len()];
    let answer = |from: usize, out: &mut [LightDraw], scratch: &mut Scratch| {
        for (i, out) in out.iter_mut().enumerate() {
            let (at, u) = (queries[from + i].receiver(1.0), u[from + i]);
            let pick = sampler.prepare(scene.lights(), &at, scratch).pick(u[0]);
            if let Some(drawn) = pick.and_then(|pick| draw(scene, &at, pick, [u[1], u[2]], settings)) {
                *out = drawn;
            }
        }
    };
    schedule::chunks(&mut out, CHUNK, settings.threads, answer, watch);
    out
}

/// A point of the light that was picked.
fn draw(scene: &Scene, at: &Receiver, pick: Pick, u: [f32; 2], settings: &Settings) -> Option<LightDraw> {
    let s = scene.lights()[pick.light as usize].sample(at, u, settings.light_points)?;
    let target = match s.end {
        End::Point(q) => q,
        End::Infinity => Vec3::from(at.start) + s.wi * (4.0 * scene.radius() + 4.0 * at.p.length()),
    };
    Some(LightDraw {
        direction: s.wi.to_array(),
        target: target.to_array(),
        distance: s.distance,
        radiance: s.radiance.0,
        pdf: pick.prob * s.density.weight(),
        light: pick.light,
    })
}
