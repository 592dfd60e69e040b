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

/// The same, usable without Python's lock: each row minus an origin, so that places far from 0 keep their digits.
#[derive(Clone, Copy)]
pub struct View<'a> {
    numbers: Numbers<'a>,
    origin: [f64; 3],
}

#[derive(Clone, Copy)]
enum Numbers<'a> {
    Single(ArrayView2<'a, f32>),
    Double(ArrayView2<'a, f64>),
}

impl Rows<'_> {
    /// A view of the numbers as they are.
    pub fn view(&self) -> View<'_> {
        self.about([0.0; 3])
    }

    /// A view of places, relative to `origin`.
    pub fn about(&self, origin: [f64; 3]) -> View<'_> {
        let numbers = match self {
            Rows::Single(array) => Numbers::Single(array.as_array()),
            Rows::Double(array) => Numbers::Double(array.as_array()),
        };
        View { numbers, origin }
    }
}

impl View<'_> {
    /// Number of rows.
    pub fn len(&self) -> usize {
        match self.numbers {
            Numbers::Single(array) => array.nrows(),
            Numbers::Double(array) => array.nrows(),
        }
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        match self.numbers {
            Numbers::Single(array) => array.ncols(),
            Numbers::Double(array) => array.ncols(),
        }
    }

    /// Row `i`; the caller has checked that there are `K` columns.
    pub fn row<const K: usize>(&self, i: usize) -> [f64; K] {
        let row = self.given::<K>(i);
        std::array::from_fn(|k| row[k] - self.origin[k])
    }

    /// Row `i` as the caller gave it.
    fn given<const K: usize>(&self, i: usize) -> [f64; K] {
        match self.numbers {
            Numbers::Single(array) => std::array::from_fn(|k| f64::from(array[[i, k]])),
            Numbers::Double(array) => std::array::from_fn(|k| array[[i, k]]),
        }
    }

    /// Rows of `run` in single precision, component by component; false if one is not finite.
    pub fn split(&self, run: Range<usize>, out: &mut [&mut [f32]; 3]) -> bool {
        let run = Slice::from(run);
        let [x, y, z] = self.origin;
        match self.numbers {
            Numbers::Single(array) if self.origin == [0.0; 3] => {
                split(array.slice_axis(Axis(0), run), out, [|c| c; 3]);
            }
            Numbers::Single(array) => {
                let about = |o: f64| move |c: f32| (f64::from(c) - o) as f32;
                split(array.slice_axis(Axis(0), run), out, [about(x), about(y), about(z)]);
            }
            Numbers::Double(array) => {
                let about = |o: f64| move |c: f64| (c - o) as f32;
                split(array.slice_axis(Axis(0), run), out, [about(x), about(y), about(z)]);
            }
        }
        out.iter().all(|component| component.iter().fold(true, |sound, c| sound & c.is_finite()))
    }

    /// Row `i` if all of it is finite; else an error that names it.
    pub fn finite<const K: usize>(&self, name: &str, i: usize) -> Result<[f64; K], String> {
        let row = self.row(i);
        if row.iter().all(|c| c.is_finite()) {
            Ok(row)
        } else {
            Err(format!("{name}[{i}] is {:?}: finite numbers are needed", self.given::<K>(i)))
        }
    }
}

fn split<T: Copy>(rows: ArrayView2<'_, T>, out: &mut [&mut [f32]; 3], single: [impl Fn(T) -> f32; 3]) {
    let [x, y, z] = out;
    if let Some(flat) = rows.as_slice() {
        let all = flat.as_chunks::<3>().0.iter();
        for ((([a, b, c], x), y), z) in all.zip(x.iter_mut()).zip(y.iter_mut()).zip(z.iter_mut()) {
            (*x, *y, *z) = (single[0](*a), single[1](*b), single[2](*c));
        }
    } else {
        for ((column, out), single) in rows.columns().into_iter().zip([x, y, z]).zip(single) {
            column.iter().zip(out.iter_mut()).for_each(|(value, out)| *out = single(*value));
        }
    }
}

/// Has `K` columns, or an error that says what is needed (the Python side has checked it before).
pub fn columns(name: &str, view: &View<'_>, k: usize) -> PyResult<()> {
    if view.columns() == k {
        Ok(())
    } else {
        Err(errors::value(format!("{name} has {} columns: {k} are needed", view.columns())))
    }
}
