//! How the surface of an object looks: reflection, emission, alpha, and the textures of each.

use std::collections::BTreeSet;

use antumbra_math::Rgb;

use super::{Channel, Roughness, Surface};
use crate::bsdf::{
    Coat, CoatedConductor, Conductor, Dielectric, DiffuseTransmission, Facets, Metal, Principled, RoughCoat,
    RoughConductor, RoughDielectric, RoughThinDielectric, ThinDielectric,
};

/// Index of a material in its scene.
pub type MaterialId = u32;
/// Index of a texture in its scene.
pub type TextureId = u32;

/// How the alpha of the colour texture is read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Alpha {
    /// Not at all.
    #[default]
    Opaque,
    /// Blocks where alpha is at least the cutoff, in every kind of ray.
    Mask {
        /// glTF's alphaCutoff.
        cutoff: f32,
    },
    /// Lets a ray pass with probability 1 − alpha.
    Blend,
}

/// A picture of normals in the frame of tangent, bitangent and normal, each component from −1 to 1 over its range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalMap {
    /// The picture, plain numbers.
    pub texture: TextureId,
    /// Factor of the two components along the surface.
    pub scale: f32,
}

/// A picture of heights over the surface, in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BumpMap {
    /// The picture, plain numbers; red counts.
    pub texture: TextureId,
    /// Factor of the heights.
    pub scale: f32,
}

/// Light that a surface gives off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// L_e [W·m⁻²·sr⁻¹].
    pub radiance: Rgb,
    /// From its back too.
    pub both_sides: bool,
}

/// The look of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Its name in the file; may be empty.
    pub name: String,
    /// How it reflects.
    pub surface: Surface,
    /// Texture of the albedo or base colour, with the alpha.
    pub color: Option<TextureId>,
    /// Texture of what it mirrors beside its colour: plastic, glass; of what it lets through: thin cloth.
    pub gloss: Option<TextureId>,
    /// Texture of metallic.
    pub metallic: Option<Channel>,
    /// Texture of roughness.
    pub roughness: Option<Roughness>,
    /// Texture of a blend's weight, of spec_trans, or of a clear coat's strength, plain numbers.
    pub blend: Option<TextureId>,
    /// Bends the shading normal.
    pub normal: Option<NormalMap>,
    /// Bends it by heights, after the normal map.
    pub bump: Option<BumpMap>,
    /// Light given off.
    pub emission: Option<Emission>,
    /// How alpha is read.
    pub alpha: Alpha,
    /// Its back is black; else both sides look alike.
    pub one_sided: bool,
    /// The look of its back, a material that stands before it in the scene; its emission and alpha do not count.
    pub back: Option<MaterialId>,
    /// Alpha factor, times the cover's red, the colour texture's alpha and the vertex colours'.
    pub opacity: f32,
    /// Texture of alpha alone, plain numbers.
    pub cover: Option<TextureId>,
}

impl Material {
    /// A diffuse surface of albedo ρ.
    pub fn diffuse(albedo: Rgb) -> Material {
        Material::of(Surface::Diffuse { albedo })
    }

    /// Paper, cloth, a leaf: light leaves evenly on both sides. Where both shares make more than 1, they are scaled down.
    pub fn diffuse_transmission(reflectance: Rgb, transmittance: Rgb) -> Material {
        Material::of(Surface::DiffuseTransmission(DiffuseTransmission { reflectance, transmittance }))
    }

    /// A perfect mirror.
    pub fn mirror(reflectance: Rgb) -> Material {
        Material::of(Surface::Mirror { reflectance })
    }

    /// A metallic-roughness surface.
    pub fn metallic_roughness(base: Rgb, metallic: f32, roughness: f32) -> Material {
        Material::of(Surface::MetallicRoughness { base, metallic, roughness, f0: 0.04 })
    }

    /// The same under a clear coat, if it is metallic-roughness: the coat's share of the surface and its roughness.
    pub fn coated(self, strength: f32, coat_roughness: f32) -> Material {
        let Surface::MetallicRoughness { base, metallic, roughness, f0 } = self.surface else { return self };
        let surface = Surface::ClearCoat { base, metallic, roughness, f0, strength, coat_roughness };
        Material { surface, ..self }
    }

    /// Disney's model.
    pub fn principled(numbers: Principled) -> Material {
        Material::of(Surface::Principled(numbers))
    }

    /// Metal, polished or with facets.
    pub fn conductor(metal: Metal, facets: Option<Facets>) -> Material {
        let reflectance = Rgb::WHITE;
        Material::of(match facets {
            None => Surface::Conductor(Conductor { metal, reflectance }),
            Some(facets) => Surface::RoughConductor(RoughConductor::new(metal, reflectance, facets)),
        })
    }

