//! Looks: each bsdf plugin as a material.

mod blend;
mod dielectric;
mod metal;
mod opaque;
mod plastic;
mod principled;
mod wrap;

use std::collections::HashMap;

use antumbra::bsdf::Facets;
use antumbra::scene::{Channel, Material, MaterialId, Roughness, TextureId};
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
    ("principled", principled::principled),
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
/// Bytes that a material takes in memory, about.
const MATERIAL_BYTES: u64 = 512;

/// What was converted already.
#[derive(Default)]
pub(super) struct Known {
    done: HashMap<*const Element, MaterialId>,
    depth: u32,
    /// The attribute of the mesh that a material shows.
    attributes: HashMap<MaterialId, String>,
    /// That of the material which is being converted.
    attribute: Option<String>,
}

impl Known {
    /// The attribute of the mesh that a material shows as its colour.
    pub(super) fn attribute(&self, id: MaterialId) -> Option<String> {
        self.attributes.get(&id).cloned()
    }
}

impl<'a> Reader<'a> {
    /// The material of a bsdf, converted at its first use.
    pub(super) fn bsdf(&mut self, element: &'a Element) -> Result<MaterialId, ReadError> {
        if let Some(id) = self.bsdfs.done.get(&std::ptr::from_ref(element)) {
            return Ok(*id);
        }
        // A bsdf in another one has colours of its own.
        let outer = self.bsdfs.attribute.take();
        let material = self.convert(element)?.named(element.attribute("id"));
        let id = self.scene.material(material);
        if let Some(own) = std::mem::replace(&mut self.bsdfs.attribute, outer) {
            self.bsdfs.attributes.insert(id, own);
        }
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
        self.context.take(1, MATERIAL_BYTES).map_err(|what| element.at.error(what))?;
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
        if let Some(texture) = self.mesh_attribute(element, name)? {
            let scale = texture.float("scale", 1.0)? as f32;
            let attribute = texture.string("name")?;
            let attribute = attribute.ok_or_else(|| texture.at.error("a mesh_attribute has no \"name\""))?;
            self.bsdfs.attribute = Some(attribute.into());
            material.surface.tint(Rgb::grey(scale));
            self.name_the_unread(texture);
            return Ok(material);
        }
        match self.paint(element, name, default)? {
            Paint::Plain(color) => material.surface.tint(color),
            Paint::Texture(texture) => {
                material.surface.tint(Rgb::WHITE);
                material.color = Some(texture);
            }
        }
        Ok(material)
    }

    /// The texture on a property, if it is what varies over a mesh itself.
    fn mesh_attribute(&self, element: &'a Element, name: &str) -> Result<Option<&'a Element>, ReadError> {
        let value = element.property(name).map(|value| self.resolved(value)).transpose()?;
        Ok(value.filter(|value| value.plugin() == "mesh_attribute"))
    }

    /// Facets of the width α, or of two, Beckmann's unless the file says otherwise; and the texture of α, if one says it.
    fn facets(&mut self, element: &'a Element) -> Result<(Facets, Option<Roughness>), ReadError> {
        let ggx = element.choice("distribution", &["beckmann", "ggx"])? == "ggx";
        element.property("sample_visible");
        let (both, mut texture) = self.measured(element, "alpha", 0.1)?;
        let (mut u, mut v) = (both, both);
        if element.has("alpha_u") || element.has("alpha_v") {
            (u, texture) = self.measured(element, "alpha_u", both.into())?;
            let across;
            (v, across) = self.measured(element, "alpha_v", both.into())?;
            if texture != across {
                let what = format!("a texture on one width of {}: it counts by its mean", element.words());
                self.said.warn(element.at.words(), what);
                let mean = |width: f32, id: Option<TextureId>| match id {
                    Some(id) => self.scene.textures[id as usize].image.mean().0[0],
                    None => width,
                };
                (u, v, texture) = (mean(u, texture), mean(v, across), None);
            }
        }
        let facets = if ggx { Facets::new(u, v) } else { Facets::beckmann(u, v) };
        let channel = texture.map(|texture| Channel { texture, component: 0 });
        Ok((facets, channel.map(|channel| Roughness::new(channel, false))))
    }

    /// `material` with the factor of what it reflects beside its colour, `specular_reflectance`.
    fn glossy(&mut self, material: Material, element: &'a Element) -> Result<Material, ReadError> {
        let mut material = material;
        match self.paint(element, "specular_reflectance", 1.0)? {
            Paint::Plain(factor) => {
                material.surface.set_gloss(factor);
            }
            Paint::Texture(texture) => material.gloss = Some(texture),
        }
        Ok(material)
    }
}

/// Black from behind, as Mitsuba's opaque bsdfs are outside of `twosided`.
fn one_sided(material: Material) -> Material {
    Material { one_sided: true, ..material }
}
