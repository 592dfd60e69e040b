//! The estimators are different ways to one number: on the same scene they agree, for every sampler and every choice.

use antumbra::estimator::{Directions, EstimatorKind, LightChoice};
use antumbra::light::{LightPoints, Point, Spot};
use antumbra::math::{DVec3, Rgb, Vec3, closed as closed_form};
use antumbra::sampler::{Pairing, SamplerKind};
use antumbra::scene::{Material, Scene, SceneBuilder};
use antumbra::sensor::Viewing;
use antumbra::settings::Settings;
use antumbra::trace::Shape;

use super::closed::{irradiance, settings, trial};
use super::judge::{Judge, size};
use super::pictures::{compare, look, small, whole};
use super::rooms;
use super::scenes::{parallelogram, receiver};

use EstimatorKind::{Area, Hemisphere, Mis, Path, PathHemisphere, Surfaces};

/// What others are compared with: every light asked, random numbers, three times the rays.
fn reference(scene: &Scene, estimator: EstimatorKind) -> antumbra::render::Picture {
    let rays = size(768, 1 << 15);
    let (sampler, lights) = (SamplerKind::Random, LightChoice::All);
    look(scene, &Settings { viewing_rays: rays, sampler, lights, seed: 77, ..small(estimator) })
}

/// Renders each way and compares it with the reference.
fn all_agree(
    test: &str,
    scene: &Scene,
    reference: &antumbra::render::Picture,
    ways: Vec<(String, Settings)>,
) {
    let mut judge = Judge::default();
    for (name, settings) in ways {
        compare(&mut judge, &name, &look(scene, &settings), reference);
    }
    judge.verdict(test, 1e-3);
}

fn named(settings: Settings) -> (String, Settings) {
    let base = Settings::default();
    let changed = settings.shown().into_iter().zip(base.shown());
    let words = changed
        .filter(|(a, b)| a != b && !["size", "threads", "seed", "viewing", "viewing_rays"].contains(&a.0));
    (words.map(|(a, _)| format!("{} {}", a.0, a.1)).collect::<Vec<_>>().join(", "), settings)
}

/// Direct light of finite lights: α = 10⁻³ over all pictures and their blocks.
#[test]
fn estimators_agree_on_finite_lights() {
    let scene = rooms::lit().build().unwrap();
    let one_bounce = |kind| Settings { bounces: 1, ..small(kind) };
    let mut ways = Vec::new();
    for kind in [Area, Hemisphere, Mis, Path, PathHemisphere, Surfaces] {
        ways.push(one_bounce(kind));
        ways.push(Settings { shadow_rays: 3, seed: 4, ..one_bounce(kind) });
    }
    for kind in [Area, Mis] {
        for lights in [LightChoice::All, LightChoice::Uniform, LightChoice::Power, LightChoice::Contribution]
        {
            ways.push(Settings { lights, seed: 5, ..one_bounce(kind) });
        }
        ways.push(Settings { light_points: LightPoints::Area, seed: 6, ..one_bounce(kind) });
    }
    for kind in [Hemisphere, Mis, Path] {
        for directions in [Directions::Cosine, Directions::Uniform] {
            ways.push(Settings { directions, seed: 7, ..one_bounce(kind) });
        }
    }
    let reference = reference(&scene, Area);
    let ways = ways.into_iter().map(named).collect();
    all_agree("estimators_agree_on_finite_lights", &scene, &reference, ways);
}

/// The same for every sampler and pairing.
#[test]
fn samplers_agree() {
    let scene = rooms::lit().build().unwrap();
    let mut ways = Vec::new();
    for kind in [Area, Mis] {
        for sampler in SamplerKind::ALL {
            let base = Settings { bounces: 1, rotate: true, sampler: *sampler, seed: 8, ..small(kind) };
            let (pairing, viewing) = (Pairing::TwoD, Viewing::Filter);
            ways.push(Settings { pairing, ..base.clone() });
            ways.push(Settings { viewing, ..base.clone() });
            ways.push(Settings { shadow_rays: 2, ..base });
        }
    }
    let reference = reference(&scene, Area);
    let filtered = look(
        &scene,
        &Settings { viewing_rays: size(768, 1 << 15), seed: 77, viewing: Viewing::Filter, ..small(Area) },
    );
    let (all, through): (Vec<_>, Vec<_>) = ways.into_iter().partition(|w| w.viewing == Viewing::Filter);
    all_agree("samplers_agree, over the filter", &scene, &filtered, all.into_iter().map(named).collect());
    all_agree("samplers_agree", &scene, &reference, through.into_iter().map(named).collect());
}

