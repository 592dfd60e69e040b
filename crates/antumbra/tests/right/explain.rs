//! A pixel taken apart is the pixel of the picture, and every row is its own formula.

use antumbra::estimator::{EstimatorKind, LightChoice, Mistake};
use antumbra::light::{LightPoints, Point};
use antumbra::math::{Rgb, Vec3};
use antumbra::render::{Explained, explain};
use antumbra::scene::Scene;
use antumbra::sensor::Viewing;
use antumbra::settings::Settings;

use super::pictures::{look, small};
use super::rooms;

use EstimatorKind::{Area, Hemisphere, Mis};

fn taken(scene: &Scene, pixel: [u32; 2], settings: &Settings) -> Explained {
    explain(scene, pixel, settings, None).unwrap()
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
    for (name, scene) in [("room", &room), ("many", &many), ("sky", &sky)] {
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

/// Each row of light sampling: V · weight · L_e · f_r · cos θ / (pdf · N · viewing rays), cos θ′ and r² as the points say.
#[test]
fn every_row_is_its_formula() {
    let scene = rooms::lit().build().unwrap();
    let s = Settings { viewing_rays: 16, shadow_rays: 2, light_points: LightPoints::Area, ..small(Area) };
    let (mut free, mut blocked) = (0, 0);
    for pixel in PIXELS {
        for ray in &taken(&scene, pixel, &s).viewing_rays {
            let Some(met) = &ray.met else { continue };
            assert!((ray.origin + ray.direction * met.distance as f32 - met.receiver.p).length() < 1e-5);
            for row in ray.light_rays.iter().filter(|row| row.pdf > 0.0) {
                let factor = row.weight * row.cos / (row.pdf * 32.0);
                for (c, brings) in row.brings.iter().enumerate() {
                    let v = if row.visible == Some(true) { 1.0 } else { 0.0 };
                    let formula = f64::from(v * row.radiance.0[c] * row.brdf.0[c] * factor);
                    // Half a dozen roundings of f32.
                    assert!((brings - formula).abs() <= 1e-6 * formula, "{row:?}");
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
    println!("{free} free, {blocked} blocked");
    assert!(free > 20 && blocked > 3);
}

/// What there is no table for is told, with what to do.
#[test]
fn other_estimators_and_pixels_are_refused() {
    let scene = rooms::lit().build().unwrap();
    let wrong = |pixel, s: Settings| {
        explain(&scene, pixel, &s, None).err().map(|e| format!("{e} {}", e.hint)).unwrap_or_default()
    };
    for kind in EstimatorKind::ALL.iter().filter(|k| ![Area, Hemisphere, Mis].contains(k)) {
        assert!(wrong([0, 0], small(*kind)).contains("Choose estimator area"), "{kind:?}");
    }
    assert!(wrong([20, 0], small(Area)).contains("pixel 20,0 does not lie in 20 × 15"));
    assert!(wrong([0, 0], Settings { shadow_rays: 1 << 15, ..small(Area) }).contains("too many"));
}