    /// Metal under a clear coat of index `eta` over that outside; each polished or with facets.
    pub fn coated_conductor(
        eta: f32,
        coat: Option<Facets>,
        metal: Metal,
        facets: Option<Facets>,
    ) -> Material {
        Material::of(Surface::CoatedConductor(CoatedConductor::new(eta, coat, metal, facets)))
    }

    /// A body of glass, clear or ground; `eta` = n inside over n outside.
    pub fn dielectric(eta: f32, facets: Option<Facets>) -> Material {
        Material::of(match facets {
            None => Surface::Dielectric(Dielectric::clear(eta)),
            Some(facets) => Surface::RoughDielectric(RoughDielectric::new(eta, facets)),
        })
    }

    /// A pane of glass without thickness, clear or ground; `eta` = n of the pane over n around it.
    pub fn thin_dielectric(eta: f32, facets: Option<Facets>) -> Material {
        Material::of(match facets {
            None => Surface::ThinDielectric(ThinDielectric::clear(eta)),
            Some(facets) => Surface::RoughThinDielectric(RoughThinDielectric::new(eta, facets)),
        })
    }

    /// Plastic: a polished or rough clear coat over a diffuse base; `eta` = n of the coat over n outside, `nonlinear`: the
    /// colour deepens with each bounce between coat and base.
    pub fn plastic(albedo: Rgb, eta: f32, facets: Option<Facets>, nonlinear: bool) -> Material {
        Material::of(match facets {
            None => Surface::Plastic { albedo, coat: Coat::new(eta, nonlinear), gloss: Rgb::WHITE },
            Some(facets) => {
                let coat = RoughCoat::new(eta, facets, nonlinear);
                Surface::RoughPlastic { albedo, coat, gloss: Rgb::WHITE }
            }
        })
    }

    /// Two materials of the scene in one: (1 − weight) of the first, weight of the second.
    pub fn blend(first: MaterialId, second: MaterialId, weight: f32) -> Material {
        Material::of(Surface::Blend { first, second, weight })
    }

    /// A black surface that emits from its front.
    pub fn light(radiance: Rgb) -> Material {
        let emission = Some(Emission { radiance, both_sides: false });
        Material { emission, ..Material::diffuse(Rgb::BLACK) }
    }

    /// Takes every factor into [0, 1]; says whether one had to be.
    pub(super) fn tame(&mut self) -> bool {
        let mut any = tame(&mut self.opacity);
        if let Surface::MetallicRoughness { metallic, roughness, f0, .. } = &mut self.surface {
            any |= tame(metallic) | tame(roughness) | tame(f0);
        }
        if let Surface::ClearCoat { metallic, roughness, f0, strength, coat_roughness, .. } =
            &mut self.surface
        {
            any |= tame(metallic) | tame(roughness) | tame(f0) | tame(strength) | tame(coat_roughness);
        }
        if let Surface::Principled(numbers) = &mut self.surface {
            numbers.shares().into_iter().for_each(|x| any |= tame(x));
        }
        if let Surface::Blend { weight, .. } = &mut self.surface {
            any |= tame(weight);
        }
        self.surface.colors().flat_map(|color| &mut color.0).for_each(|c| any |= tame(c));
        any
    }

    /// The same with a name.
    pub fn named(self, name: impl Into<String>) -> Material {
        Material { name: name.into(), ..self }
    }

    fn of(surface: Surface) -> Material {
        Material {
            name: String::new(),
            surface,
            color: None,
            gloss: None,
            metallic: None,
            roughness: None,
            blend: None,
            normal: None,
            bump: None,
            emission: None,
            alpha: Alpha::Opaque,
            one_sided: false,
            back: None,
            opacity: 1.0,
            cover: None,
        }
    }
}

impl Material {
    /// Every texture that it looks up.
    pub fn textures(&self) -> impl Iterator<Item = TextureId> {
        let channels = [self.metallic, self.roughness.as_ref().map(|r| r.channel)];
        let maps = [self.normal.map(|map| map.texture), self.bump.map(|map| map.texture)];
        let plain = [self.color, self.gloss, self.blend, self.cover];
        let channels = channels.into_iter().flatten().map(|c| c.texture);
        plain.into_iter().chain(maps).flatten().chain(channels)
    }
}

/// The material `id`, or those that it blends, and those of its back, each once.
pub fn blended(materials: &[Material], id: MaterialId) -> Vec<MaterialId> {
    let (mut open, mut seen, mut found) = (vec![id], BTreeSet::new(), Vec::new());
    while let Some(id) = open.pop() {
        if !seen.insert(id) {
            continue;
        }
        let material = &materials[id as usize];
        open.extend(material.back);
        match material.surface {
            Surface::Blend { first, second, .. } => open.extend([second, first]),
            _ => found.push(id),
        }
    }
    found
}

/// Takes a number into [0, 1], NaN to 0; says whether it had to be.
pub(super) fn tame(x: &mut f32) -> bool {
    let fits = (0.0..=1.0).contains(x);
    if !fits {
        *x = if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) };
    }
    !fits
}
