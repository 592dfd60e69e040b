//! A pixel taken apart is the pixel of the picture, and every row is its own formula.

use antumbra::estimator::{EstimatorKind, LightChoice, Mistake};
use antumbra::light::{LightPoints, Point};
use antumbra::math::{Rgb, Vec3};
use antumbra::render::{Explained, LightRay, explain};
use antumbra::scene::{Material, Scene};
use antumbra::schedule::Flow;
use antumbra::sensor::Viewing;
use antumbra::settings::Settings;

use super::pictures::{look, small};
use super::scenes::parallelogram;
use super::{glass, rooms};

use EstimatorKind::{Area, Hemisphere, Mis};

fn taken(scene: &Scene, pixel: [u32; 2], settings: &Settings) -> Explained {
    explain(scene, pixel, settings, None, &mut || Flow::Continue).unwrap()
}

/// Pixels of the room: on the floor in half shadow, on a wall, on the lamp, in a corner of the picture.
const PIXELS: [[u32; 2]; 4] = [[9, 11], [2, 4], [14, 3], [19, 14]];

/// The sum is the pixel of a render with the same settings and seed: the same f32 terms summed in f64, rounded once.
#[test]
fn the_sum_is_the_pixel() {
    let room = rooms::lit().build().unwrap();
    let mut many = rooms::lit();
    many.light("point", Point { position: Vec3::new(0.5, 2.5, 0.5), intensity: Rgb::WHITE });
    let (many, sky) = (many.build().unwrap(), rooms::under_sky().build().unwrap());
    let ground = glass::ground_glass().build().unwrap();
    let base = |kind| Settings {
        viewing: Viewing::Filter,
        viewing_rays: 5,
        shadow_rays: 3,
        bounces: 1,
        ..small(kind)
    };
    let ways = [
        base(Area),
        base(Hemisphere),
        base(Mis),
        Settings { bounces: 8, light_points: LightPoints::Area, lights: LightChoice::All, ..base(Area) },
        Settings { lights: LightChoice::Contribution, ..base(Mis) },
        Settings { bounces: 0, ..base(Area) },
        Settings { shadows: false, ..base(Mis) },
        Settings { distance_test: false, clay: Some(0.6), ..base(Area) },
        Settings { mistake: Mistake::NoDistance, passes: Some(3), ..base(Area) },
        Settings { mistake: Mistake::CountedTwice, light: vec!["ceiling".into()], ..base(Mis) },
    ];
    let mut rows = 0;
    for (name, scene) in [("room", &room), ("many", &many), ("sky", &sky), ("glass", &ground)] {
        for s in &ways {
            if name == "sky" && !s.light.is_empty() {
                continue;
            }
            let picture = look(scene, s);
            for [x, y] in PIXELS {
                let found = taken(scene, [x, y], s);
                let pixel = picture.pixels[(y * picture.width + x) as usize];
                for (sum, pixel) in found.value.iter().zip(pixel) {
                    let off = (*sum as f32 - pixel).abs();
                    assert!(
                        off <= 2.0 * f32::EPSILON * pixel.abs(),
                        "{name} {x},{y} {s:?}: {sum}, not {pixel}"
                    );
                }
                rows += found.viewing_rays.iter().map(|r| r.light_rays.len()).sum::<usize>();
            }
        }
    }
    println!("{rows} rows");
}

/// Each row: V · weight · L_e · f_r · cos θ / (pdf · N · viewing rays), cos θ′ and r² as the points say; also through
/// ground glass and in a mirror.
#[test]
fn every_row_is_its_formula() {
    let mut glass = glass::ground_glass();
    let mirror = glass.material(Material::mirror(Rgb::grey(0.9)));
    glass.object("mirror", parallelogram(Vec3::new(-2.9, 0.5, -1.0), Vec3::Z * 2.0, Vec3::Y * 1.5), mirror);
    let scenes = [rooms::lit().build().unwrap(), glass.build().unwrap()];
    let base =
        |kind| Settings { viewing_rays: 16, shadow_rays: 3, light_points: LightPoints::Area, ..small(kind) };
    let ways =
        [base(Area), base(Mis), base(Hemisphere), Settings { mistake: Mistake::NoCount, ..base(Hemisphere) }];
    let (mut free, mut blocked, mut found) = (0, 0, 0);
    for (scene, s) in scenes.iter().flat_map(|scene| ways.iter().map(move |s| (scene, s))) {
        for pixel in (0..15).flat_map(|y| [[4, y], [9, y], [14, y]]) {
            for ray in &taken(scene, pixel, s).viewing_rays {
                let Some(met) = &ray.met else { continue };
                for row in ray.light_rays.iter().filter(|row| row.pdf > 0.0) {
                    check_row(row, 48.0);
                    if row.by_direction {
                        found += u32::from(row.light.is_some());
                        continue;
                    }
                    assert_eq!(row.visible == Some(false), row.blocker.is_some(), "{row:?}");
                    let Some(q) = row.point else { continue };
                    // The end is lifted off the light by 2⁻²¹ of its coordinates.
                    assert!(((q - met.receiver.p).length() / row.distance - 1.0).abs() < 1e-5, "{row:?}");
                    free += u32::from(row.visible == Some(true));
                    blocked += u32::from(row.visible == Some(false));
                }
            }
        }
    }
    println!("{free} free, {blocked} blocked, {found} found");
    assert!(free > 1000 && blocked > 100 && found > 100);
}

fn check_row(row: &LightRay, samples: f32) {
    let factor = row.weight * row.cos / (row.pdf * samples);
    // Half a dozen roundings of f32; a drawn direction comes with f_r cos θ / pdf as one number, which rounds otherwise.
    let slack = if row.by_direction { 1e-3 } else { 2e-6 };
    for (c, brings) in row.brings.iter().enumerate() {
        let v = if row.visible == Some(true) { 1.0 } else { 0.0 };
        let formula = f64::from(v * row.radiance.0[c] * row.brdf.0[c] * factor);
        assert!((brings - formula).abs() <= slack * formula, "{formula}: {row:?}");
    }
}

/// What there is no table for is told, with what to do.
#[test]
fn other_estimators_and_pixels_are_refused() {
    let scene = rooms::lit().build().unwrap();
    let wrong = |pixel, s: Settings| {
        explain(&scene, pixel, &s, None, &mut || Flow::Continue)
            .err()
            .map(|e| format!("{e} {}", e.hint))
            .unwrap_or_default()
    };
    for kind in EstimatorKind::ALL.iter().filter(|k| ![Area, Hemisphere, Mis].contains(k)) {
        assert!(wrong([0, 0], small(*kind)).contains("Choose estimator area"), "{kind:?}");
    }
    assert!(wrong([20, 0], small(Area)).contains("pixel 20,0 does not lie in 20 × 15"));
    assert!(wrong([0, 0], Settings { shadow_rays: 1 << 15, ..small(Area) }).contains("too many"));
}
