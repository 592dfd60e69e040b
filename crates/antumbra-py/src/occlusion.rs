//! Masks of occlusion: which of many directions are blocked over points.

use antumbra::estimator::Falloff;
use antumbra::query;
use antumbra::trace::occlusion::Method;
use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray, PyArray2, PyArray3};
use pyo3::prelude::*;

use crate::arrays::Rows;
use crate::ask::Origins;
use crate::errors;
use crate::query::{Column, Table, spread, table};
use crate::scene::PyScene;
use crate::watch::watched;

/// masks, directions, lengths, frames, work.
type Masks<'py> = (Bound<'py, PyArray2<u64>>, Table<'py>, Column<'py>, Bound<'py, PyArray3<f32>>, [u64; 7]);

#[pymethods]
impl PyScene {
    /// Bits of blocked directions, (N, D/64) uint64; directions (D, 3) and lengths (D,) float32 in the frames (N, 3, 3);
    /// boxes, pairs, pairs in range, between directions, directions tested, put to the law, rays.
    #[allow(clippy::too_many_arguments, reason = "the arguments of the Python method")]
    fn occlusion_masks<'py>(
        &self,
        py: Python<'py>,
        points: Origins<'_>,
        normals: Option<Rows<'_>>,
        directions: usize,
        radius: f32,
        falloff: &str,
        method: &str,
        turned: bool,
    ) -> PyResult<Masks<'py>> {
        let asked = query::directions(directions, radius, falloff_named(falloff)?);
        let asked = asked.map_err(|e| errors::value(e.to_string()))?;
        let method = method_named(method)?;
        let scene = self.scene(py)?;
        let (queries, rows, n) = self.gather(py, &scene, &points, normals.as_ref())?;
        let found = watched(py, |look| {
            query::occlusion_masks(&scene, &queries, (&asked, method), turned, 0, &mut |_| look())
        })?;
        // Rows that met nothing are open; they have no frame.
        let words = asked.words();
        let mut masks = vec![0; n * words];
        for (mask, row) in found.words.chunks(words).zip(&rows) {
            masks[row * words..][..words].copy_from_slice(mask);
        }
        let frames = spread(&found.frames, &rows, n, [[f32::NAN; 3]; 3]);
        let frames = frames.into_flattened().into_flattened();
        let local: Vec<[f32; 3]> = (0..asked.len()).map(|i| asked.local(i)).collect();
        let lengths: Vec<f32> = (0..asked.len()).map(|i| asked.reach(i)).collect();
        let work = found.work;
        let shape = |e: numpy::ndarray::ShapeError| errors::value(e.to_string());
        Ok((
            Array2::from_shape_vec((n, words), masks).map_err(shape)?.into_pyarray(py),
            table(py, &local)?,
            lengths.into_pyarray(py),
            Array3::from_shape_vec((n, 3, 3), frames).map_err(shape)?.into_pyarray(py),
            [work.boxes, work.pairs, work.in_range, work.between, work.tested, work.law, work.rays],
        ))
    }
}

fn falloff_named(name: &str) -> PyResult<Falloff> {
    match name {
        "none" => Ok(Falloff::None),
        "linear" => Ok(Falloff::Linear),
        "quadratic" => Ok(Falloff::Quadratic),
        _ => Err(errors::choice(format!("there is no falloff \"{name}\" (none, linear, quadratic)"))),
    }
}

fn method_named(name: &str) -> PyResult<Method> {
    match name {
        "occluders" => Ok(Method::Occluders),
        "receivers" => Ok(Method::Receivers),
        "rays" => Ok(Method::Rays),
        _ => Err(errors::choice(format!("there is no method \"{name}\" (occluders, receivers, rays)"))),
    }
}
