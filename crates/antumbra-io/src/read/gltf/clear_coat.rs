//! KHR_materials_clearcoat on metallic-roughness.

use antumbra::scene::{Material, Surface};
use serde::Deserialize;

use super::Reader;
use super::document::{GltfMaterial, TextureInfo};
use super::specular::SPECULAR;

pub(super) const CLEARCOAT: &str = "KHR_materials_clearcoat";

/// KHR_materials_clearcoat.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct ClearCoat {
    clearcoat_factor: f32,
    clearcoat_texture: Option<TextureInfo>,
    clearcoat_roughness_factor: f32,
    clearcoat_roughness_texture: Option<TextureInfo>,
    clearcoat_normal_texture: Option<TextureInfo>,
}

impl Reader<'_> {
    /// The material under its coat, if it has one.
    pub(super) fn clear_coat(&mut self, m: &GltfMaterial, bare: Material, place: &str) -> Material {
        let Some(value) = m.extensions.get(CLEARCOAT) else { return bare };
        let Ok(coat) = ClearCoat::deserialize(value) else {
            self.said.warn(place, format!("{CLEARCOAT} is broken: drawn without it"));
            return bare;
        };
        if coat.clearcoat_factor.max(0.0) == 0.0 {
            return bare;
        }
        if !matches!(bare.surface, Surface::MetallicRoughness { .. }) {
            self.said.warn(place, format!("{CLEARCOAT} beside {SPECULAR}: drawn without the coat"));
            return bare;
        }
        if coat.clearcoat_roughness_texture.is_some() {
            let text =
                format!("the roughness texture of {CLEARCOAT} is not read: its factor holds everywhere");
            self.said.warn(place, text);
        }
        let bends = |info: &TextureInfo| info.index;
        if coat.clearcoat_normal_texture.as_ref().map(bends) != m.normal_texture.as_ref().map(bends) {
            let text =
                format!("the coat of {CLEARCOAT} is bent as what is under it: it has no normals of its own");
            self.said.warn(place, text);
        }
        let blend = coat.clearcoat_texture.and_then(|info| self.texture(&info, false));
        Material { blend, ..bare.coated(coat.clearcoat_factor, coat.clearcoat_roughness_factor) }
    }
}
