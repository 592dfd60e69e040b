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

/// √x of the positive part of x: for numbers that rounding may have pushed below zero.
#[inline]
pub fn safe_sqrt(x: f32) -> f32 {
    x.max(0.0).sqrt()
}
