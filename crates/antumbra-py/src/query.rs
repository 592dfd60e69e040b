//! Queries of a scene: arrays of points or rays in, arrays of answers out.

use std::ops::Range;
use std::sync::Arc;

use antumbra::light::LightId;
use antumbra::math::Vec3;
use antumbra::query::{self, Estimated, RayHit, Region};
use antumbra::scene::{Scene, SceneError};
use antumbra::schedule::Flow;
use antumbra::sensor::Query;
use antumbra::settings::Settings;
use antumbra::trace::SegmentBuffer;
use numpy::ndarray::{Array1, Array2};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arrays::{Rows, columns};
use crate::ask::{Batch, Origins, Starts, Wrong, queries};
use crate::receivers::{Hits, Receivers};
use crate::scene::PyScene;
use crate::watch::watched;
use crate::{errors, settings};

pub(crate) type Words = Vec<(String, String)>;
pub(crate) type Table<'py> = Bound<'py, PyArray2<f32>>;
pub(crate) type Doubles<'py> = Bound<'py, PyArray2<f64>>;
pub(crate) type Column<'py> = Bound<'py, PyArray1<f32>>;

#[pymethods]
impl PyScene {
    /// (N,) bool: the open segment to each end is blocked, or the ray along it up to `reach`.
    #[pyo3(signature = (origins, ends, reach = None))]
    fn occluded<'py>(
        &self,
        py: Python<'py>,
        origins: Origins<'_>,
        ends: Rows<'_>,
        reach: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Bound<'py, PyArray1<bool>>> {
        let scene = self.scene(py)?;
        let batch = self.batch(&scene, &origins, &ends, reach.as_ref())?;
        let (mut out, wrong) = (vec![false; batch.starts.len()], Wrong::default());
        let fill = |run: Range<usize>, buffer: &mut SegmentBuffer| batch.gather(run, buffer, &wrong);
        watched(py, |look| query::occluded(&scene, &fill, 0, &mut out, &mut |_| look()))?;
        wrong.raise()?;
        Ok(out.into_pyarray(py))
    }

    /// What each ray meets first.
    fn closest_hit(
        &self,
        py: Python<'_>,
        origins: Origins<'_>,
        directions: Rows<'_>,
        reach: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Hits> {
        let scene = self.scene(py)?;
        let batch = self.batch(&scene, &origins, &directions, Some(&reach))?;
        let (mut out, wrong) = (vec![RayHit::MISS; batch.starts.len()], Wrong::default());
        let fill = |run: Range<usize>, buffer: &mut SegmentBuffer| batch.gather(run, buffer, &wrong);
        watched(py, |look| query::closest_hit(&scene, &fill, 0, &mut out, &mut |_| look()))?;
        wrong.raise()?;
        Ok(Hits::new(Arc::clone(&scene), out, self.origin()))
    }

    /// Irradiance and its standard error, (N, 3) float32 each.
    fn irradiance<'py>(
        &self,
        py: Python<'py>,
        points: Origins<'_>,
        normals: Option<Rows<'_>>,
        words: Words,
    ) -> PyResult<(Table<'py>, Table<'py>)> {
        let estimated =
            self.estimate(py, &points, normals.as_ref(), &words, [0.0; 3], |s, q, set, look| {
                query::irradiance(s, q, set, &mut |_| look())
            })?;
        Ok((table(py, &estimated.values)?, table(py, &estimated.standard_error)?))
    }

    /// Openness and its standard error, (N,) float32 each.
    fn ambient_occlusion<'py>(
        &self,
        py: Python<'py>,
        points: Origins<'_>,
        normals: Option<Rows<'_>>,
        words: Words,
    ) -> PyResult<(Column<'py>, Column<'py>)> {
        let estimated =
            self.estimate(py, &points, normals.as_ref(), &words, [1.0; 3], |s, q, set, look| {
                query::ambient_occlusion(s, q, set, &mut |_| look())
            })?;
        Ok((first(py, &estimated.values), first(py, &estimated.standard_error)))
    }

    /// Mean visibility of one light and its standard error, (N,) float32 each.
    fn visible_fraction<'py>(
        &self,
        py: Python<'py>,
        points: Origins<'_>,
        normals: Option<Rows<'_>>,
        light: &str,
        words: Words,
    ) -> PyResult<(Column<'py>, Column<'py>)> {
        let scene = self.scene(py)?;
        let number = light_number(&scene, light)?;
        // Of one light, by its number in the whole scene: whichever others shine.
        let estimated =
            self.estimate(py, &points, normals.as_ref(), &words, [0.0; 3], |_, q, set, look| {
                query::visible_fraction(&scene, q, number, set, &mut |_| look())
            })?;
        Ok((first(py, &estimated.values), first(py, &estimated.standard_error)))
    }

    /// 0 umbra, 1 penumbra, 2 antumbra, 3 lit, −1 where the light does not shine, (N,) int8.
    fn regions<'py>(
        &self,
        py: Python<'py>,
        points: Origins<'_>,
        normals: Option<Rows<'_>>,
        light: &str,
        words: Words,
    ) -> PyResult<Bound<'py, PyArray1<i8>>> {
        let settings = settings::parse_query(&words)?;
        let scene = self.scene(py)?;
        let number = light_number(&scene, light)?;
        let (queries, rows, n) = self.gather(py, &scene, &points, normals.as_ref())?;
        let found = watched(py, |look| query::regions(&scene, &queries, number, &settings, &mut |_| look()))?;
        let codes: Vec<i8> = found.into_iter().map(Region::code).collect();
        Ok(spread(&codes, &rows, n, Region::code(None)).into_pyarray(py))
    }

    /// f_r at each receiver, (N, 3) float32.
    fn brdf<'py>(
        &self,
        py: Python<'py>,
        receivers: PyRef<'_, Receivers>,
        wo: Rows<'_>,
        wi: Rows<'_>,
    ) -> PyResult<Table<'py>> {
        let (wo, wi) = (wo.view(), wi.view());
        columns("wo", &wo, 3)?;
        columns("wi", &wi, 3)?;
        let (receivers, wrong): (&Receivers, _) = (&receivers, Wrong::default());
        let directions = |i: usize| {
            let pair = wo.finite::<3>("wo", i).and_then(|wo| Ok([wo, wi.finite::<3>("wi", i)?]));
            let pair = pair.map_err(|what| wrong.note(i, what)).ok()?;
            Some(pair.map(|w| Vec3::from(w.map(|c| c as f32))))
        };
        let (scene, rays) = (receivers.scene(), receivers.rays());
        let values = watched(py, |look| query::brdf(scene, rays, &directions, 0, &mut |_| look()))?;
        wrong.raise()?;
        table(py, &values)
    }
}

