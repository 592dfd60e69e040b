//! principled and sunsky: models of many numbers.

use antumbra::light::Light;
use antumbra::math::{Rgb, Vec3, real};
use antumbra::scene::{Material, SceneBuilder, Surface};

use crate::{look_of, refused, scene, warnings};

fn principled(inside: &str) -> (SceneBuilder, Material) {
    look_of(&format!("<bsdf type='principled'>{inside}</bsdf>"))
}

fn float(name: &str, value: f32) -> String {
    format!("<float name='{name}' value='{value}'/>")
}

/// (1−m)(1−t) diffuse, m metal, (1−m)t glass: whatever a blend makes of it, these are the shares.
#[test]
fn shares_of_a_principled_look_are_those_of_its_numbers() {
    for (m, t) in [(0.0, 0.25), (0.2, 0.25), (0.5, 0.5), (0.75, 0.9)] {
        let (s, look) = principled(&(float("metallic", m) + &float("spec_trans", t)));
        let Surface::Blend { first, second, weight } = look.surface else { panic!("{look:?}") };
        let part = |id: u32| &s.materials[id as usize];
        let Surface::MetallicRoughness { metallic, .. } = part(first).surface else { panic!() };
        let shares = [(1.0 - weight) * (1.0 - metallic), (1.0 - weight) * metallic, weight];
        let meant = [(1.0 - m) * (1.0 - t), m, (1.0 - m) * t];
        // Three roundings of numbers below 1.
        assert!(shares.iter().zip(meant).all(|(a, b)| (a - b).abs() < 3e-7), "{shares:?} {meant:?}");
        assert!(part(first).one_sided && !part(second).one_sided);
    }
    assert!(matches!(principled("").1.surface, Surface::MetallicRoughness { .. }));
    // Metal lets nothing through.
    let (_, metal) = principled(&(float("metallic", 1.0) + &float("spec_trans", 1.0)));
    assert!(matches!(metal.surface, Surface::MetallicRoughness { metallic: 1.0, .. }));
}

/// `specular` and `eta` say the same thing: 0.5 is the index 1.5, whose F0 is 0.04.
#[test]
fn specular_is_an_index_of_refraction() {
    for inside in [float("specular", 0.5), float("eta", 1.5)] {
        let (_, look) = principled(&inside);
        assert!(matches!(look.surface, Surface::MetallicRoughness { f0, .. } if (f0 - 0.04).abs() < 1e-6));
        let color = "<rgb name='base_color' value='0.25 0.64 1'/>";
        let smooth = float("spec_trans", 1.0) + &float("roughness", 0.0);
        let (_, glass) = principled(&(inside + &smooth + color));
        let Surface::Dielectric(glass) = glass.surface else { panic!("{glass:?}") };
        // Through both sides light takes the base colour once.
        assert_eq!(glass.transmittance, Rgb([0.5, 0.8, 1.0]));
    }
}

#[test]
fn what_principled_leaves_out_is_named_once_with_its_line() {
    let inside = float("sheen", 0.5)
        + &float("clearcoat", 1.0)
        + &float("clearcoat_gloss", 0.5)
        + &float("flatness", 0.0);
    let s = scene(&format!("<shape type='cube'><bsdf type='principled'>{inside}</bsdf></shape>"));
    let said: Vec<_> = warnings(&s).into_iter().filter(|w| w.contains("principled")).collect();
    assert_eq!(
        said,
        ["line 2, column 20: \"sheen\", \"clearcoat\" of bsdf \"principled\" left out: drawn without"]
    );
}

/// Radiance from a direction, the sun apart.
fn sky(inside: &str) -> (impl Fn(Vec3) -> Rgb + use<>, Option<(Vec3, f32, Rgb)>) {
    let s = scene(&format!("<shape type='cube'/><emitter type='sunsky'>{inside}</emitter>"));
    assert!(warnings(&s).iter().all(|w| w.starts_with(": no ")), "{:?}", warnings(&s));
    let sun = s.lights.iter().find_map(|l| match &l.1 {
        Light::Sun(sun) => Some((sun.to_light, sun.half_angle, sun.radiance)),
        _ => None,
    });
    let dome = s.lights.iter().find_map(|l| match &l.1 {
        Light::Environment(dome) => Some(dome.clone()),
        _ => None,
    });
    (move |d: Vec3| dome.as_ref().map_or(Rgb::BLACK, |dome| dome.radiance_from(d.normalize())), sun)
}

