//! Textures: pictures in the buffer, samplers, KHR_texture_transform; pictures put together of those of a material.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra::scene::{Alpha, Channel, Material, Surface, TextureId};
use antumbra::texture::{Image, Texture, Wrap};
use antumbra_math::real;
use serde_json::{Value, json};

use super::material::Asks;
use super::{Writer, number, numbers};
use crate::write::paint::{Codes8, Meaning, Texel, alike, has_alpha};

/// Pictures of the document, by the image and what its numbers are.
pub(super) type Images = HashMap<(*const Image, Meaning), usize>;

const TRANSFORM: &str = "KHR_texture_transform";
const ROUNDED: &str = "its numbers are rounded to the eight bits of glTF's pictures";

impl Writer<'_, '_> {
    /// A picture of plain numbers.
    pub(super) fn plain_texture(&mut self, id: TextureId, asks: &mut Asks) -> Result<Value, String> {
        self.whole(id, Meaning::Numbers, asks)
    }

    /// A texture as it is.
    fn whole(&mut self, id: TextureId, meaning: Meaning, asks: &mut Asks) -> Result<Value, String> {
        let texture = self.job.texture(id);
        let key = (Arc::as_ptr(&texture.image), meaning);
        let image = match self.made.images.get(&key) {
            Some(known) => *known,
            None => {
                let codes = Codes8::of(&texture.image, meaning);
                if codes.rounded {
                    self.warn(format!("texture {id}"), ROUNDED);
                }
                let image = self.image(&codes)?;
                self.made.images.insert(key, image);
                image
            }
        };
        Ok(self.info(texture, image, asks))
    }

    /// A picture put together, laid on the surface like `texture`.
    fn made(
        &mut self,
        texture: &Texture,
        meaning: Meaning,
        texel: &Texel,
        asks: &mut Asks,
    ) -> Result<Value, String> {
        let size = [texture.image.width, texture.image.height];
        let image = self.image(&Codes8::made(size, meaning, texel))?;
        Ok(self.info(texture, image, asks))
    }

    fn image(&mut self, codes: &Codes8) -> Result<usize, String> {
        let view = self.buffer.view(&codes.png()?);
        self.images.push(json!({"bufferView": view, "mimeType": "image/png"}));
        Ok(self.images.len() - 1)
    }

    /// A texture of the document with its place on the surface.
    fn info(&mut self, texture: &Texture, image: usize, asks: &mut Asks) -> Value {
        let wrap = |w: Wrap| match w {
            Wrap::Repeat => 10497,
            Wrap::Mirror => 33648,
            Wrap::Clamp => 33071,
        };
        let filter = if texture.nearest { 9728 } else { 9729 };
        let [s, t] = texture.wrap.map(wrap);
        let sampler = json!({"magFilter": filter, "minFilter": filter, "wrapS": s, "wrapT": t});
        let at = self.samplers.iter().position(|known| *known == sampler).unwrap_or_else(|| {
            self.samplers.push(sampler);
            self.samplers.len() - 1
        });
        let written = json!({"sampler": at, "source": image});
        let index = self.textures.iter().position(|known| *known == written).unwrap_or_else(|| {
            self.textures.push(written);
            self.textures.len() - 1
        });
        let mut info = json!({"index": index, "texCoord": texture.uv_set});
        if let Some(asked) = asks.sets.get_mut(usize::from(texture.uv_set)) {
            *asked = true;
        }
        if let Some((transform, exact)) = transform(&texture.map) {
            if !exact {
                self.warn("textures", "one is sheared on its surface: written without the shear");
            }
            self.extensions.insert(TRANSFORM);
            info["extensions"] = json!({TRANSFORM: transform});
        }
        info
    }

    /// The colours, with the alpha where it counts.
    pub(super) fn base_texture(
        &mut self,
        m: &Material,
        place: &str,
        asks: &mut Asks,
    ) -> Result<Option<Value>, String> {
        let cover = m.cover.filter(|_| m.alpha != Alpha::Opaque).map(|id| self.job.texture(id));
        let Some(cover) = cover else {
            let Some(id) = m.color else { return Ok(None) };
            let cutout = m.alpha != Alpha::Opaque && has_alpha(&self.job.texture(id).image);
            let meaning = if cutout { Meaning::Cutout } else { Meaning::Color };
            return self.whole(id, meaning, asks).map(Some);
        };
        let color = m.color.map(|id| self.job.texture(id));
        if let (Some(id), Some(_)) = (m.color, color.filter(|color| !alike(color, cover))) {
            self.warn(
                place,
                "its alpha lies on it in another way than its colour: written without the alpha",
            );
            return self.whole(id, Meaning::Color, asks).map(Some);
        }
        let texel = |x, y| {
            let [r, g, b, a] = color.map_or([1.0; 4], |c| c.image.texel(x, y));
            [r, g, b, a * cover.image.texel(x, y)[0]]
        };
        self.made(cover, Meaning::Cutout, &texel, asks).map(Some)
    }

