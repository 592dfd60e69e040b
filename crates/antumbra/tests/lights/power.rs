//! Sums over all draws: irradiance at a receiver, power through a sphere around the light.

use antumbra::light::{FarLights, Light, LightPoints};
use antumbra::math::{Rgb, World, real, warp};
use antumbra::receiver::Receiver;

use crate::{HOWS, draws, mean, numbers, receiver, receivers};

/// L cos θ / p of a draw, luminance.
fn carried(light: &Light, at: &Receiver, how: LightPoints, n: u32, seed: u32) -> (f64, f64) {
    mean(draws(light, at, how, n, seed).map(|s| {
        let value = |s: antumbra::light::LightSample| s.radiance.luminance() * s.wi.dot(at.ng).max(0.0);
        s.map_or(0.0, |s| f64::from(value(s)) / f64::from(s.density.weight()))
    }))
}

/// `irradiance` is E[L cos θ / p], by both ways of drawing, within five standard errors (α = 6·10⁻⁷ each) and the
/// roundings of f32; a disk that the horizon cuts may say up to 30 % of its whole more, a picture any number above 0.
#[test]
fn irradiance_is_what_the_samples_carry() {
    for (k, (kind, light)) in Light::examples().into_iter().enumerate() {
        for (r, at) in receivers().into_iter().enumerate() {
            for how in HOWS {
                let (e, se) = carried(&light, &at, how, 15_000, (31 * k + r) as u32);
                let said = f64::from(light.irradiance(&at));
                let told =
                    format!("{kind} #{k} from receiver {r}, {how:?}: {said}, samples carry {e} ± {se}");
                assert!(said >= 0.0 && (e == 0.0 || said > 0.0), "{told}");
                let picture = matches!(&light, Light::Environment(e) if e.picture.is_some());
                let slack = if kind == "Disk" { 0.05 * e.max(0.01) } else { 0.0 };
                let near = said - e <= 5.0 * se + 1e-5 * e + slack && e - said <= 5.0 * se + 1e-5 * e;
                assert!(picture || near, "{told}");
            }
        }
    }
}

/// The weight of `FarLights` is above 0 where `irradiance` is, and within a fifth of it: of a light that looks two thirds of a radian
/// across, the middle stands for the whole, to about the square of a third.
#[test]
fn weights_stand_in_for_irradiances() {
    for (kind, light) in Light::examples() {
        let one = [light.clone()];
        let far = FarLights::new(&one);
        for i in 0..2000 {
            let [a, b] = numbers(i, 21);
            let p = warp::sphere(numbers(i, 22)).0 * (0.2 + 12.0 * a * b);
            let at = receiver(p.to_array(), warp::sphere(numbers(i, 23)).0.to_array());
            let (mut weight, e) = ([0.0], light.irradiance(&at));
            far.weigh(&one, &at, &mut weight);
            let [weight] = weight;
            assert!(
                (weight - e).abs() <= 0.2 * e && (weight > 0.0 || e <= 0.0),
                "{kind} from {p}: {weight}, {e}"
            );
        }
    }
}

/// The power is what passes a sphere around the light, 4πR² E[E_in]; for lights at infinity what passes a disk from all
/// sides, πR² ∫L dω. Five standard errors; the offset of a spot with a range is 10⁻⁴ of it.
#[test]
fn power_is_what_passes_by() {
    for (k, (kind, light)) in Light::examples().into_iter().enumerate() {
        let (power, se) = match light.is_infinite() {
            true => through_disk(&light, 2.0, k as u32),
            false => through_sphere(&light, k as u32),
        };
        let said = f64::from(light.power(2.0));
        assert!((said - power).abs() <= 5.0 * se + 1e-3 * power, "{kind} #{k}: {said}, found {power} ± {se}");
    }
}

fn through_sphere(light: &Light, seed: u32) -> (f64, f64) {
    let bounds = light.bounds();
    let center = 0.5 * (bounds.low + bounds.high);
    let radius = (bounds.high - bounds.low).length() + 0.05;
    let (e, se) = mean((0..20_000).map(|i| {
        let out = warp::sphere(numbers(i, 1000 + seed)).0;
        let at = receiver((center + out * radius).to_array(), (-out).to_array());
        carried(light, &at, LightPoints::SolidAngle, 2, i.wrapping_mul(97) + seed).0
    }));
    let area = 4.0 * std::f64::consts::PI * f64::from(radius) * f64::from(radius);
    (area * e, area * se)
}

fn through_disk(light: &Light, radius: f64, seed: u32) -> (f64, f64) {
    let at = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    let below = receiver([0.0; 3], [0.0, -1.0, 0.0]);
    let light_of =
        |at: &Receiver| {
            mean(draws(light, at, LightPoints::Area, 100_000, seed).map(|s| {
                s.map_or(0.0, |s| f64::from(s.radiance.luminance()) / f64::from(s.density.weight()))
            }))
        };
    let area = std::f64::consts::PI * radius * radius;
    let (upper, se) = light_of(&at);
    // An environment is drawn from one hemisphere at a time.
    let (lower, se2) = if light.is_environment() { light_of(&below) } else { (0.0, 0.0) };
    (area * (upper + lower), area * (se * se + se2 * se2).sqrt())
}

/// Twice the light is twice everything, and both sides shine the same.
#[test]
fn back_and_front() {
    let (a, b, c) = (World::X, World::Y, World::Z);
    let front = antumbra::light::Triangle::new(a, b, c, Rgb::WHITE);
    let both = front.both_sides(true);
    let outside = receiver([2.0, 2.0, 2.0], [-1.0, -1.0, -1.0]);
    let inside = receiver([-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]);
    let e = |light: antumbra::light::Triangle, at: &Receiver| Light::from(light).irradiance(at);
    assert!(e(front, &outside) > 0.0 && e(front, &outside) == e(both, &outside));
    assert!(e(front, &inside) == 0.0 && e(both, &inside) > 0.0);
    // The sphere of directions, seen from inside an even sky.
    let sky = Light::from(antumbra::light::Environment::constant(Rgb::WHITE));
    assert_eq!(sky.irradiance(&inside), real::PI);
}
