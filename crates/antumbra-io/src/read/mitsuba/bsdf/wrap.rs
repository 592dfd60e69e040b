//! What wraps another bsdf: twosided (one look for both sides, or one for each), mask, normalmap, bumpmap.

use std::sync::Arc;

use antumbra::scene::{Alpha, Material, NormalMap, TextureId};
use antumbra::texture::{Image, Texels, Texture};

use super::super::Reader;
use super::super::document::Element;
use super::super::texture::Paint;
use crate::error::ReadError;

/// The same look from both sides, or a second one from behind.
pub(super) fn twosided<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let material = reader.inner(element)?;
    let both = |material| Material { one_sided: false, ..material };
    let material = reader.each_part(material, &both);
    match reader.plugins(element, "bsdf")?[..] {
        [_, back] => {
            let back = reader.convert(back)?;
            let back = reader.each_part(back, &both);
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
        Paint::Plain(opacity) => Ok(Material { opacity: opacity.mean(), ..material }),
        Paint::Texture(opacity) => {
            let color = with_alpha(reader, material.color, opacity);
            Ok(Material { color: Some(color), opacity: 1.0, ..material })
        }
    }
}

/// The colours of one texture with the brightness of another as alpha, on the finer of their grids.
fn with_alpha(reader: &mut Reader, color: Option<TextureId>, opacity: TextureId) -> TextureId {
    let textures = &reader.scene.textures;
    let opacity = textures[opacity as usize].clone();
    let color = color.map(|id| textures[id as usize].clone());
    let finer = match &color {
        Some(c) if c.image.width >= opacity.image.width => c,
        _ => &opacity,
    };
    let (width, height) = (finer.image.width, finer.image.height);
    // Both are looked up where the finer one has its texels; the coarser one's own wrapping and map are not undone.
    let plain = |t: &Texture| Texture { map: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0], ..t.clone() };
    let (c, o) = (color.as_ref().map(plain), plain(&opacity));
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for y in 0..height {
        for x in 0..width {
            let uv = [(x as f32 + 0.5) / width as f32, (y as f32 + 0.5) / height as f32];
            let [r, g, b, _] = c.as_ref().map_or([1.0; 4], |c| c.at(uv));
            let [or, og, ob, _] = o.at(uv);
            texels.push([r, g, b, (or + og + ob) / 3.0].map(|t| (t * 255.0 + 0.5) as u8));
        }
    }
    let image = Image::new(width, height, Texels::Linear8(texels));
    let image = image.map_or_else(|| Arc::clone(&opacity.image), Arc::new);
    let base = Texture { image, ..finer.clone() };
    reader.scene.texture(base)
}

/// Bends the shading normal by a picture of normals.
pub(super) fn normalmap<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let material = reader.inner(element)?;
    // How Mitsuba treats normals that point below the surface; antumbra has one way.
    element.pass_over(&["flip_invalid_normals", "use_shadowing_function"]);
    match reader.paint(element, "normalmap", 0.0)? {
        Paint::Texture(texture) => {
            let normal = Some(NormalMap { texture, scale: 1.0 });
            Ok(reader.each_part(material, &|part| Material { normal, ..part }))
        }
        Paint::Plain(_) => Ok(material),
    }
}

/// Bumps are left out.
pub(super) fn bumpmap<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let material = reader.inner(element)?;
    element.children.iter().for_each(|c| c.used.set(true));
    let what =
        format!("{}: heights are not read (a normal map is): drawn without its bumps", element.words());
    reader.said.warn(element.at.words(), what);
    Ok(material)
}