    /// Green roughness, blue metallic.
    pub(super) fn metal_rough(
        &mut self,
        m: &Material,
        place: &str,
        asks: &mut Asks,
    ) -> Result<Option<Value>, String> {
        let metallic = m.metallic.filter(|_| is_metal_rough(&m.surface));
        let roughness =
            m.roughness.as_ref().filter(|_| is_metal_rough(&m.surface) || m.surface.facets().is_some());
        // Facets go with the square of what the format calls roughness.
        let rooted = roughness.is_some_and(|r| !is_metal_rough(&m.surface) && !r.squared);
        let roughness = roughness.map(|r| r.channel);
        let Some(Channel { texture: first, .. }) = roughness.or(metallic) else { return Ok(None) };
        let stored = roughness.is_none_or(|c| c.component == 1 && !rooted)
            && metallic.is_none_or(|c| c.component == 2)
            && [roughness, metallic].iter().flatten().all(|c| c.texture == first);
        // A factor of 0 makes the other number what it is.
        let alone = roughness.is_some() && (metallic.is_some() || no_metal(&m.surface));
        if stored && alone {
            return self.plain_texture(first, asks).map(Some);
        }
        let on = self.job.texture(first);
        let pick = |channel: Option<Channel>| {
            let channel = channel.map(|c| (self.job.texture(c.texture), usize::from(c.component & 3)));
            channel.filter(|(texture, _)| alike(texture, on))
        };
        let (rough, metal) = (pick(roughness), pick(metallic));
        let all = rough.is_some() == roughness.is_some() && metal.is_some() == metallic.is_some();
        if !all {
            self.warn(
                place,
                "its metallic lies on it in another way than its roughness: written without the texture",
            );
        }
        let of =
            |channel: Option<(&Texture, usize)>, x, y| channel.map_or(1.0, |(t, c)| t.image.texel(x, y)[c]);
        let texel = |x, y| {
            let r = of(rough, x, y);
            [1.0, if rooted { r.max(0.0).sqrt() } else { r }, of(metal, x, y), 1.0]
        };
        self.made(on, Meaning::Numbers, &texel, asks).map(Some)
    }
}

fn is_metal_rough(surface: &Surface) -> bool {
    matches!(surface, Surface::MetallicRoughness { .. } | Surface::ClearCoat { .. } | Surface::Principled(_))
}

/// Its metallic factor is 0 in the format.
fn no_metal(surface: &Surface) -> bool {
    match surface {
        Surface::MetallicRoughness { metallic, .. } | Surface::ClearCoat { metallic, .. } => *metallic == 0.0,
        Surface::Principled(p) => p.metallic == 0.0,
        Surface::RoughConductor(_) => false,
        _ => true,
    }
}

/// Offset, rotation and scale of a map, and whether they are all of it; `None` for the identity.
fn transform(map: &[f32; 6]) -> Option<(Value, bool)> {
    let [a, b, tx, c, d, ty] = *map;
    if *map == [1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
        return None;
    }
    let mut transform = json!({"offset": numbers([tx, ty])});
    if b == 0.0 && c == 0.0 {
        transform["scale"] = numbers([a, d]);
        return Some((transform, true));
    }
    // Columns (cos · sx, −sin · sx) and (sin · sy, cos · sy).
    let angle = real::atan2(f64::from(-c), f64::from(a));
    let (sin, cos) = (real::sin(angle) as f32, real::cos(angle) as f32);
    let (sx, sy) = (a * cos - c * sin, b * sin + d * cos);
    transform["rotation"] = json!(angle);
    transform["scale"] = json!([number(sx), number(sy)]);
    let off = (a * b + c * d).abs() > 1e-5 * (a * a + c * c).sqrt() * (b * b + d * d).sqrt();
    Some((transform, !off))
}
