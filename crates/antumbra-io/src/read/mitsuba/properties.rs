//! What stands in a plugin by name: numbers, words, vectors, colours.

use antumbra_math::{DVec3, Rgb};

use super::document::Element;
use crate::error::ReadError;
use crate::read::text::show;

/// Tags of values, not of plugins.
const VALUES: [&str; 12] = [
    "float",
    "integer",
    "boolean",
    "string",
    "point",
    "vector",
    "rgb",
    "spectrum",
    "transform",
    "texture",
    "ref",
    "blackbody",
];

impl Element {
    /// Its plugin: the attribute `type`.
    pub fn plugin(&self) -> &str {
        self.attribute("type")
    }

    /// "shape "sphere"", for messages.
    pub fn words(&self) -> String {
        match self.plugin() {
            "" => format!("<{}>", self.tag),
            plugin => format!("{} {}", self.tag, show(plugin.as_bytes())),
        }
    }

    /// The value or texture that is called `name`.
    pub fn property(&self, name: &str) -> Option<&Element> {
        let found = self
            .children
            .iter()
            .rev()
            .find(|c| c.given("name") == Some(name) && VALUES.contains(&c.tag.as_str()))?;
        found.used.set(true);
        Some(found)
    }

    /// Values that change no picture.
    pub fn pass_over(&self, names: &[&str]) {
        for name in names {
            self.property(name);
        }
    }

    /// It is there, whatever it is.
    pub fn has(&self, name: &str) -> bool {
        self.property(name).is_some()
    }

    /// A number, or none.
    pub fn number(&self, name: &str) -> Result<Option<f64>, ReadError> {
        let Some(value) = self.property(name) else { return Ok(None) };
        match value.tag.as_str() {
            "float" | "integer" => value.numbers::<1>("value").map(|[x]| Some(x)),
            // A texture on a plain number is the caller's matter.
            _ => Err(value.at.error(format!("\"{name}\" of {} must be a number", self.words()))),
        }
    }

    /// A number, or its default.
    pub fn float(&self, name: &str, default: f64) -> Result<f64, ReadError> {
        Ok(self.number(name)?.unwrap_or(default))
    }

    /// A whole number that fits u32, or none.
    pub fn count(&self, name: &str) -> Result<Option<u32>, ReadError> {
        let Some(value) = self.property(name) else { return Ok(None) };
        let text = value.attribute("value").trim();
        let whole = text.parse().ok().filter(|_| value.tag == "integer");
        whole.map(Some).ok_or_else(|| {
            let what = format!("\"{name}\" = {}: a whole number from 0 is needed", show(text.as_bytes()));
            value.at.error(what)
        })
    }

    /// A boolean, or its default.
    pub fn boolean(&self, name: &str, default: bool) -> Result<bool, ReadError> {
        let Some(value) = self.property(name) else { return Ok(default) };
        match value.attribute("value").trim() {
            "true" if value.tag == "boolean" => Ok(true),
            "false" if value.tag == "boolean" => Ok(false),
            text => {
                let what = format!("\"{name}\" = {}: true or false is needed", show(text.as_bytes()));
                Err(value.at.error(what))
            }
        }
    }

    /// A text, or none.
    pub fn string(&self, name: &str) -> Result<Option<&str>, ReadError> {
        let Some(value) = self.property(name) else { return Ok(None) };
        match value.tag.as_str() {
            "string" => Ok(Some(value.attribute("value"))),
            _ => Err(value.at.error(format!("\"{name}\" must be a <string>"))),
        }
    }

    /// One of some words, or the first of them.
    pub fn choice(&self, name: &str, words: &[&'static str]) -> Result<&'static str, ReadError> {
        let Some(text) = self.string(name)? else { return Ok(words[0]) };
        words.iter().find(|w| **w == text).copied().ok_or_else(|| {
            let what = format!("\"{name}\" = {} of {}: it is not known", show(text.as_bytes()), self.words());
            self.at.error(what).hint(format!("{} are.", words.join(", ")))
        })
    }

    /// The name of a file, which must be there.
    pub fn filename(&self) -> Result<&str, ReadError> {
        let name = self.string("filename")?;
        name.ok_or_else(|| self.at.error(format!("{} has no \"filename\"", self.words())))
    }

    /// A point or vector, or none.
    pub fn vector(&self, name: &str) -> Result<Option<DVec3>, ReadError> {
        self.property(name).map(|value| value.xyz(0.0)).transpose()
    }

    /// Three numbers of a point, vector or step of a transform: `value`, or `x`, `y` and `z` with a default.
    pub fn xyz(&self, default: f64) -> Result<DVec3, ReadError> {
        if self.given("value").is_some() {
            return Ok(DVec3::from(self.numbers::<3>("value")?));
        }
        let one = |name| match self.given(name) {
            None => Ok(default),
            Some(_) => self.numbers::<1>(name).map(|[x]| x),
        };
        Ok(DVec3::new(one("x")?, one("y")?, one("z")?))
    }

    /// Exactly N numbers of an attribute.
    pub fn numbers<const N: usize>(&self, attribute: &str) -> Result<[f64; N], ReadError> {
        let all = self.list(attribute)?;
        <[f64; N]>::try_from(all.as_slice()).map_err(|_| {
            let what = format!("\"{attribute}\" of <{}> has {} numbers; {N} are needed", self.tag, all.len());
            self.at.error(what)
        })
    }

    /// The numbers of an attribute, between blanks or commas.
    pub fn list(&self, attribute: &str) -> Result<Vec<f64>, ReadError> {
        let words = self.attribute(attribute).split([',', ' ', '\t', '\n', '\r']).filter(|w| !w.is_empty());
        words.map(|word| self.one(word)).collect()
    }

    /// A finite number.
    pub fn one(&self, word: &str) -> Result<f64, ReadError> {
        let number: Option<f64> =
            word.parse().ok().filter(|x: &f64| x.is_finite() && (*x as f32).is_finite());
        number.ok_or_else(|| {
            let name = self.given("name").map(|n| format!("\"{n}\" = ")).unwrap_or_default();
            self.at.error(format!("{name}{}: a number is needed", show(word.as_bytes())))
        })
    }

    /// The colour that a `<rgb>`, `<spectrum>` or `<float>` is, linear.
    pub fn rgb(&self) -> Result<Rgb, ReadError> {
        let text = self.attribute("value").trim();
        match self.tag.as_str() {
            "rgb" if text.starts_with('#') => self.hex(text),
            "rgb" => match self.list("value")?[..] {
                [g] => Ok(Rgb::grey(g as f32)),
                [r, g, b] => Ok(Rgb([r, g, b].map(|c| c as f32))),
                ref other => {
                    Err(self.at.error(format!("a colour of {} numbers; 1 or 3 are needed", other.len())))
                }
            },
            "float" => self.numbers::<1>("value").map(|[g]| Rgb::grey(g as f32)),
            tag => {
                Err(self.at.error(format!("<{tag}> is no colour: <rgb>, <spectrum> or <float> is needed")))
            }
        }
    }

    /// `#rrggbb`, a screen colour.
    fn hex(&self, text: &str) -> Result<Rgb, ReadError> {
        let code = |i: usize| text.get(i..i + 2).and_then(|t| u8::from_str_radix(t, 16).ok());
        match (text.len(), code(1), code(3), code(5)) {
            (7, Some(r), Some(g), Some(b)) => {
                Ok(Rgb([r, g, b].map(|c| crate::srgb::decode(f64::from(c) / 255.0))))
            }
            _ => Err(self.at.error(format!("{}: a colour is written #rrggbb", show(text.as_bytes())))),
        }
    }
}
