//! What a scanner brings home: millions of tiny triangles on one closed surface.

use antumbra_math::{DVec3, Rgb};

use super::noise::{fractal, noise, ridges};
use super::solids::{ball, quad};
use super::{Builtin, Parameter, Values};
use crate::light::Rectangle;
use crate::scene::{Camera, Material, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "scan",
    shows: "A stone of two million triangles, each about 3 mm, as a scanner would bring it home",
    parameters: &[Parameter {
        name: "triangles",
        default: 2_100_000.0,
        low: 1_000.0,
        high: 10_000_000.0,
        whole: true,
        help: "about how many triangles the stone has (12 n² for a whole n)",
    }],
    build,
};

fn build(values: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let ground = scene.material(Material::diffuse(Rgb::new(0.62, 0.60, 0.57)).named("ground"));
    let stone = scene.material(Material::diffuse(Rgb::new(0.66, 0.55, 0.42)).named("stone"));

    scene.object("ground", quad(DVec3::new(-20.0, 0.0, 20.0), DVec3::X * 40.0, DVec3::Z * -40.0), ground);
    let n = (values.get("triangles") / 12.0).sqrt().round();
    scene.object("stone", ball(n as u32, surface), stone);

    let center = DVec3::new(-3.2, 4.2, 1.4);
    let toward = (DVec3::Y * 0.9 - center).normalize();
    let u = toward.cross(DVec3::Y).normalize() * 1.6;
    let v = toward.cross(u);
    let radiance = Rgb::new(1.0, 0.93, 0.83) * 34.0;
    let corner = center - (u + v) * 0.5;
    scene.light("light", Rectangle::new(corner.as_vec3(), u.as_vec3(), v.as_vec3(), radiance));

    let eye = DVec3::new(0.9, 2.5, 4.7);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(0.05, 0.80, 0.0), 31.0).sized(640, 480));
    scene
}

/// The stone's surface in the direction d: worn folds, cracks along them, and grain.
fn surface(d: DVec3) -> DVec3 {
    let bent = d + DVec3::splat(0.35 * noise(d * 1.8, 1));
    let folds = 0.17 * fractal(bent * 1.5, 3, 9);
    let cracks = 0.055 * ridges(bent * 3.1, 3, 4);
    let grain = 0.006 * fractal(d * 37.0, 2, 14);
    DVec3::Y * 0.90 + d * (0.84 + folds - cracks + grain) * DVec3::new(1.0, 1.10, 0.94)
}
