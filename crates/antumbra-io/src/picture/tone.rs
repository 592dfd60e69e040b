//! From radiance to the 256 codes of a screen: exposure, a named curve, sRGB.

use antumbra_math::real;

use crate::srgb::decode;

/// A tone curve by its name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// Clipped at 1, nothing else.
    #[default]
    Linear,
    /// x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14): K. Narkowicz's fit of the ACES film curve (2015).
    Filmic,
}

/// How a picture is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Look {
    /// Exposure: radiance is multiplied by 2^EV.
    pub exposure: f32,
    /// The curve.
    pub tone: Tone,
}

impl Tone {
    /// What the metadata of a picture says.
    pub fn name(self) -> &'static str {
        match self {
            Tone::Linear => "linear",
            Tone::Filmic => "filmic (ACES fit of Narkowicz 2015)",
        }
    }

    fn curve(self, x: f32) -> f32 {
        match self {
            Tone::Linear => x,
            // The curve tends to 2.51/2.43; beyond 100 that limit is right to 1 %, and x² cannot overflow.
            Tone::Filmic => {
                let x = x.clamp(0.0, 1e3);
                (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)
            }
        }
    }
}

/// The linear values at which the code changes: code k stands for values between entry k−1 and entry k.
pub(crate) struct Codes([f32; 255]);

impl Codes {
    pub(crate) fn new() -> Codes {
        Codes(std::array::from_fn(|k| decode((k as f64 + 0.5) / 255.0)))
    }

    /// The nearest sRGB code; 0 for what is not a number.
    pub(crate) fn encode(&self, linear: f32) -> u8 {
        self.0.partition_point(|t| linear >= *t) as u8
    }
}

impl Look {
    /// The codes of pixels, three bytes each.
    pub(super) fn encode(&self, pixels: &[[f32; 3]]) -> Vec<u8> {
        let codes = Codes::new();
        let gain = real::exp2f(self.exposure);
        pixels.iter().flatten().map(|v| codes.encode(self.tone.curve(v * gain))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_comes_back() {
        let codes = Codes::new();
        for k in 0..=255u8 {
            assert_eq!(codes.encode(decode(f64::from(k) / 255.0)), k);
        }
    }

    #[test]
    fn what_is_no_colour_is_clipped() {
        let look = Look { exposure: 0.0, tone: Tone::Filmic };
        let pixels = [[f32::NAN, -1.0, f32::INFINITY], [0.0, f32::MAX, 0.18]];
        let codes = look.encode(&pixels);
        assert_eq!(codes[..5], [0, 0, 255, 0, 255]);
        // 0.18 → 0.2671 by the formula of the curve, whose nearest code is 141.
        assert_eq!(codes[5], 141);
    }

    #[test]
    fn one_stop_doubles() {
        let codes = Codes::new();
        let look = Look { exposure: 1.0, tone: Tone::Linear };
        assert_eq!(look.encode(&[[0.25; 3]])[0], codes.encode(0.5));
    }
}
