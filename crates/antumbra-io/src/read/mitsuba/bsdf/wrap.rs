//! What wraps another bsdf: twosided (one look for both sides, or one for each), mask, normalmap, bumpmap.

use antumbra::scene::{Alpha, BumpMap, Material, NormalMap};

use super::super::Reader;
use super::super::document::Element;
use super::super::texture::{Paint, number};
use crate::error::ReadError;

/// The same look from both sides, or a second one from behind.
pub(super) fn twosided<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let material = reader.inner(element)?;
    let both = |material| Material { one_sided: false, ..material };
    let material = reader.each_part(material, &both);
    match reader.plugins(element, "bsdf")?[..] {
        [_, back] => {
            let front = reader.bsdfs.attribute.take();
            let back = reader.convert(back)?;
            let back = reader.each_part(back, &both);
            let behind = reader.bsdfs.attribute.take();
            reader.color_both(element, [front, behind]);
            Ok(Material { back: Some(reader.scene.material(back)), ..material })
        }
        [_, _, third, ..] => Err(third.at.error(format!("{} has more than two bsdfs", element.words()))),
        _ => Ok(material),
    }
}

/// Lets a part of the rays pass.
pub(super) fn mask<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let material = reader.inner(element)?;
    let material = Material { alpha: Alpha::Blend, ..material };
    match reader.paint(element, "opacity", 0.5)? {
        Paint::Plain(opacity) => Ok(Material { opacity: number(opacity), ..material }),
        Paint::Texture(opacity) => {
            Ok(Material { cover: Some(reader.luminance(opacity)), opacity: 1.0, ..material })
        }
    }
}

/// How Mitsuba treats bent normals that point below the surface and light that grazes it; antumbra has one way.
const BELOW: [&str; 2] = ["flip_invalid_normals", "use_shadowing_function"];

/// Bends the shading normal by a picture of normals.
pub(super) fn normalmap<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let material = reader.inner(element)?;
    element.pass_over(&BELOW);
    match reader.paint(element, "normalmap", 0.0)? {
        Paint::Texture(texture) => {
            let normal = Some(NormalMap { texture, scale: 1.0 });
            Ok(reader.each_part(material, &|part| Material { normal, ..part }))
        }
        Paint::Plain(_) => Ok(material),
    }
}

/// Bends the shading normal by heights.
pub(super) fn bumpmap<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let material = reader.inner(element)?;
    element.pass_over(&BELOW);
    let scale = element.float("scale", 1.0)? as f32;
    let found = reader.plugins(element, "texture")?;
    let Some(heights) = found.first() else {
        return Err(element.at.error(format!("{} needs a texture of heights in it", element.words())));
    };
    let Some(texture) = reader.texture(heights)? else { return Ok(material) };
    let texture = reader.luminance(texture);
    let bump = Some(BumpMap { texture, scale });
    Ok(reader.each_part(material, &|part| Material { bump, ..part }))
}
