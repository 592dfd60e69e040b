//! The triangles of a scene as arrays, for other programs.

use antumbra::scene::{Body, Placed, Scene};
use numpy::ndarray::Array2;
use numpy::{Element, IntoPyArray, PyArray2};
use pyo3::prelude::*;

use crate::errors;
use crate::scene::PyScene;

type Table<'py, T> = Bound<'py, PyArray2<T>>;

#[pymethods]
impl PyScene {
    /// All triangles in world space: vertices (V, 3) float32 and faces (F, 3) uint32; shapes are left out.
    fn triangles<'py>(&self, py: Python<'py>) -> PyResult<(Table<'py, f32>, Table<'py, u32>)> {
        let scene = self.scene(py)?;
        let (vertices, faces) = py.detach(|| world_triangles(&scene));
        Ok((table(py, vertices)?, table(py, faces)?))
    }
}

/// Vertices and faces of every placed mesh, one behind the other in the order of building.
fn world_triangles(scene: &Scene) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for object in scene.objects.iter() {
        let Body::Mesh(mesh) = object.body else { continue };
        let triangles = &scene.meshes[mesh as usize].triangles;
        let first = vertices.len() as u32;
        vertices.extend(triangles.vertices.iter().map(|v| in_world(object, *v)));
        faces.extend(triangles.indices.iter().map(|t| t.map(|v| v + first)));
    }
    (vertices, faces)
}

/// A vertex where its object stands; as it is where no transform is applied.
fn in_world(object: &Placed, vertex: [f32; 3]) -> [f32; 3] {
    match &object.transform {
        Some(place) => {
            let p = vertex.map(f64::from);
            (place.linear * antumbra::math::DVec3::from(p) + place.translation).as_vec3().into()
        }
        None => vertex,
    }
}

fn table<T: Element>(py: Python<'_>, rows: Vec<[T; 3]>) -> PyResult<Table<'_, T>> {
    let n = rows.len();
    let array = Array2::from_shape_vec((n, 3), rows.into_flattened());
    Ok(array.map_err(|e| errors::value(e.to_string()))?.into_pyarray(py))
}
