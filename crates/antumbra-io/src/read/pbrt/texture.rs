//! `Texture`: imagemap, constant, scale, mix, checkerboard; and what a parameter is painted with.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra::scene::TextureId;
use antumbra::texture::{Image, Texels, Texture, Wrap};
use antumbra_math::Rgb;

use super::Reader;
use super::parameters::Parameters;
use super::spectrum::Of;
use super::text::{At, Values};
use crate::error::ReadError;
use crate::read::text::show;
use crate::read::{GREY, texels};

/// What a parameter is painted with: factor × image.
#[derive(Clone, Debug)]
pub(super) struct Paint {
    /// One colour, times the image's.
    pub factor: Rgb,
    /// What varies over the surface.
    pub image: Option<Texture>,
}

impl Paint {
    /// The same everywhere.
    pub fn plain(factor: Rgb) -> Paint {
        Paint { factor, image: None }
    }

    /// The mean over its image.
    pub fn mean(&self) -> Rgb {
        self.factor * self.image.as_ref().map_or(Rgb::WHITE, |texture| texture.image.mean())
    }

    fn at(&self, uv: [f32; 2]) -> Rgb {
        let [r, g, b, _] = self.image.as_ref().map_or([1.0; 4], |texture| texture.at(uv));
        self.factor * Rgb([r, g, b])
    }
}

/// What was made already.
#[derive(Default)]
pub(super) struct Known {
    /// By name, those of numbers and those of colours apart.
    named: HashMap<(bool, String), Paint>,
    /// By name, whether its colours are sRGB, and whether it stands for a number.
    images: HashMap<(String, bool, bool), Option<Arc<Image>>>,
}

/// What a texture of a number (or of a colour) is painted with.
type Make = fn(&mut Reader, &Parameters, bool) -> Result<Paint, ReadError>;

/// Every texture that is read. To add one: a function and a line here.
const TEXTURES: [(&str, Make); 5] = [
    ("imagemap", imagemap),
    ("constant", constant),
    ("scale", scale),
    ("mix", mix),
    ("checkerboard", checkerboard),
];

/// Texels of one side of a picture that two textures make together, at most.
const WIDEST: u32 = 4096;

