//! How a surface reflects, before textures are looked up: a BSDF with its colours apart, or two blended.

use antumbra_math::Rgb;

use super::MaterialId;
use crate::bsdf::{
    BsdfKind, Coat, CoatedConductor, Conductor, Dielectric, DiffuseTransmission, Facets, Metal, Mirror,
    Plastic, Principled, RoughCoat, RoughConductor, RoughDielectric, RoughThinDielectric, ThinDielectric,
};

/// How a surface reflects, before textures are looked up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// f_r = ρ/π.
    Diffuse {
        /// ρ, times the colour texture and the vertex colours.
        albedo: Rgb,
    },
    /// Paper, cloth, a leaf: the colour texture multiplies what it reflects, the gloss texture what it lets through.
    DiffuseTransmission(DiffuseTransmission),
    /// A perfect mirror.
    Mirror {
        /// Share of light reflected.
        reflectance: Rgb,
    },
    /// glTF's metallic-roughness model (GGX).
    MetallicRoughness {
        /// Base colour, times the colour texture and the vertex colours.
        base: Rgb,
        /// 0 = dielectric, 1 = metal; times the metallic texture.
        metallic: f32,
        /// Perceptual roughness, α = roughness²; times the roughness texture.
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
    /// Metal under a clear coat; the colour texture multiplies the reflectance of the metal.
    CoatedConductor(CoatedConductor),
    /// Clear glass, its index that of the inside over the outside; the colour texture multiplies what it lets through.
    Dielectric(Dielectric),
    /// A pane of glass; the colour texture multiplies what it lets through.
    ThinDielectric(ThinDielectric),
    /// Ground glass; the colour texture multiplies what it lets through.
    RoughDielectric(RoughDielectric),
    /// A pane of ground glass; the colour texture multiplies what it lets through.
    RoughThinDielectric(RoughThinDielectric),
    /// Polished plastic.
    Plastic {
        /// Of the base, times the colour texture and the vertex colours.
        albedo: Rgb,
        /// The clear coat over it.
        coat: Coat,
        /// Factor of what the coat mirrors, times the gloss texture.
        gloss: Rgb,
    },
    /// Rough plastic.
    RoughPlastic {
        /// Of the base, times the colour texture and the vertex colours.
        albedo: Rgb,
        /// The clear coat over it.
        coat: RoughCoat,
        /// Factor of what its facets reflect, times the gloss texture.
        gloss: Rgb,
    },
    /// glTF's metallic-roughness under a clear coat.
    ClearCoat {
        /// As in metallic-roughness, as are the next three.
        base: Rgb,
        /// See base.
        metallic: f32,
        /// See base.
        roughness: f32,
        /// See base.
        f0: f32,
        /// How much of it is coated, times the red of the blend texture.
        strength: f32,
        /// Perceptual roughness of the coat.
        coat_roughness: f32,
    },
    /// Disney's model: its base times the colour texture and the vertex colours, metallic and roughness times theirs,
    /// spec_trans times the red of the blend texture.
    Principled(Principled),
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
            Surface::Plastic { albedo, coat, .. } => Plastic::new(*coat, *albedo).has_single_directions(),
            Surface::RoughConductor(c) => c.has_single_directions(),
            Surface::CoatedConductor(c) => c.has_single_directions(),
            Surface::RoughDielectric(d) => d.has_single_directions(),
            Surface::RoughThinDielectric(d) => d.has_single_directions(),
            Surface::Diffuse { .. }
            | Surface::DiffuseTransmission(_)
            | Surface::Unlit { .. }
            | Surface::MetallicRoughness { .. }
            | Surface::RoughPlastic { .. }
            | Surface::Principled(_)
            | Surface::ClearCoat { .. }
            | Surface::Blend { .. } => false,
        }
    }

    /// Its facets are wider along one tangent than along the other, so that it matters where the tangents lie.
    pub fn is_stretched(&self) -> bool {
        match self {
            Surface::CoatedConductor(c) => c.is_stretched(),
            Surface::Principled(p) => p.facets().is_stretched(),
            _ => self.facets().is_some_and(Facets::is_stretched),
        }
    }

    /// Its facets, of the kinds that have some of their own.
    pub fn facets(&self) -> Option<Facets> {
        match self {
            Surface::RoughConductor(c) => Some(c.facets()),
            Surface::RoughDielectric(d) => Some(d.facets()),
            Surface::RoughThinDielectric(d) => Some(d.facets()),
            Surface::RoughPlastic { coat, .. } => Some(coat.facets()),
            _ => None,
        }
    }

    /// The same with other facets, if it has some.
    pub(super) fn with_facets(&self, facets: Facets) -> Surface {
        match *self {
            Surface::RoughConductor(c) => Surface::RoughConductor(c.with_facets(facets)),
            Surface::RoughDielectric(d) => Surface::RoughDielectric(d.with_facets(facets)),
            Surface::RoughThinDielectric(d) => Surface::RoughThinDielectric(d.with_facets(facets)),
            Surface::RoughPlastic { albedo, coat, gloss } => {
                Surface::RoughPlastic { albedo, coat: coat.with_facets(facets), gloss }
            }
            other => other,
        }
    }

    /// The same with `facets` that lie a part `t` of the way from its own to those of the same surface `to`.
    #[inline]
    pub(super) fn between(&self, to: &Surface, t: f32, facets: Facets) -> Surface {
        match (*self, to) {
            (Surface::RoughConductor(a), Surface::RoughConductor(b)) => {
                Surface::RoughConductor(a.between(b, t, facets))
            }
            (Surface::RoughDielectric(a), Surface::RoughDielectric(b)) => {
                Surface::RoughDielectric(a.between(b, t, facets))
            }
            (Surface::RoughThinDielectric(a), Surface::RoughThinDielectric(b)) => {
                Surface::RoughThinDielectric(a.between(b, t, facets))
            }
            (Surface::RoughPlastic { albedo, coat, gloss }, Surface::RoughPlastic { coat: b, .. }) => {
                Surface::RoughPlastic { albedo, coat: coat.between(b, t, facets), gloss }
            }
            (other, _) => other,
        }
    }

    /// Gives it a colour: its albedo, reflectance, or what it lets through.
    pub fn tint(&mut self, by: Rgb) {
        if let Some(color) = self.colors().next() {
            *color = by;
        }
    }

    /// Gives it a factor of what it mirrors beside its colour; `false` for the kinds that have none.
    pub fn set_gloss(&mut self, factor: Rgb) -> bool {
        self.colors().nth(1).map(|gloss| *gloss = factor).is_some()
    }

    /// The colour that the colour texture multiplies, and the one of the gloss texture.
    pub(super) fn colors(&mut self) -> impl Iterator<Item = &mut Rgb> {
        let (first, second) = match self {
            Surface::Diffuse { albedo } | Surface::Unlit { color: albedo } => (Some(albedo), None),
            Surface::Plastic { albedo, gloss, .. } | Surface::RoughPlastic { albedo, gloss, .. } => {
                (Some(albedo), Some(gloss))
            }
            Surface::DiffuseTransmission(d) => (Some(&mut d.reflectance), Some(&mut d.transmittance)),
            Surface::Mirror { reflectance } => (Some(reflectance), None),
            Surface::MetallicRoughness { base, .. } | Surface::ClearCoat { base, .. } => (Some(base), None),
            Surface::Principled(p) => (Some(&mut p.base), None),
            Surface::Conductor(c) => (Some(&mut c.reflectance), None),
            Surface::RoughConductor(c) => (Some(&mut c.reflectance), None),
            Surface::CoatedConductor(c) => (Some(&mut c.reflectance), None),
            Surface::Dielectric(d) => (Some(&mut d.transmittance), Some(&mut d.reflectance)),
            Surface::ThinDielectric(d) => (Some(&mut d.transmittance), Some(&mut d.reflectance)),
            Surface::RoughDielectric(d) => (Some(&mut d.transmittance), Some(&mut d.reflectance)),
            Surface::RoughThinDielectric(d) => (Some(&mut d.transmittance), Some(&mut d.reflectance)),
            Surface::Blend { .. } => (None, None),
        };
        first.into_iter().chain(second)
    }

    /// The metal that it is made of.
    fn metal(&self) -> Option<Metal> {
        match self {
            Surface::Conductor(c) => Some(c.metal),
            Surface::RoughConductor(c) => Some(c.metal),
            Surface::CoatedConductor(c) => Some(c.metal()),
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
