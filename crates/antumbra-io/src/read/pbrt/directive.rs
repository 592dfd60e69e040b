//! The directives of a pbrt file.

use std::rc::Rc;

use antumbra_math::Transform;

use super::text::{At, Text};
use super::{DEEPEST, Reader, of_v3, transform};
use crate::error::ReadError;
use crate::read::text::show;

/// What a directive does; it reads its own words.
type Act = fn(&mut Reader, &At) -> Result<(), ReadError>;

/// Every directive of pbrt-v4. To add one: a function and a line here.
pub(super) const DIRECTIVES: [(&str, Act); 41] = [
    ("Accelerator", |r, at| r.plugin(at, "Accelerator").map(drop)),
    ("ActiveTransform", transform::active),
    ("AreaLightSource", area_light),
    ("Attribute", attribute),
    ("AttributeBegin", |r, _| r.keep("AttributeBegin")),
    ("AttributeEnd", |r, at| r.bring_back(at, "AttributeBegin")),
    ("Camera", camera),
    ("ColorSpace", color_space),
    ("ConcatTransform", transform::concat),
    ("CoordinateSystem", transform::remember),
    ("CoordSysTransform", transform::recall),
    ("Film", film),
    ("Identity", transform::identity),
    ("Import", import),
    ("Include", include),
    ("Integrator", |r, at| r.plugin(at, "Integrator").and_then(|(plugin, p)| r.integrator(&p, &plugin))),
    ("LightSource", light),
    ("LookAt", transform::look_at),
    ("MakeNamedMaterial", named_material),
    ("MakeNamedMedium", |r, at| r.plugin(at, "MakeNamedMedium").map(drop)),
    ("Material", material),
    ("MediumInterface", medium),
    ("NamedMaterial", use_material),
    ("ObjectBegin", |r, at| r.object_begin(at)),
    ("ObjectEnd", |r, at| r.object_end(at)),
    ("ObjectInstance", |r, at| r.object_instance(at)),
    ("Option", |r, _| option(r)),
    ("PixelFilter", |r, at| r.plugin(at, "PixelFilter").and_then(|(plugin, p)| r.filter(&p, &plugin))),
    ("ReverseOrientation", |r, _| {
        r.state.reverse = !r.state.reverse;
        Ok(())
    }),
    ("Rotate", transform::rotate),
    ("Sampler", |r, at| r.plugin(at, "Sampler").and_then(|(_, p)| r.sampler(&p))),
    ("Scale", transform::scale),
    ("Shape", shape),
    ("Texture", texture),
    ("Transform", transform::transform),
    ("TransformBegin", |r, _| r.keep("TransformBegin")),
    ("TransformEnd", transform_end),
    ("TransformTimes", |r, _| r.text()?.numbers::<2>("TransformTimes").map(drop)),
    ("Translate", transform::translate),
    ("WorldBegin", world),
    ("WorldEnd", |_, at| Err(of_v3(at.error("WorldEnd is a directive of pbrt-v3")))),
];

/// Attributes within attributes.
const MOST_KEPT: usize = 4096;

/// Parameters that `Attribute` sets.
const MOST_DEFAULTS: usize = 256;

impl Reader<'_> {
    /// Keeps the state until `bring_back`.
    pub(super) fn keep(&mut self, begun: &'static str) -> Result<(), ReadError> {
        if self.kept.len() >= MOST_KEPT {
            return Err(self
                .text()?
                .here()
                .error(format!("{begun} more than {MOST_KEPT} deep in each other")));
        }
        self.kept.push((self.state.clone(), begun));
        Ok(())
    }

    /// Back to the state before.
    pub(super) fn bring_back(&mut self, at: &At, begun: &'static str) -> Result<(), ReadError> {
        match self.kept.pop() {
            Some((state, which)) if which == begun => {
                self.state = state;
                Ok(())
            }
            Some((_, other)) => {
                Err(at.error(format!("this End belongs to {begun}, and {other} is still open")))
            }
            None => Err(at.error(format!("an End without its {begun}"))),
        }
    }
}

/// Only the transform comes back.
fn transform_end(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let state = reader.state.clone();
    reader.bring_back(at, "TransformBegin")?;
    let world = reader.state.world;
    reader.state = super::State { world, ..state };
    Ok(())
}

/// `WorldBegin`: the camera and its film are known, the transform begins anew.
fn world(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    if reader.in_world {
        return Err(at.error("WorldBegin for the second time"));
    }
    reader.in_world = true;
    reader.state.world = Transform::IDENTITY;
    reader.spaces.insert("world".into(), Transform::IDENTITY);
    reader.look()
}

fn camera(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let (plugin, p) = reader.plugin(at, "Camera")?;
    let to_camera = reader.state.world;
    if let Some(from_camera) = to_camera.inverse() {
        reader.spaces.insert("camera".into(), from_camera);
    }
    reader.view.camera = Some((p, plugin, to_camera));
    Ok(())
}

