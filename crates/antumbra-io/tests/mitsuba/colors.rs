//! Spectra as colours.

use antumbra::light::{Environment, Light};
use antumbra::math::Rgb;
use antumbra::scene::Surface;

use crate::{refused, scene, warnings, with};

/// The albedo of a cube, and the radiance of a sky, of one spectrum.
fn seen(spectrum: &str) -> (Rgb, Rgb) {
    (matter(spectrum), light(spectrum))
}

fn matter(spectrum: &str) -> Rgb {
    let value = spectrum.replace("NAME", "reflectance");
    let s = scene(&format!("<shape type='cube'><bsdf type='diffuse'>{value}</bsdf></shape>"));
    assert!(
        warnings(&s).iter().all(|w| w.contains("no emitter") || w.contains("no sensor")),
        "{:?}",
        warnings(&s)
    );
    let Surface::Diffuse { albedo } = s.materials[s.objects[0].material as usize].surface else { panic!() };
    albedo
}

fn light(spectrum: &str) -> Rgb {
    let value = spectrum.replace("NAME", "radiance");
    let s = scene(&format!("<shape type='cube'/><emitter type='constant'>{value}</emitter>"));
    assert!(warnings(&s).iter().all(|w| w.contains("no sensor")), "{:?}", warnings(&s));
    let Light::Environment(Environment { radiance, .. }) = s.lights[0].1 else { panic!() };
    radiance
}

fn close(a: Rgb, b: Rgb, within: f32) -> bool {
    a.0.iter().zip(b.0).all(|(a, b)| (a - b).abs() <= within)
}

/// The linear sRGB of x = y = 1/3 and luminance 1, by the matrix of IEC 61966-2-1; its rows keep seven digits.
const EQUAL: Rgb = Rgb([1.204_794, 0.948_292, 0.908_916]);

#[test]
fn a_constant_spectrum_is_white_on_matter_and_equal_energy_as_light() {
    for one in [
        "<spectrum name='NAME' value='0.5'/>",
        "<spectrum name='NAME' value='360:0.5, 830:0.5'/>",
        "<spectrum name='NAME' type='regular'><string name='values' value='0.5, 0.5, 0.5'/></spectrum>",
        "<spectrum name='NAME' type='irregular'><string name='wavelengths' value='360, 500, 830'/>\
         <string name='values' value='0.5, 0.5, 0.5'/></spectrum>",
    ] {
        let (surface, sky) = seen(one);
        // f32, and the table's own white is equal energy to 3·10⁻⁴.
        assert!(close(surface, Rgb::grey(0.5), 1e-6), "{one} {surface:?}");
        assert!(close(sky, EQUAL * 0.5, 1.5e-4), "{one} {sky:?}");
    }
    for white in [
        "<spectrum name='NAME' type='d65'/>",
        "<spectrum name='NAME' type='uniform'/>",
        "<spectrum name='NAME' type='rawconstant'/>",
        "<rgb name='NAME' value='1'/>",
        "<float name='NAME' value='1'/>",
    ] {
        assert_eq!(seen(white), (Rgb::WHITE, Rgb::WHITE), "{white}");
    }
    let color = "<spectrum name='NAME' type='srgb'><rgb name='color' value='0.2 0.3 0.4'/></spectrum>";
    assert_eq!(matter(color), Rgb([0.2, 0.3, 0.4]));
}

/// The ways of writing a spectrum down agree.
#[test]
fn pairs_lists_and_files_are_one() {
    let pairs = "<spectrum name='NAME' value='400:0.2 500:0.8, 600:0.3 700:0.7'/>";
    let regular = "<texture name='NAME' type='regular'><float name='wavelength_min' value='400'/>\
        <float name='wavelength_max' value='700'/><string name='values' value='0.2 0.8 0.3 0.7'/></texture>";
    let irregular = "<spectrum name='NAME' type='irregular'><string name='wavelengths' value='400 500 600 700'/>\
        <string name='values' value='0.2 0.8 0.3 0.7'/></spectrum>";
    assert_eq!(seen(pairs), seen(regular));
    assert_eq!(seen(pairs), seen(irregular));
    let s = with(
        "<shape type='cube'><bsdf type='diffuse'><spectrum name='reflectance' filename='a.spd'/></bsdf></shape>",
        &[("a.spd", "# nm, value\n400 0.2\n500 0.8 # peak\n600 0.3\n700 0.7\n")],
    )
    .unwrap();
    let Surface::Diffuse { albedo } = s.materials[s.objects[0].material as usize].surface else { panic!() };
    assert_eq!(albedo, matter(pairs));
}

/// A hotter body is bluer and brighter.
#[test]
fn a_black_body_has_its_temperature() {
    let of = |kelvin: u32| {
        let body = "<spectrum name='NAME' type='blackbody'><float name='temperature' value='K'/></spectrum>";
        light(&body.replace('K', &kelvin.to_string()))
    };
    let (cold, warm, hot) = (of(2000), of(5000), of(10000));
    assert!(cold.luminance() < warm.luminance() && warm.luminance() < hot.luminance());
    let blueness = |c: Rgb| c.0[2] / c.0[0];
    assert!(blueness(cold) < blueness(warm) && blueness(warm) < 1.0 && blueness(hot) > 1.0);
    // Planck's law at 555 nm is 1.24·10⁴ W·m⁻²·sr⁻¹·nm⁻¹; what the observer sees is near it where the curve is flat.
    assert!((warm.luminance() / 1.24e4 - 1.0).abs() < 0.03, "{warm:?}");
}

#[test]
fn a_broken_spectrum_says_what_is_wrong() {
    let bsdf =
        |value: &str| refused(&format!("<shape type='cube'><bsdf type='diffuse'>{value}</bsdf></shape>"));
    for (value, told) in [
        ("<spectrum name='reflectance' value='500:1, 400:1'/>", "must grow"),
        ("<spectrum name='reflectance' value='500:1, 600'/>", "a number is needed"),
        ("<spectrum name='reflectance' type='regular'/>", "no <string> \"values\""),
        (
            "<spectrum name='reflectance' type='irregular'><string name='wavelengths' value='1,2'/>\
             <string name='values' value='1'/></spectrum>",
            "2 wavelengths and 1 values",
        ),
        ("<spectrum name='reflectance' type='blackbody'/>", "a black body is light"),
        ("<spectrum name='reflectance' filename='fold.ply'/>", "a number is needed"),
    ] {
        assert!(bsdf(value).contains(told), "{value}: {}", bsdf(value));
    }
}

/// By wavelengths: one alone says nothing of those beside it.
#[test]
fn a_spectrum_has_two_samples_or_more() {
    for one in [
        "<spectrum name='reflectance' value='550:0.5'/>",
        "<spectrum name='reflectance' type='irregular'><string name='wavelengths' value='550'/>\
         <string name='values' value='0.5'/></spectrum>",
    ] {
        let said = refused(&format!("<shape type='cube'><bsdf type='diffuse'>{one}</bsdf></shape>"));
        assert!(said.contains("from 2 to 65536"), "{said}");
    }
}

/// Planck's law falls to the law of Rayleigh and Jeans: twice as hot, twice the light, to the digits of f32.
#[test]
fn a_very_hot_black_body_shines_with_its_temperature() {
    let [one, two] = ["1e20", "2e20"].map(|kelvin| {
        light(&format!(
            "<spectrum name='NAME' type='blackbody'><float name='temperature' value='{kelvin}'/></spectrum>"
        ))
    });
    assert!((0..3).all(|c| (two.0[c] / one.0[c] - 2.0).abs() < 1e-6), "{one:?} {two:?}");
}
