//! Statistics for tests: tail probabilities, the χ² test of counts, bins on the sphere. Not used by rendering.
//!
//! How a test uses it: fix the seed, state one α for the whole test, judge each of its n comparisons at [`sidak`]`(α, n)`.

mod sphere;
mod tails;

pub use sphere::{SphereBins, integrate2};
pub use tails::{beta_i, chi_square_tail, gamma_q, normal_two_sided, student_t_two_sided};

/// The level at which each of `n` independent comparisons is judged, so that all hold with probability 1−α:
/// 1 − (1−α)^(1/n) (Šidák 1967).
pub fn sidak(alpha: f64, n: usize) -> f64 {
    -libm::expm1(libm::log1p(-alpha) / n.max(1) as f64)
}

/// What a χ² test found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChiSquare {
    /// Σ (observed − expected)² / expected over the pooled bins.
    pub statistic: f64,
    /// Pooled bins − 1.
    pub dof: usize,
    /// Probability of a statistic at least this large if the counts follow the expectation.
    pub p: f64,
}

/// Pearson's χ² test of counts against expected counts (same total, so bins − 1 degrees of freedom).
///
/// Bins are pooled in ascending order of expectation until each holds at least 5 (Cochran's rule). What remains
/// at the end joins the largest bin. A single pooled bin says nothing: p = 1.
pub fn chi_square_test(observed: &[u64], expected: &[f64]) -> ChiSquare {
    let mut bins: Vec<(f64, u64)> = expected.iter().copied().zip(observed.iter().copied()).collect();
    bins.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut pooled: Vec<(f64, f64)> = Vec::new();
    let (mut e, mut o) = (0.0, 0.0);
    for (expect, seen) in bins {
        e += expect;
        o += seen as f64;
        if e >= 5.0 {
            pooled.push((e, o));
            (e, o) = (0.0, 0.0);
        }
    }
    match pooled.last_mut() {
        Some(last) => *last = (last.0 + e, last.1 + o),
        None => pooled.push((e, o)),
    }
    let dof = pooled.len() - 1;
    let statistic = pooled.iter().map(|(e, o)| if *e > 0.0 { (o - e) * (o - e) / e } else { 0.0 }).sum();
    let p = if dof == 0 { 1.0 } else { chi_square_tail(statistic, dof as f64) };
    ChiSquare { statistic, dof, p }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sidak_inverts() {
        let each = sidak(0.01, 100);
        assert!((1.0 - (1.0 - each).powi(100) - 0.01).abs() < 1e-12, "rounding of a hundred products");
        assert!((sidak(0.01, 1) - 0.01).abs() < 1e-15);
    }

    #[test]
    fn small_bins_are_pooled() {
        let r = chi_square_test(&[1, 2, 3, 4, 90], &[2.0, 2.0, 2.0, 4.0, 90.0]);
        // {2, 2, 2} makes 6; {4, 90} makes 94.
        assert_eq!(r.dof, 1);
        assert_eq!(r.statistic, 0.0);
        assert_eq!(r.p, 1.0);
    }

    #[test]
    fn a_wrong_distribution_is_found() {
        assert!(chi_square_test(&[600, 400], &[500.0, 500.0]).p < 1e-9);
        assert!(chi_square_test(&[510, 490], &[500.0, 500.0]).p > 0.5);
    }
}
