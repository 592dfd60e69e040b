//! Variances of estimators with one sample against closed forms: many independent samples, the band from their own
//! fourth moment.

use antumbra::estimator::{Directions, EstimatorKind, LightChoice};
use antumbra::light::{LightPoints, Sun};
use antumbra::math::hash::{hash2, unit_f32};
use antumbra::math::{Rgb, Vec3, real};
use antumbra::query;
use antumbra::sampler::{AnySampler, Pairing, SamplerKind, SamplerOptions, Use};
use antumbra::scene::{MaterialId, Scene, SceneBuilder};
use antumbra::schedule::Flow;
use antumbra::sensor::Query;
use antumbra::settings::Settings;
use serde_json::json;

use super::closed::{many_lights, settings};
use super::judge::{Judge, Trial, size};
use super::scenes::{Built, build, build_with, parallelogram, receiver};
use super::table::{Case, Way, cases_of};

/// A function of a point of the square and a random offset.
type Integrand = fn([f32; 2], f32) -> f64;

/// The variance of independent values against its truth; its error by their fourth moment.
fn of_values(name: &str, values: &[f64], truth: f64) -> Trial {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let moment = |k: i32| values.iter().map(|v| (v - mean).powi(k)).sum::<f64>() / n;
    let (square, fourth) = (moment(2), moment(4));
    let error = ((fourth - square * square) / n).sqrt();
    let estimate = square * n / (n - 1.0);
    // f32 values: 2⁻²³ of each.
    Trial { name: name.into(), estimate, error, dof: f64::INFINITY, truth, slack: 1e-6 * truth }
}

/// Many estimates at the same receiver, each with its own random numbers.
fn estimates(scene: &Scene, query: Query, settings: &Settings, n: u32) -> Vec<f64> {
    let queries = vec![query; n as usize];
    let found = query::irradiance(scene, &queries, settings, &mut |_| Flow::Continue);
    found.values.iter().map(|v| f64::from(v[0])).collect()
}

/// A black square over x < 0, halfway to the light.
fn half(builder: &mut SceneBuilder, black: MaterialId) {
    let square =
        parallelogram(Vec3::new(-4.0, 0.5, -4.0), Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 0.0, 8.0));
    builder.object("half", square, black);
}

/// How a case draws its one (or two) samples of E.
fn draws(id: &str) -> Option<Settings> {
    use EstimatorKind::{Area, Hemisphere, Mis};
    let by = |kind, rays, light_points, directions| {
        let sampler = SamplerKind::Random;
        Settings { light_points, directions, sampler, ..settings(kind, rays) }
    };
    let (area, solid) = (LightPoints::Area, LightPoints::SolidAngle);
    let (cosine, uniform) = (Directions::Cosine, Directions::Uniform);
    Some(match id {
        "CF35a" | "CF35e" | "CF36a" | "CF36d" => by(Area, 1, area, cosine),
        "CF35b" | "CF36c" | "CF36e" => by(Area, 1, solid, cosine),
        "CF35c" => by(Hemisphere, 1, area, cosine),
        "CF35d" => by(Hemisphere, 1, area, uniform),
        "CF39a" | "CF39b" | "CF39c" => by(Mis, 1, area, cosine),
        "CF39d" => by(Area, 2, area, cosine),
        "CF39e" => by(Hemisphere, 2, area, cosine),
        "CF43b" => Settings { lights: LightChoice::Uniform, ..by(Area, 1, area, cosine) },
        "CF43c" => Settings { lights: LightChoice::Power, ..by(Area, 1, area, cosine) },
        _ => return None,
    })
}

/// The scene of a case.
fn scene_of(case: &Case) -> Built {
    let up = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    match case.id.as_str() {
        // A disk has no map of its solid angle; a sun of 45° fills the same cone.
        "CF35b" => {
            let mut builder = SceneBuilder::new("cone");
            builder.light("sun", Sun::new(Vec3::Y, 0.25 * real::PI, Rgb::WHITE));
            Built { scene: builder.build().unwrap(), query: up, texels: 0.0 }
        }
        "CF35e" | "CF35f" | "CF36d" | "CF36e" => build_with(&case.scene, half),
        "CF39d" | "CF39e" => build(&json!({
            "receiver": {"p": [0, 0, 0], "n": [0, 1, 0]},
            "lights": [{"type": "disk", "center": [0, 1, 0], "normal": [0, -1, 0],
                "radius": case.number("R"), "Le": 1}],
        })),
        "CF43b" | "CF43c" => Built { scene: many_lights(), query: up, texels: 0.0 },
        _ => build(&case.scene),
    }
}

