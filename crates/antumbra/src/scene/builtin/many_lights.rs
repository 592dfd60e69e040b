//! A square at night under hundreds of small lamps.

use antumbra_math::{DVec3, Rgb};
use antumbra_trace::Shape;

use super::noise::Dice;
use super::solids::{cuboid, joined, lathe, moved, quad, rounded_box, smooth, turn_y, turned};
use super::{Builtin, Parameter, Values};
use crate::light::Sphere;
use crate::scene::{Camera, Material, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "many-lights",
    shows: "A square at night under hundreds of small lamps: which of them is worth a shadow ray?",
    parameters: &[Parameter {
        name: "lights",
        default: 400.0,
        low: 1.0,
        high: 100_000.0,
        whole: true,
        help: "number of lamps; their power together stays the same",
    }],
    build,
};

/// Paper of the lamps.
const PAPER: [Rgb; 5] = [
    Rgb::new(1.0, 0.40, 0.10),
    Rgb::new(1.0, 0.58, 0.20),
    Rgb::new(1.0, 0.24, 0.09),
    Rgb::new(0.95, 0.25, 0.40),
    Rgb::new(0.16, 0.45, 0.95),
];
/// Columns stand on a circle of this radius [m].
const CIRCLE: f64 = 3.6;

fn build(values: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let paving = scene.material(Material::diffuse(Rgb::new(0.50, 0.49, 0.48)).named("paving"));
    let marble = scene.material(Material::diffuse(Rgb::new(0.72, 0.70, 0.67)).named("marble"));

    scene.object("square", quad(DVec3::new(-20.0, 0.0, 20.0), DVec3::X * 40.0, DVec3::Z * -40.0), paving);
    for i in 0..9 {
        let (c, s) = turned(0.03 + f64::from(i) / 9.0);
        smooth(
            &mut scene,
            "column",
            moved(column(), &turn_y(0.0, DVec3::new(CIRCLE * c, 0.0, CIRCLE * s))),
            marble,
        );
    }
    let steps = (0..3).map(|i| {
        let (half, y) = (1.35 - 0.3 * f64::from(i), 0.16 * f64::from(i));
        cuboid(DVec3::new(-half, y, -half), DVec3::new(half, y + 0.16, half))
    });
    scene.object("steps", moved(joined(steps), &turn_y(0.5, DVec3::ZERO)), paving);
    scene.shape("globe", Shape::Sphere { center: [0.0, 1.13, 0.0], radius: 0.65 }, marble);
    lamps(&mut scene, values.get("lights") as u32);

    let eye = DVec3::new(1.6, 3.6, 9.6);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(0.0, 1.1, 0.0), 37.0).sized(640, 480));
    scene
}

/// A shaft that swells a little, on a square foot, under a square plate.
fn column() -> antumbra_trace::Triangles {
    let foot = rounded_box(DVec3::new(0.30, 0.08, 0.30), 0.02, 2);
    let plate = rounded_box(DVec3::new(0.30, 0.07, 0.30), 0.02, 2);
    let swell = |i: u32| {
        let t = f64::from(i) / 16.0;
        (0.21 - 0.05 * t * t, 0.15 + 2.4 * t)
    };
    let mut profile = vec![(0.0, 0.15)];
    profile.extend((0..=16).map(swell));
    profile.push((0.0, 2.55));
    let at = |y: f64| turn_y(0.0, DVec3::Y * y);
    joined([moved(foot, &at(0.08)), lathe(&profile, 48), moved(plate, &at(2.62))])
}

/// Lamps that hang in the air, clear of everything: over the ground, most of them low.
fn lamps(scene: &mut SceneBuilder, count: u32) {
    let mut dice = Dice::new(7);
    let radius = 0.07 * (400.0 / f64::from(count)).sqrt().clamp(0.08, 3.0);
    // Φ = 4π² r² L, shared by all.
    let radiance = 4.2 / (f64::from(count) * radius * radius);
    let mut hung = 0;
    while hung < count {
        let part = dice.unit();
        let (reach, height) = (0.6 + 5.0 * dice.unit().sqrt(), 0.2 + 2.8 * dice.unit() * dice.unit());
        let color = dice.pick(&PAPER);
        let (c, s) = turned(part);
        let at = DVec3::new(reach * c, height, reach * s);
        if is_clear(at, radius) {
            scene.light("lamp", Sphere::new(at.as_vec3(), radius as f32, color * radiance as f32));
            hung += 1;
        }
    }
}

/// No column, step or globe comes near.
fn is_clear(at: DVec3, radius: f64) -> bool {
    let level = DVec3::new(at.x, 0.0, at.z);
    let columns_clear = (0..9).all(|i| {
        let (c, s) = turned(0.03 + f64::from(i) / 9.0);
        (level - DVec3::new(CIRCLE * c, 0.0, CIRCLE * s)).length() > 0.45 + radius
    });
    columns_clear && level.length() > 1.95 + radius
}
