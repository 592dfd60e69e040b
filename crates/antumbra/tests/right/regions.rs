//! Umbra, penumbra, antumbra, lit: against similar triangles, at the edges of what lights are, and as maps.

use antumbra::estimator::EstimatorKind;
use antumbra::film::Planes;
use antumbra::light::{Disk, Environment, Point, Rectangle, Sphere};
use antumbra::math::{DVec3, Rgb, Vec3};
use antumbra::query::{Region, regions, visible_fraction};
use antumbra::render::render;
use antumbra::scene::{Camera, Material, Scene, SceneBuilder, builtin};
use antumbra::schedule::Flow;
use antumbra::sensor::Query;
use antumbra::settings::Settings;
use antumbra::trace::Shape;

use super::pictures::{look, plane, small};
use super::scenes::{parallelogram, receiver};

use Region::{Antumbra, Lit, Penumbra, Umbra};

fn seen(scene: &Scene, queries: &[Query], light: u32) -> Vec<Option<Region>> {
    regions(scene, queries, light, &Settings::default(), &mut |_| Flow::Continue)
}

/// A disk of light of this radius in y = 4 and a disk of radius 0.5 in y = `height` below its middle, floor at 0.
fn disks(radius: f32, height: f32) -> Scene {
    let mut builder = SceneBuilder::new("disks");
    let black = builder.material(Material::diffuse(Rgb::BLACK));
    builder.light("light", Disk::new(Vec3::Y * 4.0, -Vec3::Y, radius, Rgb::WHITE));
    let occluder = Shape::Disk { center: [0.0, height, 0.0], normal: [0.0, 1.0, 0.0], radius: 0.5 };
    builder.shape("occluder", occluder, black);
    builder.build().unwrap()
}

/// From a point of the floor at x, light and occluder are two circles in the plane of the occluder (similar triangles):
/// radius ρ about x (1 − h/H), and radius 0.5 about 0. Their borders say where the regions meet.
#[test]
fn borders_are_those_of_similar_triangles() {
    let mut found = [0; 4];
    for (radius, height) in [(0.3, 1.0), (0.3, 2.5), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0), (3.0, 3.0)] {
        let scene = disks(radius, height);
        let share = f64::from(height) / 4.0;
        let rho = f64::from(radius) * share;
        let points: Vec<f64> = (0..600).map(|i| f64::from(i) * 0.02).collect();
        let queries: Vec<Query> = points.iter().map(|x| receiver([*x, 0.0, 0.0], [0.0, 1.0, 0.0])).collect();
        for (x, got) in points.iter().zip(seen(&scene, &queries, 0)) {
            let c = x * (1.0 - share);
            let borders = [0.5 - rho, rho - 0.5, rho + 0.5];
            // 64 points on the outline know it to R (1 − cos(π/64)) = 0.0012 R; 64 inside it to a tenth.
            if borders.iter().any(|b| (c - b).abs() < 0.1 * rho.min(0.5)) {
                continue;
            }
            let truth = match c {
                c if c > borders[2] => Lit,
                c if c < borders[0] => Umbra,
                c if c < borders[1] => Antumbra,
                _ => Penumbra,
            };
            found[truth as usize] += 1;
            assert_eq!(got, Some(truth), "R = {radius}, h = {height}, x = {x}");
        }
    }
    println!("umbra, penumbra, antumbra, lit: {found:?}");
    assert!(found.iter().all(|n| *n > 20));
}

/// The edge of the umbra is as sharp as the outline: it is off by the arc between two of its points, not by the distance
/// of points inside.
#[test]
fn the_umbra_ends_where_the_outline_appears() {
    let (radius, height) = (0.6, 2.0);
    let scene = disks(radius, height);
    let end = (0.5 - 0.5 * f64::from(radius)) / 0.5;
    let step = 0.5 * f64::from(radius) * (1.0 - antumbra::math::real::cos(std::f64::consts::PI / 64.0)) / 0.5;
    let at = |x: f64| seen(&scene, &[receiver([x, 0.0, 0.0], [0.0, 1.0, 0.0])], 0)[0];
    assert_eq!([at(end - 1e-4), at(end + 1.5 * step + 1e-4)], [Some(Umbra), Some(Penumbra)]);
}

