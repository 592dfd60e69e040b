//! Textures: pictures of the file, their samplers, and KHR_texture_transform.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra::scene::TextureId;
use antumbra::texture::{Image, Texture, Wrap};
use antumbra_math::real;

use super::Reader;
use super::document::{GltfTexture, Sampler, TextureInfo, TextureTransform};
use crate::read::{texels, uri};

/// Pictures that were decoded, by index and by whether their colours are sRGB; `None` for those that cannot be read.
pub(super) type Images = HashMap<(usize, bool), Option<Arc<Image>>>;

const NEAREST: u32 = 9728;
const CLAMP: u32 = 33071;
const MIRROR: u32 = 33648;
const BASISU_ALONE: &str = "has only a KTX2 picture (KHR_texture_basisu), which is not read: drawn without it; \
    `npx @gltf-transform/cli ktxdecompress IN.glb OUT.glb` writes it as PNG";

impl Reader<'_> {
    /// The texture that a material names; `None` after a warning if it cannot be used.
    pub(super) fn texture(&mut self, info: &TextureInfo, srgb: bool) -> Option<TextureId> {
        let image = self.image_of(info, srgb)?;
        let transform = info.extensions.transform.as_ref();
        let set = transform.and_then(|t| t.tex_coord).unwrap_or(info.tex_coord);
        if set > 1 {
            let text = format!("uses texture coordinates {set}; sets 0 and 1 are read: drawn without it");
            self.said.warn(format!("texture {}", info.index), text);
            return None;
        }
        let sampler = self.doc.textures.get(info.index).and_then(|t| self.doc.samplers.get(t.sampler?));
        let sampler = sampler.unwrap_or(&Sampler { mag_filter: None, wrap_s: None, wrap_t: None });
        let wrap = |mode: Option<u32>| match mode {
            Some(CLAMP) => Wrap::Clamp,
            Some(MIRROR) => Wrap::Mirror,
            _ => Wrap::Repeat,
        };
        Some(self.scene.texture(Texture {
            image,
            uv_set: set as u8,
            wrap: [wrap(sampler.wrap_s), wrap(sampler.wrap_t)],
            nearest: sampler.mag_filter == Some(NEAREST),
            map: map(transform.unwrap_or(&TextureTransform::default())),
        }))
    }

    /// The picture of a texture, decoded once.
    pub(super) fn image_of(&mut self, info: &TextureInfo, srgb: bool) -> Option<Arc<Image>> {
        let Some(texture) = self.doc.textures.get(info.index) else {
            let text = format!("is named; there are {}: drawn without it", self.doc.textures.len());
            self.said.warn(format!("texture {}", info.index), text);
            return None;
        };
        let packed = texture.extensions.contains_key("KHR_texture_basisu");
        let index = source(texture);
        let text = match index {
            Some(_) if packed => {
                "has a KTX2 picture (KHR_texture_basisu), which is not read: its fallback is shown"
            }
            Some(_) => "",
            None if packed => BASISU_ALONE,
            None => "has no picture of a kind that is read (PNG, JPEG, WebP): drawn without it",
        };
        if !text.is_empty() {
            self.said.warn(format!("texture {}", info.index), text);
        }
        let index = index?;
        if let Some(known) = self.materials.images.get(&(index, srgb)) {
            return known.clone();
        }
        let image = match self.load(index, srgb) {
            Ok(image) => Some(Arc::new(image)),
            Err(why) => {
                self.said.warn(self.image_place(index), format!("{why}: drawn without it"));
                None
            }
        };
        self.materials.images.insert((index, srgb), image.clone());
        image
    }

    fn image_place(&self, index: usize) -> String {
        match self.doc.images.get(index) {
            Some(i) if !i.name.is_empty() => format!("image \"{}\"", i.name),
            Some(i) => match &i.uri {
                Some(u) if !u.starts_with("data:") => format!("image {index} \"{u}\""),
                _ => format!("image {index}"),
            },
            None => format!("image {index}"),
        }
    }

    fn load(&self, index: usize, srgb: bool) -> Result<Image, String> {
        let image = self.doc.images.get(index).ok_or("there is no such image")?;
        match (&image.uri, image.buffer_view) {
            (Some(u), _) => texels::decode(&uri::fetch(u, self.context)?, srgb, self.context),
            (None, Some(view)) => texels::decode(self.accessors.view(view)?, srgb, self.context),
            (None, None) => Err("has neither a uri nor a buffer view".into()),
        }
    }
}

/// The image of a texture; the plain one comes first, since extensions repeat it for readers that know them.
fn source(texture: &GltfTexture) -> Option<usize> {
    let webp = || texture.extensions.get("EXT_texture_webp")?.get("source")?.as_u64();
    texture.source.or_else(|| webp().and_then(|s| usize::try_from(s).ok()))
}

/// offset + rotation · scale · uv. The rotation is counter-clockwise to the eye, with v pointing down.
fn map(t: &TextureTransform) -> [f32; 6] {
    let (s, c) = (real::sin(t.rotation), real::cos(t.rotation));
    let ([tx, ty], [sx, sy]) = (t.offset, t.scale);
    [c * sx, s * sy, tx, -s * sx, c * sy, ty].map(|m| m as f32)
}
