//! The transfer function of screens (IEC 61966-2-1).

use antumbra_math::real;

/// sRGB component → linear.
pub(crate) fn decode(c: f64) -> f32 {
    (if c <= 0.04045 { c / 12.92 } else { real::pow((c + 0.055) / 1.055, 2.4) }) as f32
}
