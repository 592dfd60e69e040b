//! `irradiance` against the table of closed forms, CF01–CF17 as far as lights alone express them.

use std::sync::Arc;

use antumbra::light::{
    Directional, Disk, Environment, Light, LightPoints, Point, Rectangle, Sphere, Spot, SpotEdge, Sun,
    Triangle,
};
use antumbra::math::{Rgb, World, closed, real};
use antumbra::receiver::Receiver;
use antumbra::texture::{Image, Texels};
use serde_json::Value;

use crate::{draws, mean, receiver};

/// The table; `None` (said once) where there is none, a failure under CI.
fn table() -> Option<Value> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data");
    let data = std::env::var("ANTUMBRA_DATA").unwrap_or_else(|_| beside.into());
    let path = std::path::Path::new(&data).join("../closed_forms.json");
    match std::fs::read_to_string(&path) {
        Ok(text) => Some(serde_json::from_str(&text).unwrap()),
        Err(e) => {
            assert!(std::env::var("CI").as_deref() != Ok("true"), "{}: {e}", path.display());
            println!("lights/closed_forms: skipped, no {}", path.display());
            None
        }
    }
}

fn number(v: &Value) -> f32 {
    v.as_f64().unwrap() as f32
}

fn vector(v: &Value) -> World {
    World::from_array(std::array::from_fn(|i| number(&v[i])))
}

/// The light of the table; `None` for kinds that are none of ours.
fn light(l: &Value, p: World) -> Option<Light> {
    let at = |name: &str| vector(&l[name]);
    let of = |name: &str| number(&l[name]);
    let grey = |name: &str| Rgb::grey(of(name));
    Some(match l["type"].as_str().unwrap() {
        "point" => Point { position: at("position"), intensity: grey("I") }.into(),
        "spot" => {
            let range = l.get("range").map(number);
            Spot::new(at("position"), at("direction"), grey("I"), of("inner"), of("outer"), range).into()
        }
        "directional" => Directional::new(at("dir_to_light"), grey("E0")).into(),
        "sun_disc" => Sun::new(at("dir_to_light"), of("half_angle_rad"), grey("Le")).into(),
        "disk" => Disk::new(at("center"), at("normal"), of("radius"), grey("Le")).into(),
        "rect" => Rectangle::new(at("corner"), at("u"), at("v"), grey("Le")).into(),
        "sphere" => Sphere::new(at("center"), of("radius"), grey("Le")).into(),
        // The table's triangles and polygons (a rectangle) face the receiver, whichever way they run.
        kind @ ("triangle" | "polygon") => {
            let corners = l["v"].as_array().unwrap();
            let [a, b, c] = [0, 1, corners.len() - 1].map(|i| vector(&corners[i]));
            let faces = (p - a).dot((b - a).cross(c - a)) > 0.0;
            let (b, c) = if faces { (b, c) } else { (c, b) };
            if kind == "triangle" {
                Triangle::new(a, b, c, grey("Le")).into()
            } else {
                Rectangle::new(a, b - a, c - a, grey("Le")).into()
            }
        }
        _ => return None,
    })
}

/// Numbers of the scene are rounded to f32 first: 10⁻⁵ relative, as the table suggests for f32. A sun of half-angle
/// 5·10⁻³ on the horizon moves by 6·10⁻⁸/5·10⁻³ of its width; the disk of CF05c says that of a polygon around it.
#[test]
fn irradiances() {
    let Some(table) = table() else { return };
    let rows = table["rows"].as_array().unwrap();
    let mut seen = 0;
    for case in
        rows.iter().filter(|r| r["id"].as_str() <= Some("CF11")).flat_map(|r| r["cases"].as_array().unwrap())
    {
        if case["quantity"] != "E" {
            continue;
        }
        let (p, n) = (&case["scene"]["receiver"]["p"], &case["scene"]["receiver"]["n"]);
        let at = receiver(vector(p).to_array(), vector(n).to_array());
        let Some(light) = light(&case["scene"]["lights"][0], at.p) else { continue };
        let (id, value) = (case["case"].as_str().unwrap(), case["value_f64"].as_f64().unwrap());
        let got = f64::from(light.irradiance(&at));
        let tolerance = match id {
            "CF03c" | "CF03d" => 1e-4,
            "CF05c" => 0.02,
            _ => 1e-5,
        };
        assert!((got - value).abs() <= tolerance * value, "{id}: {got} is not {value}");
        seen += 1;
    }
    assert_eq!(seen, 41, "cases of the table that these lights express");
    let spot = &rows.iter().find(|r| r["id"] == "CF02").unwrap()["cases"][4];
    let flux = light(&spot["params"], World::ZERO).unwrap().power(1.0);
    assert!((flux / number(&spot["value_f64"]) - 1.0).abs() < 1e-5, "CF02e: {flux}");
}

