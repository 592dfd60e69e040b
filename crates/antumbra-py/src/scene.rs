//! A scene as Python holds it: a builder until it is first looked at, then the finished scene.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use antumbra::light::{Environment, Light};
use antumbra::math::{DMat3, DVec3, Rgb, Transform};
use antumbra::scene::{Level, Material, Mesh, Message, Scene, SceneBuilder, SceneError, builtin};
use antumbra::schedule;
use antumbra::settings::Settings;
use antumbra::texture::{Image, Texels};
use antumbra::trace::Triangles;
use antumbra_io::{Limits, ReadOptions, UpAxis, read_environment, read_path, size_of};
use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;

use crate::arrays::{Rows, View, columns};
use crate::draco;
use crate::errors;
use crate::kinds::{self, Fields, Made};

/// What a scene is at the moment.
struct State {
    /// What it is made of, as long as more may be added.
    builder: Option<SceneBuilder>,
    /// The finished scene of that builder, once somebody looked.
    built: Option<Arc<Scene>>,
}

/// A scene.
#[pyclass(frozen, name = "Scene", module = "antumbra._core")]
pub struct PyScene {
    name: String,
    /// The file it came from, for errors; may be empty.
    file: String,
    /// Place of the world that is 0 in the scene, so that places far from the world's 0 keep their digits.
    origin: [f64; 3],
    state: Mutex<State>,
}

impl PyScene {
    fn of(builder: SceneBuilder, file: &str) -> PyScene {
        let name = builder.name.clone();
        PyScene {
            name,
            file: file.into(),
            origin: [0.0; 3],
            state: Mutex::new(State { builder: Some(builder), built: None }),
        }
    }

    /// With the finished scene at once; `keep`: more may be added later.
    fn finished(self, py: Python<'_>, keep: bool) -> PyResult<PyScene> {
        let built = py.detach(|| {
            self.with_state(|state| {
                state.built = Some(build(state, keep)?);
                Ok(())
            })
        });
        match built {
            Ok(()) => Ok(self),
            Err(e) => Err(errors::scene(&e, &self.file)),
        }
    }

    fn with_state<R>(&self, work: impl FnOnce(&mut State) -> R) -> R {
        work(&mut self.state.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// The finished scene; built now if anything was added since.
    pub fn scene(&self, py: Python<'_>) -> PyResult<Arc<Scene>> {
        py.detach(|| {
            self.with_state(|state| match &state.built {
                Some(scene) => Ok(Arc::clone(scene)),
                None => {
                    let scene = build(state, true)?;
                    state.built = Some(Arc::clone(&scene));
                    Ok(scene)
                }
            })
        })
        .map_err(|e| errors::scene(&e, &self.file))
    }

    /// A copy of what it is made of.
    pub fn parts(&self) -> PyResult<SceneBuilder> {
        let parts = self.with_state(|state| state.builder.clone());
        parts.ok_or_else(|| errors::value("this scene is finished: what it was made of is gone"))
    }

    /// The file it came from; may be empty.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The place of the world that is 0 in the scene.
    pub fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// World places of the settings relative to the scene's origin.
    pub fn relate(&self, settings: &mut Settings) {
        for place in [&mut settings.eye, &mut settings.look_at].into_iter().flatten() {
            *place = [0, 1, 2].map(|k| place[k] - self.origin[k]);
        }
    }

    /// Changes what it is made of.
    fn change<R>(&self, work: impl FnOnce(&mut SceneBuilder) -> PyResult<R>) -> PyResult<R> {
        self.with_state(|state| {
            state.built = None;
            match &mut state.builder {
                Some(builder) => work(builder),
                None => Err(errors::value("this scene is finished: nothing can be added")),
            }
        })
    }
}

/// Checks and builds; `keep` leaves the builder for later additions.
fn build(state: &mut State, keep: bool) -> Result<Arc<Scene>, SceneError> {
    let builder = if keep { state.builder.clone() } else { state.builder.take() };
    let builder = builder.unwrap_or_default();
    schedule::build(builder, 0).map(Arc::new)
}

fn no_size(text: &str) -> PyErr {
    errors::choice(format!("the memory \"{text}\" is no size (500M, 4G, or a number of bytes)"))
}

#[pymethods]
impl PyScene {
    /// An empty scene; `origin` is the place of the world that its numbers are kept relative to.
    #[new]
    #[pyo3(signature = (name, origin = [0.0; 3]))]
    fn new(name: &str, origin: [f64; 3]) -> PyScene {
        PyScene { origin, ..PyScene::of(SceneBuilder::new(name), "") }
    }

    /// A built-in scene with some of its parameters.
    #[staticmethod]
    #[pyo3(signature = (name, parameters, keep = true))]
    fn builtin(py: Python<'_>, name: &str, parameters: Vec<(String, f64)>, keep: bool) -> PyResult<PyScene> {
        let builder = builtin::build(name, &parameters).map_err(|e| errors::choice(e.to_string()))?;
        PyScene::of(builder, "").finished(py, keep)
    }

    /// A scene from a file.
    #[staticmethod]
    #[pyo3(signature = (path, up_axis = None, files_from = None, parameters = Vec::new(), keep = true,
        variant = None, at_time = None, animation = None, max_memory = None))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn load(
        py: Python<'_>,
        path: &str,
        up_axis: Option<&str>,
        files_from: Option<PathBuf>,
        parameters: Vec<(String, String)>,
        keep: bool,
        variant: Option<String>,
        at_time: Option<f64>,
        animation: Option<String>,
        max_memory: Option<&str>,
    ) -> PyResult<PyScene> {
        let up_axis = match up_axis {
            None => UpAxis::default(),
            Some("y") => UpAxis::Y,
            Some("z") => UpAxis::Z,
            Some(other) => return Err(errors::choice(format!("there is no up axis \"{other}\" (y, z)"))),
        };
        let memory = max_memory.map(|text| size_of(text).ok_or_else(|| no_size(text))).transpose()?;
        let options = ReadOptions {
            limits: Limits { memory, ..Limits::default() },
            files_from,
            up_axis,
            parameters,
            variant,
            at_time,
            animation,
            draco: Some(draco::decode),
        };
        let builder = py.detach(|| read_path(Path::new(path), &options)).map_err(|e| errors::read(&e))?;
        PyScene::of(on_stage(builder), path).finished(py, keep)
    }

