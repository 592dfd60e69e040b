//! diffuse, null.

use antumbra::scene::{Alpha, Material};
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