impl Reader<'_> {
    /// `Texture "name" "spectrum" "imagemap" …`.
    pub(super) fn texture(
        &mut self,
        name: String,
        number: bool,
        p: &Parameters,
        plugin: &str,
    ) -> Result<(), ReadError> {
        let paint = match TEXTURES.iter().find(|t| t.0 == plugin) {
            Some((_, make)) => {
                let paint = make(self, p, number)?;
                self.name_the_unread(p);
                paint
            }
            None => {
                self.lacks(p, "drawn grey");
                Paint::plain(Rgb::grey(GREY))
            }
        };
        self.textures.named.insert((number, name), paint);
        Ok(())
    }

    /// What the parameter `name` is painted with, or its default.
    pub(super) fn paint(&mut self, p: &Parameters, name: &str, default: f32) -> Result<Paint, ReadError> {
        self.painted(p, name, default, false)
    }

    /// The same of a number: a grey one.
    pub(super) fn number(&mut self, p: &Parameters, name: &str, default: f32) -> Result<Paint, ReadError> {
        self.painted(p, name, default, true)
    }

    fn painted(
        &mut self,
        p: &Parameters,
        name: &str,
        default: f32,
        number: bool,
    ) -> Result<Paint, ReadError> {
        let Some(given) = p.get(name) else { return Ok(Paint::plain(Rgb::grey(default))) };
        match (&*given.values, given.kind.as_str()) {
            (Values::Texts(texts), "texture") if texts.len() == 1 => {
                let found = self.textures.named.get(&(number, texts[0].clone())).cloned();
                found.ok_or_else(|| {
                    let of = if number { "float" } else { "spectrum" };
                    let what = format!("no {of} texture is called {}", show(texts[0].as_bytes()));
                    given.fail(p, what).hint("A texture must stand before what uses it.")
                })
            }
            _ if number => Ok(Paint::plain(Rgb::grey(p.float(name, f64::from(default))? as f32))),
            _ => Ok(Paint::plain(self.color_of(given, p, Of::Matter)?)),
        }
    }

    /// The one colour of a parameter: a texture counts by its mean, with a warning.
    pub(super) fn color(&mut self, p: &Parameters, name: &str, default: f32) -> Result<Rgb, ReadError> {
        let paint = self.paint(p, name, default)?;
        Ok(self.one(&paint, name, p))
    }

    /// The one number of a parameter; as [`Reader::color`].
    pub(super) fn scalar(&mut self, p: &Parameters, name: &str, default: f32) -> Result<f32, ReadError> {
        let paint = self.number(p, name, default)?;
        Ok(self.one(&paint, name, p).0[0])
    }

    fn one(&mut self, paint: &Paint, name: &str, p: &Parameters) -> Rgb {
        if paint.image.is_some() {
            let what = format!("a texture on \"{name}\" of {}: it counts by its mean", p.words);
            self.said.warn(p.at.words(), what);
        }
        paint.mean()
    }

    /// The scene's texture of an image, added once.
    pub(super) fn intern(&mut self, texture: &Texture) -> TextureId {
        let same = |t: &Texture| {
            let placed = |t: &Texture| (t.wrap, t.nearest, t.uv_set, t.map);
            Arc::ptr_eq(&t.image, &texture.image) && placed(t) == placed(texture)
        };
        match self.scene.textures.iter().position(same) {
            Some(id) => id as TextureId,
            None => self.scene.texture(texture.clone()),
        }
    }

    /// Each texel of paints that lie on each other, through `f`; paints that lie elsewhere count by their means.
    pub(super) fn joined(
        &mut self,
        at: &At,
        paints: [&Paint; 3],
        f: impl Fn([Rgb; 3]) -> Rgb,
    ) -> Result<Paint, ReadError> {
        let mut images = paints.iter().filter_map(|p| p.image.as_ref());
        let Some(first) = images.next() else { return Ok(Paint::plain(f(paints.map(Paint::mean)))) };
        let place = |t: &Texture| (t.wrap, t.map);
        let along = |p: &Paint| p.image.as_ref().is_none_or(|t| place(t) == place(first));
        if !paints.iter().all(|p| along(p)) {
            self.said.warn(
                at.words(),
                "textures that are mapped differently are joined: some count by their mean",
            );
        }
        let flat = paints.map(|p| {
            let image = p.image.clone().filter(|_| along(p));
            let factor = if image.is_some() { p.factor } else { p.mean() };
            let unmapped = |t: Texture| Texture { map: Texture::new(t.image.clone()).map, ..t };
            Paint { factor, image: image.map(unmapped) }
        });
        let side = |of: fn(&Image) -> u32| {
            flat.iter().filter_map(|p| p.image.as_ref()).map(|t| of(&t.image)).max().unwrap_or(1).min(WIDEST)
        };
        let (width, height) = (side(|i| i.width), side(|i| i.height));
        let room = self.context.textures.take(u64::from(width) * u64::from(height), 12);
        room.map_err(|_| at.error("the pictures of the scene are too large together"))?;
        let middle = |i: u32, n: u32| (i as f32 + 0.5) / n as f32;
        let texels = (0..height).flat_map(|y| (0..width).map(move |x| [middle(x, width), middle(y, height)]));
        let texels = texels.map(|uv| f([0, 1, 2].map(|i| flat[i].at(uv))).0).collect();
        let image = Image::new(width, height, Texels::Float(texels));
        Ok(Paint {
            factor: Rgb::WHITE,
            image: image.map(|image| Texture { image: Arc::new(image), ..first.clone() }),
        })
    }

    /// A paint of numbers through `f`.
    pub(super) fn each(
        &mut self,
        at: &At,
        paint: &Paint,
        f: impl Fn(f32) -> f32,
    ) -> Result<Paint, ReadError> {
        let none = Paint::plain(Rgb::WHITE);
        self.joined(at, [paint, &none, &none], |[x, ..]| Rgb(x.0.map(&f)))
    }

    /// A picture beside the scene, decoded once; `None` after a warning if it cannot be read. For a number, its three
    /// colours count by their mean.
    pub(super) fn picture(
        &mut self,
        p: &Parameters,
        name: &str,
        srgb: bool,
        number: bool,
    ) -> Option<Arc<Image>> {
        let key = (name.to_string(), srgb, number);
        if let Some(known) = self.textures.images.get(&key) {
            return known.clone();
        }
        let decoded = self.open(name).and_then(|bytes| texels::picture(&bytes, srgb, self.context));
        let decoded = decoded.and_then(|image| if number { grey(&image, self.context) } else { Ok(image) });
        let image = decoded.map(Arc::new).map_err(|why| {
            self.said.warn(p.at.words(), format!("the picture \"{name}\": {why}: drawn without it"));
        });
        self.textures.images.insert(key, image.clone().ok());
        image.ok()
    }
}

/// The mean of the three colours of each texel.
fn grey(image: &Image, context: &crate::read::Context) -> Result<Image, String> {
    let (width, height) = (image.width, image.height);
    context.textures.take(u64::from(width) * u64::from(height), 12)?;
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| image.texel(x, y)));
    let texels = texels.map(|[r, g, b, _]| [(r + g + b) / 3.0; 3]).collect();
    Image::new(width, height, Texels::Float(texels)).ok_or_else(|| "it has no pixels".into())
}

