//! Wood, metal and china of the room: table, shelf with books, lamp, pictures, and what stands on them.

use antumbra_math::{DVec3, Rgb, Transform};
use antumbra_trace::Triangles;

use super::super::noise::{Dice, fractal};
use super::super::solids::{ball, cuboid, joined, lathe, moved, rounded_box, smooth, tube, turn, turn_y};
use super::ROOM;
use crate::scene::{Material, MaterialId, SceneBuilder};

/// Puts everything in its place.
pub(super) fn add(scene: &mut SceneBuilder) {
    let walnut = scene.material(Material::diffuse(Rgb::new(0.22, 0.12, 0.07)).named("walnut"));
    let china = scene.material(Material::diffuse(Rgb::new(0.76, 0.75, 0.72)).named("china"));
    let brass =
        scene.material(Material::metallic_roughness(Rgb::new(0.85, 0.62, 0.33), 1.0, 0.35).named("brass"));
    table(scene, DVec3::new(0.0, 0.0, -0.35), walnut, china);
    shelf(scene, DVec3::new(2.25, 0.0, -2.33), walnut);
    lamp(scene, DVec3::new(1.36, 0.0, -2.1), brass, china);
    pictures(scene, walnut);
}

/// A low table with a bowl of fruit, two books and a cup.
fn table(scene: &mut SceneBuilder, at: DVec3, wood: MaterialId, china: MaterialId) {
    let to = |x: f64, y: f64, z: f64| Transform::translation(at + DVec3::new(x, y, z));
    let leg = lathe(&[(0.0, 0.0), (0.018, 0.0), (0.028, 0.36), (0.0, 0.361)], 24);
    let legs = [(-0.5, -0.25), (0.5, -0.25), (-0.5, 0.25), (0.5, 0.25)]
        .map(|(x, z)| moved(leg.clone(), &to(x, 0.0, z)));
    let top = moved(rounded_box(DVec3::new(0.6, 0.02, 0.34), 0.018, 4), &to(0.0, 0.38, 0.0));
    smooth(scene, "table", joined(legs.into_iter().chain([top])), wood);

    let bowl = [
        (0.0, 0.0),
        (0.07, 0.0),
        (0.075, 0.008),
        (0.13, 0.035),
        (0.168, 0.075),
        (0.18, 0.11),
        (0.178, 0.114),
        (0.174, 0.112),
        (0.160, 0.078),
        (0.12, 0.042),
        (0.06, 0.02),
        (0.0, 0.018),
    ];
    smooth(scene, "bowl", moved(lathe(&bowl, 96), &to(0.12, 0.40, 0.03)), china);
    let fruit = [
        ([0.06, 0.49, 0.06], 0.040, Rgb::new(0.62, 0.10, 0.06)),
        ([0.18, 0.488, 0.07], 0.038, Rgb::new(0.72, 0.42, 0.06)),
        ([0.13, 0.49, -0.05], 0.041, Rgb::new(0.35, 0.45, 0.08)),
        ([0.12, 0.545, 0.03], 0.039, Rgb::new(0.66, 0.20, 0.07)),
    ];
    for (i, (center, radius, color)) in fruit.into_iter().enumerate() {
        let peel = scene.material(Material::metallic_roughness(color, 0.0, 0.4).named("fruit"));
        let center = at + DVec3::from(center);
        // Apples: a dimple at the top, and never quite round.
        let apple = ball(24, |d| {
            let dimple = 0.35 * (d.y - 0.75).max(0.0);
            center + d * radius * (1.0 - dimple + 0.03 * fractal(d * 1.5, 2, 40 + i as u32))
        });
        smooth(scene, "fruit", apple, peel);
    }

    let covers = [(Rgb::new(0.55, 0.13, 0.10), 0.30, 0.40), (Rgb::new(0.12, 0.25, 0.36), 0.05, 0.432)];
    for (color, angle, y) in covers {
        let cover = scene.material(Material::diffuse(color).named("cover"));
        let book = book(DVec3::new(0.085, 0.016, 0.12));
        smooth(scene, "book", moved(book, &turn_y(angle, at + DVec3::new(-0.33, y + 0.016, 0.05))), cover);
    }
    smooth(scene, "cup", moved(cup(), &to(-0.05, 0.40, 0.2)), china);
}

/// A cup with its handle.
fn cup() -> Triangles {
    let profile = [
        (0.0, 0.0),
        (0.026, 0.0),
        (0.030, 0.004),
        (0.040, 0.05),
        (0.041, 0.082),
        (0.0395, 0.084),
        (0.038, 0.082),
        (0.036, 0.05),
        (0.026, 0.008),
        (0.0, 0.006),
    ];
    let path: Vec<DVec3> = (0..=24)
        .map(|i| super::super::solids::turned(f64::from(i) / 48.0 - 0.25))
        .map(|(c, s)| DVec3::new(0.036 + 0.024 * c, 0.046 + 0.026 * s, 0.0))
        .collect();
    joined([lathe(&profile, 64), tube(&path, |_| 0.0045, 16)])
}

/// A book lying or standing: covers and pages in one rounded body.
fn book(half: DVec3) -> Triangles {
    rounded_box(half, 0.2 * half.min_element(), 2)
}

