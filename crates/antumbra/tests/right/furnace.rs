//! Light that goes round: closed rooms, plates, and white things under an even sky.

use antumbra::estimator::EstimatorKind;
use antumbra::light::{Environment, LightPoints};
use antumbra::math::{DVec3, Rgb, Vec3};
use antumbra::scene::{Camera, Emission, Material, Scene, SceneBuilder};
use antumbra::settings::Settings;
use antumbra::trace::{Shape, Triangles};

use super::closed::{irradiance, settings};
use super::judge::{Judge, Trial};
use super::pictures::{look, small, whole};
use super::scenes::{parallelogram, receiver};
use super::table::{Case, Way, cases_of};

use EstimatorKind::{Area, Hemisphere, Mis, Path, PathHemisphere, Surfaces};

/// A diffuse surface that shines from its front with radiance 1.
fn glowing(rho: f64) -> Material {
    let emission = Some(Emission { radiance: Rgb::WHITE, both_sides: false });
    Material { emission, ..Material::diffuse(Rgb::grey(rho as f32)) }
}

/// The unit cube, its fronts inside.
pub fn cube_inside() -> Triangles {
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    let faces = [(Vec3::ZERO, z, x), (y, x, z), (Vec3::ZERO, x, y), (z, y, x), (Vec3::ZERO, y, z), (x, z, y)];
    let mut all = Triangles::default();
    for (corner, u, v) in faces {
        let first = all.vertices.len() as u32;
        let face = parallelogram(corner, u, v);
        all.vertices.extend(face.vertices);
        all.indices.extend(face.indices.iter().map(|t| t.map(|i| i + first)));
    }
    all
}

fn cube(rho: f64) -> Scene {
    let mut builder = SceneBuilder::new("furnace");
    let walls = builder.material(glowing(rho));
    builder.object("walls", cube_inside(), walls);
    let eye = DVec3::new(0.4, 0.55, 0.6);
    builder.cameras.push(Camera::perspective(eye, DVec3::new(0.9, 0.1, 0.2), 80.0));
    builder.build().unwrap()
}

/// Two plates a unit apart, a thousand wide: a millionth of the light leaves between them.
fn plates(case: &Case, downwards: bool) -> Scene {
    let [lower, upper] = ["r1", "r2"].map(|k| case.number(k));
    let mut builder = SceneBuilder::new("plates");
    let (lower, upper) =
        (builder.material(glowing(lower)), builder.material(Material::diffuse(Rgb::grey(upper as f32))));
    let (u, v) = (Vec3::X * 2000.0, Vec3::Z * 2000.0);
    builder.object("lower", parallelogram(Vec3::new(-1000.0, 0.0, -1000.0), v, u), lower);
    builder.object("upper", parallelogram(Vec3::new(-1000.0, 1.0, -1000.0), u, v), upper);
    let eye = DVec3::new(0.1, 0.5, 0.2);
    let to = eye + DVec3::new(0.3, if downwards { -1.0 } else { 1.0 }, 0.1);
    builder.cameras.push(Camera::perspective(eye, to, 30.0));
    builder.build().unwrap()
}

/// Far more bounces than light survives: 0.8³⁰⁰ < 10⁻²⁸.
const ALL: u32 = 300;

/// The picture that a case is about, and the bounces it takes.
fn picture_of(case: &Case) -> (Scene, u32) {
    let bounces = case.params["bounces"].as_u64().map_or(ALL, |n| n as u32);
    match case.id.as_str() {
        id if id.starts_with("CF32") => (cube(case.number("rho")), bounces),
        "CF33a" => (plates(case, true), ALL),
        "CF33b" => (plates(case, true), 2),
        "CF33c" => (plates(case, false), 1),
        id => panic!("{id}: no furnace"),
    }
}

fn mean_of(name: String, scene: &Scene, settings: &Settings, truth: f64, slack: f64) -> Trial {
    let [estimate, error] = whole(&look(scene, settings), 1);
    Trial { name, estimate, error, dof: f64::INFINITY, truth, slack }
}

