//! The built-in scenes. To add one: a file here and a line in [`SCENES`].

mod antumbra;
mod cornell_box;
mod corner;
mod eclipse;
mod hall;
mod interior;
mod many_lights;
mod noise;
mod pillars;
mod plane_and_cylinder;
mod scan;
mod sky;
mod sky_dome;
pub mod solids;
mod terrain;
#[cfg(test)]
mod tests;
mod veach_mis;

pub use sky::default_sky;
pub use sky_dome::under;

use super::{SceneBuilder, SceneError, nearest};

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
    /// Only whole numbers.
    pub whole: bool,
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
pub const SCENES: &[Builtin] = &[
    cornell_box::SCENE,
    pillars::SCENE,
    antumbra::SCENE,
    plane_and_cylinder::SCENE,
    corner::SCENE,
    sky_dome::SCENE,
    many_lights::SCENE,
    veach_mis::SCENE,
    eclipse::SCENE,
    terrain::SCENE,
    interior::SCENE,
    hall::SCENE,
    scan::SCENE,
];

/// The built-in scene of this name.
pub fn find(name: &str) -> Result<&'static Builtin, SceneError> {
    SCENES.iter().find(|s| s.name == name).ok_or_else(|| {
        let names: Vec<&str> = SCENES.iter().map(|s| s.name).collect();
        let guess = did_you_mean(name, &names);
        let all = names.join(", ");
        SceneError::new(
            "",
            format!("there is no built-in scene \"{name}\"{guess}"),
            format!("There are: {all}."),
        )
    })
}

/// Makes the built-in scene `name`, with the parameters that are `set` (`_` stands for `-`; the last of a name counts).
pub fn build(name: &str, set: &[(String, f64)]) -> Result<SceneBuilder, SceneError> {
    let scene = find(name)?;
    let mut values = Values(scene.parameters.iter().map(|p| (p.name, p.default)).collect());
    for (key, value) in set {
        let at = parameter(scene, &key.replace('_', "-"))?;
        check(scene, &scene.parameters[at], *value)?;
        values.0[at].1 = *value;
    }
    Ok((scene.build)(&values))
}

/// Index of the parameter called `key`.
fn parameter(scene: &Builtin, key: &str) -> Result<usize, SceneError> {
    scene.parameters.iter().position(|p| p.name == key).ok_or_else(|| {
        let names: Vec<&str> = scene.parameters.iter().map(|p| p.name).collect();
        let guess = did_you_mean(key, &names);
        let hint = match names.as_slice() {
            [] => "It has none.".into(),
            names => format!("There are: {}.", names.join(", ")),
        };
        SceneError::new(scene.name, format!("there is no parameter \"{key}\"{guess}"), hint)
    })
}

/// The value is one that the scene can be made with.
fn check(scene: &Builtin, of: &Parameter, value: f64) -> Result<(), SceneError> {
    let Parameter { name, low, high, help, .. } = of;
    let wrong = |what: String| Err(SceneError::new(scene.name, what, format!("{name}: {help}.")));
    if !(*low..=*high).contains(&value) {
        return wrong(format!("parameter {name}: {value} is outside {low} … {high}"));
    }
    if of.whole && value.fract() != 0.0 {
        return wrong(format!("parameter {name}: {value} is not a whole number"));
    }
    Ok(())
}

/// "; did you mean …?" if one of the names is near.
fn did_you_mean(name: &str, names: &[&str]) -> String {
    nearest(name, names).map_or_else(String::new, |guess| format!("; did you mean \"{guess}\"?"))
}
