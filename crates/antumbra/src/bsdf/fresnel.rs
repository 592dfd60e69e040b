//! Fresnel's equations for unpolarised light at a smooth boundary, exact (Born and Wolf, "Principles of Optics", §1.5
//! for dielectrics, §14.2 for metals).

use antumbra_math::{Rgb, real};

/// An index of refraction as the kinds take it: in [0.1, 10]; not-a-number becomes 1.5.
pub fn index(eta: f32) -> f32 {
    if eta.is_nan() { 1.5 } else { eta.clamp(0.1, 10.0) }
}

/// What a boundary between two dielectrics does with light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary {
    /// Share reflected.
    pub reflected: f32,
    /// Cosine of the refracted direction to the normal beyond; 0 under total reflection.
    pub cos_beyond: f32,
}

/// Light that meets the boundary with `cos` ≥ 0; `eta` = n beyond over n on the side of the light.
#[inline]
pub fn dielectric(cos: f32, eta: f32) -> Boundary {
    let sin2_beyond = (1.0 - cos) * (1.0 + cos) / (eta * eta);
    if sin2_beyond >= 1.0 {
        return Boundary { reflected: 1.0, cos_beyond: 0.0 };
    }
    let cos_beyond = (1.0 - sin2_beyond).sqrt();
    let across = (cos - eta * cos_beyond) / (cos + eta * cos_beyond);
    let along = (eta * cos - cos_beyond) / (eta * cos + cos_beyond);
    Boundary { reflected: 0.5 * (across * across + along * along), cos_beyond }
}

/// Share that a metal of index η + ik reflects of light that meets it with `cos` ≥ 0.
#[inline]
pub fn conductor(cos: f32, eta: Rgb, k: Rgb) -> Rgb {
    Rgb([0, 1, 2].map(|c| metal(cos, eta.0[c], k.0[c])))
}

/// [`conductor`] of one component: with a² + b² = |n² − sin²θ|, where n = η + ik.
#[inline]
fn metal(cos: f32, eta: f32, k: f32) -> f32 {
    let cos2 = cos * cos;
    let sin2 = (1.0 - cos) * (1.0 + cos);
    let real = eta * eta - k * k - sin2;
    let a2_b2 = (real * real + 4.0 * eta * eta * k * k).sqrt();
    let twice_a_cos = 2.0 * real::safe_sqrt(0.5 * (a2_b2 + real)) * cos;
    let across = ratio(a2_b2 + cos2, twice_a_cos);
    let along = across * ratio(cos2 * a2_b2 + sin2 * sin2, twice_a_cos * sin2);
    0.5 * (across + along)
}

/// (sum − part) / (sum + part) for part ≤ sum; 1 where both vanish.
#[inline]
fn ratio(sum: f32, part: f32) -> f32 {
    ((sum - part) / (sum + part).max(f32::MIN_POSITIVE)).max(0.0)
}

/// 2 ∫ F(μ) μ dμ: the share reflected of light that is equal from everywhere, by Gauss–Legendre in μ.
pub fn average(share: impl Fn(f32) -> Rgb) -> Rgb {
    GAUSS.iter().map(|(mu, weight)| share(*mu) * (2.0 * mu * weight)).sum()
}

/// [`average`] of a share that follows a boundary of index `eta`. Below 1 it kinks where total reflection (share 1) begins:
/// from there on the integral runs over the cosine μ' beyond, μ² = 1 − η² (1 − μ'²) and μ dμ = η² μ' dμ'.
pub fn average_of(eta: f32, share: impl Fn(f32) -> f32) -> f32 {
    if eta >= 1.0 {
        return average(|mu| Rgb::grey(share(mu))).0[0];
    }
    let eta2 = eta * eta;
    let beyond = average(|mu| Rgb::grey(share((1.0 - eta2 * (1.0 - mu) * (1.0 + mu)).sqrt()))).0[0];
    1.0 - eta2 * (1.0 - beyond)
}

