//! Draco meshes through the Python package `DracoPy`, the extra `antumbra[draco]`.

use antumbra_io::{DracoAttribute, DracoError, DracoMesh};
use pyo3::exceptions::PyImportError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// Unpacks one primitive; the words for numpy and the package stand in `antumbra._draco`.
pub fn decode(bytes: &[u8], wanted: &[DracoAttribute]) -> Result<DracoMesh, DracoError> {
    Python::attach(|py| {
        let asked: Vec<_> = wanted.iter().map(|w| (w.id, w.component)).collect();
        let decoder = py.import("antumbra._draco")?.getattr("decode")?;
        let (indices, attributes) =
            decoder.call1((PyBytes::new(py, bytes), asked))?.extract::<(Vec<u8>, Vec<Vec<u8>>)>()?;
        let (words, _) = indices.as_chunks::<4>();
        Ok(DracoMesh { indices: words.iter().map(|w| u32::from_le_bytes(*w)).collect(), attributes })
    })
    .map_err(|e: PyErr| {
        Python::attach(|py| match e.is_instance_of::<PyImportError>(py) {
            true => DracoError::Missing,
            false => DracoError::Broken(e.value(py).to_string()),
        })
    })
}