/// α = 10⁻³ over all cases.
#[test]
fn variances_equal_closed_forms() {
    let test = "variances_equal_closed_forms";
    let Some(cases) = cases_of(test, Way::Variance) else { return };
    let mut judge = Judge::default();
    let n = size(1 << 16, 1 << 22);
    for case in cases.iter().filter(|c| !c.id.starts_with("CF37")) {
        let Built { scene, query, .. } = scene_of(case);
        let values = match (draws(&case.id), case.id.as_str()) {
            (Some(settings), _) => estimates(&scene, query, &settings, n),
            (None, "CF35f") => visibilities(&scene, query, n),
            (None, "CF36b") => inverse_densities(&scene, query, LightPoints::Area, n),
            (None, id) => panic!("{id}: nothing draws its samples"),
        };
        judge.add(of_values(&case.id, &values, case.value));
    }
    judge.verdict(test, 1e-3);
}

/// One look each at the light.
fn visibilities(scene: &Scene, query: Query, n: u32) -> Vec<f64> {
    let s = Settings { sampler: SamplerKind::Random, ..settings(EstimatorKind::Area, 1) };
    let queries = vec![query; n as usize];
    let found = query::visible_fraction(scene, &queries, 0, &s, &mut |_| Flow::Continue);
    found.values.iter().map(|v| f64::from(v[0])).collect()
}

/// 1/p(ω) of independent light points; 0 where the light gives none.
fn inverse_densities(scene: &Scene, query: Query, how: LightPoints, n: u32) -> Vec<f64> {
    let at = query.receiver(1.0);
    let u = |i: u32, k: u32| unit_f32(hash2(i, k));
    let draw = |i: u32| scene.lights()[0].sample(&at, [u(i, 1), u(i, 2)], how);
    (0..n).map(|i| draw(i).map_or(0.0, |s| 1.0 / f64::from(s.density.weight()))).collect()
}

/// Ω as the mean of 1/p(ω).
pub fn mean_solid_angle(name: &str, scene: &Scene, how: LightPoints, truth: f64) -> Trial {
    let values = inverse_densities(scene, receiver([0.0; 3], [0.0, 1.0, 0.0]), how, size(1 << 16, 1 << 22));
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>();
    let error = (square / (n * (n - 1.0))).sqrt();
    let name = format!("{name} {how:?}");
    Trial { name, estimate: mean, error, dof: f64::INFINITY, truth, slack: 1e-6 * truth }
}

/// CF37: what random and jittered numbers leave of simple integrands, with `of` points a mean. α = 10⁻³.
#[test]
fn convergence_has_the_exact_constants() {
    let test = "convergence_has_the_exact_constants";
    let Some(cases) = cases_of(test, Way::Variance) else { return };
    let mut judge = Judge::default();
    let trials = size(1 << 13, 1 << 18);
    for case in cases.iter().filter(|c| c.id.starts_with("CF37")) {
        use SamplerKind::{Random, Stratified};
        let diagonal = |[u, v]: [f32; 2], _: f32| f64::from(u + v < 1.0);
        let edge = |[u, _]: [f32; 2], offset: f32| f64::from(u < offset);
        let smooth = |[u, _]: [f32; 2], _: f32| f64::from(u);
        let (kind, of, f): (_, u32, Integrand) = match case.id.as_str() {
            "CF37a" => (Random, 16, diagonal),
            "CF37b" => (Stratified, 16, diagonal),
            "CF37c" => (Stratified, 256, diagonal),
            "CF37d" => (Stratified, 256, edge),
            "CF37e" => (Stratified, 256, smooth),
            "CF37f" => (Random, 256, smooth),
            id => panic!("{id}: no integrand"),
        };
        let options = SamplerOptions { seed: 0, pairing: Pairing::TwoD, rotate: false };
        let sampler = AnySampler::new(kind, options);
        let error = |stream: u32| {
            let offset = unit_f32(hash2(stream, 0xed9e));
            let at = |i| f(sampler.pair(hash2(stream, 5), i, of, Use::LightPoint.at(0)), offset);
            let mean = (0..of).map(at).sum::<f64>() / f64::from(of);
            // The edge at a random place: what is left of the mean given the place.
            if case.id == "CF37d" { mean - f64::from(offset) } else { mean }
        };
        let values: Vec<f64> = (0..trials).map(error).collect();
        judge.add(of_values(&case.id, &values, case.value));
    }
    judge.verdict(test, 1e-3);
}
