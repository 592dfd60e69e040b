//! The built-in scenes. To add one: a file here and a line in [`SCENES`].

use super::SceneBuilder;

/// A number that people may set with `-D name=value`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Its name, words joined by `-`.
    pub name: &'static str,
    /// Its value unless set.
    pub default: f64,
    /// Smallest value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
    /// What it means, with its unit.
    pub help: &'static str,
}

/// A scene that needs no file.
#[derive(Clone, Copy)]
pub struct Builtin {
    /// Its name on the command line.
    pub name: &'static str,
    /// One sentence: what it shows.
    pub shows: &'static str,
    /// What can be set.
    pub parameters: &'static [Parameter],
    /// Makes it; `values` answers for every parameter.
    pub build: fn(values: &Values) -> SceneBuilder,
}

/// The value of every parameter of a built-in scene.
#[derive(Clone, Debug)]
pub struct Values(Vec<(&'static str, f64)>);

impl Values {
    /// The value of `name`; the name is one of the scene's own parameters.
    pub fn get(&self, name: &str) -> f64 {
        self.0.iter().find(|(n, _)| *n == name).map_or(f64::NAN, |(_, v)| *v)
    }
}

/// All built-in scenes, in the order in which people meet them.
pub const SCENES: &[Builtin] = &[];
