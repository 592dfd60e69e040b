//! A scene on its way into a file for other programs.

use std::path::Path;

use antumbra_io::picture::check_writable;
use antumbra_io::{WRITES, is_written, write_scene};
use pyo3::prelude::*;

use crate::errors;
use crate::scene::{PyScene, said};

/// Files with their sizes [bytes], the scene's own first; and what the format could not hold: (level, place, text).
type Written = (Vec<(String, u64)>, Vec<(&'static str, String, String)>);

#[pymethods]
impl PyScene {
    /// Writes it in the format of the path's ending, whole or not at all.
    fn export(&self, py: Python<'_>, path: &str) -> PyResult<Written> {
        known(path)?;
        // What is wrong with it is an error of the scene, not of the file.
        self.scene(py)?;
        let builder = self.parts()?;
        let written = py.detach(|| write_scene(Path::new(path), builder, self.origin()));
        let written = written.map_err(|e| errors::write(&e))?;
        let files =
            written.files.into_iter().map(|(path, bytes)| (path.display().to_string(), bytes)).collect();
        Ok((files, written.messages.iter().map(said).collect()))
    }
}

/// Raises OptionError for an ending that is not written, OSError if the file could not be. Leaves nothing behind.
#[pyfunction]
pub fn check_scene_path(path: &str) -> PyResult<()> {
    known(path)?;
    check_writable(Path::new(path)).map_err(|e| errors::write(&e))
}

fn known(path: &str) -> PyResult<()> {
    if is_written(Path::new(path)) { Ok(()) } else { Err(errors::choice(format!("\"{path}\": {WRITES}"))) }
}