/// Under a sky, which has no surface.
#[test]
fn estimators_agree_under_a_sky() {
    let scene = rooms::under_sky().build().unwrap();
    let mut ways = Vec::new();
    for kind in [Area, Hemisphere, Mis, Path, PathHemisphere] {
        ways.push(Settings { bounces: 1, ..small(kind) });
    }
    ways.push(Settings { light_points: LightPoints::Area, ..small(Area) });
    ways.push(Settings { lights: LightChoice::Contribution, directions: Directions::Uniform, ..small(Mis) });
    let reference = reference(&scene, Area);
    all_agree("estimators_agree_under_a_sky", &scene, &reference, ways.into_iter().map(named).collect());
}

/// Long paths: with and without light sampling, with and without roulette, one or four shadow rays.
#[test]
fn long_paths_agree() {
    let scene = rooms::lit().build().unwrap();
    let far = |kind| Settings { bounces: 5, ..small(kind) };
    let ways = vec![
        far(Path),
        Settings { roulette: false, seed: 4, ..far(Path) },
        Settings { shadow_rays: 4, seed: 5, ..far(Path) },
        Settings { lights: LightChoice::Power, directions: Directions::Cosine, ..far(Path) },
        far(PathHemisphere),
        Settings { roulette: false, seed: 4, ..far(PathHemisphere) },
        Settings { shadow_rays: 4, seed: 5, ..far(PathHemisphere) },
    ];
    let base =
        Settings { viewing_rays: size(1024, 1 << 14), sampler: SamplerKind::Random, seed: 77, ..far(Path) };
    let reference = look(&scene, &base);
    all_agree("long_paths_agree", &scene, &reference, ways.into_iter().map(named).collect());
}

/// Points and spots: every estimator that sees them.
#[test]
fn estimators_agree_on_lights_without_size() {
    let mut room = rooms::unlit();
    let at = Vec3::new;
    room.light("point", Point { position: at(-0.5, 3.0, 1.0), intensity: Rgb::new(20.0, 15.0, 10.0) });
    let spot = Spot::new(at(2.0, 3.5, 1.0), at(-0.5, -1.0, -0.2), Rgb::grey(30.0), 0.2, 0.7, Some(9.0));
    room.light("spot", spot);
    let scene = room.build().unwrap();
    let reference = reference(&scene, Area);
    let ways = vec![
        Settings { bounces: 1, ..small(Mis) },
        Settings { bounces: 1, ..small(Path) },
        Settings { lights: LightChoice::Power, ..small(Area) },
        Settings { lights: LightChoice::Contribution, shadow_rays: 2, ..small(Area) },
    ];
    let ways = ways.into_iter().map(named).collect();
    all_agree("estimators_agree_on_lights_without_size", &scene, &reference, ways);
}

/// More shadow rays or directions per receiver leave less noise, in every estimator and in its directions too.
#[test]
fn more_samples_leave_less_noise() {
    let scene = rooms::lit().build().unwrap();
    for kind in [Area, Hemisphere, Mis, Surfaces, Path, PathHemisphere] {
        let noise = |shadow_rays| {
            let picture = look(&scene, &Settings { shadow_rays, bounces: 2, ..small(kind) });
            whole(&picture, 1)[1]
        };
        let (one, four) = (noise(1), noise(4));
        println!("{kind:?}: {one:.2e} with one sample, {four:.2e} with four");
        // The error of an error of 300 pixels with 15 degrees of freedom is a percent.
        let most = if kind == Path { 1.0 } else { 0.7 };
        assert!(four < most * one, "{kind:?}: {four} with four samples, {one} with one");
    }
}

