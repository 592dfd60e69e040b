//! Two materials in one: (1 − w) f₁ + w f₂, whatever the two are.

use std::sync::Arc;

use antumbra::estimator::EstimatorKind;
use antumbra::light::Environment;
use antumbra::math::Rgb;
use antumbra::scene::{Material, Scene};
use antumbra::settings::Settings;
use antumbra::texture::{Image, Texels, Texture};

use super::judge::{Judge, Trial};
use super::pictures::{compare, look, small, whole};
use super::rooms;

use EstimatorKind::{Area, Mis, Path};

const RED: Rgb = Rgb([0.8, 0.2, 0.1]);
const BLUE: Rgb = Rgb([0.1, 0.3, 0.9]);

/// The room with walls of what `walls` makes of it.
fn room(walls: impl Fn(&mut antumbra::scene::SceneBuilder) -> Material) -> Scene {
    let mut room = rooms::under_sky();
    let made = walls(&mut room);
    let id = room.material(made);
    for object in room.objects.iter_mut().filter(|o| o.material == 1) {
        object.material = id;
    }
    room.build().unwrap()
}

/// Diffuse walls of two albedos are diffuse walls of their mean, blended in blends too. α = 10⁻³.
#[test]
fn diffuse_blends_are_diffuse() {
    let mean = room(|_| Material::diffuse(RED.lerp(BLUE, 0.3)));
    let two = room(|room| {
        let (red, blue) = (room.material(Material::diffuse(RED)), room.material(Material::diffuse(BLUE)));
        Material::blend(red, blue, 0.3)
    });
    let three = room(|room| {
        let (red, blue) = (room.material(Material::diffuse(RED)), room.material(Material::diffuse(BLUE)));
        let half = room.material(Material::blend(red, blue, 0.5));
        Material::blend(red, half, 0.6)
    });
    let mut judge = Judge::default();
    for kind in [Area, Mis, Path] {
        let s = |seed| Settings { bounces: 2, viewing_rays: 64, seed, ..small(kind) };
        let truth = look(&mean, &s(1));
        for (name, scene, seed) in [("two", &two, 2), ("three", &three, 3)] {
            compare(&mut judge, &format!("{name}, {kind:?}"), &look(scene, &s(seed)), &truth);
        }
    }
    judge.verdict("diffuse_blends_are_diffuse", 1e-3);
}

/// A texture's red times the weight: a grey of a half everywhere is half the weight. α = 10⁻³.
#[test]
fn textures_weigh() {
    let mut judge = Judge::default();
    let floor = |weight: f32, texel: u8| {
        let mut room = rooms::under_sky();
        let (red, blue) = (room.material(Material::diffuse(RED)), room.material(Material::diffuse(BLUE)));
        let image = Image::new(1, 1, Texels::Linear8(vec![[texel, texel, texel, 255]])).unwrap();
        let blend = Some(room.texture(Texture::new(Arc::new(image))));
        let id = room.material(Material { blend, ..Material::blend(red, blue, weight) });
        room.objects[0].material = id;
        whole(&look(&room.build().unwrap(), &Settings { bounces: 1, viewing_rays: 64, ..small(Area) }), 0)
    };
    judge.agree("half a texel".into(), floor(0.8, 102), floor(0.32, 255));
    judge.agree("no texel".into(), floor(0.8, 0), floor(0.0, 255));
    judge.verdict("textures_weigh", 1e-3);
}

/// Under an even sky, white things that reflect everything cannot be seen: a blend of chalk, mirror and glass. α = 10⁻³.
#[test]
fn a_white_blend_vanishes() {
    let mut scene = antumbra::scene::SceneBuilder::new("furnace");
    let chalk = scene.material(Material::diffuse(Rgb::WHITE));
    let mirror = scene.material(Material::mirror(Rgb::WHITE));
    let glass = scene.material(Material::dielectric(1.5, None));
    let first = scene.material(Material::blend(chalk, mirror, 0.4));
    let all = scene.material(Material::blend(first, glass, 0.25));
    let (triangles, _) = rooms::ball(antumbra::math::Vec3::ZERO, 1.0);
    scene.object("ball", triangles, all);
    scene.light("sky", Environment::constant(Rgb::WHITE));
    let eye = antumbra::math::DVec3::new(0.0, 0.5, 4.0);
    scene.cameras.push(antumbra::scene::Camera::perspective(eye, antumbra::math::DVec3::ZERO, 30.0));
    let s = Settings { bounces: 300, viewing_rays: 64, ..small(Path) };
    let [estimate, error] = whole(&look(&scene.build().unwrap(), &s), 1);
    let mut judge = Judge::default();
    judge.add(Trial { name: "mean".into(), estimate, error, dof: f64::INFINITY, truth: 1.0, slack: 1e-5 });
    judge.verdict("a_white_blend_vanishes", 1e-3);
}

/// A surface with another look on its back is, seen from a side, a surface of that side's look: to the last bit.
#[test]
fn each_side_has_its_look() {
    let floor = |turned: bool, look: &dyn Fn(&mut antumbra::scene::SceneBuilder) -> Material| {
        let mut room = rooms::under_sky();
        if turned {
            room.meshes[0].triangles.indices.iter_mut().for_each(|t| t.swap(1, 2));
        }
        let made = look(&mut room);
        room.objects[0].material = room.material(made);
        whole(&self::look(&room.build().unwrap(), &Settings { bounces: 2, ..small(Mis) }), 0)
    };
    let red = |_: &mut antumbra::scene::SceneBuilder| Material::diffuse(RED);
    let blue = |_: &mut antumbra::scene::SceneBuilder| Material::diffuse(BLUE);
    let two = |room: &mut antumbra::scene::SceneBuilder| {
        let back = Some(room.material(Material::diffuse(BLUE)));
        Material { back, ..Material::diffuse(RED) }
    };
    let blend = |room: &mut antumbra::scene::SceneBuilder| {
        let part = two(room);
        let part = room.material(part);
        Material::blend(part, part, 0.5)
    };
    for look in [&two as &dyn Fn(&mut _) -> Material, &blend] {
        assert_eq!(floor(false, look), floor(false, &red));
        assert_eq!(floor(true, look), floor(true, &blue));
    }
    assert_ne!(floor(false, &red), floor(false, &blue));
}

/// A blend, or a look with a back, knows only materials that stand before it, so that none goes round.
#[test]
fn blends_do_not_go_round() {
    let back = |back| Material { back: Some(back), ..Material::diffuse(RED) };
    let blend = |first, second| Material::blend(first, second, 0.5);
    for look in [blend(0, 4), blend(4, 0), blend(0, 99), back(4), back(99)] {
        let mut room = rooms::under_sky();
        let id = room.material(look);
        room.objects[0].material = id;
        let error = room.build().err().unwrap().to_string();
        assert!(error.contains("does not stand before it"), "{error}");
    }
}
