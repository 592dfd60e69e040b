//! Pictures of the sky: drawn as they are looked up, and their suns.

use super::*;
use antumbra_math::{hash, real, warp};

use crate::texture::Texels;

const UP: World = World::Y;

fn picture(width: u32, height: u32, light: impl Fn(u32, u32) -> f32) -> Arc<Image> {
    let texels = (0..width * height).map(|i| [light(i % width, i / width); 3]).collect();
    Arc::new(Image::new(width, height, Texels::Float(texels)).unwrap())
}

/// Every case that could go wrong, with its name.
fn cases() -> Vec<(&'static str, Arc<Image>)> {
    let hot = |x0, y0| move |x, y| f32::from(u8::from((x, y) == (x0, y0))) * 1e4;
    let noise = |x: u32, y: u32| (hash::hash2(x, y) % 1000) as f32 * 1e-3;
    vec![
        ("black", picture(8, 4, |_, _| 0.0)),
        ("one texel", picture(1, 1, |_, _| 2.0)),
        ("one column", picture(1, 8, |_, y| y as f32)),
        ("constant", picture(33, 17, |_, _| 0.7)),
        ("hot texel", picture(64, 32, hot(17, 9))),
        ("hot texel at the seam", picture(64, 32, hot(63, 20))),
        ("hot texel at the upper pole", picture(64, 32, hot(5, 0))),
        ("hot texel at the lower pole", picture(16, 9, hot(5, 8))),
        ("noise", picture(40, 20, noise)),
        ("sun", picture(128, 64, |x, y| hot(30, 20)(x, y) + hot(31, 20)(x, y) + 0.5 + noise(x, y))),
        ("sun at the seam", picture(128, 64, |x, y| hot(0, 40)(x, y) + 0.5)),
        ("sun at the pole", picture(128, 64, |x, y| hot(9, 0)(x, y) + 0.5)),
    ]
}

fn maps() -> impl Iterator<Item = (String, LatLong)> {
    cases().into_iter().flat_map(|(name, image)| {
        [false, true]
            .map(|nearest| (format!("{name}, nearest {nearest}"), LatLong::new(image.clone(), nearest)))
    })
}

fn normals() -> [World; 3] {
    [UP, World::new(0.6, -0.64, 0.48), World::NEG_X]
}

/// The light of the sun and of the rest together is the picture's, to 10⁻⁶.
#[test]
fn the_split_keeps_the_energy() {
    for (name, map) in maps() {
        let light = |x: u32, y: u32| map.light(x, y);
        let whole = Harmonics::of(map.grid.width, map.grid.height, light).mean();
        assert!((map.mean() - whole).abs() <= 1e-6 * whole, "{name}: {} {whole}", map.mean());
        // Below 27 rows no cap of the rule is wide enough for a texel.
        let expected = name.starts_with("sun") || name.contains("hot texel") && map.grid.height > 26;
        assert_eq!(map.sun.is_some(), expected, "{name}");
    }
}

/// 14,400 strata: each direction says its density and radiance as they are looked up, and the mean of radiance × cos / density
/// is what quadrature says, to the larger of a percent and five standard errors of independent draws.
#[test]
fn draws_are_unbiased_and_agree_with_the_look_up() {
    const SIDE: u32 = 120;
    for (name, map) in maps() {
        for n in normals() {
            let (mut sum, mut squares, mut off, mut drawn) = (0.0, 0.0, 0, 0);
            for i in 0..SIDE * SIDE {
                let jitter = [hash::hash2(i, 1), hash::hash2(i, 2)].map(|h| (h >> 8) as f32 / 16_777_216.0);
                let u = [
                    ((i % SIDE) as f32 + jitter[0]) / SIDE as f32,
                    ((i / SIDE) as f32 + jitter[1]) / SIDE as f32,
                ];
                let Some(d) = map.sample(u.map(|u| u.min(real::ONE_MINUS)), n) else { continue };
                assert!(
                    d.pdf > 0.0 && d.pdf.is_finite() && (d.wi.length() - 1.0).abs() < 1e-6,
                    "{name}: {d:?}"
                );
                let (pdf, light) = (map.pdf(d.wi, n), map.radiance(d.wi).luminance());
                let same = |a: f32, b: f32| (a - b).abs() <= 1e-2 * a.max(b);
                off += u32::from(!same(pdf, d.pdf) || !same(light, d.radiance.luminance()));
                drawn += 1;
                let value = f64::from(d.radiance.luminance() * d.wi.dot(n).max(0.0) / d.pdf);
                sum += value;
                squares += value * value;
            }
            let count = f64::from(SIDE * SIDE);
            let mean = sum / count;
            let error = ((squares / count - mean * mean).max(0.0) / count).sqrt();
            let exact = quadrature(&map, n);
            assert!(
                (mean - exact).abs() <= 5.0 * error + 0.01 * exact,
                "{name}, {n}: {mean} ± {error}, {exact}"
            );
            // Where a direction is rounded over a border between patches, or stands at the foot of a hot texel's slope.
            assert!(off * 50 <= drawn, "{name}, {n}: {off} of {drawn} differ");
        }
    }
}

