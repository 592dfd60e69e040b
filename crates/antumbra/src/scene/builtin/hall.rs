//! A hundred thousand boxes in a closed hall.

use antumbra_math::{DMat3, DVec3, Rgb, World};
use antumbra_trace::Triangles;

use super::noise::{Dice, fractal};
use super::solids::{cuboid, single, turned};
use super::{Builtin, Parameter, Values};
use crate::light::Rectangle;
use crate::scene::{Camera, Material, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "hall",
    shows: "A hundred thousand boxes adrift in a closed hall under one light of 6 × 6 m: 1.2 million triangles",
    parameters: &[Parameter {
        name: "boxes",
        default: 100_000.0,
        low: 1.0,
        high: 1_000_000.0,
        whole: true,
        help: "number of boxes, of 12 triangles each",
    }],
    build,
};

/// Width, height and depth of the hall [m].
const HALL: DVec3 = DVec3::new(40.0, 14.0, 50.0);
const COLORS: [Rgb; 6] = [
    Rgb::new(0.72, 0.66, 0.55),
    Rgb::new(0.70, 0.40, 0.20),
    Rgb::new(0.52, 0.17, 0.14),
    Rgb::new(0.16, 0.34, 0.38),
    Rgb::new(0.30, 0.42, 0.30),
    Rgb::new(0.78, 0.75, 0.70),
];

fn build(values: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let plaster = scene.material(Material::diffuse(Rgb::new(0.68, 0.67, 0.65)).named("plaster"));
    scene.object("hall", room(), plaster);
    for (color, boxes) in COLORS.into_iter().zip(boxes(values.get("boxes") as usize)) {
        let paint = scene.material(Material::diffuse(color));
        scene.object("boxes", boxes, paint);
    }

    let corner = World::new(-3.0, HALL.y as f32 - 0.2, -5.0);
    let radiance = Rgb::new(1.0, 0.95, 0.86) * 26.0;
    scene.light("light", Rectangle::new(corner, World::X * 6.0, World::Z * 6.0, radiance));

    let eye = DVec3::new(7.0, 11.8, 22.5);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(-0.5, 4.0, -1.5), 46.0).sized(800, 500));
    scene
}

/// The hall, seen from inside.
fn room() -> Triangles {
    let half = DVec3::new(HALL.x / 2.0, 0.0, HALL.z / 2.0);
    let mut walls = cuboid(-half, half + DVec3::Y * HALL.y);
    walls.indices.iter_mut().for_each(|t| t.swap(1, 2));
    walls
}

/// Turned boxes, a mesh for each colour: drifts over the floor like dunes, and above them ever fewer in the air.
fn boxes(count: usize) -> [Triangles; COLORS.len()] {
    let unit = cuboid(DVec3::NEG_ONE, DVec3::ONE);
    let share = count / COLORS.len() + 1;
    let mut meshes = std::array::from_fn(|_| Triangles {
        vertices: Vec::with_capacity(8 * share),
        indices: Vec::with_capacity(12 * share),
    });
    let mut dice = Dice::new(3);
    for i in 0..count {
        let mesh = &mut meshes[i % COLORS.len()];
        let half = DVec3::new(1.0, dice.between(0.5, 1.0), dice.between(0.3, 1.0)) * dice.between(0.05, 0.16);
        let turn = dice.rotation() * DMat3::from_diagonal(half);
        let center = place(&mut dice);
        let first = mesh.vertices.len() as u32;
        let corners = unit.vertices.iter().map(|v| single(center + turn * DVec3::from(v.map(f64::from))));
        mesh.vertices.extend(corners);
        mesh.indices.extend(unit.indices.iter().map(|t| t.map(|v| v + first)));
    }
    meshes
}

/// Where a box floats, at least 0.3 m from every wall: three of four lie in dunes on the floor, the others drift in a
/// ring that leans.
fn place(dice: &mut Dice) -> DVec3 {
    if dice.unit() < 0.75 {
        let (x, z) = (dice.between(-0.5, 0.5) * (HALL.x - 0.6), dice.between(-0.5, 0.5) * (HALL.z - 0.6));
        let dune = 0.7 + 1.1 * fractal(DVec3::new(x, 0.0, z) / 11.0, 3, 5);
        return DVec3::new(x, 0.3 + dune.max(0.05) * dice.unit(), z);
    }
    let (c, s) = turned(dice.unit());
    // Two numbers together: dense in the middle of the ring, thin at its rim.
    let mut around = |width: f64| width * (dice.unit() + dice.unit() - 1.0);
    let (out, up) = (11.0 + around(3.2), around(0.7));
    let (x, z) = (out * c, out * s);
    DVec3::new(x, 6.0 - 0.2 * z + up, z - 3.0)
}
