//! Shadows taken apart: what segments visit, and everything that makes a pixel.

use std::collections::HashMap;
use std::ops::Range;

use antumbra::query::{self, Visited};
use antumbra::render::{self, LightRay, SurfaceMet, ViewingRay};
use antumbra::trace::SegmentBuffer;
use numpy::ndarray::Array2;
use numpy::{Element, IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::Rows;
use crate::ask::{Origins, Wrong};
use crate::scene::{PyScene, said};
use crate::watch::watched;
use crate::{errors, settings};

type Counts<'py> = Bound<'py, PyArray2<u32>>;

#[pymethods]
impl PyScene {
    /// (N, 4) uint32: boxes and primitives of any hit, boxes and primitives of closest hit; (N,) bool: blocked.
    #[pyo3(signature = (origins, ends, reach = None))]
    fn visits<'py>(
        &self,
        py: Python<'py>,
        origins: Origins<'_>,
        ends: Rows<'_>,
        reach: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<(Counts<'py>, Bound<'py, PyArray1<bool>>)> {
        let scene = self.scene(py)?;
        let batch = self.batch(&scene, &origins, &ends, reach.as_ref())?;
        let (mut out, wrong) = (vec![Visited::default(); batch.starts.len()], Wrong::default());
        let fill = |run: Range<usize>, buffer: &mut SegmentBuffer| batch.gather(run, buffer, &wrong);
        watched(py, |look| query::visits(&scene, &fill, 0, &mut out, &mut |_| look()))?;
        wrong.raise()?;
        let counts = |v: &Visited| [v.any.boxes, v.any.primitives, v.closest.boxes, v.closest.primitives];
        let numbers: Vec<u32> = out.iter().flat_map(counts).collect();
        let counts =
            Array2::from_shape_vec((out.len(), 4), numbers).map_err(|e| errors::value(e.to_string()))?;
        let blocked: Vec<bool> = out.iter().map(|v| v.blocked).collect();
        Ok((counts.into_pyarray(py), blocked.into_pyarray(py)))
    }

    /// Everything that makes a pixel, as arrays: `Explanation` of the Python side names them.
    fn explain<'py>(
        &self,
        py: Python<'py>,
        pixel: [u32; 2],
        words: Vec<(String, String)>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let mut settings = settings::parse(&words)?;
        self.relate(&mut settings);
        let (around, told) = crate::render::environment(py, &settings)?;
        let scene = self.scene(py)?;
        let explained = watched(py, |look| render::explain(&scene, pixel, &settings, around, look))?;
        let mut explained = explained.map_err(|e| errors::scene(&e, self.file()))?;
        explained.messages.extend(told);
        let (out, mut names) = (PyDict::new(py), Names::default());
        out.set_item("size", explained.size)?;
        out.set_item("value", explained.value)?;
        out.set_item("lights", explained.lights)?;
        out.set_item("messages", explained.messages.iter().map(said).collect::<Vec<_>>())?;
        out.set_item("viewing_rays", self.viewing_rays(py, &explained.viewing_rays)?)?;
        let met: Vec<&SurfaceMet> = explained.viewing_rays.iter().filter_map(|r| r.met.as_ref()).collect();
        out.set_item("receivers", self.receivers_met(py, &met, &mut names)?)?;
        let rows: Vec<&LightRay> = explained.viewing_rays.iter().flat_map(|r| &r.light_rays).collect();
        out.set_item("light_rays", self.light_rays(py, &rows, &mut names)?)?;
        out.set_item("names", names.list)?;
        Ok(out)
    }
}

/// Names of objects and materials, each once.
#[derive(Default)]
struct Names {
    list: Vec<String>,
    at: HashMap<String, i32>,
}

impl Names {
    /// The number of a name.
    fn number(&mut self, name: &str) -> i32 {
        if let Some(known) = self.at.get(name) {
            return *known;
        }
        let new = self.list.len() as i32;
        self.list.push(name.to_owned());
        self.at.insert(name.to_owned(), new);
        new
    }
}

impl PyScene {
    /// A place of the scene in the world.
    fn world(&self, p: [f32; 3]) -> [f64; 3] {
        let origin = self.origin();
        [0, 1, 2].map(|k| f64::from(p[k]) + origin[k])
    }

