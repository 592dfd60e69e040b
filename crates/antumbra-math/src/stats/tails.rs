//! Tail probabilities of the χ², Student-t and normal distributions, from the incomplete gamma and beta functions
//! (series and continued fractions of the NIST Handbook, dlmf.nist.gov; fractions by Lentz's method). f64; relative
//! error about 1e-12 for the degrees of freedom of tests (≤ 10⁴).

use libm::{erfc, exp, fabs, lgamma, log};

/// Where a series or fraction has converged.
const EPS: f64 = 1e-15;
/// Keeps Lentz's quotients from dividing by zero.
const TINY: f64 = 1e-300;
/// Far more terms than the largest parameters need (about 10·√a).
const TERMS: usize = 100_000;

/// Q(a, x) = Γ(a, x)/Γ(a), the regularised upper incomplete gamma function; a > 0.
pub fn gamma_q(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    let front = exp(a * log(x) - x - lgamma(a));
    if x < a + 1.0 { 1.0 - front * lower_series(a, x) } else { front * upper_fraction(a, x) }
}

/// Σ xᵏ / (a (a+1) … (a+k)): DLMF 8.11.4.
fn lower_series(a: f64, x: f64) -> f64 {
    let mut term = 1.0 / a;
    let mut sum = term;
    for k in 1..TERMS {
        term *= x / (a + k as f64);
        sum += term;
        if term < sum * EPS {
            break;
        }
    }
    sum
}

/// The even part of the fraction DLMF 8.9.2.
fn upper_fraction(a: f64, x: f64) -> f64 {
    let mut b = x + 1.0 - a;
    let mut c = 1.0 / TINY;
    let mut d = 1.0 / b;
    let mut h = d;
    for k in 1..TERMS {
        let k = k as f64;
        let numerator = -k * (k - a);
        b += 2.0;
        (c, d) = lentz(numerator, b, c, d);
        h *= c * d;
        if fabs(c * d - 1.0) < EPS {
            break;
        }
    }
    h
}

/// One step of Lentz's method: the next pair (C, 1/D).
fn lentz(numerator: f64, b: f64, c: f64, d: f64) -> (f64, f64) {
    let safe = |v: f64| if fabs(v) < TINY { TINY } else { v };
    (safe(b + numerator / c), 1.0 / safe(b + numerator * d))
}

/// I_x(a, b), the regularised incomplete beta function; a, b > 0, 0 ≤ x ≤ 1.
pub fn beta_i(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    if x >= 1.0 {
        return 1.0;
    }
    let front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) + b * libm::log1p(-x));
    // DLMF 8.17.4: on the side where the fraction converges fast.
    if x < (a + 1.0) / (a + b + 2.0) {
        front * beta_fraction(a, b, x) / a
    } else {
        1.0 - front * beta_fraction(b, a, 1.0 - x) / b
    }
}

/// The fraction DLMF 8.17.22.
fn beta_fraction(a: f64, b: f64, x: f64) -> f64 {
    let mut c = 1.0;
    let mut d = lentz(-(a + b) * x / (a + 1.0), 1.0, 1.0, 1.0).1;
    let mut h = d;
    for m in 1..TERMS {
        let m = m as f64;
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        (c, d) = lentz(even, 1.0, c, d);
        h *= c * d;
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        (c, d) = lentz(odd, 1.0, c, d);
        h *= c * d;
        if fabs(c * d - 1.0) < EPS {
            break;
        }
    }
    h
}

/// P(χ² ≥ x) for `dof` degrees of freedom: Q(dof/2, x/2).
pub fn chi_square_tail(x: f64, dof: f64) -> f64 {
    gamma_q(0.5 * dof, 0.5 * x)
}

/// P(|T| ≥ |t|) for Student's t with `dof` degrees of freedom: I of dof/(dof + t²) at (dof/2, 1/2).
pub fn student_t_two_sided(t: f64, dof: f64) -> f64 {
    beta_i(0.5 * dof, 0.5, dof / (dof + t * t))
}

/// P(|Z| ≥ |z|) of the standard normal distribution: erfc(|z|/√2).
pub fn normal_two_sided(z: f64) -> f64 {
    erfc(fabs(z) * std::f64::consts::FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The accuracy that the file promises.
    fn close(a: f64, b: f64) {
        assert!(fabs(a - b) <= 1e-12 * fabs(b), "{a} is not {b}");
    }

    #[test]
    fn chi_square_has_its_closed_forms() {
        for x in [0.1, 1.0, 3.0, 10.0, 80.0] {
            close(chi_square_tail(x, 1.0), erfc((0.5 * x).sqrt()));
            close(chi_square_tail(x, 2.0), exp(-0.5 * x));
            close(chi_square_tail(x, 4.0), exp(-0.5 * x) * (1.0 + 0.5 * x));
        }
        assert_eq!(chi_square_tail(0.0, 7.0), 1.0);
    }

    #[test]
    fn chi_square_of_an_even_dof_is_a_poisson_sum() {
        // P(χ²_2n ≥ 2λ) = Σ_{k<n} e^{−λ} λᵏ/k!
        for (n, lambda) in [(100, 80.0), (100, 130.0), (500, 560.0)] {
            let mut term = exp(-lambda);
            let mut sum = 0.0;
            for k in 0..n {
                sum += term;
                term *= lambda / f64::from(k + 1);
            }
            let p = chi_square_tail(2.0 * lambda, 2.0 * f64::from(n));
            assert!(fabs(p - sum) <= 1e-11 * sum, "{p} {sum}: lgamma and the sum each lose some digits");
        }
    }

    #[test]
    fn student_has_its_closed_forms() {
        for t in [0.01f64, 0.5, 2.0, 9.0] {
            close(student_t_two_sided(t, 1.0), 1.0 - libm::atan(t) * std::f64::consts::FRAC_2_PI);
            let two = 1.0 - t / (2.0 + t * t).sqrt();
            assert!(fabs(student_t_two_sided(t, 2.0) - two) < 1e-13, "the closed form cancels");
        }
        // The normal limit: the difference is of order t⁴/dof.
        assert!(fabs(student_t_two_sided(2.0, 1e6) - normal_two_sided(2.0)) < 1e-6);
        close(normal_two_sided(1.959963984540054), 0.05);
    }

    #[test]
    fn beta_has_its_closed_forms() {
        for x in [0.001, 0.3, 0.5, 0.9] {
            assert!(fabs(beta_i(1.0, 3.5, x) - (1.0 - libm::pow(1.0 - x, 3.5))) < 1e-13);
            assert!(fabs(beta_i(4.0, 1.0, x) - x * x * x * x) < 1e-13);
            assert!(fabs(beta_i(2.5, 7.0, x) + beta_i(7.0, 2.5, 1.0 - x) - 1.0) < 1e-13);
        }
    }
}
