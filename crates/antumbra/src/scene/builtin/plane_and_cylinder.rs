//! A small light between a plane and a cylinder.

use antumbra_math::{DVec3, Rgb, World};
use antumbra_trace::Shape;

use super::solids::{quad, single};
use super::{Builtin, Parameter, Values};
use crate::light::{Environment, Sphere};
use crate::scene::{Camera, Material, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "plane-and-cylinder",
    shows: "A light between a plane and a cylinder: what lies behind the light must not shadow",
    parameters: &[Parameter {
        name: "plane",
        default: -1.1,
        low: -2.0,
        high: 0.5,
        whole: false,
        help: "height of the plane [m]; the light is at 0, the cylinder above it; from 0.05 the plane hides the light",
    }],
    build,
};

/// Radius of the light [m].
const LIGHT: f32 = 0.05;

fn build(values: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let white = scene.material(Material::diffuse(Rgb::new(0.72, 0.70, 0.66)).named("white"));
    let blue = scene.material(Material::diffuse(Rgb::new(0.25, 0.42, 0.60)).named("blue"));

    let plane = values.get("plane");
    scene.object("plane", quad(DVec3::new(-2.6, plane, 2.2), DVec3::X * 5.2, DVec3::Z * -4.4), white);

    let (p, q, radius) = (DVec3::new(-1.3, 1.05, 0.0), DVec3::new(1.3, 1.05, 0.0), 0.45);
    scene.shape("cylinder", Shape::Cylinder { p: single(p), q: single(q), radius }, blue);
    for (center, out) in [(p, -DVec3::X), (q, DVec3::X)] {
        scene.shape("lid", Shape::Disk { center: single(center), normal: single(out), radius }, blue);
    }

    scene.light("light", Sphere::new(World::ZERO, LIGHT, Rgb::new(1.0, 0.92, 0.80) * 720.0));
    // So weak that it only tells things from the dark, whatever the plane hides.
    scene.light("dusk", Environment::constant(Rgb::new(0.012, 0.016, 0.024)));

    let eye = DVec3::new(2.4, 1.9, 6.9);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(0.0, -0.08, 0.0), 33.0).sized(640, 480));
    scene
}
