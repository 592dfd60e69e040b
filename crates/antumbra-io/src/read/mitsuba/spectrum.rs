//! Spectra: plugins, pairs, files, as colours.

use antumbra_math::Rgb;

use super::Reader;
use super::document::Element;
use crate::error::ReadError;
use crate::read::spectrum::{Of, Samples, black_body, flat};
use crate::read::text::{show, words};

/// The colour of a spectrum plugin.
type Make = fn(&Reader, &Element, Of) -> Result<Rgb, ReadError>;

/// Every spectrum plugin that is read. To add one: a function and a line here.
const SPECTRA: [(&str, Make); 7] = [
    ("regular", regular),
    ("irregular", irregular),
    ("blackbody", blackbody),
    ("d65", d65),
    ("uniform", uniform),
    ("srgb", srgb),
    ("rawconstant", rawconstant),
];

/// Samples of one spectrum.
const MOST: usize = 1 << 16;

/// Is a spectrum, not a picture.
pub(super) fn is_plain(element: &Element) -> bool {
    !matches!(element.tag.as_str(), "texture" | "spectrum")
        || match element.plugin() {
            "" => element.tag == "spectrum",
            plugin => SPECTRA.iter().any(|s| s.0 == plugin),
        }
}

impl Reader<'_> {
    /// The colour of a value that is no picture.
    pub(super) fn plain(&mut self, value: &Element, of: Of) -> Result<Rgb, ReadError> {
        if let Some((_, make)) = SPECTRA.iter().find(|s| s.0 == value.plugin()) {
            let seen = make(self, value, of)?;
            self.name_the_unread(value);
            return Ok(seen);
        }
        if value.tag != "spectrum" {
            return value.rgb();
        }
        let text = value.attribute("value").trim();
        if let Some(file) = value.given("filename") {
            return self.file_of_pairs(value, file, of);
        }
        if text.contains(':') {
            let words = text.split([',', ' ', '\t', '\n', '\r']).filter(|w| !w.is_empty());
            let pair = |word: &str| {
                let (wavelength, at) = word.split_once(':').unwrap_or((word, ""));
                Ok([value.one(wavelength)?, value.one(at)?])
            };
            return samples(value, words.map(pair).collect::<Result<_, ReadError>>()?, of);
        }
        let [all] = value.numbers::<1>("value")?;
        Ok(if of == Of::Light { flat(all, of) } else { Rgb::grey(all as f32) })
    }

    /// A line for each wavelength; # begins a comment.
    fn file_of_pairs(&self, value: &Element, file: &str, of: Of) -> Result<Rgb, ReadError> {
        let fail = |why: String| value.at.error(format!("the spectrum \"{file}\": {why}"));
        let bytes = self.open(file).map_err(|e| fail(e.to_string()))?;
        let lines = bytes.split(|b| *b == b'\n').map(|l| l.split(|b| *b == b'#').next().unwrap_or(l));
        let mut numbers = Vec::new();
        for word in lines.flat_map(words) {
            let number = std::str::from_utf8(word).ok().and_then(|w| w.parse::<f64>().ok());
            let number = number.filter(|x| (*x as f32).is_finite());
            numbers.push(number.ok_or_else(|| fail(format!("{}: a number is needed", show(word))))?);
            if numbers.len() > 2 * MOST + 1 {
                break;
            }
        }
        if !numbers.len().is_multiple_of(2) {
            return Err(fail("a wavelength without its value".into()));
        }
        samples(value, numbers.chunks_exact(2).map(|c| [c[0], c[1]]).collect(), of)
    }
}

fn samples(value: &Element, pairs: Vec<[f64; 2]>, of: Of) -> Result<Rgb, ReadError> {
    if pairs.len() < 2 || pairs.len() > MOST {
        let what = format!("a spectrum of {} samples: from 2 to {MOST} are read", pairs.len());
        return Err(value.at.error(what));
    }
    let samples = Samples::new(pairs);
    let samples = samples.ok_or_else(|| value.at.error("the wavelengths of a spectrum must grow"))?;
    Ok(samples.seen(of))
}

/// The numbers of a `<string>`.
fn list(element: &Element, name: &str) -> Result<Vec<f64>, ReadError> {
    match element.property(name) {
        Some(value) if value.tag == "string" => value.list("value"),
        _ => Err(element.at.error(format!("{} has no <string> \"{name}\"", element.words()))),
    }
}

/// Values from one wavelength to another, evenly.
fn regular(_: &Reader, element: &Element, of: Of) -> Result<Rgb, ReadError> {
    let values = list(element, "values")?;
    let [low, high] =
        [("wavelength_min", 360.0), ("wavelength_max", 830.0)].map(|(n, d)| element.float(n, d));
    let (low, high, last) = (low?, high?, values.len().saturating_sub(1).max(1) as f64);
    let at = |(i, value): (usize, &f64)| [low + (high - low) * i as f64 / last, *value];
    samples(element, values.iter().enumerate().map(at).collect(), of)
}

/// Values at wavelengths.
fn irregular(_: &Reader, element: &Element, of: Of) -> Result<Rgb, ReadError> {
    let (at, values) = (list(element, "wavelengths")?, list(element, "values")?);
    if at.len() != values.len() {
        let what = format!("{} wavelengths and {} values: as many are needed", at.len(), values.len());
        return Err(element.at.error(what));
    }
    samples(element, at.into_iter().zip(values).map(|(nm, value)| [nm, value]).collect(), of)
}

/// Planck's law [W·m⁻²·sr⁻¹·nm⁻¹].
fn blackbody(_: &Reader, element: &Element, of: Of) -> Result<Rgb, ReadError> {
    let kelvin = element.float("temperature", 5000.0)?;
    element.pass_over(&["wavelength_min", "wavelength_max"]);
    match of {
        Of::Light if kelvin > 0.0 => Ok(black_body(kelvin)),
        Of::Light => Err(element.at.error(format!("a black body of {kelvin} K: it must be above 0"))),
        Of::Matter => Err(element.at.error("a black body is light: no surface has its colour")),
    }
}

/// Daylight, of one colour if it has one: the white of sRGB.
fn d65(_: &Reader, element: &Element, _: Of) -> Result<Rgb, ReadError> {
    let color = element.property("color").map_or(Ok(Rgb::WHITE), Element::rgb)?;
    Ok(color * element.float("scale", 1.0)? as f32)
}

fn uniform(_: &Reader, element: &Element, _: Of) -> Result<Rgb, ReadError> {
    element.pass_over(&["wavelength_min", "wavelength_max"]);
    Ok(Rgb::grey(element.float("value", 1.0)? as f32))
}

fn srgb(_: &Reader, element: &Element, _: Of) -> Result<Rgb, ReadError> {
    let color = element.property("color");
    color.ok_or_else(|| element.at.error(format!("{} has no \"color\"", element.words())))?.rgb()
}

/// Three numbers, or one.
fn rawconstant(_: &Reader, element: &Element, _: Of) -> Result<Rgb, ReadError> {
    match element.property("value").filter(|v| matches!(v.tag.as_str(), "vector" | "point")) {
        Some(value) => Ok(Rgb(value.xyz(0.0)?.to_array().map(|c| c as f32))),
        None => Ok(Rgb::grey(element.float("value", 1.0)? as f32)),
    }
}
