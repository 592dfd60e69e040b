//! Statistics of every kind of reflection, walked through `Bsdf::examples()`: χ² of `sample` against `pdf`, the mean
//! throughput against the integral of `eval`, and the energy of both. Seeds are fixed; each test's α is 0.001, shared
//! among its comparisons by Šidák's rule.

use antumbra::bsdf::{Bsdf, BsdfSample};
use antumbra::math::hash::{hash3, unit_f32};
use antumbra::math::stats::{SphereBins, chi_square_test, normal_two_sided, sidak};
use antumbra::math::{Local, Vec3, real};

const ALPHA: f64 = 1e-3;
const COSINES: [f32; 5] = [1.0, 0.9, 0.5, 0.1, 0.02];

/// Error that each integral over the sphere may have: bins × their tolerance, and f32 inside.
const QUADRATURE: f64 = 1e-3;

fn outgoing(cos: f32) -> Local {
    let (r, phi) = (real::safe_sqrt((1.0 - cos) * (1.0 + cos)), 0.7);
    Local(Vec3::new(r * real::cosf(phi), r * real::sinf(phi), cos))
}

fn numbers(i: u32, seed: u32) -> [f32; 3] {
    [0, 1, 2].map(|k| unit_f32(hash3(i, k, seed)))
}

/// Rings about the mirrored direction whose widths double, from half the sharpest lobe outwards.
fn bins(axis: Local) -> SphereBins {
    let mut edges = vec![0.0];
    edges.extend((0..13).map(|k| std::f64::consts::PI * real::pow(0.5, f64::from(12 - k))));
    SphereBins::new(axis.0, edges, 8)
}

/// The sides that a kind sends light to, each with the direction about which its rings lie.
fn sides(bsdf: &Bsdf, wo: Local) -> Vec<(f32, Local)> {
    let through = bsdf.index_below().map(|n| {
        let (x, y) = (-wo.0.x / n, -wo.0.y / n);
        (-1.0, Local(Vec3::new(x, y, -real::safe_sqrt(1.0 - x * x - y * y)).normalize()))
    });
    std::iter::once((1.0, wo.mirrored())).chain(through).collect()
}

fn integral(bsdf: &Bsdf, wo: Local, f: impl Fn(Local) -> f32) -> f64 {
    let of = |(side, axis): (f32, Local)| -> f64 {
        let all = bins(axis).integrate(1e-5, |d| if d.z * side > 0.0 { f64::from(f(Local(d))) } else { 0.0 });
        all[..all.len() - 1].iter().sum()
    };
    sides(bsdf, wo).into_iter().map(of).sum()
}

/// ∫ f cos dω of one component.
fn reflected(bsdf: &Bsdf, wo: Local, component: usize) -> f64 {
    integral(bsdf, wo, |wi| bsdf.eval(wo, wi).0[component] * wi.cos().abs())
}

/// Every example that spreads light, from every cosine.
fn cases() -> Vec<(&'static str, Bsdf, Local)> {
    let spread = Bsdf::examples().into_iter().filter(|(_, b)| !b.is_delta());
    spread.flat_map(|(name, b)| COSINES.map(|c| (name, b, outgoing(c)))).collect()
}

/// A sample, unless it leaves into the single direction of a coat.
fn spread(bsdf: &Bsdf, wo: Local, u: [f32; 3]) -> Option<BsdfSample> {
    bsdf.sample(wo, u).filter(|s| !s.density.is_delta())
}

#[test]
fn samples_follow_the_pdf() {
    let n = 40_000;
    let cases = cases();
    let least = sidak(ALPHA, cases.iter().map(|(_, b, wo)| sides(b, *wo).len()).sum());
    for (case, (name, bsdf, wo)) in cases.iter().enumerate() {
        for (side, axis) in sides(bsdf, *wo) {
            let here = |d: &Vec3| d.z * side > 0.0;
            let bins = bins(axis);
            let density = |d: Vec3| if here(&d) { f64::from(bsdf.pdf(*wo, Local(d))) } else { 0.0 };
            let shares = bins.integrate(1e-5, density);
            let expected: Vec<f64> = shares.iter().map(|e| (e * f64::from(n)).max(0.0)).collect();
            let drawn = |i: u32| spread(bsdf, *wo, numbers(i, case as u32)).map(|s| s.wi.0).filter(here);
            let found = chi_square_test(&bins.count(n, drawn), &expected);
            assert!(found.p >= least, "{name} {bsdf:?} {wo:?} {side}: {found:?}");
        }
    }
}

#[test]
fn the_pdf_integrates_to_at_most_one() {
    for (name, bsdf, wo) in cases() {
        let total = integral(&bsdf, wo, |wi| bsdf.pdf(wo, wi));
        // A polished coat mirrors nearly all at grazing angles: that part has no density.
        let least = if matches!(bsdf, Bsdf::Plastic(_) | Bsdf::CoatedConductor(_)) { 0.0 } else { 0.3 };
        assert!(total <= 1.0 + QUADRATURE && total >= least, "{name} {bsdf:?} {wo:?}: {total}");
    }
}

#[test]
fn mean_throughput_is_what_eval_reflects() {
    let n = 40_000u32;
    let cases = cases();
    let least = sidak(ALPHA, 3 * cases.len());
    for (case, (name, bsdf, wo)) in cases.iter().enumerate() {
        for c in 0..3 {
            let mut sums = (0.0, 0.0);
            for i in 0..n {
                let draw = spread(bsdf, *wo, numbers(i, 1000 + case as u32));
                let t = f64::from(draw.map_or(0.0, |s| s.throughput.0[c]));
                sums = (sums.0 + t, sums.1 + t * t);
            }
            let n = f64::from(n);
            let mean = sums.0 / n;
            let variance = (sums.1 / n - mean * mean).max(0.0) / (n - 1.0);
            let truth = reflected(bsdf, *wo, c);
            let error = (variance + QUADRATURE * QUADRATURE / 9.0).sqrt();
            let p = normal_two_sided((mean - truth) / error);
            assert!(p >= least, "{name} {bsdf:?} {wo:?}: {mean} ± {error}, {truth}");
        }
    }
}