/// A tall shelf of five boards, full of books, against the back wall.
fn shelf(scene: &mut SceneBuilder, at: DVec3, wood: MaterialId) {
    let (half, depth, gap, thick) = (0.62, 0.16, 0.38, 0.014);
    let board = |x: f64, y: f64, half: DVec3| {
        moved(rounded_box(half, 0.004, 2), &Transform::translation(at + DVec3::new(x, y, 0.0)))
    };
    let sides = [-half, half].map(|x| board(x, 1.0, DVec3::new(thick, 1.0, depth)));
    let boards =
        (0..6).map(|i| board(0.0, 0.05 + gap * f64::from(i), DVec3::new(half - thick, thick, depth)));
    scene.object("shelf", joined(boards.chain(sides)), wood);

    let mut covers = COVERS.map(|_| Vec::new());
    let mut dice = Dice::new(23);
    for level in 0..5 {
        let y = 0.05 + thick + gap * f64::from(level);
        let mut x = -half + 0.03;
        while x < half - 0.08 {
            let book_half =
                DVec3::new(dice.between(0.008, 0.024), dice.between(0.10, 0.155), dice.between(0.08, 0.11));
            let lean = if dice.unit() < 0.07 { 0.16 } else { 0.0 };
            let room = 2.0 * book_half.x + lean * 1.6 * book_half.y;
            // Now and then a hand's breadth stays empty.
            if x + room < half - 0.03 && dice.unit() > 0.03 {
                let foot = at
                    + DVec3::new(
                        x + 0.5 * room,
                        y + book_half.y + 0.5 * lean * book_half.x,
                        0.13 - book_half.z,
                    );
                covers[dice.pick(&[0, 1, 2, 3, 4, 5])]
                    .push(moved(book(book_half), &turn(DVec3::Z, lean, foot)));
            }
            x += room + 0.0015 + if dice.unit() < 0.02 { 0.12 } else { 0.0 };
        }
    }
    for (color, books) in COVERS.into_iter().zip(covers) {
        let cover = scene.material(Material::diffuse(color).named("cover"));
        smooth(scene, "books", joined(books), cover);
    }
}

const COVERS: [Rgb; 6] = [
    Rgb::new(0.50, 0.12, 0.09),
    Rgb::new(0.11, 0.22, 0.33),
    Rgb::new(0.62, 0.52, 0.33),
    Rgb::new(0.13, 0.27, 0.18),
    Rgb::new(0.68, 0.66, 0.60),
    Rgb::new(0.30, 0.20, 0.30),
];

/// A standing lamp, switched off.
fn lamp(scene: &mut SceneBuilder, at: DVec3, brass: MaterialId, shade: MaterialId) {
    let foot = [
        (0.0, 0.0),
        (0.15, 0.0),
        (0.155, 0.008),
        (0.15, 0.02),
        (0.03, 0.035),
        (0.012, 0.06),
        (0.011, 1.32),
        (0.0, 1.33),
    ];
    smooth(scene, "lamp", moved(lathe(&foot, 64), &Transform::translation(at)), brass);
    let cloth = [(0.21, 1.24), (0.14, 1.56), (0.137, 1.56), (0.207, 1.24), (0.21, 1.24)];
    smooth(scene, "shade", moved(lathe(&cloth, 96), &Transform::translation(at)), shade);
}

/// Three framed pictures over the sofa, of plain fields of colour.
fn pictures(scene: &mut SceneBuilder, wood: MaterialId) {
    let paper = scene.material(Material::diffuse(Rgb::new(0.74, 0.72, 0.67)).named("paper"));
    let wall = -ROOM.z;
    for (i, fields) in FIELDS.iter().enumerate() {
        let middle = DVec3::new(-1.35 + 0.85 * i as f64, 1.68, wall);
        let box_at = |x: [f64; 2], y: [f64; 2], depth: f64| {
            cuboid(middle + DVec3::new(x[0], y[0], 0.002), middle + DVec3::new(x[1], y[1], depth))
        };
        let frame = [
            box_at([-0.33, -0.30], [-0.42, 0.42], 0.035),
            box_at([0.30, 0.33], [-0.42, 0.42], 0.035),
            box_at([-0.30, 0.30], [-0.42, -0.39], 0.035),
            box_at([-0.30, 0.30], [0.39, 0.42], 0.035),
        ];
        scene.object("frame", joined(frame), wood);
        scene.object("paper", box_at([-0.30, 0.30], [-0.39, 0.39], 0.012), paper);
        for (x, y, color) in fields {
            let ink = scene.material(Material::diffuse(*color).named("ink"));
            scene.object("field", box_at(*x, *y, 0.014), ink);
        }
    }
}

type Field = ([f64; 2], [f64; 2], Rgb);
const FIELDS: [[Field; 3]; 3] = [
    [
        ([-0.20, 0.20], [-0.05, 0.27], Rgb::new(0.66, 0.28, 0.12)),
        ([-0.20, 0.20], [-0.20, -0.07], Rgb::new(0.30, 0.10, 0.08)),
        ([-0.20, 0.20], [-0.27, -0.22], Rgb::new(0.70, 0.52, 0.24)),
    ],
    [
        ([-0.20, -0.02], [-0.27, 0.27], Rgb::new(0.12, 0.28, 0.36)),
        ([0.0, 0.20], [0.02, 0.27], Rgb::new(0.36, 0.52, 0.54)),
        ([0.0, 0.20], [-0.27, 0.0], Rgb::new(0.68, 0.60, 0.42)),
    ],
    [
        ([-0.20, 0.20], [0.12, 0.27], Rgb::new(0.24, 0.34, 0.20)),
        ([-0.20, 0.20], [-0.10, 0.10], Rgb::new(0.52, 0.54, 0.30)),
        ([-0.20, 0.20], [-0.27, -0.12], Rgb::new(0.14, 0.18, 0.16)),
    ],
];
