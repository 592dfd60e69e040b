//! What a property is painted with: a colour, a number, or a picture of the folder.

use std::sync::Arc;

use antumbra::scene::TextureId;
use antumbra::texture::{Image, Texels, Texture, Wrap};
use antumbra_math::{DMat3, DVec3, Rgb, Transform};

use super::Writer;
use super::xml::{Element, rgb};
use crate::write::paint::{Codes8, Meaning, Texel, exr};

/// What tells pictures apart: the image, what of it, and the factor.
pub(super) type Key = (*const Image, Part, [u32; 3]);

/// What of an image is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Part {
    /// Its colours.
    Color,
    /// Its plain numbers.
    Numbers,
    /// One component as grey.
    One(u8),
    /// The square of one component.
    Square(u8),
}

/// A picture of the folder.
pub(super) struct File {
    name: String,
    /// Its numbers are no screen colours.
    raw: bool,
}

impl Writer<'_, '_> {
    /// A property that is a colour, times a texture if it has one.
    pub(super) fn paint(&mut self, name: &str, by: Rgb, id: Option<TextureId>) -> Result<Element, String> {
        let Some(id) = id else { return Ok(rgb(name, by)) };
        let texture = self.job.texture(id);
        let file = self.picture(&texture.image, Part::Color, by)?;
        Ok(self.bitmap(name, texture, &file))
    }

    /// A property that is a number, times a part of a texture if it has one.
    pub(super) fn measure(
        &mut self,
        name: &str,
        by: f32,
        part: Option<(TextureId, Part)>,
    ) -> Result<Element, String> {
        let Some((id, part)) = part else {
            return Ok(Element::new("float").with("name", name).with("value", by.to_string()));
        };
        let texture = self.job.texture(id);
        let file = self.picture(&texture.image, part, Rgb::grey(by))?;
        Ok(self.bitmap(name, texture, &file))
    }

    /// A bitmap laid on a surface like `texture`.
    pub(super) fn bitmap(&mut self, name: &str, texture: &Texture, file: &File) -> Element {
        if texture.wrap[0] != texture.wrap[1] {
            self.warn("textures", "one goes on in different ways along u and v: written with that along u");
        }
        let wrap = match texture.wrap[0] {
            Wrap::Repeat => None,
            Wrap::Mirror => Some("mirror"),
            Wrap::Clamp => Some("clamp"),
        };
        let mut bitmap =
            Element::plugin("texture", "bitmap").with("name", name).string("filename", &file.name);
        if file.raw {
            bitmap = bitmap.boolean("raw", true);
        }
        if let Some(wrap) = wrap {
            bitmap = bitmap.string("wrap_mode", wrap);
        }
        if texture.nearest {
            bitmap = bitmap.string("filter_type", "nearest");
        }
        let [a, b, x, c, d, y] = texture.map.map(f64::from);
        let linear = DMat3::from_cols(DVec3::new(a, c, 0.0), DVec3::new(b, d, 0.0), DVec3::Z);
        bitmap.transform("to_uv", &Transform { linear, translation: DVec3::new(x, y, 0.0) })
    }

    /// The file of a part of an image times a factor: PNG where eight bits hold it, else EXR.
    pub(super) fn picture(&mut self, image: &Arc<Image>, part: Part, by: Rgb) -> Result<File, String> {
        let key = (Arc::as_ptr(image), part, by.0.map(f32::to_bits));
        let screen = part == Part::Color && by == Rgb::WHITE && matches!(image.texels, Texels::Srgb8(_));
        let raw = !screen;
        if let Some(name) = self.pictures.get(&key) {
            return Ok(File { name: name.clone(), raw });
        }
        let texel = |x, y| {
            let t = image.texel(x, y);
            let [r, g, b] = match part {
                Part::Color | Part::Numbers => [t[0], t[1], t[2]],
                Part::One(c) => [t[usize::from(c & 3)]; 3],
                Part::Square(c) => [t[usize::from(c & 3)] * t[usize::from(c & 3)]; 3],
            };
            let Rgb([r, g, b]) = Rgb([r, g, b]) * by;
            [r, g, b, 1.0]
        };
        // Alpha is stored in eight bits beside sRGB colours too.
        let codes = matches!((&image.texels, part), (Texels::Srgb8(_) | Texels::Linear8(_), Part::One(3)))
            || matches!(
                (&image.texels, part),
                (Texels::Linear8(_), Part::Color | Part::Numbers | Part::One(_))
            );
        let size = [image.width, image.height];
        let name = if screen {
            self.codes(&Codes8::of(image, Meaning::Color))?
        } else if codes && by == Rgb::WHITE {
            self.codes(&Codes8::made(size, Meaning::Numbers, &texel))?
        } else {
            self.numbers(size, &texel)?
        };
        self.pictures.insert(key, name.clone());
        Ok(File { name, raw })
    }

    /// A picture put together for one place.
    pub(super) fn made(&mut self, size: [u32; 2], eight_bits: bool, texel: &Texel) -> Result<File, String> {
        let name = if eight_bits {
            self.codes(&Codes8::made(size, Meaning::Numbers, texel))?
        } else {
            self.numbers(size, texel)?
        };
        Ok(File { name, raw: true })
    }

    fn codes(&mut self, codes: &Codes8) -> Result<String, String> {
        let bytes = codes.png()?;
        Ok(self.file("texture", "png", bytes))
    }

    fn numbers(&mut self, size: [u32; 2], texel: &Texel) -> Result<String, String> {
        let bytes = exr(size, texel)?;
        Ok(self.file("texture", "exr", bytes))
    }
}
