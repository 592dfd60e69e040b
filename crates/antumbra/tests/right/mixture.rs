//! A blend as a BSDF: what its rays meet, taken together, is the mixture of its parts.

use antumbra::bsdf::{Facets, Metal};
use antumbra::math::hash::{hash3, unit_f32};
use antumbra::math::stats::{SphereBins, chi_square_test, normal_two_sided, sidak};
use antumbra::math::{DMat3, Local, Rgb, Vec3, real};
use antumbra::receiver::Receiver;
use antumbra::scene::{Look, Material, Ray, Scene};

use super::textured::{shot, square};

const RED: Rgb = Rgb([0.8, 0.2, 0.1]);
const BLUE: Rgb = Rgb([0.1, 0.3, 0.9]);

/// A ray onto the square from 50° beside its normal.
fn slanted(scene: &Scene) -> Ray {
    let d = Vec3::new(-0.766_044_4, 0.0, -0.642_787_6);
    shot(scene, Vec3::new(0.3, 0.6, 0.0) - d, d)
}

/// What it meets as the ray of this number.
fn met(scene: &Scene, ray: &Ray, number: u32) -> Receiver {
    scene.meet(&Ray { number, ..*ray }, &Look::default()).receiver
}

/// Over the numbers of rays, a blend is the mixture of its parts: each ray meets one of the two, to the last bit; the second
/// in the share of its weight; and directions are drawn from (1 − w) p₁ + w p₂. f, furnace, reciprocity and what happens at
/// grazing angles are then those of the parts. α = 10⁻³ over all pairs and both tests.
#[test]
fn a_blend_scatters_as_the_mixture_of_its_parts() {
    let (n, weight) = (40_000u32, 0.3f32);
    let rough = |alpha| Some(Facets::isotropic(alpha));
    let copper = Material::conductor(Metal::named("Cu").unwrap(), rough(0.3));
    let plastic = Material::plastic(RED, 1.5, rough(0.2), true);
    let glass = Material::dielectric(1.5, rough(0.4));
    let varnish = Material::metallic_roughness(BLUE, 0.0, 0.4);
    let pairs = [(Material::diffuse(RED), copper), (plastic, glass.clone()), (glass, varnish)];
    let least = sidak(1e-3, 2 * pairs.len());
    for (case, (first, second)) in pairs.into_iter().enumerate() {
        let name = format!("{:?} and {:?}", first.surface, second.surface);
        let parts = [first.clone(), second.clone()].map(|part| {
            let scene = square(DMat3::IDENTITY, |_| part);
            met(&scene, &slanted(&scene), 0).bsdf
        });
        let both = square(DMat3::IDENTITY, |builder| {
            let [first, second] = [first, second].map(|part| builder.material(part));
            Material::blend(first, second, weight)
        });
        let ray = slanted(&both);
        let drawn: Vec<_> = (0..n).map(|i| met(&both, &ray, hash3(i, 1, case as u32))).collect();
        assert!(drawn.iter().all(|met| parts.contains(&met.bsdf)), "{name}");
        let seconds = drawn.iter().filter(|met| met.bsdf == parts[1]).count();
        let (mean, spread) = (f64::from(n) * 0.3, (f64::from(n) * 0.3 * 0.7).sqrt());
        assert!(normal_two_sided((seconds as f64 - mean) / spread) >= least, "{name}: {seconds} of {n}");
        let wo = drawn[0].wo;
        for side in [1.0f32, -1.0] {
            let mut edges = vec![0.0];
            edges.extend((0..8).map(|k| std::f64::consts::PI * real::pow(0.5, f64::from(7 - k))));
            let bins = SphereBins::new(wo.mirrored().0 * Vec3::new(1.0, 1.0, side), edges, 8);
            let density = |d: Vec3| {
                let [p, q] = parts.map(|part| part.pdf(wo, Local(d)));
                if d.z * side > 0.0 { f64::from((1.0 - weight) * p + weight * q) } else { 0.0 }
            };
            let shares = bins.integrate(1e-5, density);
            let expected: Vec<f64> = shares.iter().map(|e| (e * f64::from(n)).max(0.0)).collect();
            let direction = |i: u32| {
                let u = [0, 1, 2].map(|k| unit_f32(hash3(i, k, 90 + case as u32)));
                let sample = drawn[i as usize].bsdf.sample(wo, u)?;
                (sample.wi.0.z * side > 0.0).then_some(sample.wi.0)
            };
            let found = chi_square_test(&bins.count(n, direction), &expected);
            assert!(found.p >= least, "{name}, side {side}: {found:?}");
        }
    }
}
