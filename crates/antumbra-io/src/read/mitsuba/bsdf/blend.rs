//! blendbsdf, and what wraps a blend.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra::scene::{Alpha, Material, MaterialId, Surface, TextureId};
use antumbra::texture::{Image, Texels, Texture};
use antumbra_math::Rgb;

use super::super::Reader;
use super::super::document::Element;
use super::super::texture::Paint;
use crate::error::ReadError;

/// (1 − weight) of the first bsdf, weight of the second.
pub(super) fn blendbsdf<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let [first, second] = reader.plugins(element, "bsdf")?[..] else {
        return Err(element.at.error(format!("{} needs two bsdfs in it", element.words())));
    };
    let (first, second) = (reader.bsdf(first)?, reader.bsdf(second)?);
    let open = [first, second].map(|id| opacity(&reader.scene.materials[id as usize]));
    let weight = reader.paint(element, "weight", 0.5)?;
    match (weight, open) {
        (Paint::Plain(weight), [Some(a), Some(b)]) => Ok(covering(first, second, number(weight), [a, b])),
        (weight, open) => {
            if open != [Some(1.0); 2] {
                let what = format!("a mask in {} is not read: drawn without holes", element.words());
                reader.said.warn(element.at.words(), what);
            }
            Ok(match weight {
                Paint::Plain(weight) => Material::blend(first, second, number(weight)),
                Paint::Texture(weight) => {
                    let blend = Some(luminance(reader, weight));
                    Material { blend, ..Material::blend(first, second, 1.0) }
                }
            })
        }
    }
}

/// A blend whose parts cover the shares a and b: rays that meet it meet the second in w·b of all cases, out of
/// (1 − w)·a + w·b.
fn covering(first: MaterialId, second: MaterialId, weight: f32, [a, b]: [f32; 2]) -> Material {
    let covered = (1.0 - weight) * a + weight * b;
    if covered == 1.0 || (a, b) == (1.0, 1.0) {
        return Material::blend(first, second, weight);
    }
    let weight = if covered > 0.0 { weight * b / covered } else { 0.0 };
    Material { alpha: Alpha::Blend, opacity: covered, ..Material::blend(first, second, weight) }
}

/// The share of rays that a material stops; `None` where a texture says.
fn opacity(material: &Material) -> Option<f32> {
    match material.alpha {
        Alpha::Opaque => Some(1.0),
        _ => material.color.is_none().then_some(material.opacity),
    }
}

/// A texture whose red is the luminance of another: what Mitsuba takes for a number.
fn luminance(reader: &mut Reader, of: TextureId) -> TextureId {
    let texture = reader.scene.textures[of as usize].clone();
    let image = &texture.image;
    let (width, height) = (image.width, image.height);
    let texels = || (0..height).flat_map(|y| (0..width).map(move |x| image.texel(x, y)));
    let greys = || texels().map(|[r, g, b, _]| number(Rgb([r, g, b])));
    if greys().zip(texels()).all(|(grey, texel)| grey == texel[0]) {
        return of;
    }
    if reader.context.textures.take(u64::from(width) * u64::from(height), 12).is_err() {
        let what = "the pictures of the scene are too large together: the red of a weight counts";
        reader.said.warn("", what);
        return of;
    }
    match Image::new(width, height, Texels::Float(greys().map(|grey| [grey; 3]).collect())) {
        Some(image) => reader.scene.texture(Texture { image: Arc::new(image), ..texture }),
        None => of,
    }
}

/// A colour as one number: its luminance; a grey stays what it is, to the last bit.
fn number(Rgb([r, g, b]): Rgb) -> f32 {
    if r == g && g == b { r } else { Rgb([r, g, b]).luminance() }
}

impl Reader<'_> {
    /// `material` changed: of a blend, copies of all that it blends, and of its back.
    pub(super) fn each_part(
        &mut self,
        material: Material,
        change: &dyn Fn(Material) -> Material,
    ) -> Material {
        self.changed(material, change, &mut HashMap::new())
    }

    fn changed(
        &mut self,
        mut material: Material,
        change: &dyn Fn(Material) -> Material,
        done: &mut HashMap<MaterialId, MaterialId>,
    ) -> Material {
        let mut parts: Vec<&mut MaterialId> = material.back.iter_mut().collect();
        if let Surface::Blend { first, second, .. } = &mut material.surface {
            parts.extend([first, second]);
        }
        for part in parts {
            *part = match done.get(part) {
                Some(copy) => *copy,
                None => {
                    let copy = self.scene.materials[*part as usize].clone();
                    let copy = self.changed(copy, change, done);
                    let id = self.scene.material(copy);
                    done.insert(*part, id);
                    id
                }
            };
        }
        change(material)
    }
}
