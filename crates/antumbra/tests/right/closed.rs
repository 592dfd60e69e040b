//! Irradiance and visible fraction against closed forms, by every estimator that can see the lights of the case.

use antumbra::estimator::{Directions, EstimatorKind, LightChoice};
use antumbra::light::{LightPoints, Point, Sphere, Sun};
use antumbra::math::{DVec3, Rgb, Vec3, real};
use antumbra::query::{self, Estimated};
use antumbra::sampler::SamplerKind;
use antumbra::scene::{Scene, SceneBuilder, SurfaceAreas};
use antumbra::schedule::Flow;
use antumbra::sensor::Query;
use antumbra::settings::Settings;
use antumbra::trace::Shape;
use serde_json::Value;

use super::judge::{Judge, Trial, size};
use super::scenes::{Built, build, receiver};
use super::table::{Case, Way, cases_of, list};

/// E of one white point by some settings.
pub fn irradiance(scene: &Scene, query: Query, settings: &Settings) -> Estimated {
    query::irradiance(scene, &[query], settings, &mut |_| Flow::Continue)
}

/// The settings of a query with `rays` samples, on one thread.
pub fn settings(estimator: EstimatorKind, rays: u32) -> Settings {
    Settings { estimator, shadow_rays: rays, threads: 1, seed: 9, ..Settings::default() }
}

/// An estimate of the first point against its truth; 16 replicates from 256 rays on.
pub fn trial(name: String, found: &Estimated, truth: f64, slack: f64) -> Trial {
    assert!(found.rays_done >= 256);
    let [estimate, error] = [found.values[0][0], found.standard_error[0][0]].map(f64::from);
    Trial { name, estimate, error, dof: 15.0, truth, slack }
}

/// Lights so near that points spread over their area nearly all miss what counts: the mean of any feasible number of
/// them is no normal variable.
const NEAR: &[&str] = &["CF04d", "CF06d", "CF06e", "CF10e", "CF11a", "CF11b"];

/// The share of evenly spread (cosine-weighted) directions that meet the brightest light of a case.
fn found(case: &Case) -> f64 {
    let radiance = |l: &Value| l["Le"].as_f64().unwrap_or(0.0);
    let sky = if case.scene["env"].is_null() { 1e-9 } else { 1.0 };
    let brightest = list(&case.scene["lights"]).iter().map(radiance).fold(sky, f64::max);
    case.value / (std::f64::consts::PI * brightest)
}

/// The share of the surfaces of a scene that shines.
fn bright_area(scene: &Scene) -> f64 {
    let shining = scene.lights().iter().map(|l| f64::from(l.power(1.0))).sum::<f64>();
    shining / (std::f64::consts::PI * f64::from(SurfaceAreas::of(scene).total()))
}

/// The ways to estimate E that can see the lights of a case.
///
/// Random numbers where something cuts the integrand: along an edge that is parallel to the strata of a replicate, the
/// same one of its points decides in all replicates, which then agree by chance (CF04a: 26 of their standard errors off).
fn ways(case: &Case, scene: &Scene) -> Vec<(&'static str, Settings)> {
    let area = LightPoints::Area;
    let lights = list(&case.scene["lights"]);
    let any = |kinds: &[&str]| lights.iter().any(|l| kinds.contains(&l["type"].as_str().unwrap()));
    let near = NEAR.contains(&case.id.as_str());
    let delta = any(&["point", "spot", "directional"]);
    let infinite = any(&["sun_disc"]) || !case.scene["env"].is_null();
    let rays = if delta { 256 } else { size(4096, 1 << 18) };
    let cut = !list(&case.scene["occluders"]).is_empty();
    let base = |kind| {
        let sampler = if cut { SamplerKind::Random } else { SamplerKind::Owen };
        Settings { sampler, ..settings(kind, rays) }
    };
    let random = |kind| Settings { sampler: SamplerKind::Random, ..settings(kind, rays) };
    let mut ways = Vec::new();
    if !(near && any(&["disk"])) {
        ways.push(("area", base(EstimatorKind::Area)));
    }
    if !near {
        ways.push(("area by 1/A", Settings { light_points: area, ..base(EstimatorKind::Area) }));
    }
    ways.push(("mis", base(EstimatorKind::Mis)));
    ways.push(("path", base(EstimatorKind::Path)));
    let cosine = Settings { directions: Directions::Cosine, light_points: area, ..base(EstimatorKind::Mis) };
    ways.push(("mis by 1/A, cosine", cosine));
    // Directions must find the brightest light about once in fifty times (and miss it as often), else they tell nothing.
    if !delta && ((0.02..0.98).contains(&found(case)) || case.value == 0.0) {
        ways.push(("hemisphere", random(EstimatorKind::Hemisphere)));
        let uniform = Settings { directions: Directions::Uniform, ..random(EstimatorKind::Hemisphere) };
        ways.push(("hemisphere, uniform", uniform));
        ways.push(("path-hemisphere", random(EstimatorKind::PathHemisphere)));
    }
    if !delta && !infinite && !near && bright_area(scene) > 0.02 {
        ways.push(("surfaces", base(EstimatorKind::Surfaces)));
    }
    ways
}

