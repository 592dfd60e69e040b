//! The laws of every way to choose among lights.

use antumbra::light::sampler::{Choose, LightSampler, Scratch};
use antumbra::light::{Light, LightPoints, Point};
use antumbra::math::hash::{hash2, unit_f32};
use antumbra::math::stats::{chi_square_test, sidak};
use antumbra::math::{Rgb, World, real};

use crate::{mean, numbers, receiver, receivers};

const RADIUS: f32 = 5.0;

fn all_lights() -> Vec<Light> {
    Light::examples().into_iter().map(|(_, light)| light).collect()
}

/// Σ p = 1 exactly (multiples of 2⁻²⁴), and every light that gives something can be chosen.
#[test]
fn probabilities_sum_to_one() {
    let lights = all_lights();
    for &kind in Choose::ALL {
        let sampler = LightSampler::new(kind, &lights, RADIUS);
        assert_eq!(sampler.kind(), kind);
        for at in receivers() {
            let mut scratch = Scratch::default();
            let chooser = sampler.prepare(&lights, &at, &mut scratch);
            let sum: f64 = (0..lights.len()).map(|k| f64::from(chooser.prob(k as u32))).sum();
            assert_eq!(sum, 1.0, "{kind:?}");
            for (k, light) in lights.iter().enumerate() {
                assert!(
                    light.irradiance(&at) == 0.0 || chooser.prob(k as u32) > 0.0,
                    "{kind:?} leaves out {k}"
                );
            }
        }
    }
}

/// χ² of the choices against their probabilities, α = 10⁻³ over all.
#[test]
fn frequency_is_probability() {
    const N: u32 = 50_000;
    let lights = all_lights();
    let each = sidak(1e-3, Choose::ALL.len() * receivers().len());
    for (i, &kind) in Choose::ALL.iter().enumerate() {
        let sampler = LightSampler::new(kind, &lights, RADIUS);
        for (r, at) in receivers().into_iter().enumerate() {
            let mut scratch = Scratch::default();
            let chooser = sampler.prepare(&lights, &at, &mut scratch);
            let mut counts = vec![0; lights.len()];
            for j in 0..N {
                let pick = chooser.pick(unit_f32(hash2(j, (10 * i + r) as u32))).unwrap();
                assert_eq!(pick.prob, chooser.prob(pick.light));
                counts[pick.light as usize] += 1;
            }
            let expected: Vec<f64> =
                (0..lights.len()).map(|k| f64::from(N) * f64::from(chooser.prob(k as u32))).collect();
            let found = chi_square_test(&counts, &expected);
            assert!(found.p > each, "{kind:?}, receiver {r}: {found:?}");
        }
    }
}

/// L cos θ / (p(light) p(ω)) has the same mean by every way, and the least variance by contribution.
#[test]
fn every_way_has_the_same_mean_and_contribution_the_least_variance() {
    let lights: Vec<Light> = all_lights().into_iter().filter(|l| !l.is_infinite()).collect();
    let at = receiver([0.0, 0.0, 0.0], [0.1, 1.0, 0.0]);
    let total: f64 = lights.iter().map(|l| f64::from(l.irradiance(&at))).sum();
    let errors: Vec<f64> = Choose::ALL
        .iter()
        .map(|&kind| {
            let sampler = LightSampler::new(kind, &lights, RADIUS);
            let mut scratch = Scratch::default();
            let chooser = sampler.prepare(&lights, &at, &mut scratch);
            let (e, se) = mean((0..100_000).map(|i| {
                let pick = chooser.pick(unit_f32(hash2(i, 77))).unwrap();
                let s = lights[pick.light as usize].sample(&at, numbers(i, 78), LightPoints::SolidAngle);
                let carried =
                    s.map_or(0.0, |s| s.radiance.luminance() * s.wi.dot(at.ng).max(0.0) / s.density.weight());
                f64::from(carried / pick.prob)
            }));
            // Five standard errors; the disk that the horizon cuts says a little more than it sends.
            assert!((e - total).abs() < 5.0 * se + 0.01 * total, "{kind:?}: {e} ± {se}, {total}");
            se
        })
        .collect();
    let of = |kind: Choose| errors[Choose::ALL.iter().position(|k| *k == kind).unwrap()];
    assert!(of(Choose::Contribution) < of(Choose::Power).min(of(Choose::Uniform)), "{errors:?}");
}

