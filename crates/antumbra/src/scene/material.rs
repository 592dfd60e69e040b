//! How the surface of an object looks: reflection, emission, alpha, and the textures of each.

use antumbra_math::Rgb;

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
    },
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

/// Light that a surface gives off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emission {
    /// L_e [W·m⁻²·sr⁻¹].
    pub radiance: Rgb,
    /// From its back too.
    pub both_sides: bool,
}

/// The look of a surface. Both sides reflect.
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
    /// Light given off.
    pub emission: Option<Emission>,
    /// How alpha is read.
    pub alpha: Alpha,
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
        Material::of(Surface::MetallicRoughness { base, metallic, roughness })
    }

    /// A black surface that emits from its front.
    pub fn light(radiance: Rgb) -> Material {
        let emission = Some(Emission { radiance, both_sides: false });
        Material { emission, ..Material::diffuse(Rgb::BLACK) }
    }

    /// Takes every factor into [0, 1]; says whether one had to be.
    pub(super) fn tame(&mut self) -> bool {
        let mut any = tame(&mut self.opacity);
        let color = match &mut self.surface {
            Surface::Diffuse { albedo } => albedo,
            Surface::Mirror { reflectance } => reflectance,
            Surface::MetallicRoughness { base, metallic, roughness } => {
                any |= tame(metallic) | tame(roughness);
                base
            }
        };
        color.0.iter_mut().for_each(|c| any |= tame(c));
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
            emission: None,
            alpha: Alpha::Opaque,
            opacity: 1.0,
        }
    }
}

/// Takes a number into [0, 1], NaN to 0; says whether it had to be.
pub(super) fn tame(x: &mut f32) -> bool {
    let fits = (0.0..=1.0).contains(x);
    if !fits {
        *x = if x.is_nan() { 0.0 } else { x.clamp(0.0, 1.0) };
    }
    !fits
}
