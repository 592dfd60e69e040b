//! The parameters of a directive: `"float radius" [ 2 ]`.

use std::cell::Cell;
use std::rc::Rc;

use antumbra_math::DVec3;

use super::text::{At, Text, Values};
use crate::error::ReadError;
use crate::read::text::show;

/// One parameter.
#[derive(Clone, Debug)]
pub(super) struct Parameter {
    /// Where it stands.
    pub at: At,
    /// `float`, `rgb`, `texture` …
    pub kind: String,
    /// Its name.
    pub name: String,
    /// Its values.
    pub values: Rc<Values>,
    /// Somebody asked for it, or nobody minds.
    used: Cell<bool>,
}

/// What stands behind a directive.
#[derive(Clone, Debug)]
pub(super) struct Parameters {
    /// Where the directive stands.
    pub at: At,
    /// The directive with its plugin: `Shape "sphere"`.
    pub words: String,
    given: Vec<Parameter>,
}

impl Parameters {
    /// Reads all that follow.
    pub fn read(text: &mut Text, at: At, words: String) -> Result<Parameters, ReadError> {
        let mut given = Vec::new();
        loop {
            let at = text.here();
            let Some(declared) = text.string_if_any()? else { break };
            let mut parts = declared.split_whitespace();
            let (Some(kind), Some(name), None) = (parts.next(), parts.next(), parts.next()) else {
                let what =
                    format!("{words}: {} is no type and name of a parameter", show(declared.as_bytes()));
                return Err(at.error(what).hint("As in \"float radius\" 2."));
            };
            let values = Rc::new(text.values(&format!("{words}: \"{declared}\""))?);
            given.push(Parameter {
                at,
                kind: kind.into(),
                name: name.into(),
                values,
                used: Cell::new(false),
            });
        }
        Ok(Parameters { at, words, given })
    }

    /// With others behind, which count where it says nothing itself, and may stay unread.
    pub fn with_defaults(mut self, defaults: &[Parameter]) -> Parameters {
        for parameter in defaults {
            if !self.has(&parameter.name) {
                self.given.push(Parameter { used: Cell::new(true), ..parameter.clone() });
            }
        }
        self
    }

    /// How many there are.
    pub fn count_given(&self) -> usize {
        self.given.len()
    }

    /// Gives them away, as defaults for others.
    pub fn into_given(self) -> Vec<Parameter> {
        self.given
    }

    /// How many values all have together.
    pub fn length(&self) -> usize {
        self.given.iter().map(|p| p.values.len()).sum()
    }

    /// It is there, read or not.
    pub fn has(&self, name: &str) -> bool {
        self.given.iter().any(|p| p.name == name)
    }

    /// The parameter of a name.
    pub fn get(&self, name: &str) -> Option<&Parameter> {
        let found = self.given.iter().find(|p| p.name == name)?;
        found.used.set(true);
        Some(found)
    }

    /// Those that mean nothing here.
    pub fn pass_over(&self, names: &[&str]) {
        for name in names {
            self.get(name);
        }
    }

    /// Those that nobody asked for.
    pub fn unread(&self) -> impl Iterator<Item = &Parameter> {
        self.given.iter().filter(|p| !p.used.get())
    }

    /// All numbers of a parameter.
    pub fn list(&self, name: &str) -> Result<Option<&[f64]>, ReadError> {
        self.get(name).map(|p| p.numbers(self)).transpose()
    }

    /// One number.
    pub fn number(&self, name: &str) -> Result<Option<f64>, ReadError> {
        let Some(p) = self.get(name) else { return Ok(None) };
        match p.numbers(self)? {
            [x] if x.is_finite() => Ok(Some(*x)),
            [x] => Err(p.fail(self, format!("{x} is no finite number"))),
            all => Err(p.fail(self, format!("one number is needed, {} are here", all.len()))),
        }
    }

