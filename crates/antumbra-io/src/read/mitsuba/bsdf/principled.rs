//! principled: Disney's material.

use antumbra::bsdf::Principled;
use antumbra::scene::{Channel, Material, Roughness};
use antumbra_math::Rgb;

use super::super::Reader;
use super::super::document::Element;
use super::one_sided;
use crate::error::ReadError;

/// How Mitsuba chooses its samples.
const SAMPLING: [&str; 3] =
    ["diffuse_reflectance_sampling_rate", "main_specular_sampling_rate", "clearcoat_sampling_rate"];

/// Its numbers; textures of colour, metallic, roughness and spec_trans place by place, of the others by their mean.
pub(super) fn principled<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let (metallic, metal) = reader.measured(element, "metallic", 0.0)?;
    let (roughness, rough) = reader.measured(element, "roughness", 0.5)?;
    let (spec_trans, through) = reader.measured(element, "spec_trans", 0.0)?;
    let eta = index(reader, element)?;
    let mut number = |name| reader.scalar(element, name, 0.0).map(|x| x as f32);
    let numbers = Principled {
        base: Rgb::WHITE,
        metallic,
        roughness,
        anisotropic: number("anisotropic")?,
        eta,
        spec_trans,
        spec_tint: number("spec_tint")?,
        sheen: number("sheen")?,
        sheen_tint: number("sheen_tint")?,
        clearcoat: number("clearcoat")?,
        clearcoat_gloss: number("clearcoat_gloss")?,
        flatness: number("flatness")?,
        turned: false,
    };
    element.pass_over(&SAMPLING);
    let channel = |texture| Channel { texture, component: 0 };
    let material = Material {
        metallic: metal.map(channel),
        roughness: rough.map(|texture| Roughness::new(channel(texture), true)),
        blend: through,
        ..Material::principled(numbers)
    };
    let material = reader.painted(material, element, "base_color", 0.5)?;
    Ok(if numbers.spec_trans > 0.0 { material } else { one_sided(material) })
}

/// n below over n above: `eta`, or from `specular`, ((η−1)/(η+1))² = 0.08 specular.
fn index<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<f32, ReadError> {
    let specular = reader.scalar(element, "specular", 0.5)?.clamp(0.0, 1.0) as f32;
    let root = (0.08 * specular).sqrt();
    let eta = element.number("eta")?.map_or((1.0 + root) / (1.0 - root), |eta| eta as f32);
    if (0.1..=10.0).contains(&eta) {
        return Ok(eta);
    }
    let what = format!("\"eta\" = {eta}: an index of refraction from 0.1 to 10 is needed");
    Err(element.at.error(what))
}