/// Nodes and weights on [0, 1], five points (exact to degree 9).
const GAUSS: [(f32, f32); 5] = [
    (0.046_910_08, 0.118_463_44),
    (0.230_765_34, 0.239_314_33),
    (0.5, 0.284_444_45),
    (0.769_234_66, 0.239_314_33),
    (0.953_089_9, 0.118_463_44),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glass_by_its_published_numbers() {
        // n = 1.5: 4 % straight on; Brewster's angle atan 1.5 reflects only across: (n² − 1)²/(n² + 1)² / 2; everything
        // at grazing angles; from inside, nothing leaves beyond asin(1/1.5) = 41.81°.
        assert!((dielectric(1.0, 1.5).reflected - 0.04).abs() < 1e-7);
        let brewster = real::cosf(real::atanf(1.5));
        let across = (1.25f32 / 3.25) * (1.25 / 3.25) / 2.0;
        assert!((dielectric(brewster, 1.5).reflected - across).abs() < 1e-6);
        assert_eq!(dielectric(0.0, 1.5).reflected, 1.0);
        assert_eq!(dielectric(real::cosf(41.82f32.to_radians()), 1.0 / 1.5).reflected, 1.0);
        assert!(dielectric(real::cosf(41.80f32.to_radians()), 1.0 / 1.5).reflected < 1.0);
        // The same boundary from the other side.
        let out = dielectric(0.4, 1.5);
        let back = dielectric(out.cos_beyond, 1.0 / 1.5);
        assert!((out.reflected - back.reflected).abs() < 1e-6 && (back.cos_beyond - 0.4).abs() < 1e-6);
    }

    #[test]
    fn nothing_is_reflected_where_nothing_changes() {
        for cos in [0.01, 0.3, 1.0] {
            // The cosine beyond is a root of a difference: ε/cos² of it, squared.
            assert!(dielectric(cos, 1.0).reflected < 1e-6);
        }
    }

    #[test]
    fn metals_straight_on_and_without_absorption() {
        // ((η − 1)² + k²) / ((η + 1)² + k²); with k = 0 a metal is a dielectric.
        let (eta, k) = (Rgb([0.143, 1.657, 4.37]), Rgb([3.983, 9.224, 5.206]));
        let told = conductor(1.0, eta, k);
        for c in 0..3 {
            let (e, k) = (eta.0[c], k.0[c]);
            let expected = ((e - 1.0) * (e - 1.0) + k * k) / ((e + 1.0) * (e + 1.0) + k * k);
            assert!((told.0[c] - expected).abs() < 2e-6, "{told:?}");
        }
        for cos in [1.0f32, 0.7, 0.3, 0.05] {
            let clear = conductor(cos, Rgb::grey(1.5), Rgb::BLACK).0[0];
            assert!((clear - dielectric(cos, 1.5).reflected).abs() < 1e-5, "{cos}");
        }
        assert!(conductor(0.0, eta, k).0.iter().all(|f| (f - 1.0).abs() < 1e-6));
    }

    #[test]
    fn odd_indices_stay_shares() {
        for eta in [0.0, 1e-20, 1.0, 1e6] {
            for k in [0.0, 1e-20, 1.0, 1e6] {
                for cos in [0.0, 1e-30, 1e-3, 0.5, 1.0] {
                    let f = metal(cos, eta, k);
                    assert!((0.0..=1.0).contains(&f), "{eta} {k} {cos}: {f}");
                }
            }
        }
    }

    #[test]
    fn the_mean_over_directions() {
        // The closed form for n = 1.5 is 0.0918 (Duntley 1942; Egan and Hilgeman 1973, table of diffuse reflectances).
        let mean = average(|mu| Rgb::grey(dielectric(mu, 1.5).reflected)).0[0];
        assert!((mean - 0.0918).abs() < 5e-4, "{mean}");
        // 2 ∫ F μ dμ by 10⁵ midpoints. Five points err by 2e-3 at most, where F is steep; below 1 by η² of that.
        for eta in [0.1f32, 0.3, 0.6667, 0.9, 1.0, 1.1, 1.5, 2.4, 10.0] {
            let n = 100_000;
            let at = |i: i32| f64::from(dielectric(((i as f32 + 0.5) / n as f32).sqrt(), eta).reflected);
            let (slow, fast) = (
                (0..n).map(at).sum::<f64>() / f64::from(n),
                average_of(eta, |mu| dielectric(mu, eta).reflected),
            );
            assert!(
                (f64::from(fast) - slow).abs() < 2e-3 * f64::from(eta.min(1.0).powi(2)) + 1e-5,
                "{eta}: {fast} {slow}"
            );
        }
    }
}