    /// One number, or its default.
    pub fn float(&self, name: &str, default: f64) -> Result<f64, ReadError> {
        Ok(self.number(name)?.unwrap_or(default))
    }

    /// One number above 0, or its default.
    pub fn positive(&self, name: &str, default: f64) -> Result<f64, ReadError> {
        let x = self.float(name, default)?;
        if x > 0.0 { Ok(x) } else { Err(self.error(format!("\"{name}\" is {x}: it must be above 0"))) }
    }

    /// One whole number from 0 to 2³² − 1.
    pub fn count(&self, name: &str) -> Result<Option<u32>, ReadError> {
        let Some(x) = self.number(name)? else { return Ok(None) };
        let fits = (0.0..=f64::from(u32::MAX)).contains(&x) && x.fract() == 0.0;
        let what = || self.error(format!("\"{name}\" is {x}: a whole number from 0 on is needed"));
        fits.then_some(Some(x as u32)).ok_or_else(what)
    }

    /// One string.
    pub fn text(&self, name: &str) -> Result<Option<&str>, ReadError> {
        let Some(p) = self.get(name) else { return Ok(None) };
        match &*p.values {
            Values::Texts(texts) if texts.len() == 1 => Ok(Some(&texts[0])),
            _ => Err(p.fail(self, "one string in quotes is needed".into())),
        }
    }

    /// All strings of a parameter.
    pub fn texts(&self, name: &str) -> Result<&[String], ReadError> {
        let Some(p) = self.get(name) else { return Ok(&[]) };
        match &*p.values {
            Values::Texts(texts) => Ok(texts),
            _ => Err(p.fail(self, "strings in quotes are needed".into())),
        }
    }

    /// One of `choices`, the first by default.
    pub fn choice<'c>(&self, name: &str, choices: &[&'c str]) -> Result<&'c str, ReadError> {
        let Some(given) = self.text(name)? else { return Ok(choices[0]) };
        let found = choices.iter().find(|c| **c == given);
        found.copied().ok_or_else(|| {
            let what = format!("\"{name}\" is {}: it is unknown", show(given.as_bytes()));
            self.error(what).hint(format!("One of {}.", choices.join(", ")))
        })
    }

    /// `true` or `false`, in quotes or not.
    pub fn boolean(&self, name: &str, default: bool) -> Result<bool, ReadError> {
        let Some(p) = self.get(name) else { return Ok(default) };
        match &*p.values {
            Values::Truths(truths) if truths.len() == 1 => Ok(truths[0]),
            Values::Texts(texts) if texts.len() == 1 && texts[0] == "true" => Ok(true),
            Values::Texts(texts) if texts.len() == 1 && texts[0] == "false" => Ok(false),
            _ => Err(p.fail(self, "true or false is needed".into())),
        }
    }

    /// A point or a vector.
    pub fn point(&self, name: &str) -> Result<Option<DVec3>, ReadError> {
        let Some(p) = self.get(name) else { return Ok(None) };
        match p.numbers(self)? {
            [x, y, z] if DVec3::new(*x, *y, *z).is_finite() => Ok(Some(DVec3::new(*x, *y, *z))),
            all => Err(p.fail(self, format!("three finite numbers are needed, {} are here", all.len()))),
        }
    }

    /// An error about the whole.
    pub fn error(&self, what: impl Into<String>) -> ReadError {
        self.at.error(format!("{}: {}", self.words, what.into()))
    }
}

impl Parameter {
    /// Its numbers.
    pub fn numbers(&self, of: &Parameters) -> Result<&[f64], ReadError> {
        match &*self.values {
            Values::Numbers(numbers) => Ok(numbers),
            _ => Err(self.fail(of, "numbers are needed".into())),
        }
    }

    /// An error about it.
    pub fn fail(&self, of: &Parameters, what: String) -> ReadError {
        self.at.error(format!("{}: \"{} {}\": {what}", of.words, self.kind, self.name))
    }
}
