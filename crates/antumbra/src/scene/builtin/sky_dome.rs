//! A few things on a plinth under an environment, or under the picture of one that a person brings.

use antumbra_math::{DVec3, Rgb};
use antumbra_trace::{Shape, Triangles};

use super::solids::{lathe, moved, smooth, tube, turn_y, turned};
use super::{Builtin, Values, default_sky};
use crate::light::Light;
use crate::scene::{Camera, Material, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "sky-dome",
    shows: "A knot and three balls (clay, gold, mirror) under an environment that surrounds them",
    parameters: &[],
    build: |_: &Values| under(default_sky()),
};

/// The same things under another environment.
pub fn under(sky: Light) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let ground = scene.material(Material::diffuse(Rgb::new(0.42, 0.41, 0.39)).named("ground"));
    let plaster = scene.material(Material::diffuse(Rgb::new(0.70, 0.68, 0.65)).named("plaster"));
    let clay = scene.material(Material::diffuse(Rgb::new(0.62, 0.30, 0.18)).named("clay"));
    let gold =
        scene.material(Material::metallic_roughness(Rgb::new(0.95, 0.68, 0.30), 1.0, 0.32).named("gold"));
    let mirror = scene.material(Material::mirror(Rgb::grey(0.92)).named("mirror"));
    let lacquer =
        scene.material(Material::metallic_roughness(Rgb::new(0.10, 0.22, 0.33), 0.0, 0.35).named("lacquer"));

    smooth(&mut scene, "table", lathe(&TABLE, 240), ground);
    smooth(&mut scene, "plinth", plinth(), plaster);
    smooth(&mut scene, "knot", moved(knot(), &turn_y(0.5, DVec3::new(0.0, 1.28, 0.0))), lacquer);
    let balls = [(0.20, 0.42, clay), (0.37, 0.36, gold), (0.53, 0.40, mirror)];
    for (part, radius, material) in balls {
        let (c, s) = turned(part + 0.38);
        let center = [(1.75 * c) as f32, radius, (-1.75 * s) as f32];
        scene.shape("ball", Shape::Sphere { center, radius }, material);
    }
    scene.light("sky", sky);

    let eye = DVec3::new(0.9, 1.75, 7.0);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(0.0, 0.98, 0.0), 30.0).sized(640, 480));
    scene
}

/// A round plate under everything, its edge rounded.
const TABLE: [(f64, f64); 9] = [
    (0.0, -0.12),
    (2.62, -0.12),
    (2.65, -0.118),
    (2.69, -0.09),
    (2.70, -0.06),
    (2.69, -0.03),
    (2.65, -0.002),
    (2.62, 0.0),
    (0.0, 0.0),
];

/// A turned foot with a rim.
fn plinth() -> Triangles {
    let profile = [
        (0.0, 0.0),
        (1.12, 0.0),
        (1.12, 0.002),
        (1.12, 0.118),
        (1.118, 0.12),
        (1.00, 0.121),
        (0.99, 0.125),
        (0.97, 0.16),
        (0.96, 0.30),
        (0.965, 0.34),
        (0.99, 0.36),
        (1.028, 0.362),
        (1.03, 0.364),
        (1.03, 0.418),
        (1.028, 0.42),
        (0.0, 0.421),
    ];
    lathe(&profile, 160)
}

/// A trefoil: the tube whose middle line goes twice around the axis and three times around the ring.
fn knot() -> Triangles {
    let path: Vec<DVec3> = (0..=600).map(|i| knot_line(f64::from(i % 600) / 600.0)).collect();
    tube(&path, |_| 0.155, 40)
}

fn knot_line(part: f64) -> DVec3 {
    let ((c2, s2), (c3, s3)) = (turned(2.0 * part), turned(3.0 * part));
    DVec3::new((1.0 + 0.5 * c3) * c2, (1.0 + 0.5 * c3) * s2, 0.5 * s3) * 0.46
}
