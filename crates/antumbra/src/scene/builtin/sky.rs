//! A sky for scenes that bring none: a bright overcast with the sun behind thin cloud.

use std::sync::Arc;

use antumbra_math::{DVec3, Rgb, real};

use crate::light::{Environment, Light};
use crate::texture::{Image, Texels};

/// The light of a hazy day from the upper left (+y up), soft, yet with enough direction that shapes read well. Its mean
/// irradiance on level ground is about 2, so that a grey of 0.5 comes out near 0.32.
pub fn default_sky() -> Light {
    Environment::image(Arc::new(sky(DVec3::new(-0.55, 0.62, 0.56), 1.0, 1.0))).into()
}

/// A lat-long picture of a sky: zenith and horizon, ground below, and a broad lobe around the sun. `sun` ≥ 0 scales the
/// lobe, `brightness` the whole.
pub(super) fn sky(to_sun: DVec3, sun: f64, brightness: f32) -> Image {
    let (width, height) = (256, 128);
    let to_sun = to_sun.normalize();
    let mut texels = Vec::with_capacity((width * height) as usize);
    for y in 0..height {
        let theta = (f64::from(y) + 0.5) / f64::from(height) * std::f64::consts::PI;
        for x in 0..width {
            let phi = (f64::from(x) + 0.5) / f64::from(width) * std::f64::consts::TAU;
            let (s, c) = (real::sin(theta), real::cos(theta));
            let d = DVec3::new(real::sin(phi) * s, c, -real::cos(phi) * s);
            texels.push((radiance(d, d.dot(to_sun), sun) * brightness).0);
        }
    }
    Image { width, height, texels: Texels::Float(texels) }
}

/// L from the direction d, whose cosine to the sun is `cos_sun`.
fn radiance(d: DVec3, cos_sun: f64, sun: f64) -> Rgb {
    let ground = Rgb::new(0.17, 0.155, 0.14);
    let horizon = Rgb::new(0.62, 0.66, 0.70);
    let zenith = Rgb::new(0.22, 0.34, 0.56);
    // Two lobes: thin cloud lit from behind, and the sun in it (about 8° across).
    let glow = 0.55 * real::exp(6.0 * (cos_sun - 1.0)) + 26.0 * real::exp(220.0 * (cos_sun - 1.0));
    let above = horizon.lerp(zenith, real::pow(d.y.max(0.0), 0.6) as f32)
        + Rgb::new(1.0, 0.93, 0.82) * (sun * glow) as f32;
    // The horizon is a soft edge of 2°: no picture of a sky should flicker there.
    let t = (d.y / 0.035 + 0.5).clamp(0.0, 1.0);
    ground.lerp(above, t as f32)
}
