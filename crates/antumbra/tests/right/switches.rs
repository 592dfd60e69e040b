//! Switches of the scene: lights kept by name, another sky, clay; and what a stopped render is worth.

use antumbra::estimator::EstimatorKind;
use antumbra::light::{Disk, Environment, Light, Sphere};
use antumbra::math::{DVec3, Rgb, Vec3};
use antumbra::render::render;
use antumbra::scene::{Camera, Level, Material, SceneBuilder};
use antumbra::schedule::{Flow, Progress};
use antumbra::settings::Settings;
use antumbra::trace::Shape;

use super::closed::{irradiance, settings};
use super::judge::Judge;
use super::pictures::{look, plane, small, whole};
use super::rooms;
use super::scenes::{parallelogram, receiver};

use EstimatorKind::{Area, Hemisphere, Mis, Path, Surfaces};

/// Light is additive: the pictures under each light alone sum up to that under all. α = 10⁻³.
#[test]
fn lights_add_up() {
    let scene = rooms::lit().build().unwrap();
    let mut names = scene.light_names().names.clone();
    names.dedup();
    assert_eq!(names, ["ceiling", "lamp", "spot", "sail", "screen"]);
    let mut judge = Judge::default();
    for kind in [Area, Mis, Path, Surfaces, Hemisphere] {
        let of = |light: Vec<String>, seed| {
            whole(&look(&scene, &Settings { light, seed, bounces: 2, ..small(kind) }), 1)
        };
        let parts = names.iter().zip(10..).map(|(name, seed)| of(vec![name.clone()], seed));
        let sum = parts.fold([0.0, 0.0f64], |s, p| [s[0] + p[0], s[1].hypot(p[1])]);
        judge.agree(format!("{kind:?}"), sum, of(Vec::new(), 9));
    }
    judge.verdict("lights_add_up", 1e-3);
    let wrong = Settings { light: vec!["celing".into()], ..small(Area) };
    let error = render(&scene, &wrong, None, &mut |_| Flow::Continue).unwrap_err();
    assert!(error.to_string().contains("celing"), "{error}");
}

/// Another sky takes the place of the scene's own; none leaves the rest. α = 10⁻³.
#[test]
fn another_sky_takes_the_place_of_the_first() {
    let scene = rooms::under_sky().build().unwrap();
    let mut judge = Judge::default();
    let under = |sky: Option<Vec<(String, Light)>>, light: &[&str], seed| {
        let light = light.iter().map(|s| s.to_string()).collect();
        let s = Settings { seed, light, bounces: 2, ..small(Path) };
        whole(&render(&scene, &s, sky, &mut |_| Flow::Continue).unwrap(), 1)
    };
    judge.agree("without a sky".into(), under(Some(Vec::new()), &[], 1), under(None, &["lamp"], 2));
    let white = || Some(vec![("environment".into(), Environment::constant(Rgb::WHITE).into())]);
    let (both, lamp, sky) =
        (under(white(), &[], 3), under(None, &["lamp"], 4), under(white(), &["environment"], 5));
    judge.agree("under a white sky".into(), both, [lamp[0] + sky[0], lamp[1].hypot(sky[1])]);
    judge.verdict("another_sky_takes_the_place_of_the_first", 1e-3);
}

/// Emissive objects are the lights of the same shape; a cylinder cannot shine and says so.
#[test]
fn shining_shapes_are_lights() {
    let (center, normal, radius) = ([0.3, 2.0, 0.1], [0.0, -1.0, 0.1], 0.4);
    let at = Vec3::from(center);
    let shapes = [
        (Shape::Sphere { center, radius }, Light::from(Sphere::new(at, radius, Rgb::WHITE))),
        (
            Shape::Disk { center, normal, radius },
            Disk::new(at, Vec3::from(normal), radius, Rgb::WHITE).into(),
        ),
    ];
    let up = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    for (shape, light) in shapes {
        let mut builder = SceneBuilder::new("light");
        builder.lights.push((String::new(), light));
        let as_light = builder.build().unwrap();
        let mut builder = SceneBuilder::new("shape");
        let material = builder.material(Material::light(Rgb::WHITE));
        builder.shape("lamp", shape, material);
        let as_shape = builder.build().unwrap();
        for kind in [Area, Mis, Hemisphere, Surfaces] {
            let of = |scene| irradiance(scene, up, &settings(kind, 256)).values;
            assert_eq!(of(&as_light), of(&as_shape), "{kind:?} {shape:?}");
        }
    }
    let mut builder = SceneBuilder::new("tube");
    let material = builder.material(Material::light(Rgb::WHITE));
    builder.shape("tube", Shape::Cylinder { p: [0.0, 2.0, 0.0], q: [1.0, 2.0, 0.0], radius }, material);
    let scene = builder.build().unwrap();
    assert!(scene.messages.iter().any(|m| m.level == Level::Warning && m.place.contains("tube")));
}

