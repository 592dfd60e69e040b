//! dielectric, roughdielectric, thindielectric; indices of refraction by name.

use antumbra::scene::Material;

use super::super::Reader;
use super::super::document::Element;
use crate::error::ReadError;
use crate::read::text::show;

/// Indices of refraction that Mitsuba knows by name.
const NAMED: [(&str, f64); 22] = [
    ("vacuum", 1.0),
    ("helium", 1.000036),
    ("hydrogen", 1.000132),
    ("air", 1.000277),
    ("carbon dioxide", 1.00045),
    ("water", 1.333),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.52045),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.47),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.5046),
    ("sodium chloride", 1.544),
    ("pet", 1.575),
    ("diamond", 2.419),
];

/// An index of refraction: a number or a name.
pub(super) fn index(element: &Element, name: &str, default: f64) -> Result<f64, ReadError> {
    let Some(value) = element.property(name) else { return Ok(default) };
    let eta = if value.tag == "string" {
        let word = value.attribute("value");
        let known = NAMED.iter().find(|n| n.0.eq_ignore_ascii_case(word));
        known.map(|n| n.1).ok_or_else(|| {
            let names: Vec<_> = NAMED.iter().map(|n| n.0).collect();
            let what =
                format!("\"{name}\" = {}: no index of refraction has this name", show(word.as_bytes()));
            value.at.error(what).hint(format!("A number, or one of {}.", names.join(", ")))
        })?
    } else {
        element.float(name, default)?
    };
    if (0.1..=10.0).contains(&eta) {
        return Ok(eta);
    }
    Err(value.at.error(format!("\"{name}\" = {eta}: an index of refraction from 0.1 to 10 is needed")))
}

/// n inside over n outside.
pub(super) fn relative(element: &Element, inside: f64) -> Result<f32, ReadError> {
    Ok((index(element, "int_ior", inside)? / index(element, "ext_ior", 1.000277)?) as f32)
}

/// Glass BK7 in air unless the file says otherwise.
const GLASS: f64 = 1.5046;

/// Clear glass.
pub(super) fn dielectric<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    colored(reader, element, Material::dielectric(relative(element, GLASS)?, None))
}

/// Ground glass.
pub(super) fn roughdielectric<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
) -> Result<Material, ReadError> {
    let (facets, roughness) = reader.facets(element)?;
    let glass = Material::dielectric(relative(element, GLASS)?, Some(facets));
    colored(reader, element, Material { roughness, ..glass })
}

/// A pane.
pub(super) fn thindielectric<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
) -> Result<Material, ReadError> {
    colored(reader, element, Material::thin_dielectric(relative(element, GLASS)?, None))
}

/// With its factors of what is reflected and what is let through.
fn colored<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    glass: Material,
) -> Result<Material, ReadError> {
    let glass = reader.glossy(glass, element)?;
    reader.painted(glass, element, "specular_transmittance", 1.0)
}
