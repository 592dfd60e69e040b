//! diffuse, principled, null.

use antumbra::bsdf::Facets;
use antumbra::scene::{Alpha, Channel, Material, Roughness, Surface};
use antumbra_math::Rgb;

use super::super::Reader;
use super::super::document::Element;
use super::one_sided;
use crate::error::ReadError;

/// ρ/π.
pub(super) fn diffuse<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let material = Material::diffuse(Rgb::WHITE);
    Ok(one_sided(reader.painted(material, element, "reflectance", 0.5)?))
}

/// Not there at all: rays pass.
pub(super) fn null<'a>(_: &mut Reader<'a>, _: &'a Element) -> Result<Material, ReadError> {
    Ok(Material { alpha: Alpha::Blend, opacity: 0.0, ..Material::diffuse(Rgb::BLACK) })
}

/// The base of Disney's material as metallic-roughness, or as glass where it lets most light through.
pub(super) fn principled<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let (metallic, metal) = reader.measured(element, "metallic", 0.0)?;
    let (roughness, rough) = reader.measured(element, "roughness", 0.5)?;
    let channel = |texture| Channel { texture, component: 0 };
    let rough = rough.map(|texture| Roughness::new(channel(texture), true));
    let through = reader.scalar(element, "spec_trans", 0.0)?;
    let specular = reader.scalar(element, "specular", 0.5)? as f32;
    let eta = element.number("eta")?.map(|eta| eta as f32);
    for name in ["anisotropic", "spec_tint", "sheen", "sheen_tint", "clearcoat", "flatness"] {
        if reader.scalar(element, name, 0.0)? != 0.0 {
            let what = format!("\"{name}\" of {} is left out: drawn as its base", element.words());
            reader.said.warn(element.at.words(), what);
        }
    }
    element.property("clearcoat_gloss");
    if through > 0.5 && metallic < 0.5 && metal.is_none() {
        let alpha = roughness * roughness;
        // Mitsuba's specular is that of an interface: η = 2/(1 − √(0.08 specular)) − 1.
        let eta = eta.unwrap_or_else(|| 2.0 / (1.0 - (0.08 * specular.clamp(0.0, 1.0)).sqrt()) - 1.0);
        let facets = (alpha > 1e-3).then(|| Facets::isotropic(alpha));
        let glass = Material { roughness: rough, ..Material::dielectric(eta, facets) };
        return reader.painted(glass, element, "base_color", 0.5);
    }
    if through > 0.0 {
        let what = format!("\"spec_trans\" of {} is left out: drawn opaque", element.words());
        reader.said.warn(element.at.words(), what);
    }
    let f0 = match eta {
        Some(eta) => ((eta - 1.0) / (eta + 1.0)) * ((eta - 1.0) / (eta + 1.0)),
        None => 0.08 * specular,
    };
    let surface = Surface::MetallicRoughness { base: Rgb::WHITE, metallic, roughness, f0 };
    let metallic = metal.map(channel);
    let material = Material { surface, metallic, roughness: rough, ..Material::diffuse(Rgb::BLACK) };
    Ok(one_sided(reader.painted(material, element, "base_color", 0.5)?))
}
