//! Closed forms of our own (solid angles, power), and shadow borders found by halving.

use antumbra::estimator::EstimatorKind;
use antumbra::light::{Disk, LightPoints, Rectangle, Spot};
use antumbra::math::{DVec3, Rgb, Vec3, solid_angle};
use antumbra::scene::{Material, Scene, SceneBuilder};
use antumbra::sensor::Query;
use antumbra::trace::{Bits, NO_PRIM, SegmentBuffer, Visibility};
use serde_json::Value;

use super::closed::{irradiance, settings};
use super::judge::Judge;
use super::scenes::{build, parallelogram, receiver};
use super::table::{Case, Way, cases_of, number, numbers};

/// Points around the rim of a light.
const RIM: u32 = 1024;

/// Which part of the light's silhouette is blocked at a point that looks up.
fn blocked_rim(scene: &Scene, query: Query) -> f64 {
    let at = query.receiver(1.0);
    let mut segments = SegmentBuffer::default();
    for i in 0..RIM {
        let rim = scene.lights()[0].outline(&at, i as f32 / RIM as f32).unwrap();
        let antumbra::light::End::Point(end) = rim.end else { panic!("a rim at infinity") };
        segments.push_segment(at.start, end.to_array(), NO_PRIM, NO_PRIM, 0);
    }
    let mut blocked = Bits::default();
    scene.world().occluded(segments.as_segments(), &mut blocked);
    blocked.count() as f64 / f64::from(RIM)
}

/// The number in [low, high] up to which `holds`; it must not hold at `high`.
fn border(mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    assert!(holds(low) && !holds(high), "no border between {low} and {high}");
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

fn looking_up(x: f64, y: f64) -> Query {
    receiver([x, y, 0.0], [0.0, 1.0, 0.0])
}

/// Umbra, antumbra and penumbra, and the shadows of point lights.
///
/// 1024 points of a rim of radius R miss at most R (π/1024)²/2 = 5·10⁻⁶ R of it; p and the lights are f32 numbers.
#[test]
fn shadow_borders_lie_where_similar_triangles_say() {
    let test = "shadow_borders_lie_where_similar_triangles_say";
    let Some(cases) = cases_of(test, Way::Lengths) else { return };
    for case in &cases {
        let found = length(case);
        println!("{}: {found:.7}, {:.7}", case.id, case.value);
        assert!((found - case.value).abs() < 1e-5, "{}: {found}, not {}", case.id, case.value);
    }
}

fn length(case: &Case) -> f64 {
    if case.id == "CF18f" {
        let edge = straight_edge(case);
        let lit = |x: f64| blocked_rim(&edge, looking_up(x, 0.0)) == 0.0;
        let dark = |x: f64| blocked_rim(&edge, looking_up(x, 0.0)) == 1.0;
        return border(-1.0, 1.0, |x| !lit(x)) - border(-1.0, 1.0, dark);
    }
    let scene = build(&case.scene).scene;
    let rim = |x: f64, y: f64| blocked_rim(&scene, looking_up(x, y));
    let lit =
        |x: f64| irradiance(&scene, looking_up(x, 0.0), &settings(EstimatorKind::Area, 1)).values[0][0] > 0.0;
    match case.id.as_str() {
        // Below the occluder in y = 1 by the length of its umbra.
        "CF18a" => border(0.1, 1.0, |below| rim(0.0, 1.0 - below) == 1.0),
        "CF18b" => border(0.0, 0.5, |x| rim(x, 0.0) == 0.0),
        "CF18c" => border(0.5, 2.0, |x| rim(x, 0.0) > 0.0),
        "CF18d" => border(0.0, 1.0, |x| rim(x, 0.0) == 1.0),
        "CF18e" => border(1.0, 2.0, |x| rim(x, 0.0) > 0.0),
        "CF24a" => border(0.0, 1.0, |x| !lit(x)),
        "CF24d" => border(-2.0, 2.0, |x| !lit(x)),
        id => panic!("{id}: nothing finds this length"),
    }
}

/// A light in the table's height over a black half-plane x < 0.
fn straight_edge(case: &Case) -> Scene {
    let [width, light, edge] = ["light_width", "y_light", "y_edge"].map(|k| case.number(k) as f32);
    let mut builder = SceneBuilder::new("edge");
    let black = builder.material(Material::diffuse(Rgb::BLACK));
    let corner = Vec3::new(-0.5 * width, light, -0.5);
    builder.light("light", Rectangle::new(corner, Vec3::X * width, Vec3::Z, Rgb::WHITE));
    let half = parallelogram(Vec3::new(-9.0, edge, -9.0), Vec3::X * 9.0, Vec3::Z * 18.0);
    builder.object("half-plane", half, black);
    builder.build().unwrap()
}

/// Solid angles (f64, to 10⁻¹² but for two) and the power of a spot (f32). Disks by the mean of 1/p(ω), α = 10⁻³.
#[test]
fn formulas_equal_closed_forms() {
    let Some(cases) = cases_of("formulas_equal_closed_forms", Way::Formula) else { return };
    let mut judge = Judge::default();
    for case in &cases {
        let found = match case.id.get(..4) {
            Some("CF40") => rectangle(&case.params),
            Some("CF41") => triangle(&case.params),
            Some("CF42") if case.params["d"].is_number() => ball(case),
            Some("CF42") => {
                let [radius, h, a] = ["R", "h", "a"].map(|k| case.number(k) as f32);
                let mut builder = SceneBuilder::new("disk");
                let disk = Disk::new(Vec3::new(a, h, 0.0), Vec3::NEG_Y, radius, Rgb::WHITE);
                builder.light("disk", disk);
                let scene = builder.build().unwrap();
                judge.add(super::variance::mean_solid_angle(&case.id, &scene, LightPoints::Area, case.value));
                continue;
            }
            Some("CF02") => {
                let spot = spot(&case.params);
                assert!((f64::from(spot) / case.value - 1.0).abs() < 1e-6, "{}: {spot}", case.id);
                continue;
            }
            _ => panic!("{}: no formula", case.id),
        };
        let off = (found / case.value - 1.0).abs();
        // A reach of 10⁶, or of 10³ from a sliver of 10⁻⁶: V or D of tan(Ω/2) is what little is left of large terms.
        let tolerance = if ["CF40c", "CF40f"].contains(&case.id.as_str()) { 1e-10 } else { 1e-12 };
        assert!(off < tolerance, "{}: {found}, not {}: {off:e}", case.id, case.value);
    }
    judge.verdict("formulas_equal_closed_forms", 1e-3);
}

fn rectangle(params: &Value) -> f64 {
    let ([x0, x1], [z0, z1]) = (numbers(&params["x"]), numbers(&params["z"]));
    let corner = DVec3::new(x0, number(&params["y"]), z0);
    solid_angle::parallelogram(corner, DVec3::X * (x1 - x0), DVec3::Z * (z1 - z0)).abs()
}

fn triangle(params: &Value) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|i| DVec3::from(numbers::<3>(&params["v"][i])));
    solid_angle::triangle(a, b, c).abs()
}

fn ball(case: &Case) -> f64 {
    let d = case.number("d");
    solid_angle::cone(solid_angle::ball_versin(case.number("r"), d * d).unwrap())
}

fn spot(params: &Value) -> f32 {
    let at = |k: &str| super::scenes::vec3(&params[k]);
    let length = |k: &str| number(&params[k]) as f32;
    let intensity = Rgb::grey(length("I"));
    let spot = Spot::new(at("position"), at("direction"), intensity, length("inner"), length("outer"), None);
    antumbra::light::Light::from(spot).power(1.0)
}
