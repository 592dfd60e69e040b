//! conductor, roughconductor.

use antumbra::bsdf::Metal;
use antumbra::scene::Material;
use antumbra_math::Rgb;

use super::super::Reader;
use super::super::document::Element;
use super::one_sided;
use crate::error::ReadError;
use crate::read::text::show;

/// Polished metal.
pub(super) fn conductor<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let material = match metal(reader, element)? {
        Some(metal) => Material::conductor(metal, None),
        None => Material::mirror(Rgb::WHITE),
    };
    Ok(one_sided(reader.painted(material, element, "specular_reflectance", 1.0)?))
}

/// Rough metal.
pub(super) fn roughconductor<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
) -> Result<Material, ReadError> {
    let (facets, roughness) = reader.facets(element)?;
    // A metal that reflects all light: η = 0 has no direction of its own.
    let perfect = Metal { eta: Rgb::grey(1e-6), k: Rgb::WHITE };
    let metal = metal(reader, element)?.unwrap_or(perfect);
    let material = Material { roughness, ..Material::conductor(metal, Some(facets)) };
    Ok(one_sided(reader.painted(material, element, "specular_reflectance", 1.0)?))
}

/// The metal by its name, or by η and k; `None`: everything is reflected.
fn metal<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Option<Metal>, ReadError> {
    if element.has("eta") || element.has("k") {
        let (eta, k) = (reader.color(element, "eta", 0.0)?, reader.color(element, "k", 1.0)?);
        let outside = super::dielectric::index(element, "ext_eta", 1.0)? as f32;
        let metal = Metal { eta: eta * (1.0 / outside), k: k * (1.0 / outside) };
        if eta.is_black() {
            return Ok(None);
        }
        return match metal.is_possible() {
            true => Ok(Some(metal)),
            false => Err(element.at.error("a metal's eta must be above 0 and its k not below")),
        };
    }
    match element.string("material")?.unwrap_or("none") {
        "none" => Ok(None),
        name => {
            let known = Metal::named(name.split('_').next().unwrap_or(name));
            if known.is_none() {
                let names: Vec<_> = Metal::names().collect();
                let what = format!(
                    "the metal {} is not known ({}): drawn as chromium",
                    show(name.as_bytes()),
                    names.join(", ")
                );
                reader.said.warn(element.at.words(), what);
            }
            Ok(known.or_else(|| Metal::named("Cr")))
        }
    }
}
