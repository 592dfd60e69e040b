//! Materials: metallic-roughness with its textures and normal map, glass, unlit, emission, alpha; one warning for each
//! look that is left out.

use std::collections::HashMap;

use antumbra::bsdf::Facets;
use antumbra::scene::{
    Alpha, Channel, Emission, Material, MaterialId, NormalMap, Roughness, Surface, TextureId,
};
use antumbra_math::Rgb;
use serde::Deserialize;

use super::Reader;
use super::clear_coat::CLEARCOAT;
use super::document::{GltfMaterial, TextureInfo};
use super::specular::{GLOSSINESS, SPECULAR};
use super::texture::Images;

/// What was converted already.
#[derive(Default)]
pub(super) struct Materials {
    done: HashMap<Option<usize>, MaterialId>,
    pub images: Images,
}

/// KHR_materials_transmission.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct Transmission {
    transmission_factor: f32,
    transmission_texture: Option<TextureInfo>,
}

/// KHR_materials_ior; 1.5 where it is not given or makes no sense.
fn index_of_refraction(m: &GltfMaterial) -> f32 {
    let given = m.extensions.get("KHR_materials_ior").and_then(|e| e.get("ior")?.as_f64());
    given.filter(|n| (1.0..=10.0).contains(n)).unwrap_or(1.5) as f32
}

const UNLIT: &str = "KHR_materials_unlit";

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
        let base = if m.extensions.contains_key(UNLIT) {
            self.unlit(m)
        } else if let Some(glossy) = self.glossiness(m, &place) {
            self.clear_coat(m, glossy, &place)
        } else {
            self.metallic_roughness(m, &place)
        };
        let alpha = match m.alpha_mode.as_str() {
            "MASK" => Alpha::Mask { cutoff: m.alpha_cutoff },
            "BLEND" => Alpha::Blend,
            _ => Alpha::Opaque,
        };
        let normal = base.normal.or_else(|| self.normal_map(m));
        Material { name: m.name.clone(), emission: self.emission(m, &place), alpha, normal, ..base }
    }

    fn metallic_roughness(&mut self, m: &GltfMaterial, place: &str) -> Material {
        let pbr = &m.pbr_metallic_roughness;
        let [r, g, b, a] = pbr.base_color_factor;
        let base = Rgb::new(r, g, b);
        let color = pbr.base_color_texture.as_ref().and_then(|t| self.texture(t, true));
        let mr = pbr.metallic_roughness_texture.as_ref().and_then(|t| self.texture(t, false));
        let channel = |component| mr.map(|texture| Channel { texture, component });
        let roughness = channel(1).map(|channel| Roughness::new(channel, true));
        let ior = index_of_refraction(m);
        let surface = Surface::MetallicRoughness {
            base,
            metallic: pbr.metallic_factor,
            roughness: pbr.roughness_factor,
            f0: ((ior - 1.0) / (ior + 1.0)) * ((ior - 1.0) / (ior + 1.0)),
        };
        let normal = self.normal_map(m);
        let opaque = Material {
            surface,
            color,
            normal,
            metallic: channel(2),
            roughness: roughness.clone(),
            opacity: a,
            ..Material::diffuse(base)
        };
        let opaque = self.specular(m, opaque, place);
        let opaque = self.clear_coat(m, opaque, place);
        let Some((share, through)) = self.through(m, place) else { return opaque };
        if matches!(opaque.surface, Surface::ClearCoat { .. }) {
            self.said.warn(place, format!("{CLEARCOAT} on glass: its glass is drawn without the coat"));
        }
        let glass = Material {
            surface: self.glass(m, ior),
            color,
            normal,
            roughness,
            opacity: a,
            ..Material::diffuse(base)
        };
        if share >= 1.0 && through.is_none() {
            return glass;
        }
        let name = |part: &str| format!("{} ({part})", m.name);
        let (first, second) = (opaque.named(name("opaque")), glass.named(name("glass")));
        let (first, second) = (self.scene.material(first), self.scene.material(second));
        Material { blend: through, color, normal, opacity: a, ..Material::blend(first, second, share) }
    }

    fn normal_map(&mut self, m: &GltfMaterial) -> Option<NormalMap> {
        let info = m.normal_texture.as_ref()?;
        let texture = self.texture(info, false)?;
        Some(NormalMap { texture, scale: info.scale.filter(|s| s.is_finite()).unwrap_or(1.0) })
    }

    /// KHR_materials_unlit: the base colour as it is.
    fn unlit(&mut self, m: &GltfMaterial) -> Material {
        let pbr = &m.pbr_metallic_roughness;
        let [r, g, b, a] = pbr.base_color_factor;
        let color = pbr.base_color_texture.as_ref().and_then(|t| self.texture(t, true));
        let surface = Surface::Unlit { color: Rgb::new(r, g, b) };
        Material { surface, color, opacity: a, ..Material::diffuse(Rgb::BLACK) }
    }

    /// KHR_materials_transmission: the share of the light under the gloss that goes through instead of back, and its
    /// texture. Metal lets none through.
    fn through(&mut self, m: &GltfMaterial, place: &str) -> Option<(f32, Option<TextureId>)> {
        let Ok(through) = Transmission::deserialize(m.extensions.get("KHR_materials_transmission")?) else {
            self.said.warn(place, "KHR_materials_transmission is broken: drawn opaque");
            return None;
        };
        let pbr = &m.pbr_metallic_roughness;
        let metal = if pbr.metallic_roughness_texture.is_none() { pbr.metallic_factor } else { 0.0 };
        let share = (through.transmission_factor * (1.0 - metal)).clamp(0.0, 1.0);
        let texture = through.transmission_texture.and_then(|info| self.texture(&info, false));
        (share > 0.0).then_some((share, texture))
    }

    /// The glass of KHR_materials_transmission: a body if it has a volume, else a pane.
    fn glass(&self, m: &GltfMaterial, ior: f32) -> Surface {
        let pbr = &m.pbr_metallic_roughness;
        let volume = m.extensions.get("KHR_materials_volume");
        let thickness = volume.and_then(|v| v.get("thicknessFactor")?.as_f64()).unwrap_or(0.0);
        let roughness = pbr.roughness_factor;
        let facets = (roughness > 0.03).then(|| Facets::isotropic(roughness * roughness));
        let [r, g, b, _] = pbr.base_color_factor;
        let mut surface = if thickness > 0.0 {
            Material::dielectric(ior, facets).surface
        } else {
            Material::thin_dielectric(ior, facets).surface
        };
        surface.tint(Rgb::new(r, g, b));
        surface
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
                "KHR_materials_transmission" | "KHR_materials_ior" | UNLIT => continue,
                SPECULAR | GLOSSINESS | CLEARCOAT => continue,
                "KHR_materials_volume" if m.extensions[name].get("attenuationColor").is_none() => continue,
                "KHR_materials_volume" => "drawn without the colour of its depth",
                _ => "drawn without it",
            };
            self.said.warn(place, format!("asks for {name}, which antumbra does not have: {how}"));
        }
    }
}

/// `"name"`, or its number if it has none.
pub(super) fn named(index: usize, name: &str) -> String {
    if name.is_empty() { index.to_string() } else { format!("\"{name}\"") }
}
