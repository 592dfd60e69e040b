//! plastic, roughplastic.

use antumbra::scene::{Material, Surface};
use antumbra_math::Rgb;

use super::super::Reader;
use super::super::document::Element;
use super::dielectric::relative;
use super::one_sided;
use crate::error::ReadError;

/// Polypropylene.
const COAT: f64 = 1.49;

/// Polished plastic.
pub(super) fn plastic<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let nonlinear = element.boolean("nonlinear", false)?;
    let material = Material::plastic(Rgb::WHITE, relative(element, COAT)?, None, nonlinear);
    let material = reader.glossy(material, element)?;
    Ok(one_sided(reader.painted(material, element, "diffuse_reflectance", 0.5)?))
}

/// Rough plastic, which loses light between its facets as Mitsuba's does.
pub(super) fn roughplastic<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let (facets, roughness) = reader.facets(element)?;
    let nonlinear = element.boolean("nonlinear", false)?;
    let material = Material::plastic(Rgb::WHITE, relative(element, COAT)?, Some(facets), nonlinear);
    let mut material = Material { roughness, ..reader.glossy(material, element)? };
    if let Surface::RoughPlastic { coat, .. } = &mut material.surface {
        *coat = coat.losing();
    }
    Ok(one_sided(reader.painted(material, element, "diffuse_reflectance", 0.5)?))
}
