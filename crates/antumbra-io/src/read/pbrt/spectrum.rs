//! Spectra as three colours: `rgb`, `blackbody`, values by wavelength, spectra by name or from a file.

use antumbra_math::{Rgb, real};

use super::Reader;
use super::parameters::{Parameter, Parameters};
use super::text::Values;
use crate::error::ReadError;
use crate::read::text::{show, words};

/// What a spectrum stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    /// A share of light, or an index: a spectrum without colour is grey.
    Matter,
    /// Light: pbrt gives it the luminance 1 and scales it by parameters of its own.
    Light,
}

/// Indices of refraction at 587.6 nm (Schott's catalogue) of the glasses that pbrt has: its F5, F10 and F11 are SF5, SF10
/// and SF11.
const GLASSES: [(&str, f32); 7] = [
    ("BK7", 1.5168),
    ("BAF10", 1.6700),
    ("FK51A", 1.4866),
    ("LASF9", 1.8503),
    ("F5", 1.6727),
    ("F10", 1.7283),
    ("F11", 1.7847),
];

/// The index of a glass by pbrt's name of it.
pub(super) fn glass(name: &str) -> Option<f32> {
    let name = name.strip_prefix("glass-")?;
    GLASSES.iter().find(|g| g.0 == name).map(|g| g.1)
}

impl Reader<'_> {
    /// The colour of a parameter that is no texture.
    pub(super) fn color_of(&mut self, p: &Parameter, of: &Parameters, what: Of) -> Result<Rgb, ReadError> {
        match (&*p.values, p.kind.as_str()) {
            (Values::Numbers(n), "rgb") => match n[..] {
                [r, g, b] => Ok(Rgb([r, g, b].map(|x| x as f32))),
                _ => Err(p.fail(of, format!("three numbers are needed, {} are here", n.len()))),
            },
            (Values::Numbers(n), "float") if n.len() == 1 => Ok(Rgb::grey(n[0] as f32)),
            (Values::Numbers(n), "blackbody") if n.len() == 1 && n[0] > 0.0 => {
                Ok(seen(|nm| planck(nm, n[0]), Of::Light))
            }
            (Values::Numbers(n), "spectrum") => self.pairs(p, of, n, what),
            (Values::Texts(texts), "spectrum") if texts.len() == 1 => self.named(p, of, &texts[0], what),
            _ => Err(p.fail(of, "it is no spectrum that is read".into())
                .hint("rgb with three numbers, blackbody with a temperature, spectrum with pairs, a name or a file.")),
        }
    }

    fn pairs(&self, p: &Parameter, of: &Parameters, n: &[f64], what: Of) -> Result<Rgb, ReadError> {
        let pairs: Vec<[f64; 2]> = n.chunks_exact(2).map(|c| [c[0], c[1]]).collect();
        let rising = pairs.windows(2).all(|w| w[0][0] < w[1][0]);
        if n.is_empty() || !n.len().is_multiple_of(2) || !rising || !n.iter().all(|x| x.is_finite()) {
            let what = "pairs of wavelength [nm] and value are needed, the wavelengths rising";
            return Err(p.fail(of, what.into()));
        }
        Ok(seen(|nm| between(&pairs, nm), what))
    }

    /// `metal-Ag-eta` and the like come from the tables of the core; others are files.
    fn named(&mut self, p: &Parameter, of: &Parameters, name: &str, what: Of) -> Result<Rgb, ReadError> {
        if let Some(index) = glass(name) {
            return Ok(Rgb::grey(index));
        }
        if let Some(illuminant) = name.strip_prefix("stdillum-") {
            if illuminant != "D65" {
                self.said
                    .warn(p.at.words(), format!("the illuminant {illuminant} is not known: drawn white"));
            }
            return Ok(Rgb::WHITE);
        }
        if let Some(metal) = name.strip_prefix("metal-") {
            let (metal, which) = metal.rsplit_once('-').unwrap_or((metal, ""));
            if let Some(known) = antumbra::bsdf::Metal::named(metal) {
                return Ok(if which == "k" { known.k } else { known.eta });
            }
        }
        let bytes = self.open(name).map_err(|why| {
            let what = format!("{}: neither a spectrum nor a file: {why}", show(name.as_bytes()));
            p.fail(of, what)
        })?;
        let lines = bytes.split(|b| *b == b'\n').map(|l| l.split(|b| *b == b'#').next().unwrap_or(l));
        let numbers = lines.flat_map(words).map(|w| std::str::from_utf8(w).ok()?.parse().ok());
        let numbers: Option<Vec<f64>> = numbers.collect();
        let numbers = numbers
            .ok_or_else(|| p.fail(of, format!("{}: not all words are numbers", show(name.as_bytes()))))?;
        self.pairs(p, of, &numbers, what)
    }
}

