//! A rubber plant in its pot: stems of thin tubes, leaves as thin as paper.

use antumbra_math::{DMat3, DVec3, Rgb, Transform, real};
use antumbra_trace::Triangles;

use super::super::noise::{Dice, TURN};
use super::super::solids::{joined, lathe, moved, sheet, smooth, tube, turn_y, turned};
use crate::scene::{Material, SceneBuilder};

/// Puts it on the floor at `at`.
pub(super) fn add(scene: &mut SceneBuilder, at: DVec3) {
    let clay = scene.material(Material::diffuse(Rgb::new(0.58, 0.29, 0.17)).named("pot"));
    let earth = scene.material(Material::diffuse(Rgb::new(0.07, 0.05, 0.035)).named("earth"));
    let wood = scene.material(Material::diffuse(Rgb::new(0.20, 0.16, 0.08)).named("stem"));
    let greens = [Rgb::new(0.10, 0.24, 0.07), Rgb::new(0.14, 0.30, 0.08), Rgb::new(0.07, 0.18, 0.06)]
        .map(|c| scene.material(Material::metallic_roughness(c, 0.0, 0.45).named("leaf")));

    let to = Transform::translation(at);
    let pot = [
        (0.0, 0.0),
        (0.13, 0.0),
        (0.14, 0.01),
        (0.19, 0.30),
        (0.205, 0.305),
        (0.21, 0.36),
        (0.19, 0.362),
        (0.18, 0.32),
        (0.0, 0.315),
    ];
    smooth(scene, "pot", moved(lathe(&pot, 96), &to), clay);
    smooth(scene, "earth", moved(lathe(&[(0.0, 0.319), (0.182, 0.32), (0.0, 0.335)], 48), &to), earth);

    let mut dice = Dice::new(31);
    let mut stems = Vec::new();
    let mut leaves: [Vec<Triangles>; 3] = Default::default();
    for stem in 0..5 {
        let line = stem_line(&mut dice, stem);
        stems.push(tube(&line, |t| 0.011 * (1.0 - 0.7 * t), 12));
        for (i, foot) in line.iter().enumerate().skip(6).step_by(2) {
            let part = 0.382 * i as f64 + 0.2 * f64::from(stem);
            let size = dice.between(0.75, 1.15) * (1.15 - 0.4 * i as f64 / line.len() as f64);
            let green = dice.pick(&[0, 1, 2]);
            leaves[green].push(moved(leaf(size, dice.between(0.15, 0.9)), &turn_y(TURN * part, *foot)));
        }
    }
    smooth(scene, "stems", moved(joined(stems), &to), wood);
    for (green, leaves) in greens.into_iter().zip(leaves) {
        smooth(scene, "leaves", moved(joined(leaves), &to), green);
    }
}

/// From the earth upwards, leaning outwards more and more.
fn stem_line(dice: &mut Dice, stem: u32) -> Vec<DVec3> {
    let (c, s) = turned(f64::from(stem) / 5.0 + dice.between(-0.06, 0.06));
    let (height, reach) = (dice.between(0.85, 1.35), dice.between(0.12, 0.34));
    (0..=28)
        .map(|i| f64::from(i) / 28.0)
        .map(|t| {
            let out = 0.05 + reach * t * t + 0.012 * real::sin(9.0 * t + f64::from(stem));
            DVec3::new(out * c, 0.32 + height * t, out * s)
        })
        .collect()
}

/// A leaf on its stalk, along +x, bent down by `droop` [rad]: an open sheet.
fn leaf(size: f64, droop: f64) -> Triangles {
    let blade = sheet(22, 8, |u, v| {
        let across = 2.0 * v - 1.0;
        // Widest before the middle, pointed at the tip, a stalk at the foot.
        let width = 0.065 * real::pow(real::sin(TURN / 2.0 * real::pow(u, 0.8)).max(0.0), 0.8) + 0.003;
        let bend = droop * u + 0.25;
        let (x, y) = (0.26 * u, 0.05 * u - 0.10 * bend * u * u);
        let fold = 0.35 * width * across * across;
        let wave = 0.006 * across.abs() * real::sin(22.0 * u);
        DVec3::new(x, y + fold + wave, -width * across)
    });
    let scale = Transform { linear: DMat3::from_diagonal(DVec3::splat(size)), translation: DVec3::ZERO };
    moved(blade, &scale)
}
