//! Readers: bytes → scene builder. One file or folder per format; to add one, add its line to [`read`] and to
//! `format.rs`.

mod environment;
pub(crate) mod exr;
mod gltf;
pub(crate) mod hdr;
mod mitsuba;
mod obj;
mod pbrt;
mod ply;
mod polygon;
mod spectrum;
mod stl;
pub(crate) mod tessellate;
mod texels;
mod text;
mod uri;

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use antumbra::scene::{Level, Message, SceneBuilder};
use antumbra_math::{DMat3, DVec3, Transform};

use crate::error::ReadError;
use crate::files::{Files, FolderFiles, read_limited};
use crate::forecast::Forecast;
use crate::format::{Format, READS, format_of};
use crate::limits::{Allowance, Limits};

pub use gltf::draco::{DracoAttribute, DracoDecoder, DracoError, DracoMesh};

pub use environment::{EnvironmentPicture, environment_picture, read_environment};

/// What every reader gets besides the bytes.
pub(crate) struct Context<'a> {
    /// The files beside.
    pub files: &'a dyn Files,
    /// What may be asked for.
    pub limits: &'a Limits,
    /// File → world: turns z up to y up where the person asks for it.
    pub root: Transform,
    /// The file's name ends in `.glb` (for the words of an error).
    pub named_glb: bool,
    /// Values for the parameters that a file declares.
    pub parameters: &'a [(String, String)],
    /// The variant of materials that is wanted, by name.
    pub variant: Option<&'a str>,
    /// The one animation that plays, by name; all that can play together without.
    pub animation: Option<&'a str>,
    /// The time that animations stand at [s]; at rest without.
    pub at_time: Option<f64>,
    /// Unpacks Draco meshes.
    pub draco: Option<DracoDecoder>,
    /// Decoded pictures.
    pub textures: Allowance,
    /// Memory that the scene will take.
    pub forecast: Forecast,
    memory: Allowance,
    /// Files beside that brought room with them.
    granted: RefCell<HashSet<String>>,
}

impl Context<'_> {
    /// Takes room for `count` items of `size` bytes.
    pub(crate) fn take(&self, count: u64, size: u64) -> Result<(), String> {
        self.memory.take(count, size)
    }

    /// A file beside came: `bytes` of it. However often it is asked for, and however its path is spelled, it brings room once.
    pub(crate) fn grant_file(&self, name: &str, bytes: u64) {
        let words: Vec<&str> =
            name.split(['/', '\\']).filter(|word| !word.is_empty() && *word != ".").collect();
        if self.granted.borrow_mut().insert(words.join("/")) {
            self.grant(bytes);
            self.forecast.beside(bytes);
        }
    }

    /// More input came: `bytes` of it.
    pub(crate) fn grant(&self, bytes: u64) {
        self.memory.grant(bytes.saturating_mul(self.limits.expansion));
    }
}

/// Albedo of surfaces whose file says nothing about them.
pub(crate) const GREY: f32 = 0.5;

/// The words for polygons that [`polygon::Triangulator`] gave up on.
pub(crate) const INTRICATE: &str = "some polygons are too intricate: part of them is cut as a fan";

/// Which axis of a file points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpAxis {
    /// y: coordinates stay as they are.
    #[default]
    Y,
    /// z: (x, y, z) becomes (x, z, −y).
    Z,
}

impl UpAxis {
    /// File → world.
    fn transform(self) -> Transform {
        match self {
            UpAxis::Y => Transform::IDENTITY,
            UpAxis::Z => Transform {
                linear: DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y),
                translation: DVec3::ZERO,
            },
        }
    }
}

/// How a file is read from disk.
#[derive(Clone, Debug, Default)]
pub struct ReadOptions {
    /// The root that the paths of a scene may reach; its own folder if there is none.
    pub files_from: Option<PathBuf>,
    /// Which axis points up.
    pub up_axis: UpAxis,
    /// Values for the parameters that the file declares (`default` of Mitsuba's XML).
    pub parameters: Vec<(String, String)>,
    /// The variant of materials that is wanted, by name (glTF); those of the file itself without.
    pub variant: Option<String>,
    /// The one animation that plays, by name (glTF); all that can play together without.
    pub animation: Option<String>,
    /// The time that animations stand at [s] (glTF); at rest without, or at 0 where one is named.
    pub at_time: Option<f64>,
    /// Unpacks Draco meshes (glTF); files that need it are refused without.
    pub draco: Option<DracoDecoder>,
    /// What may be asked for.
    pub limits: Limits,
}

/// Reads a scene of a known format from memory.
pub fn read(
    format: Format,
    bytes: &[u8],
    files: &dyn Files,
    limits: &Limits,
) -> Result<SceneBuilder, ReadError> {
    read_with(format, bytes, files, &ReadOptions { limits: *limits, ..ReadOptions::default() })
}

/// The same with options; `files_from` does not matter here.
pub fn read_with(
    format: Format,
    bytes: &[u8],
    files: &dyn Files,
    options: &ReadOptions,
) -> Result<SceneBuilder, ReadError> {
    read_as(format, bytes, &context(files, options, bytes.len(), false))
}

