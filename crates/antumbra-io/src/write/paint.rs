//! Textures as files: PNG where eight bits hold them, EXR where they do not; and pictures put together of others.

use antumbra::scene::TextureId;
use antumbra::texture::{Image, Texels, Texture};

use super::Job;
use crate::picture::{Codes, Picture, Precision, exr_bytes};

/// What the numbers of a picture are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Meaning {
    /// Colours for the eye: stored as sRGB.
    Color,
    /// Colours with their alpha.
    Cutout,
    /// Plain numbers.
    Numbers,
}

/// Rows of texels of eight bits, three or four numbers each.
pub(super) struct Codes8 {
    width: u32,
    height: u32,
    alpha: bool,
    data: Vec<u8>,
    /// The texels had more digits.
    pub rounded: bool,
}

/// A picture of texture texels: linear numbers at column and row.
pub(super) type Texel<'a> = dyn Fn(u32, u32) -> [f32; 4] + 'a;

impl Codes8 {
    /// An image as it is stored, or rounded to eight bits.
    pub(super) fn of(image: &Image, meaning: Meaning) -> Codes8 {
        let (width, height, alpha) = (image.width, image.height, meaning == Meaning::Cutout);
        match (&image.texels, meaning) {
            (Texels::Srgb8(t), Meaning::Color | Meaning::Cutout) | (Texels::Linear8(t), Meaning::Numbers) => {
                let keep = if alpha { 4 } else { 3 };
                let data = t.iter().flat_map(|texel| texel[..keep].to_vec()).collect();
                Codes8 { width, height, alpha, data, rounded: false }
            }
            _ => {
                Codes8 { rounded: true, ..Codes8::made([width, height], meaning, &|x, y| image.texel(x, y)) }
            }
        }
    }

    /// Of linear numbers in [0, 1].
    pub(super) fn made([width, height]: [u32; 2], meaning: Meaning, texel: &Texel) -> Codes8 {
        let (codes, alpha) = (Codes::new(), meaning == Meaning::Cutout);
        let plain = |c: f32| (c.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let color = |c: f32| if meaning == Meaning::Numbers { plain(c) } else { codes.encode(c) };
        let mut data = Vec::with_capacity(width as usize * height as usize * if alpha { 4 } else { 3 });
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let [r, g, b, a] = texel(x, y);
            data.extend([r, g, b].map(color));
            if alpha {
                data.push(plain(a));
            }
        }
        Codes8 { width, height, alpha, data, rounded: false }
    }

    /// The bytes of a PNG.
    pub(super) fn png(&self) -> Result<Vec<u8>, String> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(if self.alpha { png::ColorType::Rgba } else { png::ColorType::Rgb });
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        let written = encoder.write_header().and_then(|mut w| {
            w.write_image_data(&self.data)?;
            w.finish()
        });
        written.map_err(|e| e.to_string())?;
        Ok(bytes)
    }
}

/// The bytes of an EXR of 32-bit numbers.
pub(super) fn exr([width, height]: [u32; 2], texel: &Texel) -> Result<Vec<u8>, String> {
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels = places.map(|(x, y)| {
        let [r, g, b, _] = texel(x, y);
        [r, g, b]
    });
    let picture = Picture { width, height, pixels: pixels.collect(), ..Picture::default() };
    exr_bytes(&picture, Precision::Float)
}

/// Some texel of an image is not opaque.
pub(super) fn has_alpha(image: &Image) -> bool {
    match &image.texels {
        Texels::Srgb8(t) | Texels::Linear8(t) => t.iter().any(|texel| texel[3] < 255),
        Texels::Float(_) => false,
    }
}

/// Two textures lie on a surface alike, texel over texel.
pub(super) fn alike(a: &Texture, b: &Texture) -> bool {
    let size = |t: &Texture| (t.image.width, t.image.height, t.uv_set, t.nearest);
    size(a) == size(b) && a.wrap == b.wrap && a.map == b.map
}

impl<'a> Job<'a> {
    pub(super) fn texture(&self, id: TextureId) -> &'a Texture {
        &self.scene.textures[id as usize]
    }
}