/// Lights without size, from behind, across the horizon, all around; many lights; each as the conventions say.
#[test]
fn every_kind_of_light_has_its_regions() {
    let mut builder = SceneBuilder::new("kinds");
    let black = builder.material(Material::diffuse(Rgb::BLACK));
    builder.light("point", Point { position: Vec3::Y * 3.0, intensity: Rgb::WHITE });
    let (u, v) = (Vec3::X, Vec3::Y);
    builder.light("wall", Rectangle::new(Vec3::new(-0.5, -1.0, -3.0), u, v * 2.0, Rgb::WHITE));
    builder.light("sky", Environment::constant(Rgb::WHITE));
    builder.object("lid", parallelogram(Vec3::new(-0.5, 1.0, -0.5), Vec3::X, Vec3::Z), black);
    let scene = builder.build().unwrap();
    let up = |x: f64| receiver([x, 0.0, 0.0], [0.0, 1.0, 0.0]);
    // The lid hides the point from the middle and part of the sky from everywhere near.
    assert_eq!(seen(&scene, &[up(0.0), up(5.0)], 0), [Some(Umbra), Some(Lit)]);
    assert_eq!(
        seen(&scene, &[up(0.0), receiver([0.0, 9.0, 0.0], [0.0, 1.0, 0.0])], 2),
        [Some(Penumbra), Some(Lit)]
    );
    // The horizon cuts the wall light in half; from behind it, and with all of it below the horizon, it does not shine.
    let behind = receiver([0.0, 0.0, -4.0], [0.0, 0.0, 1.0]);
    let away = receiver([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    assert_eq!(seen(&scene, &[up(0.0), behind, away], 1), [Some(Penumbra), None, None]);
    let toward = receiver([0.0, 0.0, 0.0], [0.0, 0.0, -1.0]);
    assert_eq!(seen(&scene, &[toward], 1), [Some(Lit)]);
}

/// A round light's far side is not seen, so in the open all of it is visible.
#[test]
fn a_round_light_in_the_open_is_lit() {
    let mut builder = SceneBuilder::new("ball");
    builder.light("ball", Sphere::new(Vec3::Y * 2.0, 0.7, Rgb::WHITE));
    let scene = builder.build().unwrap();
    let query = receiver([0.3, 0.0, 0.1], [0.0, 1.0, 0.0]);
    assert_eq!(seen(&scene, &[query], 0), [Some(Lit)]);
    let s = Settings { shadow_rays: 64, ..Settings::default() };
    let share = visible_fraction(&scene, &[query], 0, &s, &mut |_| Flow::Continue);
    assert_eq!((share.values[0][0], share.standard_error[0][0]), (1.0, 0.0));
}

/// Where the sun stands overhead, the moon brings the umbra when it is near and the antumbra when it is far.
#[test]
fn eclipses_are_total_or_annular() {
    let at = |distance: f64| {
        let set = [("distance".to_string(), distance)];
        let scene = builtin::build("eclipse", &set).unwrap().build().unwrap();
        seen(&scene, &[receiver([6371.001, 0.0, 0.0], [1.0, 0.0, 0.0])], 0)[0]
    };
    assert_eq!([at(356_500.0), at(406_700.0)], [Some(Umbra), Some(Antumbra)]);
}

/// The map of the shadow on the earth: the umbra is the cone r − x (R − r)/D, x behind the moon (similar triangles).
#[test]
fn the_umbra_on_the_earth_has_its_width() {
    let (earth, moon, sun, unit, distance) = (6371.0, 1737.4, 695_700.0, 149_597_870.7, 363_300.0);
    let set = [("distance".to_string(), distance)];
    let scene = builtin::build("eclipse", &set).unwrap().build().unwrap();
    let radius: f64 = moon - (distance - earth) * (sun - moon) / (unit - distance);
    let camera = Some("shadow".to_string());
    let s = Settings { camera, aov: Planes::REGIONS, region_points: 128, ..small(EstimatorKind::Area) };
    let picture = look(&scene, &Settings { viewing_rays: 1, size: Some([100, 100]), ..s });
    let umbra = plane(&picture, "regions").iter().filter(|c| **c == 0.0).count();
    let found = (umbra as f64 / std::f64::consts::PI).sqrt() * 800.0 / 100.0;
    println!("radius of the umbra {radius:.2} km, in the map {found:.2} km");
    // 296 pixels: a circle's area is known to about the root of its rim of 61, 2.6 %, so its radius to 1.3 %; 128 points
    // on the outline of the sun add R (1 − cos(π/128)) x / D = 0.5 km.
    assert!((found / radius - 1.0).abs() < 0.03);
    let rods = [("rods".to_string(), 0.0)];
    let scene = builtin::build("antumbra", &rods).unwrap().build().unwrap();
    let s = Settings {
        aov: Planes::REGIONS,
        viewing_rays: 1,
        light: vec!["key".into()],
        ..small(EstimatorKind::Area)
    };
    let picture = look(&scene, &Settings { size: Some([200, 120]), ..s });
    let rings = plane(&picture, "regions").iter().filter(|c| **c == 2.0).count();
    println!("{rings} pixels in an antumbra");
    assert!(rings > 20);
}

/// A picture has one map a light, of the middle of its pixels; the same for any noise, tile and number of threads.
#[test]
fn maps_lie_beside_the_picture() {
    let mut builder = SceneBuilder::new("floor");
    let grey = builder.material(Material::diffuse(Rgb::grey(0.5)));
    builder.object("floor", parallelogram(Vec3::new(-2.0, 0.0, 2.0), Vec3::X * 4.0, Vec3::Z * -4.0), grey);
    builder.shape("ball", Shape::Sphere { center: [0.0, 1.0, 0.0], radius: 0.4 }, grey);
    builder.light("key", Disk::new(Vec3::Y * 4.0, -Vec3::Y, 0.6, Rgb::grey(9.0)));
    let eye = DVec3::new(0.0, 3.0, 3.0);
    builder.cameras.push(Camera::perspective(eye, DVec3::new(0.0, 0.4, 0.0), 50.0));
    let one = builder.clone().build().unwrap();
    let aov = Planes::REGIONS;
    let s = Settings { aov, viewing_rays: 4, size: Some([50, 40]), ..small(EstimatorKind::Area) };
    let picture = look(&one, &s);
    let map = plane(&picture, "regions");
    let count = |code: f32| map.iter().filter(|c| **c == code).count();
    println!("none {}, umbra {}, penumbra {}, lit {}", count(-1.0), count(0.0), count(1.0), count(3.0));
    assert!([-1.0, 0.0, 1.0, 3.0].iter().all(|code| count(*code) > 10) && count(2.0) == 0);
    assert_eq!(map.len(), 50 * 40);
    assert!(picture.metadata.contains(&("antumbra.region-points".into(), "64".into())));
    let other = look(&one, &Settings { seed: 8, threads: 2, viewing_rays: 1, ..s.clone() });
    assert_eq!(map, plane(&other, "regions"));
    assert_eq!(picture.pixels, look(&one, &Settings { aov: Planes::NONE, ..s.clone() }).pixels);
    // A crop shows the same part of it.
    let part = look(&one, &Settings { crop: Some([10, 8, 20, 16]), ..s.clone() });
    let cut: Vec<f32> = (0..16).flat_map(|y| &map[(y + 8) * 50 + 10..(y + 8) * 50 + 30]).copied().collect();
    assert_eq!(plane(&part, "regions"), cut);

    builder.light("", Point { position: Vec3::new(1.0, 3.0, 1.0), intensity: Rgb::WHITE });
    builder.light("key", Point { position: Vec3::new(-1.0, 3.0, 1.0), intensity: Rgb::WHITE });
    let three = look(&builder.build().unwrap(), &s);
    let names: Vec<&str> = three.aovs.iter().map(|(name, ..)| name.as_str()).collect();
    assert_eq!(names, ["regions.key", "regions.light 2", "regions.2"]);
    assert_eq!(plane(&three, "regions.key"), map);
    assert!(plane(&three, "regions.light 2").iter().all(|c| [-1.0, 0.0, 3.0].contains(c)));
}

/// Stopped while it renders, a picture has no maps and says so.
#[test]
fn a_stopped_picture_has_no_maps() {
    let scene = disks(0.3, 1.0);
    let s = Settings { aov: Planes::REGIONS, viewing_rays: 64, ..small(EstimatorKind::Area) };
    let picture = render(&scene, &s, None, &mut |_| Flow::Stop).unwrap();
    assert!(picture.aovs.is_empty() && picture.messages.iter().any(|m| m.text.contains("left out")));
}
