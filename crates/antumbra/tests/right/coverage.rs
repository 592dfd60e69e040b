//! Standard errors cover: with 256 rays the 95 % intervals of Student's t hold the truth in 93–97 % of the receivers.

use antumbra::estimator::EstimatorKind;
use antumbra::light::Rectangle;
use antumbra::math::hash::{hash2, unit_f32};
use antumbra::math::{DVec3, Rgb, Vec3, closed};
use antumbra::query::{self, Estimated};
use antumbra::sampler::SamplerKind;
use antumbra::scene::{Material, Scene, SceneBuilder};
use antumbra::schedule::Flow;
use antumbra::sensor::Query;
use antumbra::settings::Settings;
use antumbra::trace::Shape;

use super::closed::settings;
use super::judge::size;
use super::scenes::{parallelogram, receiver};

/// Student's t at 97.5 % for 15 degrees of freedom.
const T: f64 = 2.131_449_545_559_323;

/// A class of receivers with the truth at each.
struct Class {
    name: &'static str,
    scene: Scene,
    queries: Vec<Query>,
    truths: Vec<f64>,
    openness: bool,
}

fn number(i: u32, k: u32) -> f64 {
    f64::from(unit_f32(hash2(hash2(71, k), i)))
}

/// Receivers in the penumbra of a black half-plane in y = 1, {x + tilt·z < 0}, under a square light in y = 2.
fn penumbra(name: &'static str, side: f64, tilt: f64, n: u32) -> Class {
    let mut builder = SceneBuilder::new(name);
    let black = builder.material(Material::diffuse(Rgb::BLACK));
    let corner = DVec3::new(-0.5 * side, 2.0, -0.5 * side);
    let (u, v) = (DVec3::X * side, DVec3::Z * side);
    builder.light("light", Rectangle::new(corner.as_vec3(), u.as_vec3(), v.as_vec3(), Rgb::WHITE));
    let inward = DVec3::new(-1.0, 0.0, -tilt).normalize();
    let along = DVec3::Y.cross(inward);
    let half = parallelogram(
        (DVec3::Y - along * 30.0).as_vec3(),
        (along * 60.0).as_vec3(),
        (inward * 30.0).as_vec3(),
    );
    builder.object("half-plane", half, black);
    let scene = builder.build().unwrap();
    let corners = [corner, corner + u, corner + u + v, corner + v];
    let mut queries = Vec::new();
    let mut truths = Vec::new();
    for i in 0.. {
        if queries.len() as u32 == n {
            break;
        }
        let p = DVec3::new((number(i, 1) * 2.0 - 1.0) * side, 0.0, (number(i, 2) - 0.5) * side);
        // The light beyond the plane through p and the edge, x + tilt·z ≥ 0 in y = 1.
        let cut = |q: &DVec3| (p + *q).x * 0.5 + tilt * (p + *q).z * 0.5;
        let seen = clip(&corners, cut);
        let share = area(&seen) / (side * side);
        if (0.02..=0.98).contains(&share) {
            let relative: Vec<DVec3> = seen.iter().map(|q| *q - p).collect();
            truths.push(closed::polygon(&relative, DVec3::Y).abs());
            queries.push(receiver(p.to_array(), [0.0, 1.0, 0.0]));
        }
    }
    Class { name, scene, queries, truths, openness: false }
}

/// The part of a polygon where `height` is not negative.
fn clip(corners: &[DVec3], height: impl Fn(&DVec3) -> f64) -> Vec<DVec3> {
    let mut out = Vec::new();
    for (i, a) in corners.iter().enumerate() {
        let b = &corners[(i + 1) % corners.len()];
        let (ha, hb) = (height(a), height(b));
        if ha >= 0.0 {
            out.push(*a);
        }
        if (ha >= 0.0) != (hb >= 0.0) {
            out.push(*a + (*b - *a) * (ha / (ha - hb)));
        }
    }
    out
}

/// Area of a flat polygon in y = 2.
fn area(corners: &[DVec3]) -> f64 {
    let twice = |i: usize| corners[i].cross(corners[(i + 1) % corners.len()]).y;
    0.5 * (0..corners.len()).map(twice).sum::<f64>().abs()
}

