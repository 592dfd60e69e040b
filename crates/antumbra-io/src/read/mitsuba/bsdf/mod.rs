//! Looks: each bsdf plugin as a material.

mod blend;
mod dielectric;
mod metal;
mod opaque;
mod plastic;
mod wrap;

use std::collections::HashMap;

use antumbra::bsdf::Facets;
use antumbra::scene::{Material, MaterialId, Surface};
use antumbra_math::Rgb;

use super::Reader;
use super::document::Element;
use super::texture::Paint;
use crate::error::ReadError;
use crate::read::GREY;

/// Makes the material of a bsdf.
type Make = for<'a> fn(&mut Reader<'a>, &'a Element) -> Result<Material, ReadError>;

/// Every bsdf plugin that is read. To add one: a function and a line here.
const BSDFS: [(&str, Make); 15] = [
    ("diffuse", opaque::diffuse),
    ("principled", opaque::principled),
    ("null", opaque::null),
    ("conductor", metal::conductor),
    ("roughconductor", metal::roughconductor),
    ("dielectric", dielectric::dielectric),
    ("roughdielectric", dielectric::roughdielectric),
    ("thindielectric", dielectric::thindielectric),
    ("plastic", plastic::plastic),
    ("roughplastic", plastic::roughplastic),
    ("twosided", wrap::twosided),
    ("mask", wrap::mask),
    ("blendbsdf", blend::blendbsdf),
    ("normalmap", wrap::normalmap),
    ("bumpmap", wrap::bumpmap),
];

/// Bsdfs within bsdfs.
const DEEPEST: u32 = 16;

/// What was converted already.
#[derive(Default)]
pub(super) struct Known {
    done: HashMap<*const Element, MaterialId>,
    depth: u32,
}

impl<'a> Reader<'a> {
    /// The material of a bsdf, converted at its first use.
    pub(super) fn bsdf(&mut self, element: &'a Element) -> Result<MaterialId, ReadError> {
        if let Some(id) = self.bsdfs.done.get(&std::ptr::from_ref(element)) {
            return Ok(*id);
        }
        let material = self.convert(element)?.named(element.attribute("id"));
        let id = self.scene.material(material);
        self.bsdfs.done.insert(std::ptr::from_ref(element), id);
        Ok(id)
    }

    fn convert(&mut self, element: &'a Element) -> Result<Material, ReadError> {
        if self.bsdfs.depth >= DEEPEST {
            let what = format!("bsdfs lie more than {DEEPEST} deep in each other, or in themselves");
            return Err(element.at.error(what));
        }
        let Some((_, make)) = BSDFS.iter().find(|b| b.0 == element.plugin()) else {
            self.lacks(element, "drawn grey");
            return Ok(Material::diffuse(Rgb::grey(GREY)));
        };
        self.bsdfs.depth += 1;
        let material = make(self, element)?;
        self.bsdfs.depth -= 1;
        self.name_the_unread(element);
        Ok(material)
    }

    /// The one bsdf that stands in a wrapper.
    fn inner(&mut self, element: &'a Element) -> Result<Material, ReadError> {
        match self.plugins(element, "bsdf")?.first() {
            Some(first) => self.convert(first),
            None => Err(element.at.error(format!("{} needs a bsdf in it", element.words()))),
        }
    }

    /// `material`, its colour from the property `name`.
    fn painted(
        &mut self,
        material: Material,
        element: &'a Element,
        name: &str,
        default: f32,
    ) -> Result<Material, ReadError> {
        let mut material = material;
        match self.paint(element, name, default)? {
            Paint::Plain(color) => material.surface.tint(color),
            Paint::Texture(texture) => {
                material.surface.tint(Rgb::WHITE);
                material.color = Some(texture);
            }
        }
        Ok(material)
    }

    /// Facets of the width α, or of two: Beckmann's unless the file says otherwise.
    fn facets(&mut self, element: &'a Element) -> Result<Facets, ReadError> {
        let ggx = element.choice("distribution", &["beckmann", "ggx"])? == "ggx";
        element.property("sample_visible");
        let both = self.scalar(element, "alpha", 0.1)?;
        let (u, v) = (self.scalar(element, "alpha_u", both)?, self.scalar(element, "alpha_v", both)?);
        let (u, v) = (u as f32, v as f32);
        Ok(if ggx { Facets::new(u, v) } else { Facets::beckmann(u, v) })
    }

    /// A factor that Mitsuba lets people put on highlights; antumbra's plastic has none.
    fn plain_highlights(&mut self, element: &'a Element) -> Result<(), ReadError> {
        if self.color(element, "specular_reflectance", 1.0)? != Rgb::WHITE {
            let what = format!("\"specular_reflectance\" of {} is not read: drawn as 1", element.words());
            self.said.warn(element.at.words(), what);
        }
        Ok(())
    }
}

/// The factor of what a glass reflects.
fn reflect(surface: &mut Surface, factor: Rgb) {
    match surface {
        Surface::Dielectric(d) => d.reflectance = factor,
        Surface::ThinDielectric(d) => d.reflectance = factor,
        Surface::RoughDielectric(d) => d.reflectance = factor,
        _ => {}
    }
}

/// Black from behind, as Mitsuba's opaque bsdfs are outside of `twosided`.
fn one_sided(material: Material) -> Material {
    Material { one_sided: true, ..material }
}
