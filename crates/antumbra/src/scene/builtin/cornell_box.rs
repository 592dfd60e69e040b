//! The Cornell box after the numbers that Cornell University measured and published ("Cornell Box Data"), in mm.

use antumbra_math::{DVec3, Rgb, World};
use antumbra_trace::Triangles;

use super::solids::single;
use super::{Builtin, Parameter, Values};
use crate::light::Rectangle;
use crate::scene::{Camera, Material, SceneBuilder};

pub(super) const SCENE: Builtin = Builtin {
    name: "cornell-box",
    shows: "The measured box of Cornell University: soft shadows, and colour that bleeds from wall to wall",
    parameters: &[Parameter {
        name: "light-size",
        default: 1.0,
        low: 0.001,
        high: 4.0,
        whole: false,
        help: "edge of the ceiling light over the measured one (130 × 105 mm); its power stays the same",
    }],
    build,
};

// The measured spectra (400–700 nm in steps of 4 nm) against the CIE 1931 observer, white = equal energy.
const WHITE: Rgb = Rgb::new(0.738, 0.736, 0.737);
const GREEN: Rgb = Rgb::new(0.070, 0.388, 0.088);
const RED: Rgb = Rgb::new(0.524, 0.057, 0.049);
/// The lamp's spectrum is 0, 8, 15.6, 18.4 at 400, 500, 600, 700 nm, in no unit; here it is made to suit exposure 0.
const LAMP: Rgb = Rgb::new(28.0, 17.5, 4.8);

const CEILING: f64 = 548.8;
const SHORT_BLOCK: [[f64; 2]; 4] = [[130.0, 65.0], [82.0, 225.0], [240.0, 272.0], [290.0, 114.0]];
const TALL_BLOCK: [[f64; 2]; 4] = [[423.0, 247.0], [265.0, 296.0], [314.0, 456.0], [472.0, 406.0]];

fn build(values: &Values) -> SceneBuilder {
    let mut scene = SceneBuilder::new(SCENE.name);
    let white = scene.material(Material::diffuse(WHITE).named("white"));
    let green = scene.material(Material::diffuse(GREEN).named("green"));
    let red = scene.material(Material::diffuse(RED).named("red"));

    let size = values.get("light-size");
    let (half_x, half_z) = (65.0 * size, 52.5 * size);
    let (low, high) = ([278.0 - half_x, 279.5 - half_z], [278.0 + half_x, 279.5 + half_z]);

    let floor = [[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]];
    let back = [[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, CEILING, 559.2], [556.0, CEILING, 559.2]];
    let right = [[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, CEILING, 0.0], [0.0, CEILING, 559.2]];
    let left = [[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, CEILING, 559.2], [556.0, CEILING, 0.0]];
    scene.object("floor", four_corners(floor), white);
    scene.object("ceiling", ceiling(low, high), white);
    scene.object("back wall", four_corners(back), white);
    scene.object("right wall", four_corners(right), green);
    scene.object("left wall", four_corners(left), red);
    scene.object("short block", block(SHORT_BLOCK, 165.0), white);
    scene.object("tall block", block(TALL_BLOCK, 330.0), white);

    let corner = World::new(low[0] as f32, CEILING as f32, low[1] as f32);
    let (u, v) = (World::X * (2.0 * half_x) as f32, World::Z * (2.0 * half_z) as f32);
    scene.light("lamp", Rectangle::new(corner, u, v, LAMP / (size * size) as f32));

    // A lens of 35 mm before a film of 25 mm: 39.3°.
    let eye = DVec3::new(278.0, 273.0, -800.0);
    let fov = 39.307_648;
    scene.cameras.push(Camera::perspective(eye, eye + DVec3::Z * 1079.6, fov).sized(512, 512));
    scene
}

/// The ceiling around the lamp, which hangs in a hole of it.
fn ceiling([x0, z0]: [f64; 2], [x1, z1]: [f64; 2]) -> Triangles {
    let at = |x: f64, z: f64| single(DVec3::new(x, CEILING, z));
    let vertices = vec![
        at(556.0, 0.0),
        at(556.0, 559.2),
        at(0.0, 559.2),
        at(0.0, 0.0),
        at(x1, z0),
        at(x1, z1),
        at(x0, z1),
        at(x0, z0),
    ];
    let side = |i: u32| {
        let next = (i + 1) % 4;
        [[i, next, 4 + next], [i, 4 + next, 4 + i]]
    };
    Triangles { vertices, indices: (0..4).flat_map(side).collect() }
}

/// A block over four corners (x, z) on the floor.
fn block(feet: [[f64; 2]; 4], height: f64) -> Triangles {
    let level = |y: f64| feet.map(|[x, z]| single(DVec3::new(x, y, z)));
    let side = |i: u32| {
        let next = (i + 1) % 4;
        [[i, next, 4 + next], [i, 4 + next, 4 + i]]
    };
    let lids = [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]];
    Triangles {
        vertices: level(0.0).into_iter().chain(level(height)).collect(),
        indices: lids.into_iter().chain((0..4).flat_map(side)).collect(),
    }
}

fn four_corners(corners: [[f64; 3]; 4]) -> Triangles {
    let vertices = corners.map(|c| single(DVec3::from(c))).to_vec();
    Triangles { vertices, indices: vec![[0, 1, 2], [0, 2, 3]] }
}