    /// Adds a material and returns its number.
    #[pyo3(signature = (kind, fields, emission = None))]
    fn add_material(
        &self,
        kind: &str,
        fields: HashMap<String, Vec<f64>>,
        emission: Option<[f32; 3]>,
    ) -> PyResult<u32> {
        let fields = Fields::about(fields, [0.0; 3]);
        if kind == "TwoSided" {
            let [front, back] = kinds::sides(&fields)?;
            return self.change(|builder| {
                let look = builder.materials.get(front as usize).cloned();
                let look = look.ok_or_else(|| errors::value("the front is no material of this scene"))?;
                Ok(builder.material(kinds::emitting(Material { back: Some(back), ..look }, emission)))
            });
        }
        let material = kinds::material(kind, &fields, emission)?;
        self.change(|builder| Ok(builder.material(material)))
    }

    /// Adds triangles and places them.
    #[pyo3(signature = (name, vertices, faces, material, transform = None, normals = None))]
    fn add_mesh(
        &self,
        name: &str,
        vertices: Rows<'_>,
        faces: PyReadonlyArray2<'_, u32>,
        material: u32,
        transform: Option<PyReadonlyArray2<'_, f64>>,
        normals: Option<Rows<'_>>,
    ) -> PyResult<()> {
        let indices = faces.as_array().rows().into_iter().map(|f| [f[0], f[1], f[2]]).collect();
        // A transform takes the mesh's own numbers into the world; without one they are places of the world.
        let vertices = if transform.is_some() { vertices.view() } else { vertices.about(self.origin) };
        let triangles = Triangles { vertices: triples("vertices", &vertices)?, indices };
        let normals = normals.map(|n| triples("normals", &n.view())).transpose()?;
        let mesh = Mesh { name: name.into(), triangles, normals, ..Mesh::default() };
        let transform = transform.map_or(Transform::IDENTITY, |m| matrix(&m, self.origin));
        self.change(|builder| {
            let mesh = builder.mesh(mesh);
            builder.place(name, mesh, material, transform);
            Ok(())
        })
    }

    /// Adds a shape.
    fn add_shape(
        &self,
        name: &str,
        kind: &str,
        fields: HashMap<String, Vec<f64>>,
        material: u32,
    ) -> PyResult<()> {
        let made = kinds::shape(kind, &Fields::about(fields, self.origin))?;
        self.change(|builder| {
            match made {
                Made::Shape(shape) => builder.shape(name, shape, material),
                Made::Mesh(triangles) => builder.object(name, triangles, material),
            }
            Ok(())
        })
    }

    /// Adds a light.
    fn add_light(&self, name: &str, kind: &str, fields: HashMap<String, Vec<f64>>) -> PyResult<()> {
        if kind == "Sky" {
            return self.add_sky(name, &Fields::about(fields, self.origin));
        }
        let light = kinds::light(kind, &Fields::about(fields, self.origin))?;
        if let Some(what) = light.fault() {
            return Err(errors::value(what));
        }
        self.change(|builder| {
            builder.light(name, light);
            Ok(())
        })
    }

