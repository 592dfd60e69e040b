//! The pieces of an estimator that is written in Python: viewing rays, random numbers, light points.

use antumbra::query::{self, LightDraw, LightFound};
use antumbra::render::Pass;
use antumbra::sampler::Use;
use numpy::ndarray::{Array1, Array2};
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::prelude::*;

use crate::arrays::{Rows, columns};
use crate::ask::Origins;
use crate::query::{Column, Doubles, Table, Words, spread, table};
use crate::scene::PyScene;
use crate::watch::watched;
use crate::{errors, settings};

/// direction, target, distance, radiance, pdf, cos θ′, light.
type LightArrays<'py> =
    (Table<'py>, Doubles<'py>, Column<'py>, Table<'py>, Column<'py>, Column<'py>, Bound<'py, PyArray1<u32>>);

#[pymethods]
impl PyScene {
    /// One drawn light point a receiver.
    fn sample_light<'py>(
        &self,
        py: Python<'py>,
        points: Origins<'_>,
        normals: Option<Rows<'_>>,
        u: Rows<'_>,
        words: Words,
    ) -> PyResult<LightArrays<'py>> {
        let scene = self.scene(py)?;
        let settings = settings::parse(&words)?;
        let (queries, rows, n) = self.gather(py, &scene, &points, normals.as_ref())?;
        let u = u.view();
        let numbers: Result<Vec<[f32; 3]>, String> =
            rows.iter().map(|i| unit(u.finite::<3>("u", *i)?, *i)).collect();
        let numbers = numbers.map_err(errors::value)?;
        let drawn =
            watched(py, |look| query::sample_light(&scene, &queries, &numbers, &settings, &mut |_| look()))?;
        let drawn = spread(&drawn, &rows, n, LightDraw::NONE);
        let rows = |of: fn(&LightDraw) -> [f32; 3]| drawn.iter().map(of).collect::<Vec<_>>();
        let column = |of: fn(&LightDraw) -> f32| drawn.iter().map(of).collect::<Array1<_>>().into_pyarray(py);
        Ok((
            table(py, &rows(|d| d.direction))?,
            self.places(py, drawn.iter().map(|d| d.target))?,
            column(|d| d.distance),
            table(py, &rows(|d| d.radiance))?,
            column(|d| d.pdf),
            column(|d| d.cos_light),
            drawn.iter().map(|d| d.light).collect::<Array1<_>>().into_pyarray(py),
        ))
    }

    /// radiance, pdf: what a ray of each receiver finds of the lights.
    fn find_light<'py>(
        &self,
        py: Python<'py>,
        points: Origins<'_>,
        normals: Option<Rows<'_>>,
        directions: Rows<'_>,
        words: Words,
    ) -> PyResult<(Table<'py>, Column<'py>)> {
        let scene = self.scene(py)?;
        let settings = settings::parse(&words)?;
        let (queries, rows, n) = self.gather(py, &scene, &points, normals.as_ref())?;
        let directions = directions.view();
        columns("directions", &directions, 3)?;
        let along: Result<Vec<[f32; 3]>, String> =
            rows.iter().map(|i| toward(directions.finite::<3>("directions", *i)?, *i)).collect();
        let along = along.map_err(errors::value)?;
        let found =
            watched(py, |look| query::find_light(&scene, &queries, &along, &settings, &mut |_| look()))?;
        let found = spread(&found, &rows, n, LightFound::NONE);
        let radiance: Vec<[f32; 3]> = found.iter().map(|f| f.radiance).collect();
        let pdf: Array1<f32> = found.iter().map(|f| f.pdf).collect();
        Ok((table(py, &radiance)?, pdf.into_pyarray(py)))
    }

    /// Origins and unit directions of one viewing ray through each pixel, (H·W, 3) float64 each: through its centre, or
    /// those of pass `number` of a render.
    #[pyo3(signature = (words, number = None))]
    fn camera_rays<'py>(
        &self,
        py: Python<'py>,
        words: Words,
        number: Option<u32>,
    ) -> PyResult<(Doubles<'py>, Doubles<'py>)> {
        let pass = self.pass(py, &words, number.unwrap_or(0))?;
        let rays: Vec<_> = match number {
            Some(_) => pass.viewing_rays().collect(),
            None => pass.centres().collect(),
        };
        let directions = rays.iter().flat_map(|(_, d)| d.to_array().map(f64::from)).collect();
        let directions = Array2::from_shape_vec((rays.len(), 3), directions);
        let directions = directions.map_err(|e| errors::value(e.to_string()))?;
        Ok((self.places(py, rays.iter().map(|(o, _)| o.to_array()))?, directions.into_pyarray(py)))
    }

    /// The replicate that each pass of a render belongs to.
    #[staticmethod]
    fn pass_replicates(words: Words) -> PyResult<Vec<u32>> {
        let settings = settings::parse(&words)?;
        let plan = settings.passes_of(settings.viewing_rays);
        Ok((0..plan.count).map(|pass| plan.locate(pass).0).collect())
    }

    /// (H·W, 2) float32: the numbers in [0, 1) that pass `number` of a render has for its `nth` pair, or the `nth` of
    /// the uses that take one number.
    fn pass_numbers<'py>(
        &self,
        py: Python<'py>,
        words: Words,
        number: u32,
        nth: u32,
        pair: bool,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        const PAIRS: [Use; 2] = [Use::LightPoint, Use::Direction];
        const SINGLES: [Use; 3] = [Use::LightChoice, Use::Lobe, Use::Roulette];
        let uses: &[Use] = if pair { &PAIRS } else { &SINGLES };
        let (bounce, what) = (nth / uses.len() as u32, uses[nth as usize % uses.len()]);
        let pass = self.pass(py, &words, number)?;
        let numbers: Vec<f32> = pass.numbers(what, bounce).flatten().collect();
        let numbers = Array2::from_shape_vec((numbers.len() / 2, 2), numbers);
        Ok(numbers.map_err(|e| errors::value(e.to_string()))?.into_pyarray(py))
    }
}

impl PyScene {
    fn pass(&self, py: Python<'_>, words: &[(String, String)], number: u32) -> PyResult<Pass> {
        let scene = self.scene(py)?;
        let mut settings = settings::parse(words)?;
        self.relate(&mut settings);
        Pass::new(&scene, &settings, number).map_err(|e| errors::scene(&e, self.file()))
    }
}

fn unit(u: [f64; 3], i: usize) -> Result<[f32; 3], String> {
    // The largest single below 1: a double just under 1 must not round up to it.
    const BELOW_ONE: f32 = 1.0 - f32::EPSILON / 2.0;
    if u.iter().all(|x| (0.0..1.0).contains(x)) {
        Ok(u.map(|x| (x as f32).min(BELOW_ONE)))
    } else {
        Err(format!("u[{i}] is {u:?}: numbers from 0 up to, not including, 1 are needed"))
    }
}

/// A unit vector.
fn toward(d: [f64; 3], i: usize) -> Result<[f32; 3], String> {
    let length = d.iter().map(|c| c * c).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() {
        Ok(d.map(|c| (c / length) as f32))
    } else {
        Err(format!("directions[{i}] is {d:?}: it points nowhere"))
    }
}
