//! The Python binding: arrays in, arrays out, the lock released, errors translated; no algorithm. Floor 10.

mod anatomy;
mod arrays;
mod ask;
mod draco;
mod errors;
mod export;
mod info;
mod kinds;
mod meshes;
mod occlusion;
mod picture;
mod pieces;
mod query;
mod receivers;
mod render;
mod scene;
mod settings;
mod sky;
mod watch;

use pyo3::prelude::*;

/// What `import antumbra._core` gives.
#[pymodule(gil_used = false)]
mod _core {
    #[pymodule_export]
    use super::export::check_scene_path;
    #[pymodule_export]
    use super::kinds::metals;
    #[pymodule_export]
    use super::picture::{Picture, check_writable, read_part, read_picture, write_picture};
    #[pymodule_export]
    use super::receivers::{Hits, Receivers};
    #[pymodule_export]
    use super::scene::PyScene;
    #[pymodule_export]
    use super::settings::{builtins, check_settings, nearest, table};
    #[pymodule_export]
    use super::sky::{sky, sun_position};

    #[pymodule_init]
    fn init(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        pyo3::types::PyModuleMethods::add(module, "__version__", env!("CARGO_PKG_VERSION"))
    }
}
