//! Transcendental functions with the same bits on every platform (from the `libm` crate).

pub use libm::{acos, asin, atan, atan2, cbrt, ceil, cos, exp, floor, log, pow, round, sin, sincos, tan};
pub use libm::{
    acosf, asinf, atan2f, atanf, cosf, erfcf, erff, exp2f, expf, floorf, log2f, logf, powf, roundf, sinf,
    tanf,
};

pub use std::f32::consts::PI;

/// 1/π.
pub const INV_PI: f32 = std::f32::consts::FRAC_1_PI;

/// The largest f32 below one: samplers return numbers in [0, `ONE_MINUS`].
pub const ONE_MINUS: f32 = 1.0 - f32::EPSILON / 2.0;

/// sin x for |x| ≤ π/4, to 2⁻²⁴: a series without a branch, for loops over many numbers (coefficients of S. L. Moshier's
/// Cephes library).
#[inline]
pub fn sin_octant(x: f32) -> f32 {
    let z = x * x;
    x + x * z * (-1.666_665_5e-1 + z * (8.332_161e-3 - z * 1.951_529_6e-4))
}

/// cos x for |x| ≤ π/4, as [`sin_octant`].
#[inline]
pub fn cos_octant(x: f32) -> f32 {
    let z = x * x;
    1.0 - 0.5 * z + z * z * (4.166_664_6e-2 + z * (-1.388_731_6e-3 + z * 2.443_315_7e-5))
}

/// √x of the positive part of x: for numbers that rounding may have pushed below zero.
#[inline]
pub fn safe_sqrt(x: f32) -> f32 {
    x.max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_of_an_octant() {
        for i in -100_000..=100_000 {
            let x = PI / 4.0 * (i as f32 / 100_000.0);
            let exact = sincos(f64::from(x));
            // The series to half a unit in the last place of numbers below 1, and a few roundings.
            assert!((f64::from(sin_octant(x)) - exact.0).abs() < 1.2e-7, "sin {x}");
            assert!((f64::from(cos_octant(x)) - exact.1).abs() < 1.2e-7, "cos {x}");
        }
    }
}
