//! The table of settings and the list of built-in scenes, as Python sees them.

use antumbra::scene::builtin;
use antumbra::settings::{self, Settings};
use pyo3::prelude::*;

use crate::errors;

/// name, group, metavar, choices, default, help, repeats.
type Row = (&'static str, &'static str, &'static str, Vec<&'static str>, String, String, bool);

/// Every setting: (name, group, metavar, choices, default, help, may be repeated).
#[pyfunction(name = "settings")]
pub fn table() -> Vec<Row> {
    let row = |s: &settings::Setting| {
        (s.name, s.group, s.metavar, s.choices.to_vec(), (s.default)(), s.help.trim().to_string(), s.repeats)
    };
    settings::TABLE.iter().map(row).collect()
}

/// Settings of pairs (name, text); `OptionError` names the wrong one.
pub fn parse(words: &[(String, String)]) -> PyResult<Settings> {
    let mut settings = Settings::default();
    for (name, text) in words {
        settings.set(name, text).map_err(|e| errors::option(&e))?;
    }
    Ok(settings)
}

/// Settings of a query, which has no camera and no picture; `OptionError` names a word of those.
pub fn parse_query(words: &[(String, String)]) -> PyResult<Settings> {
    const PICTURES: [&str; 8] =
        ["size", "viewing", "filter", "viewing_rays", "exposure", "tone", "aov", "exr"];
    for (name, _) in words {
        let camera = settings::TABLE.iter().any(|s| s.name == name && s.group == "Camera");
        if camera || PICTURES.contains(&name.as_str()) {
            let what = format!("{name} belongs to pictures: a query of points does not take it");
            return Err(errors::option(&settings::SettingError { name: name.clone(), what }));
        }
    }
    let settings = parse(words)?;
    settings.check().map_err(|e| errors::value(format!("{e}; {}", e.hint)))?;
    Ok(settings)
}

/// Raises `OptionError` unless every pair (name, text) is a setting with a value that it takes.
#[pyfunction]
pub fn check_settings(words: Vec<(String, String)>) -> PyResult<()> {
    parse(&words).map(|_| ())
}

/// The known word nearest to `text`, if one is near.
#[pyfunction]
pub fn nearest(text: &str, known: Vec<String>) -> Option<String> {
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    settings::nearest(text, &known).map(String::from)
}

/// name, what it shows, parameters (name, default, low, high, help).
type BuiltinRow = (&'static str, &'static str, Vec<(&'static str, f64, f64, f64, &'static str)>);

/// The built-in scenes: (name, what it shows, parameters (name, default, low, high, help)).
#[pyfunction]
pub fn builtins() -> Vec<BuiltinRow> {
    let parameter = |p: &builtin::Parameter| (p.name, p.default, p.low, p.high, p.help);
    let row = |s: &builtin::Builtin| (s.name, s.shows, s.parameters.iter().map(parameter).collect());
    builtin::SCENES.iter().map(row).collect()
}
