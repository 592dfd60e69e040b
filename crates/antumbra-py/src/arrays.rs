//! Arrays of Python read as they lie: float32 or float64, any stride.

use std::ops::Range;

use numpy::PyReadonlyArray2;
use numpy::ndarray::{ArrayView2, Axis, Slice};
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

    /// Rows of `run` in single precision, component by component; false if one is not finite.
    pub fn split(&self, run: Range<usize>, out: &mut [&mut [f32]; 3]) -> bool {
        let run = Slice::from(run);
        match self {
            View::Single(array) => split(array.slice_axis(Axis(0), run), out, |c| c),
            View::Double(array) => split(array.slice_axis(Axis(0), run), out, |c| c as f32),
        }
        out.iter().all(|component| component.iter().fold(true, |sound, c| sound & c.is_finite()))
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

fn split<T: Copy>(rows: ArrayView2<'_, T>, out: &mut [&mut [f32]; 3], single: impl Fn(T) -> f32) {
    let [x, y, z] = out;
    if let Some(flat) = rows.as_slice() {
        let all = flat.as_chunks::<3>().0.iter();
        for ((([a, b, c], x), y), z) in all.zip(x.iter_mut()).zip(y.iter_mut()).zip(z.iter_mut()) {
            (*x, *y, *z) = (single(*a), single(*b), single(*c));
        }
    } else {
        for (column, out) in rows.columns().into_iter().zip([x, y, z]) {
            column.iter().zip(out.iter_mut()).for_each(|(value, out)| *out = single(*value));
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
