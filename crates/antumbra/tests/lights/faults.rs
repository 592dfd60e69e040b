//! What is wrong with a light is found, and broken numbers never panic.

use std::sync::Arc;

use antumbra::light::{
    Directional, Disk, Environment, Light, LightPoints, Point, Rectangle, Sphere, Spot, Sun, Triangle,
};
use antumbra::math::{Rgb, World};
use antumbra::texture::{Image, Texels};

use crate::receivers;

const NAN: f32 = f32::NAN;
const W: Rgb = Rgb::WHITE;

fn broken() -> Vec<Light> {
    let at = World::new;
    let (lost, far) = (at(0.0, NAN, 0.0), at(f32::INFINITY, 0.0, 0.0));
    let texel = |v: f32| Image::new(2, 1, Texels::Float(vec![[1.0; 3], [v, 0.0, 0.0]])).unwrap();
    vec![
        Point { position: lost, intensity: W }.into(),
        Point { position: World::Y, intensity: Rgb::grey(-1.0) }.into(),
        Spot::new(far, World::Y, W, 0.1, 0.2, None).into(),
        Spot::new(World::Y, World::ZERO, W, 0.1, 0.2, None).into(),
        Spot::new(World::Y, World::Y, W, 0.3, 0.2, None).into(),
        Spot::new(World::Y, World::Y, W, 0.1, NAN, None).into(),
        Spot::new(World::Y, World::Y, W, 0.1, 0.2, Some(0.0)).into(),
        Directional::new(World::ZERO, W).into(),
        Directional::new(World::Y, Rgb::grey(NAN)).into(),
        Sun::new(lost, 0.1, W).into(),
        Sun::new(World::Y, 0.0, W).into(),
        Sun::new(World::Y, 2.0, W).into(),
        Triangle::new(World::X, World::X, World::Y, W).into(),
        Triangle::new(World::X, lost, World::Y, W).into(),
        Triangle::new(World::X, World::Z, World::Y, Rgb::grey(-1e-9)).into(),
        Rectangle::new(lost, World::X, World::Y, W).into(),
        Rectangle::new(World::X, World::X, World::X, W).into(),
        Rectangle::new(World::X, World::X, World::Y, Rgb::grey(f32::INFINITY)).into(),
        Disk::new(World::X, World::ZERO, 1.0, W).into(),
        Disk::new(World::X, World::Y, -1.0, W).into(),
        Disk::new(lost, World::Y, 1.0, W).into(),
        Sphere::new(World::X, 0.0, W).into(),
        Sphere::new(far, 1.0, W).into(),
        Environment::constant(Rgb::grey(NAN)).into(),
        Environment::image(Arc::new(texel(-1.0))).into(),
        Environment::image(Arc::new(texel(f32::INFINITY))).into(),
    ]
}

#[test]
fn faults_are_found() {
    for light in broken() {
        assert!(light.fault().is_some(), "{light:?}");
    }
    for (kind, light) in Light::examples() {
        assert_eq!(light.fault(), None, "{kind}");
    }
}

#[test]
fn broken_numbers_do_not_panic() {
    for light in broken() {
        for at in receivers() {
            for how in [LightPoints::SolidAngle, LightPoints::Area] {
                if let Some(s) = light.sample(&at, [0.4, 0.9], how) {
                    light.pdf(&at, s.wi, how);
                }
            }
            light.hit(at.p, World::Y);
            light.outline(&at, 0.5);
            light.irradiance(&at);
            light.bounds();
        }
    }
}

/// From the light itself, its plane, its middle and its rim nothing infinite comes.
#[test]
fn odd_places_give_finite_numbers() {
    for (kind, light) in Light::examples() {
        let (low, high) = (light.bounds().low, light.bounds().high);
        let middle = if light.is_infinite() { World::ZERO } else { 0.5 * (low + high) };
        for p in [middle, low, high, middle + World::X, middle + World::Y, middle + 1e-6 * World::Y] {
            if !p.is_finite() {
                continue;
            }
            let at = crate::receiver(p.to_array(), [0.0, 1.0, 0.0]);
            for i in 0..200 {
                for how in [LightPoints::SolidAngle, LightPoints::Area] {
                    let Some(s) = light.sample(&at, crate::numbers(i, 8), how) else { continue };
                    let pdf = light.pdf(&at, s.wi, how);
                    let fine = s.wi.is_finite() && s.radiance.is_finite() && s.density.weight() > 0.0;
                    assert!(
                        fine && s.density.weight().is_finite() && pdf >= 0.0,
                        "{kind} from {p}: {s:?} {pdf}"
                    );
                }
            }
            assert!(light.irradiance(&at).is_finite(), "{kind} from {p}");
        }
    }
}