impl PyScene {
    /// Segments or rays of arrays, relative to the scene's origin.
    pub fn batch<'a>(
        &self,
        scene: &Arc<Scene>,
        origins: &'a Origins<'_>,
        ends: &'a Rows<'_>,
        reach: Option<&'a PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Batch<'a>> {
        let starts = origins.view(scene, self.origin())?;
        let (name, ends) = match reach {
            Some(_) => ("directions", ends.view()),
            None => ("targets", ends.about(self.origin())),
        };
        columns(name, &ends, 3)?;
        if let Starts::Points(points) = starts {
            columns("origins", &points, 3)?;
        }
        Ok(Batch { starts, name, ends, reach: reach.map(|r| r.as_array()) })
    }

    /// The points that ask for light, each with its row; and how many rows there are.
    pub(crate) fn gather(
        &self,
        py: Python<'_>,
        scene: &Arc<Scene>,
        points: &Origins<'_>,
        normals: Option<&Rows<'_>>,
    ) -> PyResult<(Vec<Query>, Vec<usize>, usize)> {
        let starts = points.view(scene, self.origin())?;
        let (queries, rows) = queries(py, starts, normals.map(Rows::view))?;
        Ok((queries, rows, starts.len()))
    }

    /// World places of rows that are relative to the scene's origin, (N, 3) float64.
    pub(crate) fn places<'py>(
        &self,
        py: Python<'py>,
        rows: impl Iterator<Item = [f32; 3]>,
    ) -> PyResult<Doubles<'py>> {
        let origin = self.origin();
        let numbers: Vec<f64> = rows.flat_map(|p| [0, 1, 2].map(|k| f64::from(p[k]) + origin[k])).collect();
        let array = Array2::from_shape_vec((numbers.len() / 3, 3), numbers);
        Ok(array.map_err(|e| errors::value(e.to_string()))?.into_pyarray(py))
    }

    /// Estimates at every row; rows that met nothing get `elsewhere`, surely. Ctrl-C raises KeyboardInterrupt.
    fn estimate(
        &self,
        py: Python<'_>,
        points: &Origins<'_>,
        normals: Option<&Rows<'_>>,
        words: &[(String, String)],
        elsewhere: [f32; 3],
        ask: impl Fn(&Scene, &[Query], &Settings, &mut dyn FnMut() -> Flow) -> Estimated + Send + Sync,
    ) -> PyResult<Estimated> {
        let settings = settings::parse_query(words)?;
        let around = crate::render::environment(py, &settings)?;
        let scene = self.scene(py)?;
        let lit = settings.lit(&scene, around.0).map_err(|e| errors::scene(&e, self.file()))?;
        let (queries, rows, n) = self.gather(py, &scene, points, normals)?;
        let estimated = watched(py, |look| ask(&lit, &queries, &settings, look))?;
        Ok(Estimated {
            values: spread(&estimated.values, &rows, n, elsewhere),
            standard_error: spread(&estimated.standard_error, &rows, n, [0.0; 3]),
            rays_done: estimated.rays_done,
        })
    }
}

/// Values at their rows, `elsewhere` at all others.
pub(crate) fn spread<T: Copy>(values: &[T], rows: &[usize], n: usize, elsewhere: T) -> Vec<T> {
    let mut out = vec![elsewhere; n];
    for (value, row) in values.iter().zip(rows) {
        out[*row] = *value;
    }
    out
}

/// The light of this name or number, among those that shine.
fn light_number(scene: &Scene, light: &str) -> PyResult<LightId> {
    let names = scene.light_names();
    let by_name = names.names.iter().position(|name| name == light && !name.is_empty());
    let number = by_name.or_else(|| light.parse().ok()).filter(|n| *n < names.slots.len());
    let slot = number.map(|n| names.slots[n]).filter(|slot| *slot != u32::MAX);
    slot.ok_or_else(|| {
        let unknown = SceneError::unknown("light", light, &scene.distinct_light_names());
        errors::choice(format!("{}. {}", unknown.what, unknown.hint))
    })
}

pub(crate) fn table<'py>(py: Python<'py>, values: &[[f32; 3]]) -> PyResult<Table<'py>> {
    let array = Array2::from_shape_vec((values.len(), 3), values.as_flattened().to_vec());
    Ok(array.map_err(|e| errors::value(e.to_string()))?.into_pyarray(py))
}

fn first<'py>(py: Python<'py>, values: &[[f32; 3]]) -> Column<'py> {
    values.iter().map(|v| v[0]).collect::<Array1<f32>>().into_pyarray(py)
}
