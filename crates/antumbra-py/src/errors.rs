//! Errors of the core as Python exceptions, each translated once.

use antumbra::scene::SceneError;
use antumbra::settings::SettingError;
use antumbra_io::{ReadError, WriteError};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;

/// A wrong setting: `antumbra.OptionError`.
pub fn option(error: &SettingError) -> PyErr {
    raise("OptionError", (error.what.clone(),))
}

/// A wrong choice that is no setting: `antumbra.OptionError`.
pub fn choice(what: impl Into<String>) -> PyErr {
    raise("OptionError", (what.into(),))
}

/// A scene that cannot be made: `antumbra.SceneError`; `file` may be empty.
pub fn scene(error: &SceneError, file: &str) -> PyErr {
    raise("SceneError", (error.what.clone(), file.to_string(), error.place.clone(), error.hint.clone()))
}

/// A file that cannot be read: `antumbra.SceneError`.
pub fn read(error: &ReadError) -> PyErr {
    raise("SceneError", (error.what.clone(), error.file.clone(), error.place.clone(), error.hint.clone()))
}

/// A file that cannot be written: OSError.
pub fn write(error: &WriteError) -> PyErr {
    PyOSError::new_err(error.to_string())
}

/// Numbers that no query takes: ValueError.
pub fn value(what: impl Into<String>) -> PyErr {
    PyValueError::new_err(what.into())
}

/// The class of this name in `antumbra.errors`, called; or the reason why that failed.
fn raise<Args>(class: &str, args: Args) -> PyErr
where
    Args: for<'py> pyo3::call::PyCallArgs<'py>,
{
    Python::attach(|py| {
        let class = py.import("antumbra.errors").and_then(|module| module.getattr(class));
        match class.and_then(|class| class.call1(args)) {
            Ok(error) => PyErr::from_value(error),
            Err(problem) => problem,
        }
    })
}
