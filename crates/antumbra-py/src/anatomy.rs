//! Shadows taken apart: what segments visit, and everything that makes a pixel.

use std::ops::Range;

use antumbra::query::{self, Visited};
use antumbra::render::{self, LightRay, SurfaceMet, ViewingRay};
use antumbra::trace::SegmentBuffer;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

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

    /// Everything that makes a pixel, as dicts and lists: `Explanation` of the Python side names them.
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
        let explained = py.detach(|| render::explain(&scene, pixel, &settings, around));
        let mut explained = explained.map_err(|e| errors::scene(&e, self.file()))?;
        explained.messages.extend(told);
        let out = PyDict::new(py);
        out.set_item("size", explained.size)?;
        out.set_item("value", explained.value)?;
        out.set_item("lights", explained.lights)?;
        out.set_item("messages", explained.messages.iter().map(said).collect::<Vec<_>>())?;
        let rays = PyList::empty(py);
        for ray in &explained.viewing_rays {
            rays.append(self.viewing_ray(py, ray)?)?;
        }
        out.set_item("viewing_rays", rays)?;
        Ok(out)
    }
}

impl PyScene {
    /// A place of the scene in the world.
    fn world(&self, p: [f32; 3]) -> [f64; 3] {
        let origin = self.origin();
        [0, 1, 2].map(|k| f64::from(p[k]) + origin[k])
    }

    fn viewing_ray<'py>(&self, py: Python<'py>, ray: &ViewingRay) -> PyResult<Bound<'py, PyDict>> {
        let out = PyDict::new(py);
        out.set_item("origin", self.world(ray.origin.to_array()))?;
        out.set_item("direction", ray.direction.to_array())?;
        out.set_item("met", ray.met.as_ref().map(|met| self.met(py, met)).transpose()?)?;
        out.set_item("emission", ray.emission)?;
        let rows = PyList::empty(py);
        for row in &ray.light_rays {
            rows.append(self.light_ray(py, row)?)?;
        }
        out.set_item("light_rays", rows)?;
        Ok(out)
    }

    fn met<'py>(&self, py: Python<'py>, met: &SurfaceMet) -> PyResult<Bound<'py, PyDict>> {
        let out = PyDict::new(py);
        out.set_item("position", self.world(met.receiver.p.to_array()))?;
        out.set_item("normal", met.receiver.ng.to_array())?;
        out.set_item("shading_normal", met.receiver.frame.n.to_array())?;
        out.set_item("distance", met.distance)?;
        out.set_item("object", &met.object)?;
        out.set_item("material", &met.material)?;
        out.set_item("albedo", met.receiver.bsdf.albedo().0)?;
        Ok(out)
    }

    fn light_ray<'py>(&self, py: Python<'py>, row: &LightRay) -> PyResult<Bound<'py, PyDict>> {
        let out = PyDict::new(py);
        out.set_item("by_direction", row.by_direction)?;
        out.set_item("light", row.light)?;
        out.set_item("direction", row.wi.to_array())?;
        out.set_item("point", row.point.map(|p| self.world(p.to_array())))?;
        out.set_item("distance", row.distance)?;
        out.set_item("cos", row.cos)?;
        out.set_item("cos_light", row.cos_light)?;
        out.set_item("radiance", row.radiance.0)?;
        out.set_item("brdf", row.brdf.0)?;
        out.set_item("pdf", row.pdf)?;
        out.set_item("weight", row.weight)?;
        out.set_item("visible", row.visible)?;
        out.set_item("blocker", &row.blocker)?;
        out.set_item("brings", row.brings)?;
        Ok(out)
    }
}
