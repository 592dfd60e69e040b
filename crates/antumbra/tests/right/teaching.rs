//! Teaching switches are wrong on purpose, and visibly so.

use antumbra::estimator::{EstimatorKind, Mistake};
use antumbra::light::{LightPoints, Point, Rectangle};
use antumbra::math::{DVec3, Rgb, Vec3, closed};
use antumbra::scene::{Camera, Material, Scene, SceneBuilder, Start};
use antumbra::settings::Settings;

use super::closed::{irradiance, settings, trial};
use super::judge::{Judge, size};
use super::pictures::{look, small, whole};
use super::scenes::{parallelogram, receiver};

use EstimatorKind::{Area, Hemisphere, Mis, Path, Surfaces};

/// A square light to the side in y = 1.5, with a lid half over it if `covered`, and a roof behind it if `roofed`.
fn scene(covered: bool, roofed: bool) -> Scene {
    let mut builder = SceneBuilder::new("teaching");
    let black = builder.material(Material::diffuse(Rgb::BLACK));
    builder.light("light", Rectangle::new(Vec3::new(0.2, 1.5, -0.5), Vec3::X, Vec3::Z, Rgb::WHITE));
    if covered {
        let lid = parallelogram(Vec3::new(0.35, 0.75, -4.0), Vec3::X * 5.0, Vec3::Z * 8.0);
        builder.object("lid", lid, black);
    }
    if roofed {
        let roof = parallelogram(Vec3::new(-5.0, 2.0, -5.0), Vec3::X * 10.0, Vec3::Z * 10.0);
        builder.object("roof", roof, black);
    }
    builder.build().unwrap()
}

/// E of the light at the origin with nothing in the way.
fn open() -> f64 {
    let corners = [[0.2, 1.5, -0.5], [1.2, 1.5, -0.5], [1.2, 1.5, 0.5], [0.2, 1.5, 0.5]].map(DVec3::from);
    closed::polygon(&corners, DVec3::Y).abs()
}

fn up() -> antumbra::sensor::Query {
    receiver([0.0; 3], [0.0, 1.0, 0.0])
}

/// Each mistake lies more than eight standard errors beside the truth.
#[test]
fn mistakes_are_seen() {
    let scene = scene(false, false);
    let rays = size(4096, 1 << 16);
    let area = LightPoints::Area;
    let by = |mistake, light_points, kind| Settings { mistake, light_points, ..settings(kind, rays) };
    let solid = LightPoints::SolidAngle;
    let ways = [
        by(Mistake::NoCosLight, area, Area),
        by(Mistake::NoCosLight, solid, Area),
        by(Mistake::NoDistance, area, Area),
        by(Mistake::NoDistance, solid, Area),
        by(Mistake::WrongMeasure, area, Area),
        by(Mistake::WrongMeasure, solid, Area),
        by(Mistake::CountedTwice, solid, Mis),
        by(Mistake::CountedTwice, solid, Path),
    ];
    for wrong in ways {
        let name = format!("{:?} in {:?} by {:?}", wrong.mistake, wrong.estimator, wrong.light_points);
        let seen = trial(name, &irradiance(&scene, up(), &wrong), open(), 0.0);
        println!(
            "{}: {:.4}, not {:.4}: {:.0} standard errors",
            seen.name,
            seen.estimate,
            seen.truth,
            seen.score()
        );
        assert!(seen.score() > 8.0, "{}", seen.name);
        let right = Settings { mistake: Mistake::None, ..wrong };
        let seen = trial(String::new(), &irradiance(&scene, up(), &right), open(), 4e-6);
        assert!(seen.score() < 6.0, "the right way is off by {}", seen.score());
    }
}

/// The densities of the lecture have the right mean, whatever they prefer; one with a hole lacks exactly the light of
/// the hole, unless directions find it too. α = 10⁻³.
#[test]
fn densities_are_unbiased_but_for_the_hole() {
    let scene = scene(false, false);
    // A quarter of the light: x from 0.7 to 0.95.
    let strip = [[0.7, 1.5, -0.5], [0.95, 1.5, -0.5], [0.95, 1.5, 0.5], [0.7, 1.5, 0.5]].map(DVec3::from);
    let lost = closed::polygon(&strip, DVec3::Y).abs();
    assert!(lost > 0.2 * open());
    let mut judge = Judge::default();
    use LightPoints::{Hole, Nearest, Skewed};
    for (how, kind, truth) in [
        (Skewed, Area, open()),
        (Nearest, Area, open()),
        (Hole, Area, open() - lost),
        (Skewed, Mis, open()),
        (Nearest, Mis, open()),
        (Hole, Mis, open()),
        (Hole, Path, open()),
    ] {
        let s = Settings { light_points: how, bounces: 1, ..settings(kind, size(1 << 14, 1 << 18)) };
        let found = irradiance(&scene, up(), &s);
        judge.add(trial(format!("{how:?} in {kind:?}"), &found, truth, 1e-5));
        assert_eq!(
            s.doubts().iter().any(|m| m.text.contains("hole")),
            how == Hole && kind == Area,
            "{how:?} {kind:?}"
        );
    }
    judge.verdict("densities_are_unbiased_but_for_the_hole", 1e-3);
}

