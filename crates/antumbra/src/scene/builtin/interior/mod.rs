//! A furnished room by day: a window to the sky and a ceiling light of 2 × 2 m.

mod furniture;
mod plant;
mod soft;

use std::sync::Arc;

use antumbra_math::{DVec3, Rgb, Transform, World};
use antumbra_trace::Triangles;

use super::noise::Dice;
use super::solids::{cuboid, joined, moved, quad, rounded_box};
use super::{Builtin, Values, sky::sky};
use crate::light::{Environment, Rectangle};
use crate::scene::{Camera, Material, MaterialId, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "interior",
    shows: "A furnished room by day: half a million triangles, a window to the sky, a ceiling light of 2 × 2 m",
    parameters: &[],
    build,
};

/// Half the width and depth of the room, and its height [m].
const ROOM: DVec3 = DVec3::new(3.0, 2.8, 2.5);
/// Lower and upper corner of the window, in the wall x = −3: (y, z) [m].
const WINDOW: [[f64; 2]; 2] = [[0.75, -1.35], [2.35, 0.75]];
/// Thickness of the wall with the window [m].
const WALL: f64 = 0.28;

fn build(_: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let mut paint =
        |name: &str, r: f32, g: f32, b: f32| scene.material(Material::diffuse(Rgb::new(r, g, b)).named(name));
    let (white, wall) = (paint("white", 0.78, 0.77, 0.75), paint("wall", 0.64, 0.66, 0.62));
    let planks =
        [paint("oak", 0.42, 0.27, 0.15), paint("oak", 0.37, 0.23, 0.12), paint("oak", 0.46, 0.31, 0.18)];

    shell_of_room(&mut scene, white, wall);
    floor(&mut scene, planks);
    window(&mut scene, white);
    furniture::add(&mut scene);
    soft::add(&mut scene);
    plant::add(&mut scene, DVec3::new(-2.3, 0.0, -1.95));

    ceiling_light(&mut scene, white);
    scene.light("sky", Environment::image(Arc::new(sky(DVec3::new(-0.80, 0.50, 0.22), 0.3, 2.2))));

    let eye = DVec3::new(2.62, 1.50, 2.32);
    scene.cameras.push(Camera::perspective(eye, DVec3::new(-0.62, 0.74, -1.0), 52.0).sized(800, 560));
    scene
}

/// Walls, ceiling, subfloor; the wall with the window is thick, and made of four pieces.
fn shell_of_room(scene: &mut SceneBuilder, white: MaterialId, wall: MaterialId) {
    let (x, y, z) = (DVec3::X * (2.0 * ROOM.x), DVec3::Y * ROOM.y, DVec3::Z * (2.0 * ROOM.z));
    let low = DVec3::new(-ROOM.x, 0.0, -ROOM.z);
    let high = DVec3::new(ROOM.x, ROOM.y, ROOM.z);
    scene.object("back and front wall", joined([quad(low, x, y), quad(high, -x, -y)]), wall);
    scene.object("right wall", quad(high, -y, -z), wall);
    scene.object("ceiling", quad(high, -z, -x), white);
    scene.object("subfloor", quad(low - DVec3::Y * 0.02, z, x), wall);

    let [[y0, z0], [y1, z1]] = WINDOW;
    let piece = |y: [f64; 2], z: [f64; 2]| {
        cuboid(DVec3::new(-ROOM.x - WALL, y[0], z[0]), DVec3::new(-ROOM.x, y[1], z[1]))
    };
    let pieces = [
        piece([-0.02, y0], [-ROOM.z, ROOM.z]),
        piece([y1, ROOM.y], [-ROOM.z, ROOM.z]),
        piece([y0, y1], [-ROOM.z, z0]),
        piece([y0, y1], [z1, ROOM.z]),
    ];
    scene.object("wall with the window", joined(pieces), white);

    let board = |low: DVec3, high: DVec3| cuboid(low, high);
    let boards = [
        board(low, DVec3::new(ROOM.x, 0.09, -ROOM.z + 0.015)),
        board(DVec3::new(ROOM.x - 0.015, 0.0, -ROOM.z), DVec3::new(ROOM.x, 0.09, ROOM.z)),
        board(low, DVec3::new(-ROOM.x + 0.015, 0.09, ROOM.z)),
    ];
    scene.object("skirting boards", joined(boards), white);
}