/// A picture of a sky given by direction.
fn sky(width: u32, height: u32, radiance: impl Fn(World) -> f32) -> Arc<Image> {
    let texel = |i: u32| {
        let u = ((i % width) as f32 + 0.5) / width as f32;
        let theta = real::PI * ((i / width) as f32 + 0.5) / height as f32;
        let phi = 2.0 * real::PI * u;
        let (sin, cos) = (real::sinf(theta), real::cosf(theta));
        [radiance(World::new(real::sinf(phi) * sin, cos, -real::cosf(phi) * sin)); 3]
    };
    Arc::new(Image::new(width, height, Texels::Float((0..width * height).map(texel).collect())).unwrap())
}

/// E by sampling, with its standard error.
fn sampled(light: &Light, at: &Receiver, seed: u32) -> (f64, f64) {
    mean(draws(light, at, LightPoints::SolidAngle, 100_000, seed).map(|s| {
        s.map_or(0.0, |s| f64::from(s.radiance.0[0] * s.wi.dot(at.ng).max(0.0) / s.density.weight()))
    }))
}

/// Skies as pictures of 256 × 128: sampled E within five standard errors and 2·10⁻³ (texels of 1.4°, a step at the
/// horizon); the harmonics within 3 % for the lobe, exact for what they hold.
#[test]
fn pictures_of_skies() {
    let m = World::new(0.6, 0.8, 0.0);
    let lobe = Light::from(Environment::image(sky(256, 128, |d| d.dot(m).max(0.0))));
    let smooth = World::new(0.5, 0.25, -0.1);
    let low = Light::from(Environment::image(sky(256, 128, |d| {
        1.0 + smooth.dot(d) + 0.3 * (1.5 * d.y * d.y - 0.5)
    })));
    for (k, n) in [[0.0, 1.0, 0.0], [1.0, 2.0, 2.0], [-0.3, 0.5, -0.8]].into_iter().enumerate() {
        let at = receiver([0.0; 3], n);
        let pi = std::f64::consts::PI;
        let of_lobe = closed::cosine_lobe(real::acos(f64::from(at.ng.dot(m))));
        let y = f64::from(at.ng.y);
        let of_low =
            pi + 2.0 * pi / 3.0 * f64::from(smooth.dot(at.ng)) + 0.3 * pi / 4.0 * (1.5 * y * y - 0.5);
        for (light, value, harmonics) in
            [(&lobe, of_lobe, 0.03 * closed::cosine_lobe(0.0)), (&low, of_low, 1e-3 * of_low)]
        {
            let (e, se) = sampled(light, &at, 60 + k as u32);
            assert!((e - value).abs() < 5.0 * se + 2e-3 * value, "{n:?}: {e} ± {se}, {value}");
            let said = f64::from(light.irradiance(&at));
            assert!((said - value).abs() < harmonics, "{n:?}: {said} is not {value}");
        }
    }
}

/// CF17b, c: one texel of a 64 × 32 map, as a patch of one radiance, to five standard errors; a map turned by a
/// quarter shows it a quarter further.
#[test]
fn one_texel() {
    // Elevation 45° is the border of row 8; azimuth from +x to +z, so φ = azimuth + 90°: column 16 + 1.
    let texels = (0..64 * 32).map(|i| [if i == 7 * 64 + 17 { 1.0 } else { 0.0 }; 3]).collect();
    let image = Arc::new(Image::new(64, 32, Texels::Float(texels)).unwrap());
    let patch = Environment::image(image).nearest(true);
    let up = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    let cases = [(up, &patch, 0.004788236894), (receiver([0.0; 3], [1.0, 0.0, 0.0]), &patch, 0.004298760172)];
    for (at, patch, value) in cases {
        let (e, se) = sampled(&Light::from(patch.clone()), &at, 70);
        assert!((e - value).abs() < 5.0 * se + 1e-5 * value, "{e} ± {se}, {value}");
    }
    // +x turned by a quarter about +y is −z.
    let turned = Light::from(patch.rotated(0.5 * real::PI));
    let (e, se) = sampled(&turned, &receiver([0.0; 3], [0.0, 0.0, -1.0]), 71);
    assert!((e - 0.004298760172).abs() < 5.0 * se + 1e-5 * e, "{e} ± {se}");
}

/// Mitsuba's spot: I (outer − a)/(outer − inner) between its angles, over r² = 4.
#[test]
fn a_linear_edge_is_linear_in_the_angle() {
    let [inner, outer] = [10.0f32, 40.0].map(f32::to_radians);
    let spot = Spot::new(World::ZERO, World::Z, Rgb::WHITE, inner, outer, None);
    let light = Light::from(Spot { edge: SpotEdge::Linear, ..spot });
    for (degrees, share) in [(0.0f32, 1.0), (9.0, 1.0), (17.5, 0.75), (25.0, 0.5), (38.5, 0.05), (41.0, 0.0)]
    {
        let toward = World::new(real::sinf(degrees.to_radians()), 0.0, real::cosf(degrees.to_radians()));
        let e = light.irradiance(&receiver((toward * 2.0).to_array(), (-toward).to_array()));
        // An angle from its cosine: ε/sin a, over 30°.
        assert!((4.0 * e - share).abs() < 1e-5, "{degrees}: {e}");
    }
}
