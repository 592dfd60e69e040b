//! Light through surfaces: clear glass keeps all of it, and ground glass is the same to every estimator.

use antumbra::bsdf::{Facets, Metal};
use antumbra::estimator::EstimatorKind;
use antumbra::light::Environment;
use antumbra::math::{DVec3, Rgb, Vec3};
use antumbra::scene::{Camera, Material, SceneBuilder};
use antumbra::settings::Settings;
use antumbra::trace::Shape;

use super::judge::{Judge, size};
use super::pictures::{compare, look, small};
use super::rooms;
use super::scenes::parallelogram;

use EstimatorKind::{Area, Hemisphere, Mis, Path, PathHemisphere, Surfaces};

/// A body of glass, one within another, and a pane, under an even sky of radiance 1: whatever light does inside, it comes
/// out as it went in. Every path carries exactly 1 (10⁻⁵: some fifty roundings).
#[test]
fn clear_glass_under_an_even_sky_cannot_be_seen() {
    let mut builder = SceneBuilder::new("glass");
    let glass = builder.material(Material::dielectric(1.5, None));
    let diamond = builder.material(Material::dielectric(2.4, None));
    let air = builder.material(Material::dielectric(1.0 / 1.5, None));
    let pane = builder.material(Material::thin_dielectric(1.5, None));
    let ball = |x: f32, radius| Shape::Sphere { center: [x, 0.0, 0.0], radius };
    builder.shape("ball", ball(0.0, 1.0), glass);
    builder.shape("bubble", ball(0.2, 0.5), air);
    builder.shape("stone", ball(2.2, 0.8), diamond);
    let side = parallelogram(Vec3::new(-3.0, -1.0, 1.0), Vec3::new(1.7, 0.0, 0.3), Vec3::Y * 2.0);
    builder.object("pane", side, pane);
    builder.light("sky", Environment::constant(Rgb::WHITE));
    builder.cameras.push(Camera::perspective(DVec3::new(0.3, 0.4, 6.0), DVec3::ZERO, 50.0));
    let scene = builder.build().unwrap();
    for kind in [Path, PathHemisphere] {
        let picture =
            look(&scene, &Settings { bounces: 300, roulette: false, viewing_rays: 64, ..small(kind) });
        for (i, pixel) in picture.pixels.iter().enumerate() {
            assert!(pixel.iter().all(|c| (c - 1.0).abs() < 1e-5), "{kind:?} pixel {i}: {pixel:?}");
        }
    }
}

/// The lit room with a ball and a sheet of ground glass, rough copper on a wall, and a curtain.
pub(super) fn ground_glass() -> SceneBuilder {
    let mut room = rooms::lit();
    let glass = room.material(Material::dielectric(1.5, Some(Facets::isotropic(0.4))));
    let metal = Metal::named("Cu").unwrap();
    let copper = room.material(Material::conductor(metal, Some(Facets::isotropic(0.3))));
    room.shape("ball", Shape::Sphere { center: [0.7, 1.3, 1.0], radius: 0.6 }, glass);
    let sheet = parallelogram(Vec3::new(-1.6, 0.2, 1.3), Vec3::new(1.3, 0.0, 0.2), Vec3::new(0.0, 1.5, -0.1));
    room.object("sheet", sheet, glass);
    let plate = parallelogram(Vec3::new(0.2, 0.9, -2.9), Vec3::X * 2.0, Vec3::Y * 1.5);
    room.object("copper", plate, copper);
    let colors = [Rgb([0.2, 0.4, 0.3]), Rgb([0.5, 0.3, 0.4])];
    let cloth = room.material(Material::diffuse_transmission(colors[0], colors[1]));
    let curtain = parallelogram(Vec3::new(-1.9, 0.9, -1.4), Vec3::new(1.2, 0.0, 0.5), Vec3::Y * 1.4);
    room.object("curtain", curtain, cloth);
    room
}

/// Direct light through ground glass: lights on both sides of it are sampled, or found. α = 10⁻³.
#[test]
fn estimators_agree_through_ground_glass() {
    let scene = ground_glass().build().unwrap();
    let rays = size(256, 1 << 14);
    let direct = |kind, seed| Settings { bounces: 1, viewing_rays: rays, seed, ..small(kind) };
    let reference = look(&scene, &Settings { viewing_rays: 3 * rays, ..direct(Mis, 77) });
    let mut judge = Judge::default();
    for kind in [Area, Hemisphere, Path, Surfaces] {
        compare(&mut judge, &format!("{kind:?}"), &look(&scene, &direct(kind, 5)), &reference);
    }
    judge.verdict("estimators_agree_through_ground_glass", 1e-3);
}

/// All light, with and without light sampling, with and without roulette. α = 10⁻³.
#[test]
fn paths_agree_through_ground_glass() {
    let scene = ground_glass().build().unwrap();
    let all = |kind, seed| Settings { bounces: 6, seed, ..small(kind) };
    let reference = look(&scene, &Settings { viewing_rays: 1024, ..all(Path, 78) });
    let mut judge = Judge::default();
    let without = look(&scene, &Settings { viewing_rays: 1024, ..all(PathHemisphere, 6) });
    compare(&mut judge, "path-hemisphere", &without, &reference);
    compare(
        &mut judge,
        "no roulette",
        &look(&scene, &Settings { roulette: false, ..all(Path, 7) }),
        &reference,
    );
    judge.verdict("paths_agree_through_ground_glass", 1e-3);
}

/// A surface of one side reflects on its front and is black from behind; every direction brings ρ exactly (few roundings).
#[test]
fn one_sided_is_black_from_behind() {
    for (z, expected) in [(5.0, 0.5), (-5.0, 0.0)] {
        let mut builder = SceneBuilder::new("card");
        let card = builder.material(Material { one_sided: true, ..Material::diffuse(Rgb::grey(0.5)) });
        let square = parallelogram(Vec3::new(-1.0, -1.0, 0.0), Vec3::X * 2.0, Vec3::Y * 2.0);
        builder.object("card", square, card);
        builder.light("sky", Environment::constant(Rgb::WHITE));
        builder.cameras.push(Camera::perspective(DVec3::new(0.0, 0.0, z), DVec3::ZERO, 5.0));
        let scene = builder.build().unwrap();
        let picture = look(&scene, &Settings { viewing_rays: 4, ..small(Hemisphere) });
        assert!(picture.pixels.as_flattened().iter().all(|c| (c - expected).abs() < 1e-6), "{z}");
    }
}
