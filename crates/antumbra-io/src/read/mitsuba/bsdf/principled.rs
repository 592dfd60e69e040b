//! principled: Disney's material as what the core has of it.
//!
//! Mitsuba adds (1−m)(1−t) of a diffuse base under an interface, m of metal and (1−m)t of glass (m metallic, t spec_trans):
//! a blend of metallic-roughness and glass of the weight w = (1−m)t, whose metallic is m/(1−w).

use antumbra::bsdf::Facets;
use antumbra::scene::{Channel, Material, Roughness, Surface, TextureId};
use antumbra_math::Rgb;

use super::super::Reader;
use super::super::document::Element;
use super::super::texture::Paint;
use super::one_sided;
use crate::error::ReadError;

/// What no part of the material follows.
const LEFT_OUT: [&str; 6] = ["anisotropic", "spec_tint", "sheen", "sheen_tint", "clearcoat", "flatness"];

/// Numbers and textures of numbers that both parts share.
struct Numbers {
    roughness: f32,
    rough: Option<Roughness>,
    /// Of the interface, over the index around it.
    eta: f32,
    /// What the interface reflects straight on.
    f0: f32,
}

/// Its base as metallic-roughness, its glass as glass, or a blend of both.
pub(super) fn principled<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<Material, ReadError> {
    let (metallic, metal) = reader.measured(element, "metallic", 0.0)?;
    let (roughness, rough) = reader.measured(element, "roughness", 0.5)?;
    let (through, glassy) = reader.measured(element, "spec_trans", 0.0)?;
    let specular = reader.scalar(element, "specular", 0.5)?.clamp(0.0, 1.0) as f32;
    // Mitsuba's specular is that of an interface: ((η−1)/(η+1))² = 0.08 specular.
    let root = (0.08 * specular).sqrt();
    let (eta, f0) = match element.number("eta")?.map(|eta| eta as f32) {
        Some(eta) => (eta, ((eta - 1.0) / (eta + 1.0)) * ((eta - 1.0) / (eta + 1.0))),
        None => ((1.0 + root) / (1.0 - root), 0.08 * specular),
    };
    if !(0.1..=10.0).contains(&eta) {
        let what = format!("\"eta\" = {eta}: an index of refraction from 0.1 to 10 is needed");
        return Err(element.at.error(what));
    }
    left_out(reader, element)?;
    let rough = rough.map(|texture| Roughness::new(channel(texture), true));
    let numbers = Numbers { roughness, rough, eta, f0 };
    let mean = metal.map_or(metallic, |id| metallic * reader.scene.textures[id as usize].image.mean().0[0]);
    let weight = (1.0 - mean.clamp(0.0, 1.0)) * through.clamp(0.0, 1.0);
    if weight <= 0.0 {
        return base(reader, element, &numbers, (metallic, metal));
    }
    if metal.is_some() || (glassy.is_some() && metallic > 0.0) {
        let what = format!(
            "a picture says where {} is metal or glass: both are mixed by its mean, not place by place",
            element.words()
        );
        reader.said.warn(element.at.words(), what);
    }
    let glass = glass(reader, element, &numbers)?;
    if weight >= 1.0 && glassy.is_none() {
        return Ok(glass);
    }
    let metallic = if glassy.is_some() { metallic } else { (metallic / (1.0 - weight)).min(1.0) };
    let base = base(reader, element, &numbers, (metallic, metal))?;
    let [first, second] = [base, glass].map(|part| reader.scene.material(part));
    Ok(Material { blend: glassy, ..Material::blend(first, second, weight) })
}

fn channel(texture: TextureId) -> Channel {
    Channel { texture, component: 0 }
}

/// Names in one warning what is given and not followed.
fn left_out<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<(), ReadError> {
    let mut given = Vec::new();
    for name in LEFT_OUT {
        if reader.scalar(element, name, 0.0)? != 0.0 {
            given.push(format!("\"{name}\""));
        }
    }
    // It says how wide a coat shines that is left out.
    element.property("clearcoat_gloss");
    // How Mitsuba chooses its samples.
    element.pass_over(&[
        "diffuse_reflectance_sampling_rate",
        "main_specular_sampling_rate",
        "clearcoat_sampling_rate",
    ]);
    if !given.is_empty() {
        let what = format!("{} of {} left out: drawn without", given.join(", "), element.words());
        reader.said.warn(element.at.words(), what);
    }
    Ok(())
}

/// Metal, and a diffuse base under an interface.
fn base<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    numbers: &Numbers,
    (metallic, metal): (f32, Option<TextureId>),
) -> Result<Material, ReadError> {
    let Numbers { roughness, f0, .. } = *numbers;
    let surface = Surface::MetallicRoughness { base: Rgb::WHITE, metallic, roughness, f0 };
    let (metallic, roughness) = (metal.map(channel), numbers.rough.clone());
    let material = Material { surface, metallic, roughness, ..Material::diffuse(Rgb::BLACK) };
    Ok(one_sided(reader.painted(material, element, "base_color", 0.5)?))
}

/// Glass that lets √base_color through at each of its sides.
fn glass<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    numbers: &Numbers,
) -> Result<Material, ReadError> {
    let alpha = numbers.roughness * numbers.roughness;
    let facets = (alpha > 1e-3).then(|| Facets::isotropic(alpha));
    let roughness = numbers.rough.clone();
    let mut glass = Material { roughness, ..Material::dielectric(numbers.eta, facets) };
    match reader.paint(element, "base_color", 0.5)? {
        Paint::Plain(color) => glass.surface.tint(color.map(|c| c.max(0.0).sqrt())),
        Paint::Texture(texture) => {
            let what = format!(
                "\"base_color\" of {} is a picture: light takes its colour at both sides of the glass",
                element.words()
            );
            reader.said.warn(element.at.words(), what);
            glass.color = Some(texture);
        }
    }
    Ok(glass)
}
