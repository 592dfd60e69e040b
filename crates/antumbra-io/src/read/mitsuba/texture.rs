//! Textures: bitmap and checkerboard, and what a property is painted with.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra::scene::TextureId;
use antumbra::texture::{Image, Texels, Texture, Wrap};
use antumbra_math::Rgb;

use super::Reader;
use super::document::Element;
use super::spectrum::is_plain;
use crate::error::ReadError;
use crate::read::spectrum::Of;
use crate::read::texels;

/// What a property is painted with.
#[derive(Clone, Copy, Debug)]
pub(super) enum Paint {
    /// One colour.
    Plain(Rgb),
    /// A texture of the scene.
    Texture(TextureId),
}

/// What was decoded already.
#[derive(Default)]
pub(super) struct Known {
    textures: HashMap<*const Element, Option<TextureId>>,
    /// The grey one of each texture that stands for a number.
    greys: HashMap<TextureId, TextureId>,
    /// By name and whether the colours are sRGB; `None` for those that cannot be read.
    images: HashMap<(String, bool), Option<Arc<Image>>>,
}

/// Makes a texture; `None` after a warning if it cannot be used.
type Make = for<'a> fn(&mut Reader<'a>, &'a Element) -> Result<Option<Texture>, ReadError>;

/// Every texture plugin that is read. To add one: a function and a line here.
const TEXTURES: [(&str, Make); 3] =
    [("bitmap", bitmap), ("checkerboard", checkerboard), ("mesh_attribute", mesh_attribute)];

impl<'a> Reader<'a> {
    /// What the property `name` is painted with, or its default.
    pub(super) fn paint(
        &mut self,
        element: &'a Element,
        name: &str,
        default: f32,
    ) -> Result<Paint, ReadError> {
        self.paint_of(element, name, default, Of::Matter)
    }

    fn paint_of(
        &mut self,
        element: &'a Element,
        name: &str,
        default: f32,
        of: Of,
    ) -> Result<Paint, ReadError> {
        let Some(value) = element.property(name) else { return Ok(Paint::Plain(Rgb::grey(default))) };
        let value = self.resolved(value)?;
        if !is_plain(value) {
            let texture = self.texture(value)?;
            return Ok(texture.map_or(Paint::Plain(Rgb::grey(default)), Paint::Texture));
        }
        self.plain(value, of).map(Paint::Plain)
    }

    /// The one colour of the property `name`: a texture counts by its mean, with a warning.
    pub(super) fn color(&mut self, element: &'a Element, name: &str, default: f32) -> Result<Rgb, ReadError> {
        self.color_of(element, name, default, Of::Matter)
    }

    /// The same of matter or of light.
    pub(super) fn color_of(
        &mut self,
        element: &'a Element,
        name: &str,
        default: f32,
        of: Of,
    ) -> Result<Rgb, ReadError> {
        match self.paint_of(element, name, default, of)? {
            Paint::Plain(color) => Ok(color),
            Paint::Texture(id) => {
                let what = format!("a texture on \"{name}\" of {}: it counts by its mean", element.words());
                self.said.warn(element.at.words(), what);
                Ok(self.scene.textures[id as usize].image.mean())
            }
        }
    }

    /// The number of the property `name`; as [`Reader::color`].
    pub(super) fn scalar(
        &mut self,
        element: &'a Element,
        name: &str,
        default: f64,
    ) -> Result<f64, ReadError> {
        match element.property(name).map(|p| p.tag.as_str()) {
            Some("texture" | "ref" | "spectrum" | "rgb") => {
                Ok(f64::from(self.color(element, name, default as f32)?.mean()))
            }
            _ => element.float(name, default),
        }
    }

    /// The number of the property `name`, or the texture whose red says it: a texture counts by its luminance, as in Mitsuba.
    pub(super) fn measured(
        &mut self,
        element: &'a Element,
        name: &str,
        default: f64,
    ) -> Result<(f32, Option<TextureId>), ReadError> {
        let tag = element.property(name).map(|p| p.tag.as_str());
        let textured = matches!(tag, Some("texture" | "ref" | "spectrum" | "rgb"));
        if !textured {
            return Ok((element.float(name, default)? as f32, None));
        }
        Ok(match self.paint(element, name, default as f32)? {
            Paint::Plain(color) => (number(color), None),
            Paint::Texture(id) => (1.0, Some(self.luminance(id))),
        })
    }

    /// A texture whose red is the luminance of another: what Mitsuba takes for a number.
    pub(super) fn luminance(&mut self, of: TextureId) -> TextureId {
        if let Some(known) = self.textures.greys.get(&of) {
            return *known;
        }
        let grey = self.grey(of);
        self.textures.greys.insert(of, grey);
        grey
    }

