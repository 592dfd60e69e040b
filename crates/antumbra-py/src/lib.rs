//! The Python binding: arrays in, arrays out, the lock released, errors translated; no algorithm. Floor 10.

use pyo3::prelude::*;

/// What `import antumbra._core` gives.
#[pymodule(gil_used = false)]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    Ok(())
}