/// ∫ L cos⁺ by the midpoints of 4 × 4 parts of every texel (more in small pictures).
fn quadrature(map: &LatLong, n: World) -> f64 {
    let parts = 4 * (64 / map.grid.width.min(64)).max(1);
    let (w, h) = (map.grid.width * parts, map.grid.height * parts);
    let mut sum = 0.0;
    for j in 0..h {
        let theta = std::f64::consts::PI * (f64::from(j) + 0.5) / f64::from(h);
        let cell =
            std::f64::consts::TAU / f64::from(w) * std::f64::consts::PI / f64::from(h) * real::sin(theta);
        for i in 0..w {
            let phi = std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(w);
            let sin = real::sin(theta);
            let d = World::new(
                (real::sin(phi) * sin) as f32,
                real::cos(theta) as f32,
                (-real::cos(phi) * sin) as f32,
            );
            sum += f64::from(map.radiance(d).luminance() * d.dot(n).max(0.0)) * cell;
        }
    }
    sum
}

/// Density wherever there is radiance on the receiver's side, and it integrates to 1.
#[test]
fn densities_cover_the_light() {
    for (name, map) in maps() {
        for n in normals() {
            let (mut sum, total) = (0.0, 60_000);
            for i in 0..total {
                let turns = (f64::from(i) * 0.618_033_988_75).fract();
                let u = [(i as f32 + 0.5) / total as f32, turns as f32];
                let d = warp::sphere(u).0;
                let pdf = map.pdf(d, n);
                let lit = map.radiance(d).luminance() > 0.0 && d.dot(n) > 0.0;
                assert!(pdf > 0.0 || !lit, "{name}, {n}: no density toward {d}");
                sum += f64::from(pdf) * 4.0 * std::f64::consts::PI / f64::from(total);
            }
            // A hot texel has some forty of the directions, a patch at a pole one or none.
            let drawn = map.sample([0.5, 0.5], n).is_some() && !name.contains("pole");
            assert!(!drawn || (sum - 1.0).abs() < 0.3, "{name}, {n}: ∫pdf = {sum}");
        }
    }
}

/// Within a part, the draws of a grey picture hardly vary: what is left is the bend of cos θ in a cell.
#[test]
fn drawn_in_proportion_to_the_look_up() {
    for (name, map) in maps().filter(|m| m.1.sun.is_none() && !m.0.contains("black")) {
        let rest = |corners: [(u32, u32); 4]| corners.map(|(x, y)| map.light(x, y));
        let value = |i: u32| {
            let u = [hash::hash2(i, 3), hash::hash2(i, 4)].map(|h| (h >> 8) as f32 / 16_777_216.0);
            let part = &map.parts[i as usize % map.parts.len()].cells;
            let (place, _) = part.sample(u, rest).unwrap();
            // The part's own solid angle is in its density: the whole's share of it is not.
            let colors = map.colors(place);
            let corners = map.grid.corners(place.column, place.row);
            let (light, pdf) = (between(colors, place).luminance(), part.pdf(place, rest(corners)));
            (i as usize % map.parts.len(), f64::from(light / pdf))
        };
        let values: Vec<(usize, f64)> = (0..5000).map(value).collect();
        for part in 0..map.parts.len() {
            let own: Vec<f64> = values.iter().filter(|v| v.0 == part).map(|v| v.1).collect();
            let mean = own.iter().sum::<f64>() / own.len() as f64;
            let square =
                own.iter().map(|v| (v / mean - 1.0) * (v / mean - 1.0)).sum::<f64>() / own.len() as f64;
            let allowed = if map.grid.height < 10 { 0.3 } else { 0.05 };
            assert!(square.sqrt() < allowed, "{name}, part {part}: {}", square.sqrt());
        }
    }
}

/// A sun below the horizon of a receiver is never drawn; in sight, it takes its share.
#[test]
fn the_sun_is_drawn_where_it_shines() {
    let (_, image) = cases().into_iter().find(|c| c.0 == "sun").unwrap();
    let map = LatLong::new(image, false);
    assert_eq!(Chances::new(&map.regards, -UP).of(0), 0.0);
    assert!(Chances::new(&map.regards, UP).of(0) > 0.8);
    assert!(map.irradiance(UP) > 5.0 * map.irradiance(-UP));
}