    /// Adds an environment of a lat-long picture, its north at an azimuth [rad], clockwise from −z over +x.
    fn add_environment(
        &self,
        name: &str,
        pixels: PyReadonlyArray3<'_, f32>,
        scale: f32,
        azimuth: f32,
        nearest: bool,
    ) -> PyResult<()> {
        let pixels = pixels.as_array();
        let texels = pixels.rows().into_iter().map(|c| [c[0], c[1], c[2]]).collect();
        let image = Image::new(pixels.shape()[1] as u32, pixels.shape()[0] as u32, Texels::Float(texels));
        let image = image.ok_or_else(|| errors::value("an environment has at least one pixel"))?;
        self.change(|builder| {
            builder.light(name, placed(Environment::image(Arc::new(image)), scale, azimuth, nearest));
            Ok(())
        })
    }

    /// Adds an environment of a file.
    fn add_environment_file(
        &self,
        py: Python<'_>,
        name: &str,
        path: &str,
        scale: f32,
        azimuth: f32,
        nearest: bool,
    ) -> PyResult<()> {
        let (light, messages) = environment_file(py, path)?;
        self.change(|builder| {
            builder.light(name, placed(light, scale, azimuth, nearest));
            builder.messages.extend(messages);
            Ok(())
        })
    }

    /// What it is called.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// Settings that the file asks for, by name.
    fn suggested(&self, py: Python<'_>) -> PyResult<HashMap<&'static str, String>> {
        Ok(self.scene(py)?.suggested.iter().cloned().collect())
    }

    /// Parameters that the file declares: (name, value).
    fn parameters(&self, py: Python<'_>) -> PyResult<Vec<(String, String)>> {
        Ok(self.scene(py)?.parameters.clone())
    }

    /// Notes and warnings: (level, place, text).
    fn messages(&self, py: Python<'_>) -> PyResult<Vec<(&'static str, String, String)>> {
        Ok(self.scene(py)?.messages.iter().map(said).collect())
    }
}

impl PyScene {
    /// Adds the dome and the sun of a sky: NAME and "NAME sun"; "sky" and "sun" without a name.
    fn add_sky(&self, name: &str, fields: &Fields) -> PyResult<()> {
        let lights = kinds::sky(fields)?.lights(crate::render::SKY_WIDTH).map_err(errors::value)?;
        self.change(|builder| {
            for (own, light) in lights {
                let called = match (name, own.as_str()) {
                    ("", own) => own.into(),
                    (name, "sun") => format!("{name} sun"),
                    (name, _) => name.into(),
                };
                builder.light(&called, light);
            }
            Ok(())
        })
    }
}

/// A map as Python asks for it.
fn placed(map: Environment, scale: f32, azimuth: f32, nearest: bool) -> Environment {
    map.scaled(Rgb::grey(scale)).nearest(nearest).rotated(-azimuth)
}

/// A lat-long picture alone is light and nothing to see: the built-in things stand under it.
fn on_stage(builder: SceneBuilder) -> SceneBuilder {
    let mut builder = builder;
    if !builder.objects.is_empty() || !matches!(builder.lights[..], [(_, Light::Environment(_))]) {
        return builder;
    }
    match builder.lights.pop() {
        Some((_, sky)) => {
            let SceneBuilder { name, source, messages, .. } = builder;
            SceneBuilder { name, source, messages, ..builtin::under(sky) }
        }
        None => builder,
    }
}

/// An environment from a lat-long file, with what there is to say about it.
pub fn environment_file(py: Python<'_>, path: &str) -> PyResult<(Environment, Vec<Message>)> {
    py.detach(|| read_environment(Path::new(path), &ReadOptions::default())).map_err(|e| errors::read(&e))
}

/// (level, place, text).
pub fn said(message: &Message) -> (&'static str, String, String) {
    let level = match message.level {
        Level::Note => "note",
        Level::Warning => "warning",
    };
    (level, message.place.clone(), message.text.clone())
}

fn triples(name: &str, view: &View<'_>) -> PyResult<Vec<[f32; 3]>> {
    columns(name, view, 3)?;
    Ok((0..view.len()).map(|i| view.row::<3>(i).map(|c| c as f32)).collect())
}

fn matrix(m: &PyReadonlyArray2<'_, f64>, origin: [f64; 3]) -> Transform {
    let m = m.as_array();
    let column = |k: usize| DVec3::new(m[[0, k]], m[[1, k]], m[[2, k]]);
    Transform {
        linear: DMat3::from_cols(column(0), column(1), column(2)),
        translation: column(3) - DVec3::from(origin),
    }
}