/// Openness beside a ball that rests on the plane: 1 − (r/√(s² + r²))³.
fn beside_a_ball(n: u32) -> Class {
    let mut builder = SceneBuilder::new("ball");
    let black = builder.material(Material::diffuse(Rgb::BLACK));
    builder.shape("ball", Shape::Sphere { center: [0.0, 1.0, 0.0], radius: 1.0 }, black);
    let distance = |i: u32| 0.15 + 3.0 * number(i, 3);
    let at = |i: u32| {
        let turn = 2.0 * std::f64::consts::PI * number(i, 4);
        let (sin, cos) = (antumbra::math::real::sin(turn), antumbra::math::real::cos(turn));
        receiver([distance(i) * cos, 0.0, distance(i) * sin], [0.0, 1.0, 0.0])
    };
    let truth = |i: u32| 1.0 - (1.0 / (distance(i) * distance(i) + 1.0).sqrt()).powi(3);
    let (queries, truths) = ((0..n).map(at).collect(), (0..n).map(truth).collect());
    Class { name: "occlusion by a ball", scene: builder.build().unwrap(), queries, truths, openness: true }
}

/// Openness below the edge of a large roof in y = 2: (1 + x/√(x² + h²))/2.
fn below_a_roof(n: u32) -> Class {
    let mut builder = SceneBuilder::new("roof");
    let black = builder.material(Material::diffuse(Rgb::BLACK));
    let roof = parallelogram(Vec3::new(-1e6, 2.0, -1e6), Vec3::X * 1e6, Vec3::Z * 2e6);
    builder.object("roof", roof, black);
    let x = |i: u32| 12.0 * number(i, 5) - 6.0;
    let queries = (0..n).map(|i| receiver([x(i), 0.0, number(i, 6)], [0.0, 1.0, 0.0])).collect();
    let truths = (0..n).map(|i| 0.5 + 0.5 * x(i) / (x(i) * x(i) + 4.0).sqrt()).collect();
    Class { name: "occlusion by a roof", scene: builder.build().unwrap(), queries, truths, openness: true }
}

impl Class {
    fn estimates(&self, settings: &Settings) -> Estimated {
        let watch = &mut |_| Flow::Continue;
        if self.openness {
            query::ambient_occlusion(&self.scene, &self.queries, settings, watch)
        } else {
            query::irradiance(&self.scene, &self.queries, settings, watch)
        }
    }

    /// The share of receivers whose interval holds the truth; and Σ (estimate − truth)² / Σ error².
    fn covered(&self, settings: &Settings) -> [f64; 2] {
        let found = self.estimates(settings);
        let n = self.truths.len();
        let (mut inside, mut off2, mut error2) = (0, 0.0, 0.0);
        for (i, truth) in self.truths.iter().enumerate() {
            let off = (f64::from(found.values[i][0]) - truth).abs();
            let error = f64::from(found.standard_error[i][0]);
            inside += u32::from(off <= T * error);
            off2 += off * off;
            error2 += error * error;
        }
        [f64::from(inside) / n as f64, off2 / error2]
    }
}

/// What is asked of a class, and what of the one case that is known to fall short: a straight edge parallel to a side of
/// the light. Each replicate of 16 Owen points has then one point in the column of the light that the edge cuts, and the
/// replicates differ by that point alone: sixteen throws of one coin, whose t-interval covers about 87 %. The error is
/// right in the mean square all the same, as everywhere, and the smallest of all samplers.
fn bounds(class: &Class, sampler: SamplerKind) -> [f64; 2] {
    match sampler {
        SamplerKind::Owen if class.name == ALONG => [0.85, 0.97],
        // Four columns, four points in the one that is cut: nearly there.
        SamplerKind::Stratified if class.name == ALONG => [0.92, 0.97],
        _ => [0.93, 0.97],
    }
}

const ALONG: &str = "penumbra, edge along the light";

/// Intervals cover, and the mean square of the errors that are told is that of the errors that are made.
#[test]
fn intervals_cover() {
    let n = size(4000, 100_000);
    let classes = [
        penumbra(ALONG, 1.0, 0.0, n),
        penumbra("penumbra, edge askew", 1.0, 0.7, n),
        penumbra("small light", 0.05, 0.3, n),
        beside_a_ball(n),
        below_a_roof(n),
    ];
    let mut bad = Vec::new();
    for class in &classes {
        for sampler in [SamplerKind::Owen, SamplerKind::Random, SamplerKind::Stratified] {
            let s = Settings { sampler, ..settings(EstimatorKind::Area, 256) };
            let [covered, ratio] = class.covered(&s);
            let told = format!("{}, {sampler:?}: {:.2} %, ratio {ratio:.3}", class.name, 100.0 * covered);
            println!("{told}");
            let [low, high] = bounds(class, sampler);
            // Squares of 4000 errors of one kind: their mean is known to 3 %, four of these.
            if !(low..=high).contains(&covered) || (ratio - 1.0).abs() > 0.12 {
                bad.push(told);
            }
        }
    }
    assert!(bad.is_empty(), "{bad:#?}");
}
