//! How much light arrives at points, how open they are, what part of a light they see.

use antumbra_math::{Rgb, Vec3};
use antumbra_trace::{Bits, Visibility};

use crate::estimator::{AnyEstimator, EstimatorKind, LightChoice, Proposals};
use crate::film::{Film, Planes};
use crate::illuminate::Job;
use crate::light::{LightId, LightPoints};
use crate::receiver::Receiver;
use crate::sampler::{Use, stream};
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
    estimate(scene, queries, settings, Seen::Light, std::f32::consts::PI, watch)
}

/// (1/π) ∫ V cos θ dω at each point; 1 = open.
pub fn ambient_occlusion(
    scene: &Scene,
    queries: &[Query],
    settings: &Settings,
    watch: &mut dyn FnMut(Progress) -> Flow,
) -> Estimated {
    let settings = Settings { estimator: EstimatorKind::AmbientOcclusion, ..settings.clone() };
    estimate(scene, queries, &settings, Seen::Open, 1.0, watch)
}

fn estimate(
    scene: &Scene,
    queries: &[Query],
    settings: &Settings,
    seen: Seen,
    unit: f32,
    watch: &mut dyn FnMut(Progress) -> Flow,
) -> Estimated {
    let sensor = PointSensor { queries };
    let one_ray = crate::estimator::Options { shadow_rays: 1, ..settings.options() };
    let estimator = AnyEstimator::new(settings.estimator, scene, one_ray);
    let visibility = scene.visibility(settings.masks == Masks::Opaque);
    let paths = matches!(settings.estimator, EstimatorKind::Path | EstimatorKind::PathHemisphere);
    let job = Job {
        scene,
        visibility: &visibility,
        sensor: &sensor,
        estimator: &estimator,
        sampler: settings.sampler(),
        seed: settings.seed,
        shadow_rays: 1,
        bounces: if paths { settings.bounces } else { 1 },
        passes: settings.passes_of(settings.shadow_rays),
        planes: Planes::NONE,
        look: settings.look(),
        seen,
        shadows: settings.shadows,
        distance_test: settings.distance_test,
    };
    let finished = schedule::run(&job, settings.threads, watch);
    let mut out = Estimated { rays_done: finished.passes_done, ..Estimated::default() };
    for (_, film) in &finished.tiles {
        for cell in 0..film.cells() {
            let scaled = |v: [f64; 3]| v.map(|c| (c * f64::from(unit)) as f32);
            out.values.push(scaled(film.mean(Planes::BEAUTY, cell)));
            out.standard_error.push(film.standard_error(cell).map_or([f32::NAN; 3], scaled));
        }
    }
    out
}

/// Mean V of one light from each point: uniform area for flat lights, solid angle for sphere, sun and sky. A light
/// point below the point's horizon is not seen.
pub fn visible_fraction(
    scene: &Scene,
    queries: &[Query],
    light: LightId,
    settings: &Settings,
    watch: &mut dyn FnMut(u64) -> Flow,
) -> Estimated {
    const CHUNK: usize = 64;
    let visibility = scene.visibility(settings.masks == Masks::Opaque);
    let mut seen = vec![[f32::NAN; 2]; queries.len()];
    let work = |from: usize, out: &mut [[f32; 2]], buffers: &mut (Proposals, Bits)| {
        let film = light_seen(
            scene,
            &visibility,
            (from, &queries[from..from + out.len()]),
            light,
            settings,
            buffers,
        );
        for (cell, out) in out.iter_mut().enumerate() {
            let error = film.standard_error(cell).map_or(f32::NAN, |e| e[0] as f32);
            *out = [film.mean(Planes::BEAUTY, cell)[0] as f32, error];
        }
    };
    schedule::chunks(&mut seen, CHUNK, settings.threads, work, watch);
    Estimated {
        values: seen.iter().map(|s| [s[0]; 3]).collect(),
        standard_error: seen.iter().map(|s| [s[1]; 3]).collect(),
        rays_done: settings.shadow_rays,
    }
}