/// Oak planks with narrow joints, each row shifted.
fn floor(scene: &mut SceneBuilder, oak: [MaterialId; 3]) {
    let (width, length, joint) = (0.125, 1.25, 0.004);
    let mut dice = Dice::new(17);
    let mut planks: [Vec<Triangles>; 3] = Default::default();
    for row in 0..(2.0 * ROOM.z / width) as u32 {
        let z = -ROOM.z + width * f64::from(row);
        let shift = dice.between(0.0, length);
        for i in 0..6 {
            let start = (-ROOM.x - shift + length * f64::from(i)).max(-ROOM.x);
            let end = (-ROOM.x - shift + length * f64::from(i + 1)).min(ROOM.x);
            if end - start > 0.02 {
                let low = DVec3::new(start + joint, -0.015, z + joint);
                planks[dice.pick(&[0, 1, 2])].push(cuboid(low, DVec3::new(end, 0.0, z + width)));
            }
        }
    }
    for (wood, planks) in oak.into_iter().zip(planks) {
        scene.object("planks", joined(planks), wood);
    }
}

/// Frame, cross bars and sill.
fn window(scene: &mut SceneBuilder, white: MaterialId) {
    let [[y0, z0], [y1, z1]] = WINDOW;
    let x = -ROOM.x - 0.6 * WALL;
    let (middle_y, middle_z) = (0.5 * (y0 + y1), 0.5 * (z0 + z1));
    let bar = |half: DVec3, y: f64, z: f64| {
        moved(rounded_box(half, 0.008, 2), &Transform::translation(DVec3::new(x, y, z)))
    };
    let (tall, wide) = (0.5 * (y1 - y0), 0.5 * (z1 - z0));
    let upright = |z: f64, half: f64| bar(DVec3::new(0.03, tall, half), middle_y, z);
    let across = |y: f64, half: f64| bar(DVec3::new(0.028, half, wide), y, middle_z);
    let sill = rounded_box(DVec3::new(0.20, 0.02, wide + 0.10), 0.012, 2);
    let sill_at = Transform::translation(DVec3::new(-ROOM.x - 0.02, y0, middle_z));
    let parts = [
        upright(z0 + 0.03, 0.035),
        upright(z1 - 0.03, 0.035),
        upright(middle_z, 0.04),
        across(y0 + 0.045, 0.035),
        across(y1 - 0.03, 0.035),
        across(y0 + 1.12, 0.022),
        moved(sill, &sill_at),
    ];
    scene.object("window", joined(parts), white);
}

/// A panel of light in a frame under the ceiling.
fn ceiling_light(scene: &mut SceneBuilder, white: MaterialId) {
    let y = ROOM.y - 0.06;
    let edge =
        |x: [f64; 2], z: [f64; 2]| cuboid(DVec3::new(x[0], y - 0.02, z[0]), DVec3::new(x[1], ROOM.y, z[1]));
    let frame = [
        edge([-1.05, -1.0], [-1.05, 1.05]),
        edge([1.0, 1.05], [-1.05, 1.05]),
        edge([-1.0, 1.0], [-1.05, -1.0]),
        edge([-1.0, 1.0], [1.0, 1.05]),
    ];
    scene.object("frame of the ceiling light", joined(frame), white);
    let corner = World::new(-1.0, y as f32, -1.0);
    let radiance = Rgb::new(1.0, 0.90, 0.76) * 1.9;
    scene.light("ceiling light", Rectangle::new(corner, World::X * 2.0, World::Z * 2.0, radiance));
}
