//! The planes beside the picture: parts that add up, and what is seen.

use antumbra::estimator::EstimatorKind;
use antumbra::film::Planes;
use antumbra::light::Rectangle;
use antumbra::math::{DVec3, Rgb, Vec3};
use antumbra::scene::{Camera, Material, SceneBuilder};
use antumbra::sensor::Viewing;
use antumbra::settings::Settings;

use super::judge::{Judge, Trial};
use super::pictures::{look, plane, small, whole};
use super::rooms;
use super::scenes::parallelogram;

/// Sums of the same f32 terms in f64, rounded once each: a few 2⁻²⁴ of the whole.
fn equal(a: f32, b: f32, of: f32) -> bool {
    (a - b).abs() <= 4.0 * f32::EPSILON * of.abs().max(1e-6)
}

#[test]
fn direct_indirect_and_emission_make_the_picture() {
    let scene = rooms::lit().build().unwrap();
    for kind in EstimatorKind::ALL.iter().filter(|k| **k != EstimatorKind::AmbientOcclusion) {
        let s = Settings { aov: Planes::ALL, viewing_rays: 8, bounces: 4, ..small(*kind) };
        let picture = look(&scene, &s);
        let [direct, indirect, emission] = ["direct", "indirect", "emission"].map(|n| plane(&picture, n));
        let mut lit = [0.0f32; 3];
        for (i, pixel) in picture.pixels.iter().flatten().enumerate() {
            let sum = direct[i] + indirect[i] + emission[i];
            assert!(equal(sum, *pixel, *pixel), "{kind:?} value {i}: {sum}, not {pixel}");
            [direct[i], indirect[i], emission[i]].iter().zip(&mut lit).for_each(|(p, all)| *all += p);
        }
        let paths = matches!(kind, EstimatorKind::Path | EstimatorKind::PathHemisphere);
        assert!(lit[0] > 0.0 && lit[2] > 0.0 && (lit[1] > 0.0) == paths, "{kind:?}: {lit:?}");
    }
}

/// What one bounce gives is the direct plane of many; none gives the emission plane.
#[test]
fn fewer_bounces_are_parts_of_more() {
    let scene = rooms::lit().build().unwrap();
    let of = |bounces| {
        look(&scene, &Settings { aov: Planes::ALL, viewing_rays: 8, bounces, ..small(EstimatorKind::Path) })
    };
    let (none, one, many) = (of(0), of(1), of(6));
    for (i, all) in many.pixels.iter().flatten().enumerate() {
        let [none, one] = [&none, &one].map(|p| *p.pixels.iter().flatten().nth(i).unwrap());
        let [direct, emission] = ["direct", "emission"].map(|n| plane(&many, n)[i]);
        assert!(equal(none, emission, *all) && equal(one, direct + emission, *all), "value {i}");
    }
}

/// Light as if nothing blocked: the plane is the picture with shadows off, in mean, whatever the estimator. α = 10⁻³.
#[test]
fn the_unshadowed_plane_is_the_picture_without_shadows() {
    let scene = rooms::lit().build().unwrap();
    let aov = Planes::UNSHADOWED.union(Planes::EMISSION);
    let mut judge = Judge::default();
    let viewing = Viewing::Centre;
    for kind in [EstimatorKind::Area, EstimatorKind::Mis, EstimatorKind::Hemisphere, EstimatorKind::Path] {
        let base = Settings { viewing, bounces: 1, aov, ..small(kind) };
        let off = look(&scene, &Settings { shadows: false, ..base.clone() });
        // The plane's own error is not known; it is that of light sampling without shadows, below that of any of them.
        let seen = look(&scene, &Settings { seed: 5, viewing_rays: 512, ..base });
        let n = f64::from(seen.width * seen.height);
        let sum =
            |name: &str| plane(&seen, name).iter().skip(1).step_by(3).map(|v| f64::from(*v)).sum::<f64>() / n;
        let truth = sum("unshadowed-direct") + sum("emission");
        let [estimate, error] = whole(&off, 1);
        let name = format!("{kind:?}");
        let dof = f64::INFINITY;
        judge.add(Trial { name, estimate, error: 1.5 * error, dof, truth, slack: 1e-5 * truth });
    }
    judge.verdict("the_unshadowed_plane_is_the_picture_without_shadows", 1e-3);
}

/// With the samples of the picture: `area` without shadows is its own unshadowed plane, bit for bit.
#[test]
fn the_unshadowed_plane_has_the_noise_of_the_picture() {
    let scene = rooms::lit().build().unwrap();
    let s = Settings { aov: Planes::ALL, shadows: false, viewing_rays: 8, ..small(EstimatorKind::Area) };
    let picture = look(&scene, &s);
    assert_eq!(plane(&picture, "unshadowed-direct"), plane(&picture, "direct"));
}

/// Normal, position, depth, albedo of a floor seen from above, and the visible fraction of its light: 1 in the open, 0
/// under a lid.
#[test]
fn planes_say_what_is_seen() {
    let mut builder = SceneBuilder::new("floor");
    let grey = builder.material(Material::diffuse(Rgb::new(0.2, 0.4, 0.6)));
    builder.object("floor", parallelogram(Vec3::new(-9.0, 0.5, 9.0), Vec3::X * 18.0, Vec3::Z * -18.0), grey);
    // The lid hides the light from the left half and is out of the camera's view.
    builder.object("lid", parallelogram(Vec3::new(-9.0, 1.5, -9.0), Vec3::X * 8.9, Vec3::Z * 18.0), grey);
    let light = Rectangle::new(Vec3::new(-0.1, 5.0, -0.1), Vec3::X * 0.2, Vec3::Z * 0.2, Rgb::WHITE);
    builder.light("light", light);
    let eye = DVec3::new(0.0, 1.2, 0.0);
    let down = Camera { up: DVec3::Z, ..Camera::perspective(eye, DVec3::ZERO, 40.0) };
    builder.cameras.push(down);
    let scene = builder.build().unwrap();
    let (aov, viewing) = (Planes::ALL, Viewing::Centre);
    let s = Settings { aov, viewing, viewing_rays: 16, shadow_rays: 2, ..small(EstimatorKind::Area) };
    let picture = look(&scene, &s);
    let near = |a: f32, b: f32| (a - b).abs() < 1e-6;
    let [normal, position, depth] = ["normal", "position", "depth"].map(|n| plane(&picture, n));
    let (albedo, visible) = (plane(&picture, "albedo"), plane(&picture, "visible-fraction"));
    for i in 0..depth.len() {
        let p = Vec3::from_slice(&position[3 * i..3 * i + 3]);
        assert!(near(p.y, 0.5) && near((p - eye.as_vec3()).length(), depth[i]), "{p} {}", depth[i]);
        assert!(Vec3::from_slice(&normal[3 * i..3 * i + 3]).abs_diff_eq(Vec3::Y, 1e-6));
        assert!(near(albedo[3 * i], 0.2) && near(albedo[3 * i + 1], 0.4) && near(albedo[3 * i + 2], 0.6));
        // The lid's edge at x = −0.1 in y = 1.5 throws a border at −0.128 ± 0.05 onto the floor.
        if p.x > -0.05 || p.x < -0.2 {
            assert_eq!(visible[i], if p.x > -0.05 { 1.0 } else { 0.0 }, "{p}");
        }
        assert_eq!(plane(&picture, "sample-count")[i], 16.0);
    }
    let error = picture.standard_error.as_ref().unwrap();
    assert_eq!(plane(&picture, "standard-error"), error.iter().flatten().copied().collect::<Vec<_>>());
}
