//! Mitsuba 3 XML, with its meshes (PLY), textures and light from all around in one folder beside it.

mod bsdf;
mod emitter;
mod mask;
mod ply;
mod sensor;
mod shape;
mod texture;
mod xml;

use std::collections::HashMap;

use super::Job;
use super::names::Names;
use xml::Element;

/// The document as it grows.
struct Writer<'j, 'a> {
    job: &'j mut Job<'a>,
    /// Name of the folder beside.
    folder: String,
    ids: Names,
    files: Names,
    /// Looks that shapes name: material, and whether without its textures.
    looks: HashMap<(u32, bool), String>,
    /// The elements of these, before the shapes.
    bsdfs: Vec<Element>,
    meshes: HashMap<ply::Key, String>,
    pictures: HashMap<texture::Key, String>,
}

/// Makes the document.
pub(super) fn write(job: &mut Job) -> Result<Vec<u8>, String> {
    let folder = format!("{}-files", Names::default().give(&job.stem, "scene"));
    let mut writer = Writer {
        job,
        folder,
        ids: Names::default(),
        files: Names::default(),
        looks: HashMap::new(),
        bsdfs: Vec::new(),
        meshes: HashMap::new(),
        pictures: HashMap::new(),
    };
    let mut scene = Element::new("scene").with("version", "3.0.0").add(writer.integrator());
    for (i, camera) in writer.cameras().iter().enumerate() {
        let sensor = writer.sensor(camera, i == 0);
        scene = scene.add(sensor);
    }
    let mut shapes = Vec::new();
    for object in writer.job.objects() {
        shapes.push(writer.shape(object)?);
    }
    let lights = writer.lights()?;
    let document = scene.all(writer.bsdfs).all(shapes).all(lights).document();
    Ok(document.into_bytes())
}

impl Writer<'_, '_> {
    /// A file of the folder; its name as the document has it.
    fn file(&mut self, name: &str, ending: &str, bytes: Vec<u8>) -> String {
        let name = format!("{}/{}.{ending}", self.folder, self.files.give(name, "file"));
        self.job.file(&name, bytes);
        name
    }

    fn warn(&mut self, place: impl Into<String>, text: impl Into<String>) {
        self.job.said.warn(place, text);
    }
}
