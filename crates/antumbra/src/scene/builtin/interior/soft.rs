//! Cloth of the room: sofa, cushions, curtains and rug. Most of the triangles are here.

use antumbra_math::{DVec3, Rgb, Transform, real};
use antumbra_trace::Triangles;

use super::super::noise::{TURN, fractal};
use super::super::solids::{ball, joined, lathe, moved, rounded_box, sheet, smooth, turn, turn_y};
use super::{ROOM, WINDOW};
use crate::scene::{Material, MaterialId, SceneBuilder};

/// Puts everything in its place.
pub(super) fn add(scene: &mut SceneBuilder) {
    sofa(scene, DVec3::new(-0.5, 0.0, -1.95));
    armchair(scene, DVec3::new(-1.9, 0.0, 0.55));
    curtains(scene);
    let wool = scene.material(Material::diffuse(Rgb::new(0.60, 0.53, 0.42)).named("wool"));
    smooth(scene, "rug", rug(), wool);
}

/// A sofa for three: body, two arms, seat and back cushions, and three loose ones.
fn sofa(scene: &mut SceneBuilder, at: DVec3) {
    let linen = scene.material(Material::diffuse(Rgb::new(0.30, 0.36, 0.38)).named("linen"));
    let part = |half: [f64; 3], x: f64, y: f64, z: f64| {
        let to = Transform::translation(at + DVec3::new(x, y, z));
        moved(rounded_box(DVec3::from(half), 0.05, 6), &to)
    };
    let body = [
        part([1.05, 0.11, 0.42], 0.0, 0.22, 0.0),
        part([1.05, 0.30, 0.10], 0.0, 0.50, -0.36),
        part([0.10, 0.25, 0.44], -1.10, 0.36, 0.0),
        part([0.10, 0.25, 0.44], 1.10, 0.36, 0.0),
    ];
    smooth(scene, "sofa", joined(body), linen);
    legs(scene, at, 1.0, 0.34);
    for i in 0..2 {
        let x = f64::from(i) - 0.5;
        let seat = cushion(DVec3::new(0.49, 0.10, 0.38), 52, 50 + i);
        let seat_at = Transform::translation(at + DVec3::new(x, 0.41, 0.07));
        smooth(scene, "seat cushion", moved(seat, &seat_at), linen);
        let back = cushion(DVec3::new(0.47, 0.10, 0.25), 44, 60 + i);
        let back_at = turn(DVec3::X, TURN * 0.21, at + DVec3::new(x, 0.70, -0.19));
        smooth(scene, "back cushion", moved(back, &back_at), linen);
    }
    let loose = [
        (-0.82, 0.35, Rgb::new(0.66, 0.36, 0.14)),
        (-0.50, -0.15, Rgb::new(0.70, 0.66, 0.56)),
        (0.78, -0.30, Rgb::new(0.50, 0.15, 0.12)),
    ];
    for (i, (x, angle, color)) in loose.into_iter().enumerate() {
        let velvet = scene.material(Material::diffuse(color).named("velvet"));
        let pillow = pillow(0.23, 0.10, 44, 70 + i as u32);
        let standing = turn(DVec3::X, TURN * 0.19, DVec3::ZERO);
        let front = 0.10 + 0.07 * (i % 2) as f64;
        let to = turn_y(angle, at + DVec3::new(x, 0.71, front - 0.05)).after(&standing);
        smooth(scene, "loose cushion", moved(pillow, &to), velvet);
    }
}

/// A small chair of the same make, turned to the table.
fn armchair(scene: &mut SceneBuilder, at: DVec3) {
    let cord = scene.material(Material::diffuse(Rgb::new(0.58, 0.40, 0.20)).named("corduroy"));
    let part = |half: [f64; 3], x: f64, y: f64, z: f64| {
        moved(rounded_box(DVec3::from(half), 0.045, 6), &Transform::translation(DVec3::new(x, y, z)))
    };
    let back = turn(DVec3::X, -0.22, DVec3::new(0.0, 0.62, -0.34));
    let body = [
        part([0.36, 0.08, 0.36], 0.0, 0.26, 0.0),
        part([0.07, 0.20, 0.36], -0.40, 0.40, 0.0),
        part([0.07, 0.20, 0.36], 0.40, 0.40, 0.0),
        moved(rounded_box(DVec3::new(0.38, 0.36, 0.07), 0.06, 6), &back),
    ];
    let to = turn_y(1.25, at);
    smooth(scene, "armchair", moved(joined(body), &to), cord);
    let seat = cushion(DVec3::new(0.33, 0.085, 0.33), 40, 80);
    smooth(scene, "seat cushion", moved(moved(seat, &Transform::translation(DVec3::Y * 0.42)), &to), cord);
    legs(scene, at, 0.26, 0.26);
}

