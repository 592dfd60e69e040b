//! Equal balls at five heights under a disk of light: the umbra shrinks, closes, and the antumbra opens.

use antumbra_math::{DVec3, Rgb};
use antumbra_trace::Shape;

use super::solids::{quad, single};
use super::{Builtin, Parameter, Values};
use crate::light::{Disk, Rectangle};
use crate::scene::{Camera, Material, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "antumbra",
    shows: "Equal balls at five heights under a disk of light: the umbra shrinks, closes, and the antumbra opens",
    parameters: &[
        Parameter {
            name: "light-radius",
            default: 1.3,
            low: 0.001,
            high: 3.0,
            whole: false,
            help: "radius of the disk of light [m]; its power stays the same",
        },
        Parameter {
            name: "rods",
            default: 1.0,
            low: 0.0,
            high: 1.0,
            whole: true,
            help: "1: rods hold the balls; 0: nothing crosses the ring of light around them",
        },
    ],
    build,
};

/// Radius of the balls [m].
const BALL: f64 = 0.3;
const COLORS: [Rgb; 5] = [
    Rgb::new(0.72, 0.22, 0.14),
    Rgb::new(0.80, 0.48, 0.16),
    Rgb::new(0.78, 0.70, 0.42),
    Rgb::new(0.24, 0.46, 0.42),
    Rgb::new(0.15, 0.26, 0.45),
];

fn build(values: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let plaster = scene.material(Material::diffuse(Rgb::new(0.74, 0.72, 0.69)).named("plaster"));
    let steel = scene.material(Material::diffuse(Rgb::grey(0.25)).named("rod"));
    scene.object("floor", quad(DVec3::new(-30.0, 0.0, 30.0), DVec3::X * 60.0, DVec3::Z * -60.0), plaster);

    for (i, color) in COLORS.into_iter().enumerate() {
        let height = BALL + 0.62 * i as f64;
        let foot = DVec3::new(1.35 * (i as f64 - 2.0), 0.0, 0.0);
        let ball = scene.material(Material::diffuse(color));
        let center = single(foot + DVec3::Y * height);
        scene.shape("ball", Shape::Sphere { center, radius: BALL as f32 }, ball);
        if values.get("rods") > 0.0 {
            scene.shape("rod", Shape::Cylinder { p: single(foot), q: center, radius: 0.02 }, steel);
        }
    }

    let radius = values.get("light-radius") as f32;
    let center = DVec3::new(-1.4, 8.2, -4.0);
    let normal = (DVec3::new(0.3, 0.0, 1.0) - center).normalize().as_vec3();
    let warm = Rgb::new(1.0, 0.90, 0.74) * (96.0 / (radius * radius));
    scene.light("key", Disk::new(center.as_vec3(), normal, radius, warm));
    // A wide, weak second light from above keeps the umbra readable: cool, so that the two can be told apart.
    let cool = Rgb::new(0.55, 0.75, 1.0) * 0.16;
    let (corner, u, v) = (DVec3::new(-5.0, 10.0, -2.0), DVec3::X * 10.0, DVec3::Z * 8.0);
    scene.light("fill", Rectangle::new(corner.as_vec3(), u.as_vec3(), v.as_vec3(), cool));

    let eye = DVec3::new(1.1, 7.6, 10.8);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(0.72, 0.72, 0.6), 29.5).sized(800, 480));
    scene
}
