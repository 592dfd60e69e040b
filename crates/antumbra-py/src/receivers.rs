//! Points on surfaces that rays have met, and the hits that they come from.

use std::sync::Arc;

use antumbra::math::Vec3;
use antumbra::scene::{Look, Met, Scene};
use antumbra::sensor::Query;
use antumbra::trace::{NO_PRIM, PrimId};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::errors;

/// A ray with what it met: small, because there may be millions; everything else follows from it.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Origin.
    pub o: [f32; 3],
    /// Direction, any length.
    pub d: [f32; 3],
    /// Ray parameter; +∞ for a miss.
    pub t: f64,
    /// What was met.
    pub prim: PrimId,
    /// Where on it.
    pub uv: [f32; 2],
}

impl Ray {
    /// A ray that met nothing.
    pub const MISS: Ray = Ray { o: [0.0; 3], d: [0.0; 3], t: f64::INFINITY, prim: NO_PRIM, uv: [0.0; 2] };

    fn position(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| f64::from(self.o[k]) + self.t * f64::from(self.d[k]))
    }
}

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
    rays: Arc<Vec<Ray>>,
    /// What is added to a place of the scene to have it in the world.
    origin: [f64; 3],
}

impl Receivers {
    /// The scene that they lie in.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.rays.len()
    }

    /// The surface at receiver `i`; `None` where the ray missed.
    pub fn met(&self, i: usize) -> Option<Met> {
        let ray = &self.rays[i];
        let meet = || self.scene.meet(ray.o.into(), ray.d.into(), ray.t, ray.prim, ray.uv, &Look::default());
        (ray.prim != NO_PRIM).then(meet)
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

    fn table<'py>(
        &self,
        py: Python<'py>,
        row: impl Fn(usize) -> Option<[f64; 3]> + Sync,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let values = py.detach(|| (0..self.len()).flat_map(|i| row(i).unwrap_or([f64::NAN; 3])).collect());
        let array =
            Array2::from_shape_vec((self.len(), 3), values).map_err(|e| errors::value(e.to_string()))?;
        Ok(array.into_pyarray(py))
    }
}

fn doubles(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

#[pymethods]
impl Receivers {
    /// (N, 3) float64; NaN where the ray missed.
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let place = |ray: &Ray| {
            let p = ray.position();
            [0, 1, 2].map(|k| p[k] + self.origin[k])
        };
        self.table(py, |i| (self.rays[i].prim != NO_PRIM).then(|| place(&self.rays[i])))
    }

    /// Geometric unit normals on the side that was looked at, (N, 3) float64; NaN where the ray missed.
    fn normals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.table(py, |i| self.met(i).map(|met| doubles(met.receiver.ng)))
    }

    fn __len__(&self) -> usize {
        self.len()
    }

    /// Those of these numbers.
    fn take(&self, numbers: PyReadonlyArray1<'_, u64>) -> PyResult<Receivers> {
        let ray = |i: &u64| self.rays.get(*i as usize).copied();
        let rays: Option<Vec<Ray>> = numbers.as_array().iter().map(ray).collect();
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
    pub fn new(scene: Arc<Scene>, rays: Vec<Ray>, origin: [f64; 3]) -> Hits {
        Hits { receivers: Receivers { scene, rays: Arc::new(rays), origin } }
    }

    /// The number of the object and of the primitive in it.
    fn located(&self, ray: &Ray) -> (u32, u32) {
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

    /// The same points for further queries.
    fn receivers(&self) -> Receivers {
        let Receivers { scene, rays, origin } = &self.receivers;
        Receivers { scene: Arc::clone(scene), rays: Arc::clone(rays), origin: *origin }
    }
}