/// A spectrum of pairs at a wavelength: linear between them, constant beyond.
fn between(pairs: &[[f64; 2]], nm: f64) -> f64 {
    let above = pairs.partition_point(|p| p[0] < nm);
    match (above.checked_sub(1).and_then(|i| pairs.get(i)), pairs.get(above)) {
        (Some(a), Some(b)) => a[1] + (b[1] - a[1]) * (nm - a[0]) / (b[0] - a[0]),
        (Some(only), None) | (None, Some(only)) => only[1],
        (None, None) => 0.0,
    }
}

/// Planck's law up to a factor; `nm` in nanometres, T in kelvin.
fn planck(nm: f64, t: f64) -> f64 {
    // hc/k = 1.4387769·10⁷ nm·K.
    let x = nm / 1000.0;
    1.0 / (x * x * x * x * x * (real::exp(1.438_776_9e7 / (nm * t)) - 1.0))
}

/// x̄, ȳ, z̄ of CIE 1931 by the sums of bells of Wyman, Sloan, Shirley 2013, "Simple Analytic Approximations to the CIE
/// XYZ Color Matching Functions", eq. 4 (within about 1 % of the peaks).
fn observer(nm: f64) -> [f64; 3] {
    let bell = |mean: f64, below: f64, above: f64| {
        let x = (nm - mean) / if nm < mean { below } else { above };
        real::exp(-0.5 * x * x)
    };
    [
        1.056 * bell(599.8, 37.9, 31.0) + 0.362 * bell(442.0, 16.0, 26.7) - 0.065 * bell(501.1, 20.4, 26.2),
        0.821 * bell(568.8, 46.9, 40.5) + 0.286 * bell(530.9, 16.3, 31.1),
        1.217 * bell(437.0, 11.8, 36.0) + 0.681 * bell(459.0, 26.0, 13.8),
    ]
}

/// XYZ to linear sRGB (IEC 61966-2-1).
const SRGB: [[f64; 3]; 3] = [
    [3.240_454_2, -1.537_138_5, -0.498_531_4],
    [-0.969_266, 1.876_010_8, 0.041_556],
    [0.055_643_4, -0.204_025_9, 1.057_225_2],
];

/// What the standard observer sees, in linear sRGB.
fn seen(spectrum: impl Fn(f64) -> f64, what: Of) -> Rgb {
    let (mut sum, mut white) = ([0.0; 3], [0.0; 3]);
    for nm in (360..=830).step_by(5).map(f64::from) {
        let (value, weights) = (spectrum(nm), observer(nm));
        for c in 0..3 {
            sum[c] += value * weights[c];
            white[c] += weights[c];
        }
    }
    let rgb = |xyz: [f64; 3]| SRGB.map(|row| (0..3).map(|c| row[c] * xyz[c]).sum::<f64>());
    let by = match what {
        Of::Light => [sum[1]; 3],
        Of::Matter => rgb(white),
    };
    let rgb = rgb(sum);
    Rgb(std::array::from_fn(|c| if by[c] > 0.0 { (rgb[c] / by[c]).max(0.0) as f32 } else { 0.0 }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grey_stays_grey_and_light_has_luminance_1() {
        let Rgb(grey) = seen(|_| 0.25, Of::Matter);
        assert!(grey.iter().all(|c| (c - 0.25).abs() < 1e-6), "{grey:?}");
        for t in [2000.0, 6500.0, 12000.0] {
            // The clamp of what lies outside of sRGB may add some.
            assert!((seen(|nm| planck(nm, t), Of::Light).luminance() - 1.0).abs() < 0.02, "{t}");
        }
    }

    /// Black bodies of 6500 K lie beside the white of sRGB (Wyszecki and Stiles 1982: x = 0.3135, y = 0.3237 against
    /// 0.3127, 0.3290), which is (1.05, 0.98, 1.04) there; the bells add up to 2 %.
    #[test]
    fn the_colour_of_heat() {
        let Rgb([r, g, b]) = seen(|nm| planck(nm, 6500.0), Of::Light);
        assert!((r - 1.05).abs() < 0.03 && (g - 0.98).abs() < 0.03 && (b - 1.04).abs() < 0.04, "{r} {g} {b}");
        let Rgb([r, g, b]) = seen(|nm| planck(nm, 3000.0), Of::Light);
        assert!(r > 1.5 * g && g > 1.8 * b, "{r} {g} {b}");
    }

    #[test]
    fn pairs_are_joined_by_lines() {
        let pairs = [[400.0, 1.0], [500.0, 3.0]];
        assert_eq!(
            [300.0, 400.0, 450.0, 500.0, 900.0].map(|nm| between(&pairs, nm)),
            [1.0, 1.0, 2.0, 3.0, 3.0]
        );
    }
}
