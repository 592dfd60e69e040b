//! How the surface of an object looks: reflection, emission, alpha, and the textures of each.

use std::collections::BTreeSet;

use antumbra_math::Rgb;

use crate::bsdf::{
    BsdfKind, Coat, Conductor, Dielectric, Facets, Metal, Mirror, Plastic, RoughCoat, RoughConductor,
    RoughDielectric, ThinDielectric,
};

/// Index of a material in its scene.
pub type MaterialId = u32;
/// Index of a texture in its scene.
pub type TextureId = u32;

/// How a surface reflects, before textures are looked up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// f_r = ρ/π.
    Diffuse {
        /// ρ, times the colour texture and the vertex colours.
        albedo: Rgb,
    },
    /// A perfect mirror.
    Mirror {
        /// Share of light reflected.
        reflectance: Rgb,
    },
    /// glTF's metallic-roughness model (GGX).
    MetallicRoughness {
        /// Base colour, times the colour texture and the vertex colours.
        base: Rgb,
        /// 0 = dielectric, 1 = metal; times the blue of the metallic-roughness texture.
        metallic: f32,
        /// Perceptual roughness, α = roughness²; times the green of the metallic-roughness texture.
        roughness: f32,
        /// Share reflected straight on where it is not metal: 0.04 for the index of refraction 1.5.
        f0: f32,
    },
    /// Shows its colour as radiance where the sensor looks, whatever the light, and reflects none.
    Unlit {
        /// Times the colour texture and the vertex colours.
        color: Rgb,
    },
    /// Polished metal; the colour texture multiplies its reflectance.
    Conductor(Conductor),
    /// Rough metal; the colour texture multiplies its reflectance.
    RoughConductor(RoughConductor),
    /// Clear glass, its index that of the inside over the outside; the colour texture multiplies what it lets through.
    Dielectric(Dielectric),
    /// A pane of glass; the colour texture multiplies what it lets through.
    ThinDielectric(ThinDielectric),
    /// Ground glass; the colour texture multiplies what it lets through.
    RoughDielectric(RoughDielectric),
    /// Polished plastic.
    Plastic {
        /// Of the base, times the colour texture and the vertex colours.
        albedo: Rgb,
        /// The clear coat over it.
        coat: Coat,
    },
    /// Rough plastic.
    RoughPlastic {
        /// Of the base, times the colour texture and the vertex colours.
        albedo: Rgb,
        /// The clear coat over it.
        coat: RoughCoat,
    },
    /// One of two materials that stand before it in the scene, drawn by a hash of (ray number, primitive), so that light
    /// is reflected as by (1 − weight) f₁ + weight f₂. Their emission and alpha do not count: its own do.
    Blend {
        /// The material of weight 0.
        first: MaterialId,
        /// The material of weight 1.
        second: MaterialId,
        /// Share of the second, times the red of the blend texture.
        weight: f32,
    },
}

impl Surface {
    /// A part of its light leaves into single directions, where light sampling cannot see it.
    pub fn has_single_directions(&self) -> bool {
        match self {
            Surface::Mirror { reflectance } => Mirror { reflectance: *reflectance }.has_single_directions(),
            Surface::Conductor(c) => c.has_single_directions(),
            Surface::Dielectric(d) => d.has_single_directions(),
            Surface::ThinDielectric(d) => d.has_single_directions(),
            Surface::Plastic { albedo, coat } => Plastic::new(*coat, *albedo).has_single_directions(),
            Surface::RoughConductor(c) => c.has_single_directions(),
            Surface::RoughDielectric(d) => d.has_single_directions(),
            Surface::Diffuse { .. }
            | Surface::Unlit { .. }
            | Surface::MetallicRoughness { .. }
            | Surface::RoughPlastic { .. }
            | Surface::Blend { .. } => false,
        }
    }

    /// Its facets are wider along one tangent than along the other, so that it matters where the tangents lie.
    pub(super) fn is_stretched(&self) -> bool {
        match self {
            Surface::RoughConductor(c) => c.facets().is_stretched(),
            Surface::RoughDielectric(d) => d.facets().is_stretched(),
            Surface::RoughPlastic { coat, .. } => coat.facets().is_stretched(),
            _ => false,
        }
    }

    /// Gives it a colour: its albedo, reflectance, or what it lets through.
    pub fn tint(&mut self, by: Rgb) {
        if let Some(color) = self.colors().next() {
            *color = by;
        }
    }

