//! Writers: checked scene → files for other programs. One folder per format; to add one, add its line to [`FORMATS`].
//!
//! A writer makes all its bytes in memory; they are put onto the disk together at the end, so that nothing is half
//! written. What a format cannot hold is written in the nearest form that it has, or left out, with one warning a kind.

mod environment;
mod gltf;
mod light;
mod mitsuba;
mod names;
mod paint;
mod solids;

use std::path::{Path, PathBuf};

use antumbra::scene::{Body, Material, MaterialId, Mesh, Message, Object, SceneBuilder};
use antumbra_math::DVec3;
use antumbra_trace::Shape;

use crate::error::WriteError;
use crate::picture::write_together;
use crate::read::Counted;

/// Makes the bytes of the scene's own file, and of those beside it.
type Write = fn(&mut Job) -> Result<Vec<u8>, String>;

/// Every format that is written, by its ending. To add one: a folder and a line here.
const FORMATS: [(&str, Write); 3] = [("glb", gltf::glb), ("gltf", gltf::text), ("xml", mitsuba::write)];

/// The formats that are written, for messages.
pub const WRITES: &str = "a scene is written as .glb or .gltf (glTF 2.0) or .xml (Mitsuba 3)";

/// The work in progress: the scene, the files beside its own, and what was said.
struct Job<'a> {
    scene: &'a SceneBuilder,
    /// Name of the file without its ending.
    stem: String,
    /// Files beside the scene's own: path relative to it, with `/` between its parts, and bytes.
    beside: Vec<(String, Vec<u8>)>,
    /// Its light from all around is what readers give to every file without light.
    sky_is_default: bool,
    said: Counted,
}

/// What was written.
#[derive(Clone, Debug)]
pub struct Written {
    /// Every file with its size [bytes]; the scene's own first.
    pub files: Vec<(PathBuf, u64)>,
    /// What the format could not hold.
    pub messages: Vec<Message>,
}

/// The path's ending names a format that is written.
pub fn is_written(path: &Path) -> bool {
    writer(path).is_ok()
}

/// Writes a scene in the format that the path's ending names, whole or not at all. `origin` is added to all its places.
pub fn write_scene(path: &Path, scene: SceneBuilder, origin: [f64; 3]) -> Result<Written, WriteError> {
    let fail = |why: String| WriteError { file: path.display().to_string(), why };
    let write = writer(path)?;
    let unlit = scene.sky_if_unlit && scene.lights.is_empty();
    let mut scene = scene.checked().map_err(|e| fail(e.to_string()))?;
    shift(&mut scene, DVec3::from(origin));
    let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
    let sky_is_default = unlit && !scene.lights.is_empty();
    let mut job = Job { scene: &scene, stem, beside: Vec::new(), sky_is_default, said: Counted::default() };
    let bytes = write(&mut job).map_err(fail)?;
    let Job { beside, said, .. } = job;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut files = vec![(path.to_path_buf(), bytes)];
    files.extend(beside.into_iter().map(|(name, bytes)| (folder.join(name), bytes)));
    write_together(&files)?;
    let mut messages = SceneBuilder::default();
    said.into_scene(&mut messages);
    let files = files.into_iter().map(|(path, bytes)| (path, bytes.len() as u64)).collect();
    Ok(Written { files, messages: messages.messages })
}

fn writer(path: &Path) -> Result<Write, WriteError> {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    let found = FORMATS.iter().find(|(name, _)| *name == ending).map(|(_, write)| *write);
    found.ok_or_else(|| WriteError { file: path.display().to_string(), why: WRITES.into() })
}

/// Moves everything that has a place.
fn shift(scene: &mut SceneBuilder, by: DVec3) {
    if by == DVec3::ZERO {
        return;
    }
    let moved = |p: [f32; 3]| (DVec3::from(p.map(f64::from)) + by).as_vec3().to_array();
    for object in &mut scene.objects {
        match &mut object.body {
            Body::Mesh(_) => object.transform.translation += by,
            Body::Shape(Shape::Sphere { center, .. } | Shape::Disk { center, .. }) => {
                *center = moved(*center)
            }
            Body::Shape(Shape::Cylinder { p, q, .. }) => (*p, *q) = (moved(*p), moved(*q)),
        }
    }
    scene.lights.iter_mut().for_each(|(_, l)| light::shift(l, by));
    for camera in &mut scene.cameras {
        camera.eye += by;
        camera.look_at += by;
    }
}

impl<'a> Job<'a> {
    fn material(&self, id: MaterialId) -> &'a Material {
        &self.scene.materials[id as usize]
    }

    /// What an object is called in a message.
    fn place_of(object: &Object) -> String {
        format!("object \"{}\"", object.name)
    }

    /// The objects that have something to see.
    fn objects(&self) -> impl Iterator<Item = &'a Object> + use<'a> {
        let scene = self.scene;
        scene.objects.iter().filter(move |o| match o.body {
            Body::Mesh(m) => !scene.meshes[m as usize].triangles.indices.is_empty(),
            Body::Shape(_) => true,
        })
    }

    fn mesh(&self, id: u32) -> &'a Mesh {
        &self.scene.meshes[id as usize]
    }

    /// Lower and upper corner of all objects; `None` if there are none.
    fn bounds(&self) -> Option<[DVec3; 2]> {
        let wide = |p: &[f32; 3]| DVec3::from(p.map(f64::from));
        let grown = |b: [DVec3; 2], p: DVec3| [b[0].min(p), b[1].max(p)];
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let whole = self.objects().fold(empty, |b, o| match &o.body {
            Body::Mesh(m) => {
                let vertices = &self.mesh(*m).triangles.vertices;
                vertices.iter().fold(b, |b, v| grown(b, o.transform.point(wide(v))))
            }
            Body::Shape(Shape::Sphere { center, radius } | Shape::Disk { center, radius, .. }) => {
                let around = DVec3::splat(f64::from(*radius));
                grown(grown(b, wide(center) - around), wide(center) + around)
            }
            Body::Shape(Shape::Cylinder { p, q, .. }) => grown(grown(b, wide(p)), wide(q)),
        });
        (whole[0].x <= whole[1].x).then_some(whole)
    }

    /// Adds a file beside the scene's own.
    fn file(&mut self, name: &str, bytes: Vec<u8>) {
        self.beside.push((name.into(), bytes));
    }
}