/// All samples of a run of points (number of the first, points) toward one light.
fn light_seen(
    scene: &Scene,
    visibility: &dyn Visibility,
    (from, queries): (usize, &[Query]),
    light: LightId,
    settings: &Settings,
    (proposals, blocked): &mut (Proposals, Bits),
) -> Film {
    let (plan, sampler) = (settings.passes_of(settings.shadow_rays), settings.sampler());
    let mut film = Film::tile(queries.len(), Planes::NONE);
    for pass in 0..plan.count {
        let (replicate, index, of) = plan.locate(pass);
        proposals.clear();
        for (query, cell) in queries.iter().zip(0..) {
            let stream = stream(settings.seed, from as u32 + cell, replicate);
            let at = Receiver { cell, stream, index, ..query.receiver(1.0) };
            let u = sampler.pair(stream, index, of, Use::LightPoint.at(0));
            let sample = scene.lights()[light as usize].sample(&at, u, LightPoints::Area);
            if let Some(s) = sample.filter(|s| at.sees_side(s.wi)) {
                proposals.segment(&at, 0, &s, Planes::NONE, Rgb::WHITE);
            }
        }
        visibility.occluded(proposals.segments.as_segments(), blocked);
        for (i, carried) in proposals.carried.iter().enumerate() {
            if !blocked.get(i) {
                film.add(Planes::BEAUTY, carried.cell, carried.light);
            }
        }
        film.next_sample();
        if plan.begin(replicate + 1) == pass + 1 {
            film.close_replicate();
        }
    }
    film
}

/// One light point for each query, from three numbers each (which light, where on it): what a student's own estimator
/// of the area form needs.
#[derive(Clone, Debug, Default)]
pub struct LightDraws {
    /// ω_i, unit vectors; 0 where there is no light point.
    pub direction: Vec<[f32; 3]>,
    /// Where the shadow ray ends, or a point far along ω_i for lights at infinity.
    pub target: Vec<[f32; 3]>,
    /// Distance to the light point; +∞ at infinity.
    pub distance: Vec<f32>,
    /// L_e; for lights without size the irradiance at normal incidence.
    pub radiance: Vec<[f32; 3]>,
    /// p(light) · p(ω_i) [1/sr]; lights without size: p(light).
    pub pdf: Vec<f32>,
    /// Which light.
    pub light: Vec<LightId>,
}

/// Draws a light point for every query.
pub fn sample_light(scene: &Scene, queries: &[Query], u: &[[f32; 3]], settings: &Settings) -> LightDraws {
    use crate::light::sampler::{Choose, LightSampler};
    let choose = match settings.lights {
        LightChoice::Power => Choose::Power,
        LightChoice::Contribution => Choose::Contribution,
        _ => Choose::Uniform,
    };
    let sampler = LightSampler::new(choose, scene.lights(), scene.radius());
    let mut scratch = Vec::new();
    let mut out = LightDraws::default();
    for (query, u) in queries.iter().zip(u) {
        let at = query.receiver(1.0);
        let pick = sampler.prepare(scene.lights(), &at, &mut scratch).pick(u[0]);
        let drawn = pick.and_then(|pick| {
            let s = scene.lights()[pick.light as usize].sample(&at, [u[1], u[2]], settings.light_points)?;
            Some((pick, s))
        });
        let Some((pick, s)) = drawn else {
            out.push([0.0; 3], [0.0; 3], 0.0, [0.0; 3], 1.0, 0);
            continue;
        };
        let target = match s.end {
            crate::light::End::Point(q) => q,
            crate::light::End::Infinity => {
                Vec3::from(at.start) + s.wi * (4.0 * scene.radius() + 4.0 * at.p.length())
            }
        };
        let pdf = pick.prob * s.density.weight();
        out.push(s.wi.to_array(), target.to_array(), s.distance, s.radiance.0, pdf, pick.light);
    }
    out
}

impl LightDraws {
    fn push(
        &mut self,
        wi: [f32; 3],
        target: [f32; 3],
        distance: f32,
        radiance: [f32; 3],
        pdf: f32,
        light: LightId,
    ) {
        self.direction.push(wi);
        self.target.push(target);
        self.distance.push(distance);
        self.radiance.push(radiance);
        self.pdf.push(pdf);
        self.light.push(light);
    }
}
