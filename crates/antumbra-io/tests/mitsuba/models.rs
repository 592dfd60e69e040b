//! principled and sunsky: models of many numbers.

use antumbra::bsdf::Principled;
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

/// Every number arrives under its own name; what lets nothing through is black from behind.
#[test]
fn principled_has_all_its_numbers() {
    let names =
        ["metallic", "anisotropic", "spec_tint", "sheen", "sheen_tint", "clearcoat", "clearcoat_gloss"];
    let inside: String =
        names.iter().enumerate().map(|(i, name)| float(name, 0.1 * (i + 1) as f32)).collect();
    let rest = float("flatness", 0.8) + &float("roughness", 0.9);
    let color = "<rgb name='base_color' value='0.25 0.64 1'/>";
    let (s, look) = principled(&(inside.clone() + &rest + color));
    let meant = Principled {
        base: Rgb([0.25, 0.64, 1.0]),
        metallic: 0.1,
        anisotropic: 0.2,
        spec_tint: 0.3,
        sheen: 0.4,
        sheen_tint: 0.5,
        clearcoat: 0.6,
        clearcoat_gloss: 0.7,
        flatness: 0.8,
        roughness: 0.9,
        ..Principled::default()
    };
    let Surface::Principled(told) = look.surface else { panic!("{look:?}") };
    // `specular` 0.5 is the index 1.5, to the last bits of a root.
    assert!((told.eta - 1.5).abs() < 1e-6, "{}", told.eta);
    // 0.1 · 3 and the like, written to the digits that f32 needs.
    let close = |a: f32, b: f32| (a - b).abs() < 1e-6;
    let numbers = |p: &Principled| {
        [p.metallic, p.anisotropic, p.spec_tint, p.sheen, p.sheen_tint, p.clearcoat, p.clearcoat_gloss]
    };
    assert!(numbers(&told).into_iter().zip(numbers(&meant)).all(|(a, b)| close(a, b)), "{told:?}");
    assert_eq!((told.base, told.flatness, told.roughness), (meant.base, meant.flatness, meant.roughness));
    assert!(look.one_sided && warnings(&s).iter().all(|w| !w.contains("principled")), "{:?}", warnings(&s));
    let (_, glass) = principled(&(float("spec_trans", 0.5) + &float("eta", 1.33)));
    assert!(!glass.one_sided);
    assert!(matches!(glass.surface, Surface::Principled(p) if p.eta == 1.33 && p.spec_trans == 0.5));
}

/// A picture says place by place what is metal, rough, and lets light through; of the other numbers its mean counts.
#[test]
fn principled_has_textures() {
    let field = |name: &str| {
        format!("<texture name='{name}' type='checkerboard'><rgb name='color0' value='0'/></texture>")
    };
    let inside = ["spec_trans", "metallic", "base_color", "sheen"].map(field).concat();
    let s = scene(&format!("<shape type='cube'><bsdf type='principled'>{inside}</bsdf></shape>"));
    let look = &s.materials[s.objects[0].material as usize];
    let said = "a texture on \"sheen\" of bsdf \"principled\": it counts by its mean";
    assert!(warnings(&s).iter().any(|w| w.ends_with(said)), "{:?}", warnings(&s));
    let red = |id: u32| s.textures[id as usize].at([0.2, 0.2])[0];
    assert_eq!(
        [look.blend, look.metallic.map(|c| c.texture), look.color].map(|id| red(id.unwrap())),
        [0.0; 3]
    );
    let Surface::Principled(told) = look.surface else { panic!("{look:?}") };
    // Half of Mitsuba's checkerboard is its second colour, 0.2.
    assert!((told.sheen - 0.1).abs() < 1e-6 && told.spec_trans == 1.0, "{told:?}");
    assert!(!look.one_sided);
}

/// Facets of two widths need to know where the tangents of a round shape lie: it becomes a mesh with texture coordinates.
#[test]
fn a_stretched_look_makes_a_mesh_of_a_ball() {
    let stretched = "<float name='alpha_u' value='0.1'/><float name='alpha_v' value='0.3'/>";
    for (bsdf, meshes) in [
        (format!("<bsdf type='principled'>{}</bsdf>", float("anisotropic", 0.5)), 1),
        (format!("<bsdf type='principled'>{}</bsdf>", float("sheen", 0.5)), 0),
        (format!("<bsdf type='roughconductor'>{stretched}</bsdf>"), 1),
        ("<bsdf type='roughconductor'/>".into(), 0),
    ] {
        let s = scene(&format!("<shape type='sphere'>{bsdf}</shape>"));
        assert_eq!(s.meshes.len(), meshes, "{bsdf}");
    }
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