/// α = 10⁻³ over all cases, with and without light sampling.
#[test]
fn furnaces_have_their_radiance() {
    let test = "furnaces_have_their_radiance";
    let Some(cases) = cases_of(test, Way::Furnace) else { return };
    let mut judge = Judge::default();
    for case in &cases {
        let (scene, bounces) = picture_of(case);
        for kind in [Path, PathHemisphere] {
            let s = Settings { bounces, size: Some([8, 6]), ..small(kind) };
            // A few roundings a bounce; a millionth leaves between the plates.
            judge.add(mean_of(format!("{} {kind:?}", case.id), &scene, &s, case.value, 1e-5 * case.value));
        }
    }
    judge.verdict(test, 1e-3);
}

/// Inside the furnace every point gets E = π from the walls, in every direct estimator; and what directions find is not
/// even noisy.
#[test]
fn walls_of_a_furnace_get_pi() {
    let scene = cube(0.5);
    let mut judge = Judge::default();
    for p in [[0.5, 0.0, 0.5], [0.1, 0.0, 0.97]] {
        let at = receiver(p, [0.0, 1.0, 0.0]);
        for kind in [Area, Mis, Hemisphere] {
            let found = irradiance(&scene, at, &settings(kind, 4096));
            let name = format!("{kind:?} at {p:?}");
            judge.add(super::closed::trial(name, &found, std::f64::consts::PI, 1e-5));
        }
        let found = irradiance(&scene, at, &settings(Hemisphere, 16));
        assert!((found.values[0][0] / antumbra::math::real::PI - 1.0).abs() < 1e-6);
    }
    judge.verdict("walls_of_a_furnace_get_pi", 1e-3);
}

/// Under an even sky a white ball cannot be told from it: diffuse and mirror, in every estimator that sees the sky.
#[test]
fn white_things_vanish_under_an_even_sky() {
    let mut judge = Judge::default();
    let materials = [Material::diffuse(Rgb::WHITE), Material::mirror(Rgb::WHITE)];
    for (material, name) in materials.into_iter().zip(["diffuse", "mirror"]) {
        let mut builder = SceneBuilder::new("white");
        let white = builder.material(material);
        builder.shape("ball", Shape::Sphere { center: [0.0; 3], radius: 1.0 }, white);
        builder.light("sky", Environment::constant(Rgb::WHITE));
        builder.cameras.push(Camera::perspective(DVec3::new(0.0, 1.0, 3.0), DVec3::ZERO, 35.0));
        let scene = builder.build().unwrap();
        for kind in [Area, Hemisphere, Mis, Path, PathHemisphere] {
            if name == "mirror" && kind == Area {
                continue;
            }
            for light_points in [LightPoints::SolidAngle, LightPoints::Area] {
                let s = Settings { light_points, viewing_rays: 256, size: Some([8, 6]), ..small(kind) };
                judge.add(mean_of(format!("{name} {kind:?} {light_points:?}"), &scene, &s, 1.0, 4e-6));
            }
        }
    }
    judge.verdict("white_things_vanish_under_an_even_sky", 1e-3);
}

/// A lit room has no more light than its lights give: E at a wall from a closed, dark room is 0.
#[test]
fn nothing_shines_in_a_dark_room() {
    let mut builder = SceneBuilder::new("dark");
    let walls = builder.material(Material::diffuse(Rgb::WHITE));
    builder.object("walls", cube_inside(), walls);
    builder.light("sky", Environment::constant(Rgb::WHITE));
    let scene = builder.build().unwrap();
    let at = receiver([0.5, 0.0, 0.5], [0.0, 1.0, 0.0]);
    for kind in [Area, Mis, Hemisphere, Surfaces, Path, PathHemisphere] {
        assert_eq!(irradiance(&scene, at, &settings(kind, 1024)).values[0], [0.0; 3], "{kind:?}");
    }
}