/// A light that is seen only in a mirror: the irradiance of its mirror image. α = 10⁻³.
#[test]
fn light_in_a_mirror_arrives() {
    let mut builder = SceneBuilder::new("mirror");
    let mirror = builder.material(Material::mirror(Rgb::grey(0.8)));
    let square = parallelogram(Vec3::new(2.0, -20.0, -20.0), Vec3::Y * 40.0, Vec3::Z * 40.0);
    builder.object("mirror", square, mirror);
    let (corner, u, v) = (Vec3::new(1.0, 1.0, -1.0), Vec3::Y * 2.0, Vec3::Z * 2.0);
    builder.light("light", antumbra::light::Rectangle::new(corner, u, v, Rgb::WHITE));
    let scene = builder.build().unwrap();
    // x = 2 maps the light's x = 1 to 3.
    let corners = [[3.0, 1.0, -1.0], [3.0, 1.0, 1.0], [3.0, 3.0, 1.0], [3.0, 3.0, -1.0]].map(DVec3::from);
    let truth = 0.8 * closed_form::polygon(&corners, DVec3::Y);
    assert!(truth > 0.0);
    let up = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    let mut judge = Judge::default();
    for kind in [Path, PathHemisphere] {
        let base =
            Settings { bounces: 2, sampler: SamplerKind::Random, ..settings(kind, size(1 << 16, 1 << 20)) };
        judge.add(trial(format!("{kind:?}"), &irradiance(&scene, up, &base), truth, 4e-6));
    }
    // Direct light alone, or one bounce, does not reach it.
    for kind in [Area, Mis, Hemisphere, Surfaces] {
        let found = irradiance(&scene, up, &settings(kind, 256));
        assert_eq!(found.values[0], [0.0; 3], "{kind:?}");
    }
    judge.verdict("light_in_a_mirror_arrives", 1e-3);
}

/// Before a ball of polished plastic, whose coat mirrors and whose base does not, directions of any density find all light.
#[test]
fn plastic_shows_the_lights_in_any_directions() {
    let mut room = rooms::lit();
    let plastic = room.material(Material::plastic(Rgb::new(0.8, 0.3, 0.1), 1.9, None, true));
    room.shape("ball", Shape::Sphere { center: [0.2, 0.8, 1.2], radius: 0.8 }, plastic);
    let scene = room.build().unwrap();
    let reference = look(&scene, &Settings { bounces: 1, viewing_rays: 512, seed: 77, ..small(Path) });
    let mut ways = Vec::new();
    for kind in [Mis, Hemisphere, Path, PathHemisphere] {
        for directions in [Directions::Cosine, Directions::Uniform] {
            ways.push(named(Settings { bounces: 1, directions, ..small(kind) }));
        }
    }
    all_agree("plastic_shows_the_lights_in_any_directions", &scene, &reference, ways);
}

/// A camera before a mirror ball sees the lights in it: `mis`, `path` and `hemisphere` agree; `area` says it is blind.
#[test]
fn mirrors_show_the_lights() {
    let mut room = rooms::lit();
    let mirror = room.material(Material::mirror(Rgb::new(0.9, 0.8, 0.7)));
    room.shape("ball", Shape::Sphere { center: [0.2, 0.8, 1.2], radius: 0.8 }, mirror);
    let scene = room.build().unwrap();
    let reference = look(&scene, &Settings { bounces: 1, viewing_rays: 512, seed: 77, ..small(Path) });
    let ways = [Mis, Hemisphere, PathHemisphere].map(|kind| named(Settings { bounces: 1, ..small(kind) }));
    all_agree("mirrors_show_the_lights", &scene, &reference, ways.into());
    let blind = look(&scene, &Settings { viewing_rays: 1, ..small(Area) });
    assert!(blind.messages.iter().any(|m| m.text.contains("mirror")), "{:?}", blind.messages);
}
