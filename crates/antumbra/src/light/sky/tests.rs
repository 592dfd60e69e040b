//! Skies: how bright they are, what they keep, what they refuse.

use antumbra_math::World;

use super::*;

fn luminance(texel: [f32; 3]) -> f64 {
    f64::from(Rgb(texel).luminance())
}

/// The texels and the grid of a picture.
fn texels(sky: &Sky, width: u32, with_sun: bool) -> (Vec<[f32; 3]>, Grid) {
    let image = sky.picture(width, with_sun).unwrap();
    let Texels::Float(texels) = image.texels else { panic!("float texels") };
    (texels, Grid { width: image.width, height: image.height })
}

/// Diffuse illuminance of level ground under a clear sky with the sun at 60° is 10 to 20 klx (IES, Recommended Practice
/// for the Calculation of Daylight Availability 1984: 0.8 + 15.5 sin^0.5 = 15 klx).
#[test]
fn illuminance_of_a_clear_sky() {
    let sky = Sky { elevation: 60f64.to_radians(), ..Sky::default() };
    let (texels, grid) = texels(&sky, 128, false);
    let level: f64 =
        texels.iter().enumerate().map(|(i, t)| luminance(*t) * grid.level_part(i as u32 / grid.width)).sum();
    let klux = 0.683 * level;
    assert!((10.0..20.0).contains(&klux), "{klux} klx");
}

/// The sun drawn into a picture has the energy of the disc, at every resolution, to the roundings of f32 texels.
#[test]
fn a_drawn_sun_keeps_its_energy() {
    for elevation in [0.0, 12.0, 45.0, 89.9, 90.0] {
        let sky = Sky { elevation: f64::to_radians(elevation), ..Sky::default() };
        let sun = sky.sun();
        let exact =
            solid_angle::cone(solid_angle::versin(sky.half_angle)) * f64::from(sun.radiance.luminance());
        for width in [8, 64, 512] {
            let ((with, grid), (without, _)) = (texels(&sky, width, true), texels(&sky, width, false));
            let added: f64 = (0..with.len())
                .map(|i| (luminance(with[i]) - luminance(without[i])) * grid.solid_angle(i as u32 / width))
                .sum();
            assert!((added / exact - 1.0).abs() < 1e-4, "{elevation}°, {width}: {added} {exact}");
        }
    }
}

/// The brightest texel of the dome lies in the sun's direction of the compass (below it, where the horizon glows); north is −z and the picture's left border.
#[test]
fn the_sun_stands_where_it_is_told() {
    let sky = Sky { elevation: 20f64.to_radians(), azimuth: 90f64.to_radians(), ..Sky::default() };
    assert!(
        (sky.to_sun() - DVec3::new(real::cos(sky.elevation), real::sin(sky.elevation), 0.0)).length() < 1e-12
    );
    let (texels, grid) = texels(&sky, 256, false);
    let brightest = (0..texels.len()).max_by(|a, b| luminance(texels[*a]).total_cmp(&luminance(texels[*b])));
    let i = brightest.unwrap() as u32;
    let d = grid.direction(f64::from(i % 256) + 0.5, f64::from(i / 256) + 0.5);
    assert!(d.x > 0.0 && (d.z / d.x).abs() < 0.02, "{d}");
    let [(_, dome), (name, sun)] = sky.lights(64).unwrap();
    assert!(dome.is_environment() && sun.is_environment() && sun.fault().is_none() && name == "sun");
    assert_eq!(sky.sun().to_light, World::from(sky.to_sun().as_vec3()).normalize());
}

#[test]
fn finite_and_not_negative_at_every_end() {
    for elevation in [0.0, 0.001, 45.0, 90.0] {
        for (turbidity, albedo) in [(1.0, 0.0), (1.0, 1.0), (5.5, 0.5), (10.0, 0.0), (10.0, 1.0)] {
            let elevation = f64::to_radians(elevation);
            let sky = Sky { elevation, turbidity, albedo, ..Sky::default() };
            let all = texels(&sky, 32, true).0;
            assert!(all.iter().flatten().all(|c| c.is_finite() && *c >= 0.0), "{sky:?}");
        }
    }
}

#[test]
fn wrong_numbers_are_named() {
    let fault = |sky: Sky| sky.picture(16, false).err().unwrap_or_default();
    let good = Sky::default();
    assert!(fault(Sky { elevation: -0.1, ..good }).contains("-5.73° above the horizon"));
    assert!(fault(Sky { turbidity: 0.5, ..good }).contains("turbidity 0.5"));
    assert!(fault(Sky { albedo: 2.0, ..good }).contains("albedo 2"));
    assert!(fault(Sky { azimuth: f64::NAN, ..good }).contains("azimuth"));
    assert!(fault(good).is_empty());
}

#[test]
fn words_come_back() {
    let words = "sky:elevation=39.8899:azimuth=194.34024:turbidity=3.5:albedo=0.2";
    let sky = Sky::from_words(words).unwrap().unwrap();
    assert_eq!((sky.turbidity, sky.words().as_str()), (3.5, words));
    assert_eq!(Sky::from_words("sky:").unwrap().unwrap(), Sky::default());
    assert!(Sky::from_words("sky").is_none());
    let wrong = |text: &str| Sky::from_words(text).unwrap().unwrap_err();
    assert!(wrong("sky:height=3").contains("no \"height\""));
    assert!(wrong("sky:elevation").contains("a number"));
    assert!(wrong("sky:elevation=-3").contains("-3.00°"));
}
