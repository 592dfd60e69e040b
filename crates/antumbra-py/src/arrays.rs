//! Arrays of Python read as they lie: float32 or float64, any stride.

use numpy::PyReadonlyArray2;
use numpy::ndarray::ArrayView2;
use pyo3::prelude::*;

use crate::errors;

/// An (N, K) array of either precision.
#[derive(FromPyObject)]
pub enum Rows<'py> {
    /// float32.
    Single(PyReadonlyArray2<'py, f32>),
    /// float64.
    Double(PyReadonlyArray2<'py, f64>),
}

/// The same, usable without Python's lock.
#[derive(Clone, Copy)]
pub enum View<'a> {
    /// float32.
    Single(ArrayView2<'a, f32>),
    /// float64.
    Double(ArrayView2<'a, f64>),
}

impl Rows<'_> {
    /// A view of the array.
    pub fn view(&self) -> View<'_> {
        match self {
            Rows::Single(array) => View::Single(array.as_array()),
            Rows::Double(array) => View::Double(array.as_array()),
        }
    }
}

impl View<'_> {
    /// Number of rows.
    pub fn len(&self) -> usize {
        match self {
            View::Single(array) => array.nrows(),
            View::Double(array) => array.nrows(),
        }
    }

    /// Row `i`; the caller has checked that there are `K` columns.
    pub fn row<const K: usize>(&self, i: usize) -> [f64; K] {
        match self {
            View::Single(array) => std::array::from_fn(|k| f64::from(array[[i, k]])),
            View::Double(array) => std::array::from_fn(|k| array[[i, k]]),
        }
    }

    /// Row `i` if all of it is finite; else an error that names it.
    pub fn finite<const K: usize>(&self, name: &str, i: usize) -> Result<[f64; K], String> {
        let row = self.row(i);
        if row.iter().all(|c| c.is_finite()) {
            Ok(row)
        } else {
            Err(format!("{name}[{i}] is {row:?}: finite numbers are needed"))
        }
    }
}

/// Has `K` columns, or an error that says what is needed (the Python side has checked it before).
pub fn columns(name: &str, view: &View<'_>, k: usize) -> PyResult<()> {
    let found = match view {
        View::Single(array) => array.ncols(),
        View::Double(array) => array.ncols(),
    };
    if found == k {
        Ok(())
    } else {
        Err(errors::value(format!("{name} has {found} columns: {k} are needed")))
    }
}
