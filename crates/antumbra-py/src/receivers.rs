//! Points on surfaces that rays have met, and the hits that they come from.

use std::sync::Arc;

use antumbra::math::{Rgb, Vec3};
use antumbra::query::RayHit;
use antumbra::scene::{Met, Scene};
use antumbra::schedule;
use antumbra::sensor::Query;
use antumbra::trace::{NO_PRIM, PrimId};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::errors;
use crate::watch::watched;

/// Where a segment from a receiver starts.
pub struct Start {
    /// The safe start above the surface.
    pub origin: [f32; 3],
    /// The primitive it leaves.
    pub prim: PrimId,
    /// Its normal, on the side of the start.
    pub normal: [f64; 3],
}

/// Points on surfaces of a scene.
#[pyclass(frozen, module = "antumbra._core")]
pub struct Receivers {
    scene: Arc<Scene>,
    rays: Arc<Vec<RayHit>>,
    /// What is added to a place of the scene to have it in the world.
    origin: [f64; 3],
}

impl Receivers {
    /// The scene that they lie in.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// The rays that met them.
    pub fn rays(&self) -> &[RayHit] {
        &self.rays
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.rays.len()
    }

    /// The surface at receiver `i`; `None` where the ray missed.
    pub fn met(&self, i: usize) -> Option<Met> {
        self.rays[i].met(&self.scene)
    }

    /// Where segments of receiver `i` start.
    pub fn start(&self, i: usize) -> Option<Start> {
        let at = self.met(i)?.receiver;
        Some(Start { origin: at.start, prim: at.prim, normal: doubles(at.ng) })
    }

    /// Receiver `i` as a query.
    pub fn query(&self, i: usize) -> Option<Query> {
        let start = self.start(i)?;
        Some(Query { p: self.rays[i].position(), n: start.normal, start: Some((start.origin, start.prim)) })
    }

    /// A row for each receiver, NaN where the ray missed.
    fn table<'py>(
        &self,
        py: Python<'py>,
        row: impl Fn(usize) -> Option<[f64; 3]> + Sync,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let mut values = vec![[f64::NAN; 3]; self.len()];
        let fill = |from: usize, out: &mut [[f64; 3]], _: &mut ()| {
            let found = |(i, out): (usize, &mut [f64; 3])| *out = row(from + i).unwrap_or(*out);
            out.iter_mut().enumerate().for_each(found);
        };
        watched(py, |look| schedule::chunks(&mut values, CHUNK, 0, fill, &mut |_| look()))?;
        let array = Array2::from_shape_vec((self.len(), 3), values.into_flattened());
        Ok(array.map_err(|e| errors::value(e.to_string()))?.into_pyarray(py))
    }
}

/// Receivers that a thread takes at once.
const CHUNK: usize = 4096;

fn doubles(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

#[pymethods]
impl Receivers {
    /// (N, 3) float64; NaN where the ray missed.
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let place = |ray: &RayHit| {
            let p = ray.position();
            [0, 1, 2].map(|k| p[k] + self.origin[k])
        };
        self.table(py, |i| (self.rays[i].prim != NO_PRIM).then(|| place(&self.rays[i])))
    }

    /// Geometric unit normals on the side that was looked at, (N, 3) float64; NaN where the ray missed.
    fn normals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.table(py, |i| self.met(i).map(|met| doubles(met.receiver.ng)))
    }

    /// Unit normals that shading uses, (N, 3) float64; NaN where the ray missed.
    fn shading_normals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.table(py, |i| self.met(i).map(|met| doubles(met.receiver.frame.n)))
    }

    /// ω_o, unit vectors back along the rays, (N, 3) float64; NaN where the ray missed.
    fn toward_viewer<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let back = |ray: &RayHit| {
            let d = ray.d.map(f64::from);
            let length = d.iter().map(|c| c * c).sum::<f64>().sqrt();
            d.map(|c| -c / length)
        };
        self.table(py, |i| (self.rays[i].prim != NO_PRIM).then(|| back(&self.rays[i])))
    }

    fn __len__(&self) -> usize {
        self.len()
    }

    /// Those of these numbers.
    fn take(&self, numbers: PyReadonlyArray1<'_, u64>) -> PyResult<Receivers> {
        let ray = |i: &u64| self.rays.get(*i as usize).copied();
        let rays: Option<Vec<RayHit>> = numbers.as_array().iter().map(ray).collect();
        let rays = rays.ok_or_else(|| errors::value(format!("there are {} receivers", self.len())))?;
        Ok(Receivers { scene: Arc::clone(&self.scene), rays: Arc::new(rays), origin: self.origin })
    }
}

/// The closest hit of each ray.
#[pyclass(frozen, module = "antumbra._core")]
pub struct Hits {
    receivers: Receivers,
}

impl Hits {
    /// What rays of a scene met.
    pub fn new(scene: Arc<Scene>, rays: Vec<RayHit>, origin: [f64; 3]) -> Hits {
        Hits { receivers: Receivers { scene, rays: Arc::new(rays), origin } }
    }

    /// The number of the object and of the primitive in it.
    fn located(&self, ray: &RayHit) -> (u32, u32) {
        if ray.prim == NO_PRIM {
            return (NO_PRIM, NO_PRIM);
        }
        self.receivers.scene.world().locate(ray.prim).unwrap_or((NO_PRIM, NO_PRIM))
    }
}

#[pymethods]
impl Hits {
    /// Ray parameter, (N,) float64; inf for a miss.
    fn t<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.receivers.rays.iter().map(|ray| ray.t).collect::<Vec<_>>().into_pyarray(py)
    }

    /// Primitive within its object, (N,) uint32.
    fn primitive<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        self.receivers.rays.iter().map(|ray| self.located(ray).1).collect::<Vec<_>>().into_pyarray(py)
    }

    /// Number of the object, (N,) uint32.
    fn mesh<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        self.receivers.rays.iter().map(|ray| self.located(ray).0).collect::<Vec<_>>().into_pyarray(py)
    }

    /// Weights of the second and third corner, (N, 2) float32.
    fn uv<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let values = self.receivers.rays.iter().flat_map(|ray| ray.uv).collect();
        let shape = (self.receivers.len(), 2);
        let array = Array2::from_shape_vec(shape, values).map_err(|e| errors::value(e.to_string()))?;
        Ok(array.into_pyarray(py))
    }

    /// Light that each ray sees of the lights themselves: L_e of what it met, else of all light at infinity; and the
    /// colour of surfaces that show it as it is. (N, 3) float64.
    fn emitted<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let Receivers { scene, rays, .. } = &self.receivers;
        let light = |i: usize| match rays[i].met(scene) {
            Some(met) => met.emitted.map_or(Rgb::BLACK, |(_, radiance)| radiance) + met.shown,
            None => {
                let d = Vec3::from(rays[i].d).normalize_or_zero();
                scene.from_infinity(d).fold(Rgb::BLACK, |sum, (_, radiance)| sum + radiance)
            }
        };
        self.receivers.table(py, |i| Some(light(i).0.map(f64::from)))
    }

    /// Those of these numbers.
    fn take(&self, numbers: PyReadonlyArray1<'_, u64>) -> PyResult<Hits> {
        self.receivers.take(numbers).map(|receivers| Hits { receivers })
    }

    /// The same points for further queries.
    fn receivers(&self) -> Receivers {
        let Receivers { scene, rays, origin } = &self.receivers;
        Receivers { scene: Arc::clone(scene), rays: Arc::clone(rays), origin: *origin }
    }
}
