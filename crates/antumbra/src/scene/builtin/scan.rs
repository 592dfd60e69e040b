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

    let eye = DVec3::new(0.9, 1.75, 4.9);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(0.0, 0.93, 0.0), 30.0).sized(640, 480));
    scene
}

/// The stone's surface in the direction d: folds, pits and grain.
fn surface(d: DVec3) -> DVec3 {
    let bent = d * 1.7 + DVec3::new(noise(d * 2.1, 1), noise(d * 2.1, 2), noise(d * 2.1, 3)) * 0.45;
    let height = 0.16 * ridges(bent, 5, 4) + 0.10 * fractal(d * 2.6, 3, 9) + 0.012 * fractal(d * 24.0, 3, 14);
    DVec3::Y * 0.98 + d * (0.80 + height) * DVec3::new(1.0, 1.06, 0.94)
}
