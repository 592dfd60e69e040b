//! Eight pillars on a floor under one area light.

use antumbra_math::{DVec3, Rgb};

use super::solids::{cuboid, moved, quad, turn_y, turned};
use super::{Builtin, Parameter, Values};
use crate::light::Rectangle;
use crate::scene::{Camera, Material, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "pillars",
    shows: "Soft shadows of one area light: sharp at the foot of a pillar, wide at its head",
    parameters: &[Parameter {
        name: "light-size",
        default: 1.0,
        low: 0.001,
        high: 4.0,
        whole: false,
        help: "edge of the square light [m]; its power stays the same",
    }],
    build,
};

/// From the shortest pillar to the tallest.
const COLORS: [Rgb; 4] = [
    Rgb::new(0.75, 0.60, 0.38),
    Rgb::new(0.70, 0.36, 0.20),
    Rgb::new(0.52, 0.20, 0.17),
    Rgb::new(0.22, 0.30, 0.38),
];

fn build(values: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let stone = scene.material(Material::diffuse(Rgb::new(0.70, 0.68, 0.64)).named("stone"));
    let colors = COLORS.map(|c| scene.material(Material::diffuse(c)));

    scene.object("floor", quad(DVec3::new(-30.0, 0.0, 30.0), DVec3::X * 60.0, DVec3::Z * -60.0), stone);
    for i in 0..8 {
        let step = f64::from(i);
        let (c, s) = turned(0.40 - step / 8.0);
        let height = 0.4 + 0.24 * step;
        let body = cuboid(DVec3::new(-0.24, 0.0, -0.24), DVec3::new(0.24, height, 0.24));
        let to = turn_y(0.5 * step, DVec3::new(2.0 * c, 0.0, -2.0 * s));
        scene.object("pillar", moved(body, &to), colors[i as usize / 2]);
    }

    let size = values.get("light-size");
    let center = DVec3::new(-3.3, 6.2, -3.6);
    let toward = (DVec3::new(0.0, 0.5, 0.0) - center).normalize();
    let u = toward.cross(DVec3::Y).normalize() * size;
    let v = toward.cross(u);
    let radiance = Rgb::new(1.0, 0.93, 0.82) * (165.0 / (size * size)) as f32;
    let corner = center - (u + v) * 0.5;
    scene.light("light", Rectangle::new(corner.as_vec3(), u.as_vec3(), v.as_vec3(), radiance));

    let eye = DVec3::new(3.0, 8.4, 9.4);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(0.25, 0.1, 0.75), 33.0).sized(640, 480));
    scene
}