    /// `met`: the number of its receiver, −1 for none; `rows`: how many rays to lights it has.
    fn viewing_rays<'py>(&self, py: Python<'py>, rays: &[ViewingRay]) -> PyResult<Bound<'py, PyDict>> {
        let out = PyDict::new(py);
        let mut count = 0..;
        let met = rays.iter().map(|r| r.met.as_ref().and_then(|_| count.next()).unwrap_or(-1_i32));
        out.set_item("origin", vectors(py, rays.iter().map(|r| self.world(r.origin.to_array())))?)?;
        out.set_item("direction", vectors(py, rays.iter().map(|r| r.direction.to_array()))?)?;
        out.set_item("met", PyArray1::from_iter(py, met))?;
        out.set_item("emission", vectors(py, rays.iter().map(|r| r.emission))?)?;
        out.set_item("rows", PyArray1::from_iter(py, rays.iter().map(|r| r.light_rays.len() as i64)))?;
        Ok(out)
    }

    fn receivers_met<'py>(
        &self,
        py: Python<'py>,
        met: &[&SurfaceMet],
        names: &mut Names,
    ) -> PyResult<Bound<'py, PyDict>> {
        let out = PyDict::new(py);
        out.set_item("position", vectors(py, met.iter().map(|m| self.world(m.receiver.p.to_array())))?)?;
        out.set_item("normal", vectors(py, met.iter().map(|m| m.receiver.ng.to_array()))?)?;
        out.set_item("shading_normal", vectors(py, met.iter().map(|m| m.receiver.frame.n.to_array()))?)?;
        out.set_item("distance", PyArray1::from_iter(py, met.iter().map(|m| m.distance)))?;
        out.set_item("object", PyArray1::from_iter(py, met.iter().map(|m| names.number(&m.object))))?;
        out.set_item("material", PyArray1::from_iter(py, met.iter().map(|m| names.number(&m.material))))?;
        out.set_item("albedo", vectors(py, met.iter().map(|m| m.receiver.bsdf.albedo().0))?)?;
        Ok(out)
    }

    /// What is not there: light and blocker −1, point NaN, visible −1.
    fn light_rays<'py>(
        &self,
        py: Python<'py>,
        rows: &[&LightRay],
        names: &mut Names,
    ) -> PyResult<Bound<'py, PyDict>> {
        let out = PyDict::new(py);
        let numbers = |of: fn(&LightRay) -> f32| PyArray1::from_iter(py, rows.iter().map(|r| of(r)));
        let light = |r: &&LightRay| r.light.map_or(-1, i64::from);
        let point = |r: &&LightRay| r.point.map_or([f64::NAN; 3], |p| self.world(p.to_array()));
        let blocker = |r: &&LightRay| r.blocker.as_deref().map_or(-1, |name| names.number(name));
        out.set_item("by_direction", PyArray1::from_iter(py, rows.iter().map(|r| r.by_direction)))?;
        out.set_item("light", PyArray1::from_iter(py, rows.iter().map(light)))?;
        out.set_item("direction", vectors(py, rows.iter().map(|r| r.wi.to_array()))?)?;
        out.set_item("point", vectors(py, rows.iter().map(point))?)?;
        out.set_item("distance", numbers(|r| r.distance))?;
        out.set_item("cos", numbers(|r| r.cos))?;
        out.set_item("cos_light", numbers(|r| r.cos_light))?;
        out.set_item("radiance", vectors(py, rows.iter().map(|r| r.radiance.0))?)?;
        out.set_item("brdf", vectors(py, rows.iter().map(|r| r.brdf.0))?)?;
        out.set_item("pdf", numbers(|r| r.pdf))?;
        out.set_item("weight", numbers(|r| r.weight))?;
        out.set_item(
            "visible",
            PyArray1::from_iter(py, rows.iter().map(|r| r.visible.map_or(-1, i8::from))),
        )?;
        out.set_item("blocker", PyArray1::from_iter(py, rows.iter().map(blocker)))?;
        out.set_item("brings", vectors(py, rows.iter().map(|r| r.brings))?)?;
        Ok(out)
    }
}

/// Rows of three, (N, 3).
fn vectors<T: Element>(
    py: Python<'_>,
    rows: impl Iterator<Item = [T; 3]>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let all: Vec<T> = rows.flatten().collect();
    let shaped = Array2::from_shape_vec((all.len() / 3, 3), all);
    Ok(shaped.map_err(|e| errors::value(e.to_string()))?.into_pyarray(py))
}