/// What may be missing from E however small its standard error.
///
/// Rounding: light sample, cosine, density and their product in f32, p and the light's numbers too. Half a disc at the
/// horizon is as uncertain as the elevation of its middle, 2⁻²⁴ of 0.0047 rad. And where directions meet a small light
/// less than thirty times in all rays, the share of E that the balance heuristic leaves to them may come or not.
fn slack(case: &Case) -> f64 {
    let rounding = if ["CF03c", "CF03d"].contains(&case.id.as_str()) { 4e-5 } else { 4e-6 };
    let found = found(case);
    let rare = if found * f64::from(size(4096, 1 << 18)) < 30.0 { found } else { 0.0 };
    (rounding + rare) * case.value
}

/// α = 10⁻³ over all cases and estimators.
#[test]
fn irradiance_equals_closed_forms() {
    let test = "irradiance_equals_closed_forms";
    let Some(cases) = cases_of(test, Way::Irradiance) else { return };
    let mut judge = Judge::default();
    for case in cases.iter().filter(|c| !c.scene.is_null()) {
        let Built { scene, query, texels } = build(&case.scene);
        for (way, settings) in ways(case, &scene) {
            let found = irradiance(&scene, query, &settings);
            let name = format!("{} {way}", case.id);
            judge.add(trial(name, &found, case.value + texels, slack(case)));
        }
    }
    let rest = cases.iter().filter(|c| c.scene.is_null()).map(|c| c.id.as_str());
    assert_eq!(rest.collect::<Vec<_>>(), ["CF34a", "CF34b", "CF43a"]);
    judge.verdict(test, 1e-3);
}

/// The many point lights of CF43.
pub fn many_lights() -> Scene {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let mut builder = SceneBuilder::new("many lights");
    for k in 0..1000u32 {
        let (r, phi) = (f64::from(k).sqrt() / 4.0, f64::from(k) * golden);
        let position = DVec3::new(r * real::cos(phi), 3.0, r * real::sin(phi)).as_vec3();
        builder.light("lamp", Point { position, intensity: Rgb::grey((k % 7 + 1) as f32) });
    }
    builder.build().unwrap()
}

/// α = 10⁻³. Every light asked: a sum without noise. One light chosen: the same mean.
#[test]
fn many_lights_sum_up() {
    let Some(cases) = cases_of("many_lights_sum_up", Way::Irradiance) else { return };
    let case = cases.iter().find(|c| c.id == "CF43a").unwrap();
    let scene = many_lights();
    let mut judge = Judge::default();
    let up = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    for choice in [LightChoice::Auto, LightChoice::All, LightChoice::Uniform, LightChoice::Power] {
        let rays = if choice == LightChoice::All { 256 } else { size(1 << 14, 1 << 18) };
        let settings = Settings { lights: choice, ..settings(EstimatorKind::Area, rays) };
        let found = irradiance(&scene, up, &settings);
        // A thousand f32 terms, each to a few roundings.
        judge.add(trial(format!("CF43a {choice:?}"), &found, case.value, 2e-6 * case.value));
    }
    judge.verdict("many_lights_sum_up", 1e-3);
}