fn context<'a>(
    files: &'a dyn Files,
    options: &'a ReadOptions,
    length: usize,
    named_glb: bool,
) -> Context<'a> {
    let limits = &options.limits;
    let context = Context {
        files,
        limits,
        root: options.up_axis.transform(),
        named_glb,
        parameters: &options.parameters,
        variant: options.variant.as_deref(),
        animation: options.animation.as_deref(),
        at_time: options.at_time.or(options.animation.as_ref().map(|_| 0.0)),
        draco: options.draco,
        textures: Allowance::new(limits.texture_bytes),
        forecast: Forecast::new(limits.memory, length as u64),
        memory: Allowance::new(limits.expansion_base),
        granted: RefCell::default(),
    };
    context.grant(length as u64);
    context
}

/// Refuses what only glTF knows of other formats.
fn refuse_foreign(format: Format, context: &Context) -> Result<(), ReadError> {
    if context.at_time.is_some_and(|t| !t.is_finite()) {
        return Err(ReadError::new("", "the time of its animations is no finite number"));
    }
    let asked = context.variant.map(|_| "variants of materials").or(context.at_time.map(|_| "animations"));
    match asked {
        Some(what) if format != Format::Gltf => {
            let what = format!("has no {what}: only glTF files have them");
            Err(ReadError::new("", what).hint("Leave the option away."))
        }
        _ => Ok(()),
    }
}

fn read_as(format: Format, bytes: &[u8], context: &Context) -> Result<SceneBuilder, ReadError> {
    refuse_foreign(format, context)?;
    let scene = match format {
        Format::Gltf => gltf::read(bytes, context),
        Format::Obj => obj::read(bytes, context),
        Format::Ply => ply::read(bytes, context),
        Format::Stl => stl::read(bytes, context),
        Format::Environment => environment::read(bytes, context),
        Format::Mitsuba => mitsuba::read(bytes, context),
        Format::Pbrt => pbrt::read(bytes, context),
        Format::NotRead(name) => {
            let what = format!("{name} is not read yet");
            Err(ReadError::new("", what).hint(format!("antumbra reads {READS}.")))
        }
    }?;
    context.forecast.whole(&scene)?;
    Ok(scene)
}

/// Reads a scene from disk; the only reader that touches a file system.
pub fn read_path(path: &Path, options: &ReadOptions) -> Result<SceneBuilder, ReadError> {
    let name = path.display().to_string();
    read_file(path, options).map_err(|e| e.of(name))
}

fn read_file(path: &Path, options: &ReadOptions) -> Result<SceneBuilder, ReadError> {
    let limits = &options.limits;
    let unreadable = |why: String| ReadError::new("", format!("cannot be read ({why})"));
    if let Ok(about) = std::fs::metadata(path) {
        Forecast::new(limits.memory, about.len()).part(0, 0)?;
    }
    let bytes = read_limited(path, limits.file_bytes).map_err(unreadable)?;
    let Some(format) = format_of(path, &bytes) else {
        let what = "its format is not known: neither its name nor its first bytes tell it";
        return Err(ReadError::new("", what).hint(format!("antumbra reads {READS}.")));
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let root = options.files_from.as_deref().unwrap_or(folder);
    let files = FolderFiles::new(root, folder, limits).map_err(|e| {
        let what = format!("the folder {} of its files: {e}", root.display());
        ReadError::new("", what)
    })?;
    let named_glb = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("glb"));
    let context = context(&files, options, bytes.len(), named_glb);
    let mut scene = read_as(format, &bytes, &context)?;
    scene.name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    Ok(scene)
}

/// Messages that are counted and said once.
#[derive(Default)]
pub(crate) struct Counted {
    said: Vec<(Message, usize)>,
    known: HashMap<String, usize>,
}

impl Counted {
    /// Says `text` about `place`; the same text again only counts.
    pub(crate) fn warn(&mut self, place: impl Into<String>, text: impl Into<String>) {
        self.say(Level::Warning, place.into(), text.into());
    }

    /// The same as a note.
    pub(crate) fn note(&mut self, place: impl Into<String>, text: impl Into<String>) {
        self.say(Level::Note, place.into(), text.into());
    }

    fn say(&mut self, level: Level, place: String, text: String) {
        match self.known.get(&text) {
            Some(at) => self.said[*at].1 += 1,
            None => {
                self.known.insert(text.clone(), self.said.len());
                self.said.push((Message { level, place, text }, 1));
            }
        }
    }

    /// Takes over what was said about a part, with the part's place before each.
    pub(crate) fn take_from(&mut self, part: Counted, place: &str) {
        for (message, n) in part.said {
            let place = format!("{place}: {}", message.place);
            (0..n).for_each(|_| self.say(message.level, place.clone(), message.text.clone()));
        }
    }

    /// Puts what was said into the scene.
    pub(crate) fn into_scene(self, scene: &mut SceneBuilder) {
        for (mut message, n) in self.said {
            if n > 1 {
                message.text.push_str(&format!(" (and {} more like it)", n - 1));
            }
            scene.messages.push(message);
        }
    }
}
