//! pbrt-v4 scenes (https://pbrt.org/fileformat-v4): what direct light and paths need of them.
//!
//! A directive is a function and a line in the table below; a plugin is one in the table of its kind: `shape`, `material`,
//! `texture`, `light`. A plugin that is not there, and a parameter that nobody looks at, give one warning with their place.

mod camera;
mod directive;
mod light;
mod material;
mod parameters;
mod shape;
mod spectrum;
mod text;
mod texture;
mod transform;

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::Read;
use std::rc::Rc;

use antumbra::scene::{Level, MaterialId, SceneBuilder};
use antumbra_math::Transform;

use parameters::{Parameter, Parameters};
use text::{At, Text};

use super::{Context, Counted};
use crate::error::ReadError;

/// What `AttributeBegin` keeps and `AttributeEnd` brings back.
#[derive(Clone)]
struct State {
    /// Object → the file's world.
    world: Transform,
    /// Transforms count: not so for those of the shutter's end.
    moves: bool,
    /// Surfaces face the other way.
    reverse: bool,
    /// The look of shapes, if the file named one.
    material: Option<MaterialId>,
    /// What shapes give off.
    area: Option<light::Area>,
    /// Parameters that `Attribute` adds to those of shapes, lights, materials and textures.
    defaults: Rc<Vec<(String, Parameter)>>,
}

/// The work in progress.
struct Reader<'a> {
    context: &'a Context<'a>,
    /// The files that are open, the one being read last.
    open: Vec<Text<'a>>,
    /// `WorldBegin` was read.
    in_world: bool,
    state: State,
    kept: Vec<(State, &'static str)>,
    spaces: HashMap<String, Transform>,
    view: camera::View,
    materials: HashMap<String, MaterialId>,
    textures: texture::Known,
    shapes: shape::Known,
    scene: SceneBuilder,
    said: Counted,
}

/// Reads a `.pbrt`.
pub(super) fn read(bytes: &[u8], context: &Context) -> Result<SceneBuilder, ReadError> {
    if bytes.is_empty() {
        return Err(ReadError::new("", "the file is empty (0 bytes)"));
    }
    let whole = unzipped(bytes.into(), context).map_err(|why| ReadError::new("", why))?;
    let mut reader = Reader {
        context,
        open: Vec::new(),
        in_world: false,
        state: State {
            world: Transform::IDENTITY,
            moves: true,
            reverse: false,
            material: None,
            area: None,
            defaults: Rc::default(),
        },
        kept: Vec::new(),
        spaces: HashMap::new(),
        view: camera::View::default(),
        materials: HashMap::new(),
        textures: texture::Known::default(),
        shapes: shape::Known::default(),
        scene: SceneBuilder { source: "pbrt-v4".into(), ..SceneBuilder::default() },
        said: Counted::default(),
    };
    reader.file(Text::new("", whole))?;
    reader.finish()
}

/// Files within files.
const DEEPEST: usize = 32;

/// Bytes of a directive with its plugin, and of sixteen of its values, for the account of memory.
const ROOM: u64 = 384;

/// What opening a file counts at least [bytes].
const OPENED: u64 = 4096;

/// How well text packs, at most.
const PACKED: u64 = 16;

/// What to do with a file of the version before.
fn of_v3(e: ReadError) -> ReadError {
    e.hint("antumbra reads pbrt-v4. `pbrt --upgrade old.pbrt > new.pbrt` of pbrt-v4 converts.")
}

impl<'a> Reader<'a> {
    /// Follows the directives of a file to its end.
    fn file(&mut self, text: Text<'a>) -> Result<(), ReadError> {
        self.open.push(text);
        loop {
            let text = self.text()?;
            let at = text.here();
            let Some(word) = text.directive()? else { break };
            match directive::DIRECTIVES.iter().find(|d| d.0 == word) {
                Some((_, act)) => act(self, &at)?,
                None => {
                    let what = format!("{} is no directive of pbrt-v4", super::text::show(word.as_bytes()));
                    return Err(at.error(what));
                }
            }
        }
        self.open.pop();
        Ok(())
    }