/// Clay takes the colour of everything and leaves the light: the albedo plane is ρ, the light of the lamps as before.
#[test]
fn clay_takes_the_colour() {
    let scene = rooms::lit().build().unwrap();
    let (aov, clay) = (antumbra::film::Planes::ALL, Some(0.25));
    let s = Settings { aov, viewing_rays: 4, bounces: 1, ..small(Area) };
    let (before, after) = (look(&scene, &s), look(&scene, &Settings { clay, ..s }));
    assert!(plane(&after, "albedo").iter().all(|a| *a == 0.25 || *a == 0.0));
    assert_eq!(plane(&before, "emission"), plane(&after, "emission"));
    assert_ne!(plane(&before, "direct"), plane(&after, "direct"));
}

/// Columns run to the right, rows downwards, whatever the projection.
#[test]
fn pictures_stand_upright() {
    let mut builder = SceneBuilder::new("wall");
    let grey = builder.material(Material::diffuse(Rgb::WHITE));
    builder.object("wall", parallelogram(Vec3::new(-9.0, -9.0, 0.0), Vec3::X * 18.0, Vec3::Y * 18.0), grey);
    builder.cameras.push(Camera::perspective(DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO, 60.0));
    let scene = builder.build().unwrap();
    let aov = antumbra::film::Planes::POSITION;
    let picture = look(&scene, &Settings { aov, viewing_rays: 1, size: Some([8, 4]), ..small(Area) });
    let position = plane(&picture, "position");
    // Half the height of the view is 4 tan 30°, pixels are square, centres half a pixel in.
    let pixel = 8.0 * antumbra::math::real::tan(std::f64::consts::PI / 6.0) / 4.0;
    for y in 0..4 {
        for x in 0..8 {
            let at = &position[3 * (y * 8 + x)..];
            let truth = [(x as f64 - 3.5) * pixel, (1.5 - y as f64) * pixel];
            let off = (0..2).map(|k| (f64::from(at[k]) - truth[k]).abs()).fold(0.0, f64::max);
            // p to 2⁻²³ of 9, the eye's ray to 2⁻²⁴ a component.
            assert!(off < 4e-6, "pixel {x}, {y}: {:?}, not {truth:?}", &at[..2]);
        }
    }
}

/// A render that is stopped keeps whole rounds of passes (here of eight), the same bits for the same number of them
/// whatever the threads, and knows its error.
#[test]
fn a_stopped_render_keeps_whole_passes() {
    let scene = rooms::lit().build().unwrap();
    let mut seen = std::collections::HashMap::new();
    for threads in [1, 2, 5, 1, 2, 5] {
        let s = Settings { threads, size: Some([50, 40]), viewing_rays: 64, bounces: 2, ..small(Path) };
        // How soon the stop is heard depends on the clock.
        let mut enough = |p: Progress| if p.passes_done >= 24 { Flow::Stop } else { Flow::Continue };
        let picture = render(&scene, &s, None, &mut enough).unwrap();
        assert!([24, 32].contains(&picture.passes_done) && picture.passes == 64, "{}", picture.passes_done);
        assert!(picture.standard_error.is_some());
        let hash = seen.entry(picture.passes_done).or_insert(picture.hash);
        assert_eq!(*hash, picture.hash, "{} passes on {threads} threads", picture.passes_done);
    }
    // And asked for by their number, the same bits again.
    for (passes, hash) in seen {
        let passes = Some(passes);
        let s = Settings { passes, size: Some([50, 40]), viewing_rays: 64, bounces: 2, ..small(Path) };
        assert_eq!(look(&scene, &s).hash, hash, "{passes:?} passes");
    }
}

/// The hash of a scene changes with what is seen, textures and skies too, and with nothing else.
#[test]
fn scenes_are_told_apart_by_their_hash() {
    let of = |change: &dyn Fn(&mut SceneBuilder)| {
        let mut room = rooms::under_sky();
        change(&mut room);
        room.build().unwrap().content_hash()
    };
    let same = of(&|_| ());
    assert_eq!(same, of(&|room| room.name = "another name".into()));
    let changes: [&dyn Fn(&mut SceneBuilder); 7] = [
        &|room| room.meshes[0].triangles.vertices[0][1] += 1e-6,
        &|room| room.meshes[0].uvs[0].as_mut().unwrap()[0] = [0.0, 0.5],
        &|room| room.materials[1] = Material::diffuse(Rgb::grey(0.5)),
        &|room| room.textures[0].nearest = true,
        &|room| room.lights.truncate(1),
        &|room| room.lights[0].1 = Environment::constant(Rgb::WHITE).into(),
        &|room| room.cameras[0].eye.x += 1e-9,
    ];
    for (i, change) in changes.into_iter().enumerate() {
        assert_ne!(same, of(change), "change {i}");
    }
    let scene = rooms::lit().build().unwrap();
    let lamp = scene.only_lights(&["lamp".to_string()]).unwrap();
    assert_ne!(scene.content_hash(), lamp.content_hash());
    let screen = scene.only_lights(&["screen".to_string()]).unwrap();
    assert_ne!(lamp.content_hash(), screen.content_hash());
}