/// Four turned feet.
fn legs(scene: &mut SceneBuilder, at: DVec3, half_x: f64, half_z: f64) {
    let wood = scene.material(Material::diffuse(Rgb::new(0.16, 0.09, 0.05)).named("leg"));
    let leg = lathe(&[(0.0, 0.0), (0.016, 0.0), (0.03, 0.2), (0.0, 0.201)], 24);
    let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
    let legs = corners.map(|(x, z)| {
        moved(leg.clone(), &Transform::translation(at + DVec3::new(x * half_x, 0.0, z * half_z)))
    });
    smooth(scene, "legs", joined(legs), wood);
}

/// A stuffed block of 12 n² triangles, lying: bulges above, wrinkles at the seams.
fn cushion(half: DVec3, n: u32, seed: u32) -> Triangles {
    ball(n, |d| {
        let corner = |x: f64| real::pow(x.abs(), 0.36).copysign(x);
        let p = DVec3::new(corner(d.x), corner(d.y), corner(d.z));
        let edge = p.x.abs().max(p.z.abs());
        let swell = 1.0 - 0.22 * edge * edge * edge * edge;
        let wrinkle = 0.010 * fractal(DVec3::new(p.x, 0.4 * p.y, p.z) * 3.1, 4, seed);
        DVec3::new(p.x * half.x, p.y * half.y * swell, p.z * half.z) + d * wrinkle
    })
}

/// A square cushion with four tips, lying; edge 2 · `half`.
fn pillow(half: f64, thick: f64, n: u32, seed: u32) -> Triangles {
    ball(n, |d| {
        let corner = |x: f64, e: f64| real::pow(x.abs(), e).copysign(x);
        let (x, z) = (corner(d.x, 0.45), corner(d.z, 0.45));
        let pinch = (1.0 - real::pow(x.abs(), 3.5)).max(0.0) * (1.0 - real::pow(z.abs(), 3.5)).max(0.0);
        // Sides sag inwards between the tips.
        let sag = |a: f64| 1.0 - 0.10 * (1.0 - a * a);
        let wrinkle = 0.012 * fractal(d * 2.6, 4, seed);
        let y = corner(d.y, 0.6) * thick * (0.12 + 0.88 * pinch.sqrt());
        DVec3::new(x * half * sag(z), y + wrinkle * pinch, z * half * sag(x))
    })
}

/// Two curtains beside the window, in folds that grow toward the hem, on a rod.
fn curtains(scene: &mut SceneBuilder) {
    let voile = scene.material(Material::diffuse(Rgb::new(0.72, 0.68, 0.58)).named("curtain"));
    let metal = scene.material(Material::metallic_roughness(Rgb::grey(0.55), 1.0, 0.3).named("rod"));
    let (z0, z1) = (WINDOW[0][1], WINDOW[1][1]);
    hang(scene, voile, z0 - 0.30, z0 + 0.20, 90);
    hang(scene, voile, z1 - 0.14, z1 + 0.36, 91);
    let rod = lathe(&[(0.0, -1.5), (0.012, -1.5), (0.012, 1.5), (0.0, 1.5)], 24);
    let along_z = turn(DVec3::X, TURN / 4.0, DVec3::new(-ROOM.x + 0.10, 2.52, 0.5 * (z0 + z1)));
    smooth(scene, "rod", moved(rod, &along_z), metal);
}

fn hang(scene: &mut SceneBuilder, cloth: MaterialId, z0: f64, z1: f64, seed: u32) {
    let folds = sheet(240, 110, |u, v| {
        let down = 1.0 - v;
        let along = u + 0.012 * fractal(DVec3::new(3.0 * u, 1.5 * v, 0.0), 3, seed);
        let depth = 0.028 + 0.018 * down;
        let wave = real::sin(TURN * 6.5 * along) + 0.35 * real::sin(TURN * 15.0 * along + 2.0 * down);
        DVec3::new(-ROOM.x + 0.10 + depth * wave, 0.02 + 2.49 * v, z0 + (z1 - z0) * u)
    });
    smooth(scene, "curtain", folds, cloth);
}

/// A woven rug: rows of knots.
fn rug() -> Triangles {
    sheet(320, 200, |u, v| {
        let (x, z) = (-1.55 + 3.1 * u, 0.85 - 2.0 * v);
        let knot = real::sin(TURN * 80.0 * u) * real::sin(TURN * 50.0 * v);
        let edge = (1.0 - (2.0 * u - 1.0).abs()).min(1.0 - (2.0 * v - 1.0).abs());
        let height = 0.012 * (edge * 60.0).min(1.0)
            + 0.0025 * knot
            + 0.004 * fractal(DVec3::new(x, 0.0, z) * 4.0, 3, 95);
        DVec3::new(x, height.max(0.001), z)
    })
}
