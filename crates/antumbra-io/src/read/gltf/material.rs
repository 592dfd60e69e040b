//! Materials: metallic-roughness with its textures, emission, alpha; one warning for each look that is left out.

use std::collections::HashMap;

use antumbra::scene::{Alpha, Emission, Material, MaterialId, Surface};
use antumbra_math::Rgb;
use serde::Deserialize;

use super::Reader;
use super::document::{GltfMaterial, TextureInfo};
use super::texture::Images;

/// What was converted already.
#[derive(Default)]
pub(super) struct Materials {
    done: HashMap<Option<usize>, MaterialId>,
    pub images: Images,
}

/// KHR_materials_pbrSpecularGlossiness.
#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct SpecularGlossiness {
    diffuse_factor: [f32; 4],
    diffuse_texture: Option<TextureInfo>,
}

impl Default for SpecularGlossiness {
    fn default() -> SpecularGlossiness {
        SpecularGlossiness { diffuse_factor: [1.0; 4], diffuse_texture: None }
    }
}

const GLOSSINESS: &str = "KHR_materials_pbrSpecularGlossiness";

impl Reader<'_> {
    /// The material of a primitive, converted at its first use; the default one if it names none.
    pub(super) fn material(&mut self, index: Option<usize>) -> MaterialId {
        let index = index.filter(|i| {
            let there = *i < self.doc.materials.len();
            if !there {
                let text = format!("is named; there are {}: drawn as plain", self.doc.materials.len());
                self.said.warn(format!("material {i}"), text);
            }
            there
        });
        if let Some(id) = self.materials.done.get(&index) {
            return *id;
        }
        let doc = self.doc;
        let material = match index {
            Some(i) => self.convert(i, &doc.materials[i]),
            None => self.convert(0, &GltfMaterial::default()),
        };
        let id = self.scene.material(material);
        self.materials.done.insert(index, id);
        id
    }

    fn convert(&mut self, index: usize, m: &GltfMaterial) -> Material {
        let place = format!("material {}", named(index, &m.name));
        self.name_the_missing(m, &place);
        let base = match m.extensions.get(GLOSSINESS).map(SpecularGlossiness::deserialize) {
            Some(Ok(glossy)) => self.diffuse_part(&glossy),
            Some(Err(e)) => {
                self.said.warn(place.clone(), format!("{GLOSSINESS} is broken ({e}): drawn without it"));
                self.metallic_roughness(m)
            }
            None => self.metallic_roughness(m),
        };
        let alpha = match m.alpha_mode.as_str() {
            "MASK" => Alpha::Mask { cutoff: m.alpha_cutoff },
            "BLEND" => Alpha::Blend,
            _ => Alpha::Opaque,
        };
        Material { name: m.name.clone(), emission: self.emission(m, &place), alpha, ..base }
    }

    fn metallic_roughness(&mut self, m: &GltfMaterial) -> Material {
        let pbr = &m.pbr_metallic_roughness;
        let [r, g, b, a] = pbr.base_color_factor;
        let base = Rgb::new(r, g, b);
        let color = pbr.base_color_texture.as_ref().and_then(|t| self.texture(t, true));
        let mr = pbr.metallic_roughness_texture.as_ref().and_then(|t| self.texture(t, false));
        let surface = Material::metallic_roughness(base, pbr.metallic_factor, pbr.roughness_factor);
        Material { color, metallic_roughness: mr, opacity: a, ..surface }
    }

    fn diffuse_part(&mut self, glossy: &SpecularGlossiness) -> Material {
        let [r, g, b, a] = glossy.diffuse_factor;
        let color = glossy.diffuse_texture.as_ref().and_then(|t| self.texture(t, true));
        let surface = Surface::Diffuse { albedo: Rgb::new(r, g, b) };
        Material { surface, color, opacity: a, ..Material::diffuse(Rgb::BLACK) }
    }

    /// emissiveFactor × strength; a texture on it counts by its mean colour.
    fn emission(&mut self, m: &GltfMaterial, place: &str) -> Option<Emission> {
        let strength = m.extensions.get("KHR_materials_emissive_strength");
        let strength = strength.and_then(|e| e.get("emissiveStrength")?.as_f64()).unwrap_or(1.0) as f32;
        let mut radiance = Rgb(m.emissive_factor) * strength;
        if radiance.is_black() {
            return None;
        }
        if let Some(info) = &m.emissive_texture
            && let Some(image) = self.image_of(info, true)
        {
            radiance *= image.mean();
            let text = "its emissiveTexture is not read texel by texel: it emits the mean colour evenly";
            self.said.warn(place, text);
        }
        if !radiance.is_finite() || radiance.0.iter().any(|c| *c < 0.0) {
            self.said.warn(place, "its emission is negative or not finite: left out");
            return None;
        }
        (!radiance.is_black()).then_some(Emission { radiance, both_sides: m.double_sided })
    }

    /// Looks that antumbra does not have, one warning each with the number of materials that ask for them.
    fn name_the_missing(&mut self, m: &GltfMaterial, place: &str) {
        for name in m.extensions.keys() {
            let how = match name.as_str() {
                "KHR_materials_emissive_strength" | "KHR_materials_variants" => continue,
                GLOSSINESS => "drawn with its diffuse part only",
                "KHR_materials_unlit" => "drawn as lit",
                "KHR_materials_transmission" | "KHR_materials_volume" => "drawn opaque",
                _ => "drawn without it",
            };
            self.said.warn(place, format!("asks for {name}, which antumbra does not have: {how}"));
        }
        if m.normal_texture.is_some() {
            self.said.warn(place, "asks for a normalTexture, which antumbra does not have: drawn without it");
        }
    }
}

/// `"name"`, or its number if it has none.
pub(super) fn named(index: usize, name: &str) -> String {
    if name.is_empty() { index.to_string() } else { format!("\"{name}\"") }
}