    /// The colour that textures multiply, and a second one.
    fn colors(&mut self) -> impl Iterator<Item = &mut Rgb> {
        let (first, second) = match self {
            Surface::Diffuse { albedo }
            | Surface::Unlit { color: albedo }
            | Surface::Plastic { albedo, .. }
            | Surface::RoughPlastic { albedo, .. } => (Some(albedo), None),
            Surface::Mirror { reflectance } => (Some(reflectance), None),
            Surface::MetallicRoughness { base, .. } => (Some(base), None),
            Surface::Conductor(c) => (Some(&mut c.reflectance), None),
            Surface::RoughConductor(c) => (Some(&mut c.reflectance), None),
            Surface::Dielectric(d) => (Some(&mut d.transmittance), Some(&mut d.reflectance)),
            Surface::ThinDielectric(d) => (Some(&mut d.transmittance), Some(&mut d.reflectance)),
            Surface::RoughDielectric(d) => (Some(&mut d.transmittance), Some(&mut d.reflectance)),
            Surface::Blend { .. } => (None, None),
        };
        first.into_iter().chain(second)
    }

    /// The metal that it is made of.
    fn metal(&self) -> Option<&Metal> {
        match self {
            Surface::Conductor(c) => Some(&c.metal),
            Surface::RoughConductor(c) => Some(&c.metal),
            _ => None,
        }
    }

    /// What makes it impossible, in words.
    pub(super) fn fault(&self) -> Option<String> {
        let impossible = self.metal().filter(|metal| !metal.is_possible())?;
        Some(format!(
            "is a metal of η {:?} and k {:?}: η must be above 0, k not below",
            impossible.eta.0, impossible.k.0
        ))
    }
}

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
    /// Texture of metallic (blue) and roughness (green).
    pub metallic_roughness: Option<TextureId>,
    /// Texture of a blend's weight, plain numbers.
    pub blend: Option<TextureId>,
    /// Bends the shading normal.
    pub normal: Option<NormalMap>,
    /// Light given off.
    pub emission: Option<Emission>,
    /// How alpha is read.
    pub alpha: Alpha,
    /// Its back is black; else both sides look alike.
    pub one_sided: bool,
    /// The look of its back, a material that stands before it in the scene; its emission and alpha do not count.
    pub back: Option<MaterialId>,
    /// Alpha factor, times the texture's and the vertex colours' alpha.
    pub opacity: f32,
}

impl Material {
    /// A diffuse surface of albedo ρ.
    pub fn diffuse(albedo: Rgb) -> Material {
        Material::of(Surface::Diffuse { albedo })
    }

    /// A perfect mirror.
    pub fn mirror(reflectance: Rgb) -> Material {
        Material::of(Surface::Mirror { reflectance })
    }

    /// A metallic-roughness surface.
    pub fn metallic_roughness(base: Rgb, metallic: f32, roughness: f32) -> Material {
        Material::of(Surface::MetallicRoughness { base, metallic, roughness, f0: 0.04 })
    }

    /// Metal, polished or with facets.
    pub fn conductor(metal: Metal, facets: Option<Facets>) -> Material {
        let reflectance = Rgb::WHITE;
        Material::of(match facets {
            None => Surface::Conductor(Conductor { metal, reflectance }),
            Some(facets) => Surface::RoughConductor(RoughConductor::new(metal, reflectance, facets)),
        })
    }

    /// A body of glass, clear or ground; `eta` = n inside over n outside.
    pub fn dielectric(eta: f32, facets: Option<Facets>) -> Material {
        Material::of(match facets {
            None => Surface::Dielectric(Dielectric::clear(eta)),
            Some(facets) => Surface::RoughDielectric(RoughDielectric::new(eta, facets)),
        })
    }

    /// A pane of clear glass without thickness; `eta` = n of the pane over n around it.
    pub fn thin_dielectric(eta: f32) -> Material {
        Material::of(Surface::ThinDielectric(ThinDielectric::clear(eta)))
    }

    /// Plastic: a polished or rough clear coat over a diffuse base; `eta` = n of the coat over n outside, `nonlinear`: the
    /// colour deepens with each bounce between coat and base.
    pub fn plastic(albedo: Rgb, eta: f32, facets: Option<Facets>, nonlinear: bool) -> Material {
        Material::of(match facets {
            None => Surface::Plastic { albedo, coat: Coat::new(eta, nonlinear) },
            Some(facets) => Surface::RoughPlastic { albedo, coat: RoughCoat::new(eta, facets, nonlinear) },
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
            metallic_roughness: None,
            blend: None,
            normal: None,
            emission: None,
            alpha: Alpha::Opaque,
            one_sided: false,
            back: None,
            opacity: 1.0,
        }
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