    /// The file being read.
    fn text(&mut self) -> Result<&mut Text<'a>, ReadError> {
        self.open.last_mut().ok_or_else(|| ReadError::new("", "the file ended"))
    }

    /// What follows a directive: its plugin and parameters.
    fn plugin(&mut self, at: &At, directive: &str) -> Result<(String, Parameters), ReadError> {
        let text = self.text()?;
        let plugin = text.string(directive)?;
        let words = format!("{directive} \"{plugin}\"");
        let p = Parameters::read(text, at.clone(), words)?;
        self.context.take(1 + p.length() as u64 / 16, ROOM).map_err(|why| p.error(why))?;
        Ok((plugin, p))
    }

    /// Object → our world.
    fn world(&self) -> Transform {
        self.context.root.after(&self.state.world)
    }

    /// The defaults that `Attribute` set for a kind of thing.
    fn with_defaults(&self, p: Parameters, kind: &str) -> Parameters {
        let of_kind: Vec<_> =
            self.state.defaults.iter().filter(|d| d.0 == kind).map(|d| d.1.clone()).collect();
        p.with_defaults(&of_kind)
    }

    /// The bytes of a file beside, unpacked if it is gzipped.
    fn open(&self, name: &str) -> Result<Vec<u8>, String> {
        let bytes = self.context.files.open(name).map_err(|e| e.to_string())?;
        self.context.grant_file(name, bytes.len() as u64);
        let whole = unzipped(bytes.into(), self.context)?;
        let again = self.context.take((whole.len() as u64).max(OPENED), 1);
        again.map_err(|_| "it is asked for again and again, beyond what the scene's files hold")?;
        Ok(whole.into_owned())
    }

    /// Says what was not looked at.
    fn name_the_unread(&mut self, p: &Parameters) {
        for given in p.unread() {
            let what = format!("\"{}\" of {} is not read", given.name, p.words);
            self.said.warn(given.at.words(), what);
        }
    }

    /// A plugin that is not in its table.
    fn lacks(&mut self, p: &Parameters, instead: &str) {
        self.said
            .warn(p.at.words(), format!("{} is a plugin that antumbra does not have: {instead}", p.words));
    }

    fn finish(mut self) -> Result<SceneBuilder, ReadError> {
        if let Some((_, begun)) = self.kept.last() {
            let what = format!("the file ends before its {begun} does");
            return Err(ReadError::new("", what).hint("The file is cut short, or an End is missing."));
        }
        if !self.in_world {
            let what = "there is no WorldBegin";
            return Err(
                ReadError::new("", what).hint("Check that this is a whole scene of pbrt, not a part of one.")
            );
        }
        if !self.shapes.any() {
            let what = "there is nothing to render: no shape in the scene";
            return Err(ReadError::new("", what).hint("Check that the right file was given."));
        }
        let shines = self.scene.materials.iter().any(|m| m.emission.is_some());
        if self.scene.lights.is_empty() && !shines {
            self.scene.say(Level::Warning, "", "no light that is read in the file");
        }
        self.said.into_scene(&mut self.scene);
        Ok(self.scene)
    }
}

/// What a gzipped file holds, within the limits; other bytes as they are.
fn unzipped<'a>(bytes: Cow<'a, [u8]>, context: &Context) -> Result<Cow<'a, [u8]>, String> {
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return Ok(bytes);
    }
    let limits = context.limits;
    let most = limits.expansion_base + limits.expansion.saturating_mul(bytes.len() as u64);
    let most = most.min(limits.file_bytes);
    let mut whole = Vec::new();
    let unpacked = flate2::read::MultiGzDecoder::new(&bytes[..]).take(most + 1).read_to_end(&mut whole);
    unpacked.map_err(|e| format!("it cannot be unpacked ({e})"))?;
    if whole.len() as u64 > most {
        return Err(format!("unpacked it has more than {most} bytes"));
    }
    // Text packs well, and what it makes is in proportion to it; beyond that it is no text that people write.
    context.grant((whole.len() as u64).min(PACKED * bytes.len() as u64));
    Ok(whole.into())
}
