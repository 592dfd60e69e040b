//! A corner of a room with a few things in it, under an even sky: occlusion alone.

use antumbra_math::{DVec3, Rgb};
use antumbra_trace::Shape;

use super::solids::{ball, joined, lathe, moved, quad, rounded_box, smooth, torus, turn, turn_y};
use super::{Builtin, Parameter, Values};
use crate::light::{Environment, Rectangle};
use crate::scene::{Camera, Material, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "corner",
    shows: "Three meeting walls and a few things under an even sky: occlusion alone makes the shading",
    parameters: &[Parameter {
        name: "light-size",
        default: 0.0,
        low: 0.0,
        high: 2.0,
        whole: false,
        help: "edge of a square lamp in place of the sky [m], its power the same for each; 0: the sky",
    }],
    build,
};

fn build(values: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let clay = scene.material(Material::diffuse(Rgb::new(0.60, 0.58, 0.55)).named("clay"));

    let wall = 5.0;
    let (x, y, z) = (DVec3::X * wall, DVec3::Y * wall, DVec3::Z * wall);
    let walls = [quad(DVec3::ZERO, z, x), quad(DVec3::ZERO, x, y), quad(DVec3::ZERO, y, z)];
    scene.object("walls", joined(walls), clay);

    scene.shape("ball", Shape::Sphere { center: [1.55, 0.5, 1.15], radius: 0.5 }, clay);
    let crate_ = rounded_box(DVec3::new(0.42, 0.62, 0.42), 0.035, 3);
    smooth(&mut scene, "box", moved(crate_, &turn_y(0.42, DVec3::new(0.62, 0.62, 0.68))), clay);
    let ring = torus(0.36, 0.13, 96, 40);
    smooth(
        &mut scene,
        "ring on the floor",
        moved(ring.clone(), &turn_y(0.0, DVec3::new(0.95, 0.13, 1.95))),
        clay,
    );
    let tilted = turn(DVec3::X, 1.15, DVec3::new(2.45, 0.44, 0.36));
    smooth(&mut scene, "ring at the wall", moved(ring, &tilted), clay);
    let cone = [(0.0, 0.0), (0.34, 0.0), (0.34, 0.02), (0.0, 0.95)];
    smooth(&mut scene, "cone", moved(lathe(&cone, 96), &turn_y(0.0, DVec3::new(2.3, 0.0, 1.5))), clay);
    for (at, radius) in [([1.62, 0.13, 2.02], 0.13), ([1.9, 0.09, 1.86], 0.09), ([0.3, 0.2, 1.42], 0.2)] {
        let pebble = ball(24, |d| d * radius + DVec3::from(at));
        smooth(&mut scene, "pebble", pebble, clay);
    }

    match values.get("light-size") {
        0.0 => scene.light("sky", Environment::constant(Rgb::new(0.80, 0.83, 0.86))),
        size => scene.light("lamp", lamp(size)),
    }

    let eye = DVec3::new(4.6, 2.9, 5.1);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(1.12, 0.62, 0.98), 31.0).sized(640, 480));
    scene
}

/// A square over the picture that shines into the corner.
fn lamp(size: f64) -> Rectangle {
    let center = DVec3::new(1.7, 3.7, 1.6);
    let toward = (DVec3::new(0.8, 0.3, 0.8) - center).normalize();
    let u = toward.cross(DVec3::Y).normalize() * size;
    let v = toward.cross(u);
    let radiance = Rgb::new(1.0, 0.93, 0.82) * (34.0 / (size * size)) as f32;
    Rectangle::new((center - (u + v) * 0.5).as_vec3(), u.as_vec3(), v.as_vec3(), radiance)
}
