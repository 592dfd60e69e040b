//! Radiance of a clear or hazy sky without its sun: Hosek and Wilkie, An Analytic Model for Full Spectral Sky-Dome
//! Radiance (2012), the data set for R, G, B, from the crate `hw-skymodel`.

use antumbra_math::real::{exp, pow};
use hw_skymodel::rgb::{SkyParams, SkyState};

/// The coefficients of the model for one sun, turbidity and ground.
pub struct Dome {
    shape: [[f64; 9]; 3],
    radiance: [f64; 3],
}

impl Dome {
    /// `elevation` [rad] in [0, π/2], `turbidity` in [1, 10], `albedo` in [0, 1]; `None` beyond.
    pub fn new(elevation: f64, turbidity: f64, albedo: f64) -> Option<Dome> {
        let params = SkyParams {
            elevation: firm(elevation as f32),
            turbidity: turbidity as f32,
            albedo: [albedo as f32; 3],
        };
        let (shape, radiance) = SkyState::new(&params).ok()?.raw();
        let shape = std::array::from_fn(|c| std::array::from_fn(|i| f64::from(shape[9 * c + i])));
        Some(Dome { shape, radiance: radiance.map(f64::from) })
    }

    /// L [W·m⁻²·sr⁻¹] of each channel from a direction whose cosine to the zenith is `cos_zenith` ≥ 0 and whose angle to
    /// the sun is `gamma` [rad] (the paper's equation 8). Never negative.
    pub fn radiance(&self, cos_zenith: f64, gamma: f64, cos_gamma: f64) -> [f32; 3] {
        std::array::from_fn(|c| {
            let p = &self.shape[c];
            let mie = (1.0 + cos_gamma * cos_gamma) / pow(1.0 + p[8] * p[8] - 2.0 * p[8] * cos_gamma, 1.5);
            let around = p[2] + p[3] * exp(p[4] * gamma) + p[5] * cos_gamma * cos_gamma;
            let up = 1.0 + p[0] * exp(p[1] / (cos_zenith + 0.01));
            let whole = up * (around + p[6] * mie + p[7] * cos_zenith.sqrt());
            (self.radiance[c] * whole).max(0.0) as f32
        })
    }
}

/// An elevation within 10⁻⁶ of the one given for which the crate's one call of a function of the platform, the cube root
/// of elevation/(π/2) in f32, is not near the middle between two numbers: every platform, right to 0.55 units of the last
/// place, then gives the same one.
fn firm(elevation: f32) -> f32 {
    const HALF_TURN: f32 = 0.5 * std::f32::consts::PI;
    let near_middle = |e: f32| {
        let root = pow(f64::from(e / HALF_TURN), f64::from(1.0f32 / 3.0f32));
        let rounded = root as f32;
        let unit = f64::from(f32::from_bits(rounded.to_bits() + 1)) - f64::from(rounded);
        0.5 - ((root - f64::from(rounded)) / unit).abs() < 0.05
    };
    let mut e = elevation.clamp(0.0, HALF_TURN);
    while e > 0.0 && e < HALF_TURN && near_middle(e) {
        e = f32::from_bits(e.to_bits() + 1);
    }
    e.min(HALF_TURN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use hw_skymodel::rgb::Channel;

    /// Our f64 form against the crate's own f32 one: equal to the roundings of f32 (10⁻⁵).
    #[test]
    fn the_crate_agrees() {
        let params = SkyParams { elevation: firm(0.4), turbidity: 3.5, albedo: [0.3; 3] };
        let (state, dome) = (SkyState::new(&params).unwrap(), Dome::new(0.4, 3.5, 0.3).unwrap());
        for i in 0..100 {
            let (theta, gamma) = (0.0157 * i as f32, 0.031 * i as f32);
            let zenith = antumbra_math::real::cos(f64::from(theta));
            let gamma64 = f64::from(gamma);
            let ours = dome.radiance(zenith, gamma64, antumbra_math::real::cos(gamma64));
            for (c, channel) in [Channel::R, Channel::G, Channel::B].into_iter().enumerate() {
                let theirs = state.radiance(theta, gamma, channel);
                assert!((ours[c] - theirs).abs() <= 1e-5 * theirs, "{theta} {gamma}: {} {theirs}", ours[c]);
            }
        }
    }

    #[test]
    fn firm_elevations_stay_where_they_are() {
        for i in 0..=1000 {
            let e = i as f32 * 0.5 * std::f32::consts::PI / 1000.0;
            assert!((firm(e) - e).abs() < 1e-6);
        }
        assert!(Dome::new(-0.1, 3.0, 0.3).is_some() && Dome::new(0.1, 11.0, 0.3).is_none());
    }
}
