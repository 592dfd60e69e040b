//! KHR_materials_specular and KHR_materials_pbrSpecularGlossiness, as far as metallic-roughness can say them.

use antumbra::scene::{Material, Surface};
use antumbra_math::Rgb;
use serde::Deserialize;

use super::Reader;
use super::document::{GltfMaterial, TextureInfo};

pub(super) const SPECULAR: &str = "KHR_materials_specular";
pub(super) const GLOSSINESS: &str = "KHR_materials_pbrSpecularGlossiness";

/// F₀ of the metallic-roughness model for what is no metal.
const PLAIN_F0: f32 = 0.04;

/// KHR_materials_specular.
#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct Specular {
    specular_factor: f32,
    specular_texture: Option<TextureInfo>,
    specular_color_factor: [f32; 3],
    specular_color_texture: Option<TextureInfo>,
}

impl Default for Specular {
    fn default() -> Specular {
        Specular {
            specular_factor: 1.0,
            specular_texture: None,
            specular_color_factor: [1.0; 3],
            specular_color_texture: None,
        }
    }
}

/// KHR_materials_pbrSpecularGlossiness.
#[derive(Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct SpecularGlossiness {
    diffuse_factor: [f32; 4],
    diffuse_texture: Option<TextureInfo>,
    specular_factor: [f32; 3],
    glossiness_factor: f32,
    specular_glossiness_texture: Option<TextureInfo>,
}

impl Default for SpecularGlossiness {
    fn default() -> SpecularGlossiness {
        SpecularGlossiness {
            diffuse_factor: [1.0; 4],
            diffuse_texture: None,
            specular_factor: [1.0; 3],
            glossiness_factor: 1.0,
            specular_glossiness_texture: None,
        }
    }
}

impl Reader<'_> {
    /// KHR_materials_specular on a metallic-roughness material: its colour weighs F₀, its factor is the share that has
    /// a gloss at all.
    pub(super) fn specular(&mut self, m: &GltfMaterial, glossy: Material, place: &str) -> Material {
        let Some(value) = m.extensions.get(SPECULAR) else { return glossy };
        let Surface::MetallicRoughness { base, metallic, roughness, f0 } = glossy.surface else {
            return glossy;
        };
        // Metal does not heed the extension.
        if metallic >= 1.0 && glossy.metallic.is_none() {
            return glossy;
        }
        let Ok(s) = Specular::deserialize(value) else {
            self.said.warn(place, format!("{SPECULAR} is broken: drawn without it"));
            return glossy;
        };
        if s.specular_texture.is_some() || s.specular_color_texture.is_some() {
            self.said
                .warn(place, format!("the textures of {SPECULAR} are not read: its factors hold everywhere"));
        }
        let [r, g, b] = s.specular_color_factor;
        if r != g || g != b {
            self.said.warn(place, format!("the tint of {SPECULAR} is drawn as grey"));
        }
        let tint = ((r + g + b) / 3.0).max(0.0);
        let f0 = (f0 * tint).min(1.0);
        let glossy =
            Material { surface: Surface::MetallicRoughness { base, metallic, roughness, f0 }, ..glossy };
        let share = s.specular_factor;
        if share >= 1.0 || share.is_nan() {
            return glossy;
        }
        if metallic > 0.0 {
            let text = format!("the factor of {SPECULAR} on a surface that is partly metal is not read");
            self.said.warn(place, text);
            return glossy;
        }
        let surface = Surface::Diffuse { albedo: base };
        let matt = Material { surface, metallic: None, roughness: None, ..glossy.clone() };
        if share <= 0.0 {
            return matt;
        }
        let (color, normal, opacity) = (glossy.color, glossy.normal, glossy.opacity);
        let name = |part: &str| format!("{} ({part})", m.name);
        let (first, second) = (matt.named(name("matt")), glossy.named(name("glossy")));
        let (first, second) = (self.scene.material(first), self.scene.material(second));
        Material { color, normal, opacity, ..Material::blend(first, second, share) }
    }

    /// KHR_materials_pbrSpecularGlossiness in the words of metallic-roughness; `None` if it cannot be read.
    pub(super) fn glossiness(&mut self, m: &GltfMaterial, place: &str) -> Option<Material> {
        let g = match SpecularGlossiness::deserialize(m.extensions.get(GLOSSINESS)?) {
            Ok(g) => g,
            Err(e) => {
                self.said.warn(place, format!("{GLOSSINESS} is broken ({e}): drawn without it"));
                return None;
            }
        };
        let [r, g_, b, a] = g.diffuse_factor;
        let diffuse = Rgb::new(r, g_, b);
        let color = g.diffuse_texture.as_ref().and_then(|t| self.texture(t, true));
        let surface = if g.specular_glossiness_texture.is_some() {
            let text = format!("the specularGlossinessTexture of {GLOSSINESS} is not read: drawn matt");
            self.said.warn(place, text);
            Surface::Diffuse { albedo: diffuse }
        } else {
            converted(diffuse, Rgb(g.specular_factor), 1.0 - g.glossiness_factor)
        };
        Some(Material { surface, color, opacity: a, ..Material::diffuse(Rgb::BLACK) })
    }
}

/// Metallic-roughness that looks like a diffuse and a specular colour. A grey specular is an F₀ of its own; a coloured
/// one is metal in part, as the conversion that the extension's authors published does it.
fn converted(diffuse: Rgb, specular: Rgb, roughness: f32) -> Surface {
    let strongest = specular.max().clamp(0.0, 1.0);
    let [r, g, b] = specular.0;
    if r == g && g == b {
        let base = diffuse * (1.0 - strongest);
        return Surface::MetallicRoughness { base, metallic: 0.0, roughness, f0: strongest };
    }
    let rest = (1.0 - strongest) / (1.0 - PLAIN_F0);
    let metallic = metallic_of(brightness(diffuse), brightness(specular), rest);
    let of_diffuse = diffuse * (rest / (1.0 - metallic).max(1e-6));
    let of_specular = (specular - Rgb::grey(PLAIN_F0 * (1.0 - metallic))) * (1.0 / metallic.max(1e-6));
    let base = of_diffuse.lerp(of_specular, metallic * metallic).map(|c| c.clamp(0.0, 1.0));
    Surface::MetallicRoughness { base, metallic, roughness, f0: PLAIN_F0 }
}

/// The metallic that gives both brightnesses: the root of F₀ m² + b m + c.
fn metallic_of(diffuse: f32, specular: f32, rest: f32) -> f32 {
    if specular < PLAIN_F0 {
        return 0.0;
    }
    let b = diffuse * rest + specular - 2.0 * PLAIN_F0;
    let c = PLAIN_F0 - specular;
    let root = (b * b - 4.0 * PLAIN_F0 * c).max(0.0).sqrt();
    ((root - b) / (2.0 * PLAIN_F0)).clamp(0.0, 1.0)
}

/// As the eye weighs colours.
fn brightness(c: Rgb) -> f32 {
    let [r, g, b] = c.0;
    (0.299 * r * r + 0.587 * g * g + 0.114 * b * b).sqrt()
}