/// The thousand point lights of CF43: E and the variances of the three ways, exactly, from the probabilities.
#[test]
fn thousand_point_lights() {
    let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let lights: Vec<Light> = (0..1000)
        .map(|k| {
            let (r, phi) = (f64::from(k).sqrt() / 4.0, f64::from(k) * golden);
            let position = World::new((r * real::cos(phi)) as f32, 3.0, (r * real::sin(phi)) as f32);
            Point { position, intensity: Rgb::grey((k % 7 + 1) as f32) }.into()
        })
        .collect();
    let at = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    let e: Vec<f64> = lights.iter().map(|l| f64::from(l.irradiance(&at))).collect();
    let total: f64 = e.iter().sum();
    let variance = |kind: Choose| {
        let sampler = LightSampler::new(kind, &lights, RADIUS);
        let mut scratch = Scratch::default();
        let chooser = sampler.prepare(&lights, &at, &mut scratch);
        let square: f64 = e.iter().enumerate().map(|(k, e)| e * e / f64::from(chooser.prob(k as u32))).sum();
        square - total * total
    };
    // f32 positions, intensities and probabilities of 2⁻²⁴.
    let near = |got: f64, value: f64| assert!((got / value - 1.0).abs() < 1e-3, "{got} is not {value}");
    near(total, 82.35814050453);
    near(variance(Choose::Uniform), 10439.51013048);
    near(variance(Choose::Power), 7103.103556845);
    assert!(variance(Choose::Contribution).abs() < 1e-3 * total * total);
}

/// Nothing to choose, nothing that reaches, and more lights than contribution weighs.
#[test]
fn ends_of_the_range() {
    let mut scratch = Scratch::default();
    let at = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    for &kind in Choose::ALL {
        let sampler = LightSampler::new(kind, &[], RADIUS);
        assert_eq!(sampler.prepare(&[], &at, &mut scratch).pick(0.5), None);
    }
    let below = vec![Light::from(Point { position: -World::Y, intensity: Rgb::WHITE })];
    let sampler = LightSampler::new(Choose::Contribution, &below, RADIUS);
    assert_eq!(sampler.prepare(&below, &at, &mut scratch).pick(0.5), None);
    let many = vec![Light::from(Point { position: World::Y, intensity: Rgb::WHITE }); (1 << 20) + 1];
    assert_eq!(LightSampler::new(Choose::Contribution, &many, RADIUS).kind(), Choose::Power);
}

/// Among 10⁵ points at one place each has its share of their intensities, to two of the 2²⁴ steps: one that each has at
/// least, one of rounding; so 10⁵ of those steps of each share are spread evenly, 0.6 %.
#[test]
fn contribution_weighs_a_hundred_thousand() {
    let intensity = |k: u32| (k % 7) as f32;
    let lights: Vec<Light> = (0..100_000)
        .map(|k| Point { position: World::Y, intensity: Rgb::grey(intensity(k)) }.into())
        .collect();
    let at = receiver([0.0; 3], [0.0, 1.0, 0.0]);
    let sampler = LightSampler::new(Choose::Contribution, &lights, RADIUS);
    assert_eq!(sampler.kind(), Choose::Contribution);
    let mut scratch = Scratch::default();
    let chooser = sampler.prepare(&lights, &at, &mut scratch);
    let total: f64 = (0..100_000).map(|k| f64::from(intensity(k))).sum();
    let mut sum = 0.0;
    for k in 0..100_000 {
        let (p, share) = (f64::from(chooser.prob(k)), f64::from(intensity(k)) / total);
        assert!((p - share).abs() <= 2.0 / f64::from(1 << 24) + 0.006 * share, "light {k}: {p}, not {share}");
        sum += p;
    }
    assert_eq!(sum, 1.0);
}