/// The noise of one shadow ray: near a light, points about the nearest one beat even ones, and skewed ones lose.
#[test]
fn densities_that_follow_the_light_have_less_noise() {
    let mut builder = SceneBuilder::new("near");
    let light = Rectangle::new(Vec3::new(-1.0, 0.2, -1.0), Vec3::X * 2.0, Vec3::Z * 2.0, Rgb::WHITE);
    builder.light("light", light);
    let scene = builder.build().unwrap();
    let at = receiver([-0.4, 0.0, -0.3], [0.0, 1.0, 0.0]);
    let noise = |light_points| {
        let sampler = antumbra::sampler::SamplerKind::Random;
        let s = Settings { light_points, sampler, ..settings(Area, size(1 << 14, 1 << 18)) };
        f64::from(irradiance(&scene, at, &s).standard_error[0][0])
    };
    let [nearest, even, skewed] = [LightPoints::Nearest, LightPoints::Area, LightPoints::Skewed].map(noise);
    println!("standard errors: nearest {nearest:.2e}, even {even:.2e}, skewed {skewed:.2e}");
    // 16 replicates know a standard error to a fifth.
    assert!(nearest < 0.5 * even && even < skewed, "{nearest} {even} {skewed}");
}

/// Light counted twice is twice the light; N samples added up are N times the light.
#[test]
fn counting_mistakes_count() {
    let mut judge = Judge::default();
    let s = Settings { mistake: Mistake::CountedTwice, ..settings(Mis, size(1 << 14, 1 << 18)) };
    judge.add(trial("twice".into(), &irradiance(&scene(false, false), up(), &s), 2.0 * open(), 1e-5));
    let scene = floor_below(Vec3::Y);
    for kind in [Area, Hemisphere, Mis] {
        let of = |mistake| look(&scene, &Settings { mistake, shadow_rays: 3, bounces: 1, ..small(kind) });
        let ([right, e], [wrong, f]) = (whole(&of(Mistake::None), 1), whole(&of(Mistake::NoCount), 1));
        judge.agree(format!("NoCount in {kind:?}"), [wrong, f], [3.0 * right, 3.0 * e]);
    }
    judge.verdict("counting_mistakes_count", 1e-3);
}

/// Without shadows everything gets the unoccluded light, in every estimator that draws lights or directions. α = 10⁻³.
#[test]
fn shadows_off_is_the_unoccluded_closed_form() {
    let covered = scene(true, true);
    let mut judge = Judge::default();
    for kind in [Area, Mis, Path, Hemisphere, Surfaces] {
        let rays = size(1 << 14, 1 << 18);
        let off = Settings { shadows: false, bounces: 1, ..settings(kind, rays) };
        judge.add(trial(format!("{kind:?}"), &irradiance(&covered, up(), &off), open(), 1e-5));
        let on = Settings { bounces: 1, ..settings(kind, rays) };
        let shaded = f64::from(irradiance(&covered, up(), &on).values[0][0]);
        assert!(shaded < 0.7 * open(), "{kind:?}: {shaded} under the lid, {} in the open", open());
    }
    judge.verdict("shadows_off_is_the_unoccluded_closed_form", 1e-3);
}

/// Without the distance test what lies behind the light shadows it; with it, nothing changes.
#[test]
fn without_the_distance_test_things_behind_the_light_shadow_it() {
    let roofed = scene(false, true);
    let wrong = Settings { distance_test: false, ..settings(Area, 1024) };
    assert_eq!(irradiance(&roofed, up(), &wrong).values[0][0], 0.0);
    let seen = trial("right".into(), &irradiance(&roofed, up(), &settings(Area, 4096)), open(), 4e-6);
    assert!(seen.score() < 6.0, "{seen:?}");
    let mut builder = SceneBuilder::new("point");
    let black = builder.material(Material::diffuse(Rgb::BLACK));
    builder.light("point", Point { position: Vec3::Y, intensity: Rgb::WHITE });
    builder.object("roof", parallelogram(Vec3::new(-5.0, 2.0, -5.0), Vec3::X * 10.0, Vec3::Z * 10.0), black);
    let scene = builder.build().unwrap();
    let of = |distance_test| {
        irradiance(&scene, up(), &Settings { distance_test, ..settings(Area, 1) }).values[0][0]
    };
    assert_eq!([of(true), of(false)], [1.0, 0.0]);
}

/// A white floor (with this normal) under a light, seen from above.
fn floor_below(normal: Vec3) -> Scene {
    let mut builder = SceneBuilder::new("floor");
    let white = builder.material(Material::diffuse(Rgb::WHITE));
    let (s, t) = normal.normalize().any_orthonormal_pair();
    let floor = parallelogram(-(s + t) * 3.0, s * 6.0, t * 6.0);
    builder.object("floor", floor, white);
    builder.light("light", Rectangle::new(Vec3::new(-0.5, 2.5, -0.5), Vec3::X, Vec3::Z, Rgb::grey(4.0)));
    builder.cameras.push(Camera::perspective(DVec3::new(0.5, 1.8, 2.0), DVec3::ZERO, 40.0));
    builder.build().unwrap()
}

/// Segments that start at the rounded point meet their own surface; a small epsilon or the safe start do not; a large
/// epsilon changes the light.
#[test]
fn self_intersection_shows() {
    let scene = floor_below(Vec3::new(0.21, 0.93, -0.37));
    let of = |self_intersection| {
        whole(&look(&scene, &Settings { self_intersection, viewing_rays: 64, ..small(Area) }), 1)
    };
    let [safe, none, small, large] =
        [Start::Safe, Start::None, Start::Epsilon(1e-4), Start::Epsilon(0.5)].map(of);
    println!("safe {safe:?}, none {none:?}, epsilon 1e-4 {small:?}, epsilon 0.5 {large:?}");
    // About half of all rounded points lie below the plane.
    assert!((0.2..0.8).contains(&(none[0] / safe[0])), "{none:?} without a lift, {safe:?} with it");
    let mut judge = Judge::default();
    judge.agree("epsilon 1e-4".into(), small, safe);
    judge.verdict("self_intersection_shows", 1e-3);
    assert!((large[0] / safe[0] - 1.0).abs() < 0.5);
}
