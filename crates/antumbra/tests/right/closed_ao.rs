//! Ambient occlusion against closed forms, radius and falloff too.

use antumbra::estimator::{EstimatorKind, Falloff};
use antumbra::math::hash::{hash2, unit_f32};
use antumbra::math::{Rgb, Vec3};
use antumbra::query;
use antumbra::scene::{Material, Scene, SceneBuilder};
use antumbra::schedule::Flow;
use antumbra::sensor::Query;
use antumbra::settings::Settings;
use serde_json::json;

use super::closed::{settings, trial};
use super::judge::{Judge, Trial, size};
use super::scenes::{Built, build, parallelogram, receiver};
use super::table::{Case, Way, cases_of};

/// Squares that stand for infinite planes at the corner where the receiver lies 0.01 along its normal: what lies beyond
/// them is seen within 10⁻⁸ rad.
const FAR: f64 = 1e6;

/// The scene of a case; those without one in the table are built as their text says.
fn scene_of(case: &Case) -> Built {
    let wall = |u: [f64; 3], v: [f64; 3]| json!({"type": "rect", "corner": [0, 0, 0], "u": u, "v": v});
    let (x, y, z) = ([FAR, 0.0, 0.0], [0.0, FAR, 0.0], [0.0, 0.0, FAR]);
    let both_ways =
        |along: [f64; 3]| json!({"type": "rect", "corner": [0, 0, -FAR], "u": [0, 0, 2.0 * FAR], "v": along});
    let built = |n: [f64; 3], walls: serde_json::Value| {
        let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        let p = n.map(|c| 0.01 * c / length);
        build(&json!({"receiver": {"p": p, "n": n}, "lights": [], "occluders": walls}))
    };
    match case.id.as_str() {
        "CF26a" => built([1.0, 1.0, 0.0], json!([both_ways(x), both_ways(y)])),
        "CF26b" => built([1.0, 1.0, 1.0], json!([wall(x, y), wall(y, z), wall(z, x)])),
        // The limit from inside, a millionth off the walls.
        "CF44b" => Built { query: receiver([1e-6, 0.0, 1e-6], [0.0, 1.0, 0.0]), ..open_cube() },
        "CF44c" => Built { query: receiver([0.5, 0.0, 1e-6], [0.0, 1.0, 0.0]), ..open_cube() },
        _ => {
            assert!(!case.scene.is_null(), "{}: no scene", case.id);
            build(&case.scene)
        }
    }
}

/// The four walls of the unit cube of CF44.
fn open_cube() -> Built {
    let mut builder = SceneBuilder::new("open cube");
    let black = builder.material(Material::diffuse(Rgb::BLACK));
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    for (corner, along) in [(Vec3::ZERO, z), (x, z), (Vec3::ZERO, x), (z, x)] {
        builder.object("wall", parallelogram(corner, y, along), black);
    }
    let query = receiver([0.5, 0.0, 0.5], [0.0, 1.0, 0.0]);
    Built { scene: builder.build().unwrap(), query, texels: 0.0 }
}

fn openness(scene: &Scene, queries: &[Query], settings: &Settings) -> query::Estimated {
    query::ambient_occlusion(scene, queries, settings, &mut |_| Flow::Continue)
}

fn limits(case: &Case) -> (f32, Falloff) {
    let radius = case.scene["ao_max_dist"].as_f64().map_or(f32::INFINITY, |r| r as f32);
    let falloff = match case.scene["ao_falloff"].as_str() {
        Some("linear") => Falloff::Linear,
        Some("quadratic") => Falloff::Quadratic,
        Some("none") | None => Falloff::None,
        Some(other) => panic!("{}: falloff {other}", case.id),
    };
    (radius, falloff)
}

/// Cases about the whole floor of the cube.
const OF_THE_FLOOR: [&str; 2] = ["CF44d", "CF44e"];

/// α = 10⁻³ over all cases.
#[test]
fn ambient_occlusion_equals_closed_forms() {
    let test = "ambient_occlusion_equals_closed_forms";
    let Some(cases) = cases_of(test, Way::Openness) else { return };
    let mut judge = Judge::default();
    for case in cases.iter().filter(|c| !OF_THE_FLOOR.contains(&c.id.as_str())) {
        let Built { scene, query, .. } = scene_of(case);
        let (radius, falloff) = limits(case);
        let base = settings(EstimatorKind::AmbientOcclusion, size(1 << 14, 1 << 20));
        let settings = Settings { radius, falloff, ..base };
        // Finite walls stand for infinite ones: 10⁻⁶ of the directions see past them.
        let slack = 2e-6;
        judge.add(trial(case.id.clone(), &openness(&scene, &[query], &settings), case.value, slack));
    }
    judge.verdict(test, 1e-3);
}

/// Mean over the floor, and of the bilinear interpolant between 3 × 3 vertices. α = 10⁻³.
#[test]
fn ambient_occlusion_of_a_floor() {
    let Some(cases) = cases_of("ambient_occlusion_of_a_floor", Way::Openness) else { return };
    let truth = |id: &str| cases.iter().find(|c| c.id == id).unwrap().value;
    let Built { scene, .. } = open_cube();
    let values = |queries: &[Query], rays, seed| {
        let s = Settings { seed, ..settings(EstimatorKind::AmbientOcclusion, rays) };
        openness(&scene, queries, &s).values.iter().map(|v| f64::from(v[0])).collect::<Vec<_>>()
    };
    let mean = |seed| {
        let all = values(&floor(32, seed), 16, seed);
        all.iter().sum::<f64>() / all.len() as f64
    };
    let steps = [1e-6, 0.5, 1.0 - 1e-6];
    let vertices: Vec<Query> =
        (0..9).map(|i| receiver([steps[i % 3], 0.0, steps[i / 3]], [0.0, 1.0, 0.0])).collect();
    // The integral of a tent over the square: its products of 1/4, 1/2, 1/4.
    let weight = |i: usize| [0.25, 0.5, 0.25][i % 3] * [0.25, 0.5, 0.25][i / 3];
    let interpolated = |seed| {
        let all = values(&vertices, size(1024, 1 << 14), seed);
        all.iter().enumerate().map(|(i, v)| weight(i) * v).sum::<f64>()
    };
    let mut judge = Judge::default();
    judge.add(of_rounds("CF44d", mean, truth("CF44d")));
    judge.add(of_rounds("CF44e", interpolated, truth("CF44e")));
    judge.verdict("ambient_occlusion_of_a_floor", 1e-3);
}

/// One random point in each of `side`² cells of the floor of the unit cube.
pub fn floor(side: u32, seed: u32) -> Vec<Query> {
    let at = |i: u32, k: u32| f64::from(unit_f32(hash2(hash2(seed, k), i)));
    let point = |i: u32| {
        let (x, z) = (f64::from(i % side) + at(i, 1), f64::from(i / side) + at(i, 2));
        receiver([x / f64::from(side), 0.0, z / f64::from(side)], [0.0, 1.0, 0.0])
    };
    (0..side * side).map(point).collect()
}

/// The mean of 16 independent rounds, with their scatter as its error.
pub fn of_rounds(name: &str, round: impl Fn(u32) -> f64, truth: f64) -> Trial {
    let values: Vec<f64> = (1..=16).map(round).collect();
    let mean = values.iter().sum::<f64>() / 16.0;
    let square = values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>();
    let error = (square / (16.0 * 15.0)).sqrt();
    Trial { name: name.into(), estimate: mean, error, dof: 15.0, truth, slack: 1e-6 }
}
