//! Laws of every sampler: range, purity, stratification where it is claimed, error slopes, no shared numbers.

use super::*;

const DIMENSIONS: [Use; 4] = [Use::Pixel, Use::LightPoint, Use::Direction, Use::Roulette];

fn samplers() -> Vec<(SamplerKind, AnySampler)> {
    let options = SamplerOptions { seed: 7, pairing: Pairing::TwoD, rotate: true };
    SamplerKind::ALL.iter().map(|k| (*k, AnySampler::new(*k, options))).collect()
}

#[test]
fn values_lie_in_the_unit_square_and_are_pure() {
    for (kind, sampler) in samplers() {
        for i in 0..2000 {
            let d = DIMENSIONS[i as usize % 4].at(i % 5);
            let a = sampler.pair(stream(1, i, 0), i, 49, d);
            assert!(a.iter().all(|v| (0.0..1.0).contains(v)), "{kind:?} {a:?}");
            assert_eq!(a, sampler.pair(stream(1, i, 0), i, 49, d));
        }
    }
}

#[test]
fn permutations_are_permutations() {
    for n in [1, 2, 3, 7, 16, 100, 129] {
        for key in 0..50 {
            let mut seen: Vec<u32> = (0..n).map(|i| permute(i, n, hash::mix32(key))).collect();
            seen.sort_unstable();
            assert_eq!(seen, (0..n).collect::<Vec<_>>());
        }
    }
}

/// How many cells of a grid hold exactly one of n points.
fn cells_met_once(points: &[[f32; 2]], columns: u32, rows: u32) -> usize {
    let mut count = vec![0; (columns * rows) as usize];
    for p in points {
        count[((p[1] * rows as f32) as u32 * columns + (p[0] * columns as f32) as u32) as usize] += 1;
    }
    count.iter().filter(|c| **c == 1).count()
}

#[test]
fn strata_are_met_once() {
    for (kind, sampler) in samplers() {
        if kind == SamplerKind::Random {
            continue;
        }
        for s in 0..20 {
            for d in DIMENSIONS {
                let points: Vec<_> = (0..64).map(|i| sampler.pair(stream(3, s, 0), i, 64, d.at(0))).collect();
                assert_eq!(cells_met_once(&points, 8, 8), 64, "{kind:?}");
                if kind == SamplerKind::Owen {
                    for k in 0..=6 {
                        assert_eq!(
                            cells_met_once(&points, 1 << k, 64 >> k),
                            64,
                            "elementary intervals 2^{k}"
                        );
                    }
                }
            }
        }
    }
}

/// Owen points in 4-D: of 256 points one lies in each of the 4⁴ cells of side 1/4, of 16 one in each of 2⁴; and each
/// half alone is met once in every elementary interval.
#[test]
fn the_four_d_point_fills_four_dimensions() {
    let options = SamplerOptions { seed: 0, pairing: Pairing::FourD, rotate: false };
    let sampler = AnySampler::new(SamplerKind::Owen, options);
    for s in 0..20 {
        for (n, side) in [(16u32, 2.0f32), (256, 4.0)] {
            let mut count = vec![0; n as usize];
            for i in 0..n {
                let a = sampler.pair(s, i, n, Use::Pixel.at(0));
                let b = sampler.pair(s, i, n, Use::LightPoint.at(0));
                let cell =
                    [a[0], a[1], b[0], b[1]].iter().fold(0, |c, v| c * side as usize + (v * side) as usize);
                count[cell] += 1;
            }
            assert!(count.iter().all(|c| *c == 1), "{n}");
        }
        let points: Vec<_> = (0..64).map(|i| sampler.pair(s, i, 64, Use::LightPoint.at(0))).collect();
        (0..=6).for_each(|k| assert_eq!(cells_met_once(&points, 1 << k, 64 >> k), 64));
    }
}

/// Variance of the mean of `f` over independent streams.
fn variance(sampler: &AnySampler, n: u32, f: impl Fn([f32; 2]) -> f64) -> f64 {
    let streams = 4000;
    let (mut sum, mut sum2) = (0.0, 0.0);
    for s in 0..streams {
        let mean =
            (0..n).map(|i| f(sampler.pair(stream(11, s, 0), i, n, Use::LightPoint.at(1)))).sum::<f64>()
                / f64::from(n);
        sum += mean;
        sum2 += mean * mean;
    }
    let m = f64::from(streams);
    (sum2 - sum * sum / m) / (m - 1.0)
}

/// CF37: constants of the convergence, each within 4 standard errors of a variance from 4000 streams (√(2/3999), 9 %).
#[test]
fn variances_are_those_of_cf37() {
    let options = SamplerOptions { seed: 7, pairing: Pairing::TwoD, rotate: true };
    let random = AnySampler::new(SamplerKind::Random, options);
    let stratified = AnySampler::new(SamplerKind::Stratified, options);
    let diagonal = |p: [f32; 2]| if p[0] + p[1] < 1.0 { 1.0 } else { 0.0 };
    let left = |p: [f32; 2]| f64::from(p[0]);
    for (name, got, truth) in [
        ("a", variance(&random, 16, diagonal), 0.015_625),
        ("b", variance(&stratified, 16, diagonal), 0.003_906_25),
        ("c", variance(&stratified, 256, diagonal), 6.103_515_625e-5),
        ("e", variance(&stratified, 256, left), 1.271_565_755_208e-6),
        ("f", variance(&random, 256, left), 0.000_325_520_833_333_3),
    ] {
        assert!((got / truth - 1.0).abs() < 0.09, "CF37{name}: {got} against {truth}");
    }
    let owen = AnySampler::new(SamplerKind::Owen, options);
    assert!(variance(&owen, 256, left) < 2.0 * 1.271_565_755_208e-6);
}
