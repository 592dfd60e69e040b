//! Mitsuba 3 XML (https://mitsuba.readthedocs.io, versions 2 and 3 of the format).
//!
//! A plugin is a function and a line in the table of its kind: `shape`, `bsdf`, `emitter`, `sensor`, `integrator`. A
//! plugin that is not there, and a property that nobody looks at, give one warning with their place.

mod bsdf;
mod document;
mod emitter;
mod film;
mod integrator;
mod properties;
mod sensor;
mod shape;
mod sky;
mod spectrum;
mod texture;
mod transform;

use std::collections::HashMap;

use antumbra::scene::{Level, SceneBuilder};

use document::Element;

use super::{Context, Counted};
use crate::error::ReadError;
use crate::files::FileError;

/// The work in progress: the elements by their ids, what is built from them, and what was said.
struct Reader<'a> {
    context: &'a Context<'a>,
    ids: HashMap<&'a str, &'a Element>,
    /// Where its files lie besides its own folder.
    folders: &'a [String],
    scene: SceneBuilder,
    said: Counted,
    bsdfs: bsdf::Known,
    textures: texture::Known,
    meshes: shape::Known,
    /// The serialized file that was read last.
    serialized: shape::Serialized,
    /// Shapes that the file asks for, drawn or not.
    announced: usize,
}

/// Reads a `.xml`.
pub(super) fn read(bytes: &[u8], context: &Context) -> Result<SceneBuilder, ReadError> {
    if bytes.is_empty() {
        return Err(ReadError::new("", "the file is empty (0 bytes)"));
    }
    let tree = document::load(bytes, context)?;
    let mut reader = Reader {
        context,
        ids: document::ids(&tree.root)?,
        folders: &tree.folders,
        scene: SceneBuilder {
            source: "Mitsuba 3 XML".into(),
            parameters: tree.parameters.clone(),
            ..SceneBuilder::default()
        },
        said: Counted::default(),
        bsdfs: bsdf::Known::default(),
        textures: texture::Known::default(),
        meshes: shape::Known::default(),
        serialized: shape::Serialized::default(),
        announced: 0,
    };
    for child in &tree.root.children {
        child.used.set(true);
        match child.tag.as_str() {
            "shape" => reader.shape(child)?,
            "emitter" => reader.emitter(child)?,
            "sensor" => reader.sensor(child)?,
            "integrator" => reader.integrator(child)?,
            // What bears an id waits until somebody asks for it.
            "bsdf" | "texture" | "medium" | "film" | "sampler" | "spectrum" | "rgb" | "float" | "integer"
            | "string" | "boolean" | "ref" | "alias" => {}
            tag => reader.said.warn(child.at.words(), format!("<{tag}> is not read: left out")),
        }
    }
    reader.finish()
}

impl<'a> Reader<'a> {
    /// The bytes of a file that the scene names.
    fn open(&self, name: &str) -> Result<Vec<u8>, FileError> {
        document::open(self.context, self.folders, name)
    }

    /// The plugins that stand in `element` with one of these tags, named by `<ref>` or written out.
    fn plugins(&self, element: &'a Element, tag: &str) -> Result<Vec<&'a Element>, ReadError> {
        let mut found = Vec::new();
        for child in &element.children {
            let meant = self.resolved(child)?;
            if meant.tag == tag {
                child.used.set(true);
                found.push(meant);
            }
        }
        Ok(found)
    }

    /// The element that a `<ref>` names; any other is itself.
    fn resolved(&self, element: &'a Element) -> Result<&'a Element, ReadError> {
        if element.tag != "ref" {
            return Ok(element);
        }
        let id = element.attribute("id");
        self.ids.get(id).copied().ok_or_else(|| {
            let hint = "The id of a <bsdf>, <texture> or other element is needed.";
            element.at.error(format!("nothing has the id \"{id}\"")).hint(hint)
        })
    }

    /// Says what stands in a plugin and was not looked at.
    fn name_the_unread(&mut self, element: &Element) {
        for child in element.children.iter().filter(|c| !c.used.get()) {
            child.used.set(true);
            let what = match child.given("name") {
                Some(name) => format!("\"{name}\" of {} is not read", element.words()),
                None => format!("{} in {} is not read", child.words(), element.words()),
            };
            self.said.warn(child.at.words(), what);
        }
    }

    /// A plugin that is not in its table.
    fn lacks(&mut self, element: &Element, instead: &str) {
        let what = format!("{} is a plugin that antumbra does not have: {instead}", element.words());
        self.said.warn(element.at.words(), what);
    }

    fn finish(mut self) -> Result<SceneBuilder, ReadError> {
        if self.announced == 0 {
            let what = "there is nothing to render: no shape in the scene";
            return Err(ReadError::new("", what).hint("Check that the right file was given."));
        }
        let shines = self.scene.materials.iter().any(|m| m.emission.is_some());
        if self.scene.lights.is_empty() && !shines {
            self.scene.say(Level::Warning, "", "no emitter that is read in the file");
        }
        if self.scene.cameras.is_empty() {
            self.scene.say(Level::Warning, "", "no sensor that is read in the file");
        }
        self.said.into_scene(&mut self.scene);
        Ok(self.scene)
    }
}