/// u′ = uscale·u + udelta; v′ the same, upwards: pictures stand with v = 0 at their lower edge.
fn mapping(reader: &mut Reader, p: &Parameters, up: bool) -> Result<[f32; 6], ReadError> {
    if p.choice("mapping", &["uv", "planar", "spherical", "cylindrical"])? != "uv" {
        let what = format!("the mapping of {} is not read: drawn by the surface's own coordinates", p.words);
        reader.said.warn(p.at.words(), what);
        p.pass_over(&["v1", "v2", "uscale", "vscale", "udelta", "vdelta"]);
    }
    let number = |name, default| p.float(name, default).map(|x| x as f32);
    let (su, du) = (number("uscale", 1.0)?, number("udelta", 0.0)?);
    let (sv, dv) = (number("vscale", 1.0)?, number("vdelta", 0.0)?);
    Ok(if up { [su, 0.0, du, 0.0, sv, dv] } else { [su, 0.0, du, 0.0, -sv, 1.0 - dv] })
}

fn imagemap(reader: &mut Reader, p: &Parameters, number: bool) -> Result<Paint, ReadError> {
    let map = mapping(reader, p, false)?;
    let wrap = match p.choice("wrap", &["repeat", "clamp", "black", "octahedralsphere"])? {
        "repeat" => Wrap::Repeat,
        other => {
            if other != "clamp" {
                let what = format!("the wrap \"{other}\" is not read: its border goes on");
                reader.said.warn(p.at.words(), what);
            }
            Wrap::Clamp
        }
    };
    let encoding = p.text("encoding")?.unwrap_or("sRGB").to_string();
    let gamma = encoding.strip_prefix("gamma ").and_then(|g| g.trim().parse::<f32>().ok());
    if !(encoding == "sRGB" || encoding == "linear" || gamma.is_some_and(|g| g > 0.0)) {
        return Err(p.error(format!(
            "\"encoding\" is {}: sRGB, linear or \"gamma 2.2\" is needed",
            show(encoding.as_bytes())
        )));
    }
    p.pass_over(&["maxanisotropy"]);
    let nearest = p.choice("filter", &["bilinear", "trilinear", "ewa", "point"])? == "point";
    let (factor, invert) = (p.float("scale", 1.0)? as f32, p.boolean("invert", false)?);
    let Some(name) = p.text("filename")? else { return Err(p.error("\"string filename\" is missing")) };
    let Some(image) = reader.picture(p, name, encoding == "sRGB", number) else {
        return Ok(Paint::plain(Rgb::grey(GREY)));
    };
    let texture = Texture { wrap: [wrap; 2], nearest, map, ..Texture::new(image) };
    let paint = Paint { factor: Rgb::grey(factor), image: Some(texture) };
    let paint = match gamma {
        Some(gamma) => reader.each(&p.at, &paint, |x| antumbra_math::real::powf(x, gamma))?,
        None => paint,
    };
    if invert { reader.each(&p.at, &paint, |x| (1.0 - x).max(0.0)) } else { Ok(paint) }
}

fn constant(reader: &mut Reader, p: &Parameters, number: bool) -> Result<Paint, ReadError> {
    reader.painted(p, "value", 1.0, number)
}

/// The product of two.
fn scale(reader: &mut Reader, p: &Parameters, number: bool) -> Result<Paint, ReadError> {
    let paint = reader.painted(p, "tex", 1.0, number)?;
    let by = reader.number(p, "scale", 1.0)?;
    match (&paint.image, &by.image) {
        (_, None) => Ok(Paint { factor: paint.factor * by.factor, ..paint }),
        (None, _) => Ok(Paint { factor: by.factor * paint.factor, ..by }),
        _ => reader.joined(&p.at, [&paint, &by, &by], |[a, b, _]| a * b),
    }
}

/// (1 − amount) of the first, amount of the second.
fn mix(reader: &mut Reader, p: &Parameters, number: bool) -> Result<Paint, ReadError> {
    let (first, second) = (reader.painted(p, "tex1", 0.0, number)?, reader.painted(p, "tex2", 1.0, number)?);
    let amount = reader.number(p, "amount", 0.5)?;
    reader.joined(&p.at, [&first, &second, &amount], |[a, b, t]| a * (Rgb::WHITE + t * -1.0) + b * t)
}

/// Fields of side 1 in turn.
fn checkerboard(reader: &mut Reader, p: &Parameters, number: bool) -> Result<Paint, ReadError> {
    if p.count("dimension")?.unwrap_or(2) != 2 {
        reader.said.warn(p.at.words(), "a checkerboard in space is not read: drawn on the surface");
    }
    let of = |reader: &mut Reader, name: &str, default| {
        let paint = reader.painted(p, name, default, number)?;
        Ok::<_, ReadError>(reader.one(&paint, name, p).0)
    };
    let (a, b) = (of(reader, "tex1", 1.0)?, of(reader, "tex2", 0.0)?);
    let image = Image::new(2, 2, Texels::Float(vec![a, b, b, a]));
    let map = mapping(reader, p, true)?.map(|x| 0.5 * x);
    let texture = image.map(|image| Texture { nearest: true, map, ..Texture::new(Arc::new(image)) });
    Ok(Paint { factor: Rgb::WHITE, image: texture })
}