/// Visible fractions and covered discs. α = 10⁻³.
#[test]
fn visible_fraction_equals_closed_forms() {
    let test = "visible_fraction_equals_closed_forms";
    let Some(cases) = cases_of(test, Way::Visible) else { return };
    let mut judge = Judge::default();
    for case in &cases {
        let (Built { scene, query, .. }, truth) = match case.quantity.as_str() {
            "V" => (build(&case.scene), case.value),
            _ => (eclipse(case), 1.0 - case.value),
        };
        let settings = settings(EstimatorKind::Area, size(1 << 14, 1 << 18));
        let found = query::visible_fraction(&scene, &[query], 0, &settings, &mut |_| Flow::Continue);
        // Counts of samples; borders of occluders move by 2⁻²⁴ of the numbers, seen 2⁻²⁴/0.0047 of a disc wide.
        let slack = if case.id == "CF22a" { 2.0 * 6e-8 / 0.0047 } else { 1e-6 };
        judge.add(trial(case.id.clone(), &found, truth, slack));
    }
    judge.verdict(test, 1e-3);
}

/// A sun in the zenith behind a moon at distance 5.
fn eclipse(case: &Case) -> Built {
    let angle = |k: &str| case.number(k).to_radians();
    let (sun, moon, apart) = (angle("r1_deg"), angle("r2_deg"), angle("d_deg"));
    let mut builder = SceneBuilder::new("eclipse");
    let black = builder.material(antumbra::scene::Material::diffuse(Rgb::BLACK));
    builder.light("sun", Sun::new(Vec3::Y, sun as f32, Rgb::WHITE));
    let center = DVec3::new(real::sin(apart), real::cos(apart), 0.0) * 5.0;
    let radius = (5.0 * real::sin(moon)) as f32;
    builder.shape("moon", Shape::Sphere { center: center.as_vec3().to_array(), radius }, black);
    Built { scene: builder.build().unwrap(), query: receiver([0.0; 3], [0.0, 1.0, 0.0]), texels: 0.0 }
}

/// Form factors between whole faces of a cube (CF34a, b): the mean irradiance of the floor under one bright face. Each
/// of 16 rounds draws new points, so their scatter is the error. α = 10⁻³.
#[test]
fn face_to_face_form_factors() {
    let Some(cases) = cases_of("face_to_face_form_factors", Way::Irradiance) else { return };
    let (bright, one) = (Rgb::grey(1.0 / real::PI), Vec3::ONE);
    let ceiling = antumbra::light::Rectangle::new(Vec3::Y, Vec3::X, Vec3::Z, bright);
    let wall = antumbra::light::Rectangle::new(one, Vec3::NEG_Z, Vec3::NEG_Y, bright);
    let mut judge = Judge::default();
    for (id, light) in [("CF34a", ceiling), ("CF34b", wall)] {
        let case = cases.iter().find(|c| c.id == id).unwrap();
        let mut builder = SceneBuilder::new("cube");
        builder.light("face", light);
        let scene = builder.build().unwrap();
        let mean = |seed| {
            let s = Settings { seed, ..settings(EstimatorKind::Area, 16) };
            let floor = super::closed_ao::floor(32, seed);
            let found = query::irradiance(&scene, &floor, &s, &mut |_| Flow::Continue);
            found.values.iter().map(|v| f64::from(v[0])).sum::<f64>() / found.values.len() as f64
        };
        judge.add(super::closed_ao::of_rounds(id, mean, case.value));
    }
    judge.verdict("face_to_face_form_factors", 1e-3);
}

/// Spheres: the sample's density gives the solid angle, whoever asks (E[1/p] = Ω). α = 10⁻³ over both ways.
#[test]
fn a_sphere_fills_its_solid_angle() {
    let mut builder = SceneBuilder::new("sphere");
    builder.light("sphere", Sphere::new(Vec3::new(0.0, 2.0, 0.0), 1.0, Rgb::WHITE));
    let scene = builder.build().unwrap();
    let mut judge = Judge::default();
    for how in [LightPoints::SolidAngle, LightPoints::Area] {
        judge.add(super::variance::mean_solid_angle("sphere", &scene, how, 0.841_787_214_476_932_9));
    }
    judge.verdict("a_sphere_fills_its_solid_angle", 1e-3);
}