fn film(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let (plugin, p) = reader.plugin(at, "Film")?;
    if plugin == "image" {
        return Err(of_v3(p.error("this is a film of pbrt-v3")));
    }
    reader.view.film = Some(p);
    Ok(())
}

fn shape(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let (plugin, p) = reader.plugin(at, "Shape")?;
    let p = reader.with_defaults(p, "shape");
    reader.shape(&p, &plugin)
}

fn light(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let (plugin, p) = reader.plugin(at, "LightSource")?;
    let p = reader.with_defaults(p, "light");
    reader.light(&p, &plugin)
}

fn area_light(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let (plugin, p) = reader.plugin(at, "AreaLightSource")?;
    let p = reader.with_defaults(p, "light");
    reader.area_light(&p, &plugin)
}

fn material(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let (plugin, p) = reader.plugin(at, "Material")?;
    let p = reader.with_defaults(p, "material");
    reader.state.material = Some(reader.material(&p, &plugin, "")?);
    Ok(())
}

fn named_material(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let (name, p) = reader.plugin(at, "MakeNamedMaterial")?;
    let p = reader.with_defaults(p, "material");
    let Some(plugin) = p.text("type")?.map(str::to_string) else {
        return Err(p.error("\"string type\" is missing: it says which material"));
    };
    let id = reader.material(&p, &plugin, &name)?;
    reader.materials.insert(name, id);
    Ok(())
}

fn use_material(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let name = reader.text()?.string("NamedMaterial")?;
    let known = reader.materials.get(&name).copied();
    reader.state.material = Some(known.ok_or_else(|| {
        let what = format!("no material is called {}", show(name.as_bytes()));
        at.error(what).hint("MakeNamedMaterial must stand before what uses it.")
    })?);
    Ok(())
}

fn texture(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let text = reader.text()?;
    let (name, kind) = (text.string("Texture")?, text.string("Texture")?);
    let number = match kind.as_str() {
        "float" => true,
        "spectrum" => false,
        "color" => return Err(of_v3(at.error("a texture of colours is called spectrum in pbrt-v4"))),
        _ => {
            return Err(at.error(format!("a texture is of float or spectrum, not {}", show(kind.as_bytes()))));
        }
    };
    let (plugin, p) = reader.plugin(at, "Texture")?;
    let p = reader.with_defaults(p, "texture");
    reader.texture(name, number, &p, &plugin)
}

/// Media are not followed: light goes straight through them.
fn medium(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let text = reader.text()?;
    let inside = text.string("MediumInterface")?;
    let outside = text.string_if_any()?.unwrap_or_default();
    if !(inside.is_empty() && outside.is_empty()) {
        reader.said.warn(at.words(), "media (fog, smoke, coloured glass) are not read: drawn clear");
    }
    Ok(())
}

/// Defaults for what follows.
fn attribute(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let (target, p) = reader.plugin(at, "Attribute")?;
    if !["shape", "light", "material", "medium", "texture"].contains(&target.as_str()) {
        return Err(p.error("one of shape, light, material, medium, texture is needed"));
    }
    let defaults = Rc::make_mut(&mut reader.state.defaults);
    if defaults.len() + p.count_given() > MOST_DEFAULTS {
        return Err(p.error(format!("more than {MOST_DEFAULTS} parameters are set for what follows")));
    }
    defaults.extend(p.into_given().into_iter().map(|given| (target.clone(), given)));
    Ok(())
}

fn color_space(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let name = reader.text()?.string("ColorSpace")?;
    if name != "srgb" {
        let what =
            format!("the colour space {} is not read: its colours are taken as sRGB", show(name.as_bytes()));
        reader.said.warn(at.words(), what);
    }
    Ok(())
}

/// Options of pbrt the program.
fn option(reader: &mut Reader) -> Result<(), ReadError> {
    let text = reader.text()?;
    let declared = text.string("Option")?;
    text.values(&format!("Option \"{declared}\"")).map(drop)
}

/// The directives of another file, here.
fn include(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let name = reader.text()?.string("Include")?;
    if reader.open.len() >= DEEPEST {
        return Err(at.error(format!("files lie more than {DEEPEST} deep in each other, or in themselves")));
    }
    let bytes = reader.open(&name);
    let bytes = bytes.map_err(|why| at.error(format!("the file \"{name}\": {why}")))?;
    reader.file(Text::new(&name, bytes.into()))
}

/// The same, and what it changes for shapes ends with it.
fn import(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    reader.keep("Import")?;
    include(reader, at)?;
    reader.bring_back(at, "Import")
}

/// The name that follows a directive.
pub(super) fn name_of(reader: &mut Reader, directive: &str) -> Result<String, ReadError> {
    reader.text()?.string(directive)
}
