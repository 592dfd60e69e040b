//! Spectra as three colours: `rgb`, `blackbody`, values by wavelength, spectra by name or from a file.

use antumbra_math::Rgb;

use super::Reader;
use super::parameters::{Parameter, Parameters};
use super::text::Values;
use crate::error::ReadError;
use crate::read::spectrum::{Of as Seen, Samples, black_body};
use crate::read::text::{show, words};

/// What a spectrum stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    /// A share of light, or an index, under daylight (D65): a spectrum without colour is grey.
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
                Ok(of_luminance_1(black_body(n[0])))
            }
            (Values::Numbers(n), "spectrum") => self.pairs(p, of, n, what),
            (Values::Texts(texts), "spectrum") if texts.len() == 1 => self.named(p, of, &texts[0], what),
            _ => Err(p.fail(of, "it is no spectrum that is read".into())
                .hint("rgb with three numbers, blackbody with a temperature, spectrum with pairs, a name or a file.")),
        }
    }

    fn pairs(&self, p: &Parameter, of: &Parameters, n: &[f64], what: Of) -> Result<Rgb, ReadError> {
        let pairs: Vec<[f64; 2]> = n.chunks_exact(2).map(|c| [c[0], c[1]]).collect();
        let whole = n.len() >= 4 && n.len().is_multiple_of(2) && n.iter().all(|x| (*x as f32).is_finite());
        let samples = Samples::new(pairs).filter(|_| whole).ok_or_else(|| {
            let what = "two or more pairs of wavelength [nm] and value are needed, the wavelengths rising";
            p.fail(of, what.into())
        })?;
        Ok(match what {
            Of::Matter => samples.seen(Seen::Matter),
            Of::Light => of_luminance_1(samples.seen(Seen::Light)),
        })
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

/// Light in its chromaticity with the luminance 1, as pbrt scales what shines; black stays black.
fn of_luminance_1(light: Rgb) -> Rgb {
    let luminance = light.luminance();
    if luminance > 0.0 { light * (1.0 / luminance) } else { Rgb::BLACK }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is drawn has the luminance 1 at any heat, cold bodies too (nothing of 300 K is seen).
    #[test]
    fn light_has_luminance_1() {
        for t in [2000.0, 6500.0, 12000.0] {
            assert!((of_luminance_1(black_body(t)).luminance() - 1.0).abs() < 1e-6, "{t}");
        }
        assert_eq!(of_luminance_1(Rgb::BLACK), Rgb::BLACK);
    }

    /// Black bodies of 6500 K lie beside the white of sRGB (Wyszecki and Stiles 1982: x = 0.3135, y = 0.3237 against
    /// 0.3127, 0.3290), which is (1.042, 0.984, 1.035) there: Y = 1, X = x/y, Z = (1 − x − y)/y by the matrix of IEC
    /// 61966-2-1. The four digits of x and y, and 4 K to 6504 K, are 5·10⁻³ here.
    #[test]
    fn the_colour_of_heat() {
        let Rgb(seen) = of_luminance_1(black_body(6500.0));
        let near = seen.iter().zip([1.042, 0.984, 1.035]).all(|(a, b)| (a - b).abs() < 5e-3);
        assert!(near, "{seen:?}");
    }
}