#[test]
fn a_sunsky_stands_on_z_and_turns_with_its_transform() {
    let sun = "<vector name='sun_direction' value='0, 0.6, 0.8'/>";
    let (upright, place) = sky(sun);
    let (to_sun, half_angle, radiance) = place.unwrap();
    assert!((to_sun - Vec3::new(0.0, 0.6, 0.8)).length() < 1e-6);
    assert!((half_angle - 0.2669f32.to_radians()).abs() < 1e-6);
    assert!(upright(Vec3::new(0.0, 0.6, 0.7)).luminance() > upright(Vec3::new(0.0, -0.6, 0.7)).luminance());
    assert_eq!(upright(Vec3::new(0.3, 0.0, -0.9)), Rgb::BLACK);
    // y up: what was toward z comes from y. The direction of the sun is that of the world.
    let turn = "<transform name='to_world'><rotate x='1' angle='-90'/></transform>";
    let there = "<vector name='sun_direction' value='0, 0.8, -0.6'/>";
    let (turned, place) = sky(&format!("{there}{turn}"));
    assert!((place.unwrap().0 - Vec3::new(0.0, 0.8, -0.6)).length() < 1e-6);
    for (x, y, z) in [(0.1, 0.5, 0.6), (-0.7, 0.1, 0.3), (0.2, -0.8, 0.4)] {
        let (a, b) = (upright(Vec3::new(x, y, z)), turned(Vec3::new(x, z, -y)));
        // The look-up in the same picture, from directions rounded to f32.
        assert!(a.0.iter().zip(b.0).all(|(a, b)| (a - b).abs() < 1e-4 * a), "{a:?} {b:?}");
    }
    // A wider sun gives the same light; scales are factors.
    let (_, wide) = sky(&format!("{sun}{}{}", float("sun_aperture", 5.338), float("sun_scale", 2.0)));
    let (_, wide_angle, dim) = wide.unwrap();
    let light = |angle: f32, l: Rgb| f64::from(l.luminance()) * (1.0 - real::cos(f64::from(angle)));
    assert!((light(wide_angle, dim) / light(half_angle, radiance) - 2.0).abs() < 1e-3);
    let (dark, none) = sky(&format!("{sun}{}{}", float("sky_scale", 0.0), float("sun_scale", 0.0)));
    assert!(none.is_none() && dark(Vec3::Z) == Rgb::BLACK);
}

/// The sun by place and time: from the east to the west as the day goes on in Paris.
#[test]
fn a_sunsky_knows_the_hour() {
    let at = |hour: u32| {
        let place = float("latitude", 48.86) + &float("longitude", 2.35) + &float("timezone", 2.0);
        let day = "<integer name='year' value='2026'/><integer name='month' value='6'/><integer name='day' value='21'/>";
        let time = format!("<float name='hour' value='{hour}'/><float name='minute' value='30'/>");
        sky(&format!("{place}{day}{time}{}", float("sky_scale", 0.0))).1.unwrap().0
    };
    // x is south, y west; heights of NOAA's solar calculator, to a tenth of a degree.
    let (morning, evening) = (at(9), at(18));
    let height = |d: Vec3| real::asin(f64::from(d.z)).to_degrees();
    assert!((height(morning) - 33.3).abs() < 0.1 && morning.y < -0.8, "{morning}");
    assert!((height(evening) - 30.8).abs() < 0.1 && evening.y > 0.8, "{evening}");
    let said = refused(
        "<shape type='cube'/><emitter type='sunsky'><vector name='sun_direction' value='1 0 -1'/></emitter>",
    );
    assert!(said.contains("above the horizon"), "{said}");
}