    fn grey(&mut self, of: TextureId) -> TextureId {
        let texture = self.scene.textures[of as usize].clone();
        let image = &texture.image;
        let (width, height) = (image.width, image.height);
        let texels = || (0..height).flat_map(|y| (0..width).map(move |x| image.texel(x, y)));
        let greys = || texels().map(|[r, g, b, _]| number(Rgb([r, g, b])));
        if greys().zip(texels()).all(|(grey, texel)| grey == texel[0]) {
            return of;
        }
        if self.context.textures.take(u64::from(width) * u64::from(height), 12).is_err() {
            let what =
                "the pictures of the scene are too large together: the red of a number's texture counts";
            self.said.warn("", what);
            return of;
        }
        match Image::new(width, height, Texels::Float(greys().map(|grey| [grey; 3]).collect())) {
            Some(image) => self.scene.texture(Texture { image: Arc::new(image), ..texture }),
            None => of,
        }
    }

    /// The texture of an element, made once.
    pub(super) fn texture(&mut self, element: &'a Element) -> Result<Option<TextureId>, ReadError> {
        if let Some(known) = self.textures.textures.get(&std::ptr::from_ref(element)) {
            return Ok(*known);
        }
        let made = match TEXTURES.iter().find(|t| t.0 == element.plugin()) {
            Some((_, make)) => {
                let texture = make(self, element)?;
                self.name_the_unread(element);
                texture.map(|texture| self.scene.texture(texture))
            }
            None => {
                self.lacks(element, "drawn without it");
                None
            }
        };
        self.textures.textures.insert(std::ptr::from_ref(element), made);
        Ok(made)
    }

    /// A picture beside the scene, decoded once; `None` after a warning if it cannot be read.
    fn image(&mut self, element: &Element, srgb: bool) -> Result<Option<Arc<Image>>, ReadError> {
        let name = element.filename()?;
        let key = (name.to_string(), srgb);
        if let Some(known) = self.textures.images.get(&key) {
            return Ok(known.clone());
        }
        let opened = self.open(name).map_err(|e| e.to_string());
        let image = match opened.and_then(|bytes| texels::picture(&bytes, srgb, self.context)) {
            Ok(image) => Some(Arc::new(image)),
            Err(why) => {
                let what = format!("the picture \"{name}\": {why}: drawn without it");
                self.said.warn(element.at.words(), what);
                None
            }
        };
        self.textures.images.insert(key, image.clone());
        Ok(image)
    }
}

/// A colour as one number: its luminance; a grey stays what it is, to the last bit.
pub(super) fn number(Rgb([r, g, b]): Rgb) -> f32 {
    if r == g && g == b { r } else { Rgb([r, g, b]).luminance() }
}

/// `bitmap`: a picture; v = 0 is its top row.
fn bitmap<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Option<Texture>, ReadError> {
    let raw = element.boolean("raw", false)?;
    let wrap = match element.choice("wrap_mode", &["repeat", "mirror", "clamp"])? {
        "mirror" => Wrap::Mirror,
        "clamp" => Wrap::Clamp,
        _ => Wrap::Repeat,
    };
    let nearest = element.choice("filter_type", &["bilinear", "nearest"])? == "nearest";
    // How a texture is stored or sampled inside of Mitsuba changes no picture.
    element.pass_over(&["format", "accel"]);
    let map = element.uv_transform()?;
    let image = reader.image(element, !raw)?;
    Ok(image.map(|image| Texture { wrap: [wrap; 2], nearest, map, ..Texture::new(image) }))
}

/// `checkerboard`: two by two fields over the unit square.
fn checkerboard<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Option<Texture>, ReadError> {
    let (first, second) = (reader.color(element, "color0", 0.4)?, reader.color(element, "color1", 0.2)?);
    let (a, b) = (first.0, second.0);
    let image = Image::new(2, 2, Texels::Float(vec![a, b, b, a]));
    let map = element.uv_transform()?;
    Ok(image.map(|image| Texture { nearest: true, map, ..Texture::new(Arc::new(image)) }))
}

/// `mesh_attribute` is read where it is the colour of a bsdf: elsewhere there is nothing that could hold it.
fn mesh_attribute<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Option<Texture>, ReadError> {
    element.pass_over(&["name", "scale"]);
    let what = "colours of a mesh count as the colour of a bsdf alone: not read here";
    reader.said.warn(element.at.words(), what);
    Ok(None)
}
