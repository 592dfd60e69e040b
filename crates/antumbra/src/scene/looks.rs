//! How a surface reflects at a point: which of blended materials, with its textures looked up.

use antumbra_math::{Rgb, hash};

use super::{Body, Look, Material, Placed, Scene, Surface, TextureId};
use crate::bsdf::{Bsdf, Diffuse, MetallicRoughness, Mirror, Plastic, RoughPlastic};

/// Tells the numbers of blends in blends apart.
const BLENDED: u32 = 0x2c1b_3c6d;

/// An object, which of its triangles, and where on it.
pub(super) type At<'a> = (&'a Placed, u32, [f32; 2]);

impl Scene {
    /// The reflection of a surface with its textures looked up.
    #[inline]
    pub(super) fn bsdf(&self, material: &Material, at: At<'_>, front: bool, look: &Look) -> Bsdf {
        if let Some(rho) = look.clay {
            return Bsdf::Diffuse(Diffuse { albedo: Rgb::grey(rho) });
        }
        if material.one_sided && !front {
            return Bsdf::Diffuse(Diffuse { albedo: Rgb::BLACK });
        }
        let metal_rough = || self.texel(at, material.metallic_roughness).unwrap_or([1.0; 4]);
        reflection(&material.surface, front, |c| self.tinted(c, material, at), metal_rough)
    }

    /// The look of an object's side at a point: of a blend, the one that `number` draws.
    #[inline]
    pub(super) fn material_at(&self, at: At<'_>, front: bool, number: u32) -> &Material {
        let side = |id: u32| match self.materials[id as usize].back {
            Some(back) if !front => &self.materials[back as usize],
            _ => &self.materials[id as usize],
        };
        let mut material = side(at.0.material);
        // Not the number that alpha took.
        let mut number = hash::hash2(number, BLENDED);
        while let Surface::Blend { first, second, weight } = material.surface {
            let [red, ..] = self.texel(at, material.blend).unwrap_or([1.0; 4]);
            let second_wins = hash::unit_f32(number) < weight * red;
            material = side(if second_wins { second } else { first });
            number = hash::hash2(number, BLENDED);
        }
        material
    }

    /// A texture at a point of a mesh.
    fn texel(&self, (object, local, uv): At<'_>, id: Option<TextureId>) -> Option<[f32; 4]> {
        let Body::Mesh(mesh) = object.body else { return None };
        let texture = &self.textures[id? as usize];
        Some(texture.at(self.meshes[mesh as usize].uv_at(texture.uv_set, local, uv)))
    }

    /// A colour times the material's texture and the vertex colours.
    fn tinted(&self, c: Rgb, material: &Material, at: At<'_>) -> Rgb {
        let (object, local, uv) = at;
        let white = |c: Option<[f32; 4]>| c.map_or(Rgb::WHITE, |c| Rgb([c[0], c[1], c[2]]));
        let vertex = match object.body {
            Body::Mesh(m) => self.meshes[m as usize].color_at(local, uv),
            Body::Shape(_) => None,
        };
        c * white(self.texel(at, material.color)) * white(vertex)
    }

    /// What an unlit surface shows to the sensor.
    #[inline]
    pub(super) fn shown(&self, material: &Material, at: At<'_>, look: &Look) -> Rgb {
        match material.surface {
            Surface::Unlit { color } if look.clay.is_none() => self.tinted(color, material, at),
            _ => Rgb::BLACK,
        }
    }
}

/// The BSDF of a surface on its front or back; `tint` multiplies a colour by the texture's, `metal_rough` is the texel of
/// metallic (blue) and roughness (green).
fn reflection(
    surface: &Surface,
    front: bool,
    tint: impl Fn(Rgb) -> Rgb,
    metal_rough: impl Fn() -> [f32; 4],
) -> Bsdf {
    match *surface {
        Surface::Diffuse { albedo } => Bsdf::Diffuse(Diffuse { albedo: tint(albedo) }),
        Surface::Mirror { reflectance } => Bsdf::Mirror(Mirror { reflectance: tint(reflectance) }),
        // An unlit one's colour is shown by `shown`; of a blend, `material_at` has drawn one.
        Surface::Unlit { .. } | Surface::Blend { .. } => Bsdf::Diffuse(Diffuse { albedo: Rgb::BLACK }),
        Surface::MetallicRoughness { base, metallic, roughness, f0 } => {
            let [_, green, blue, _] = metal_rough();
            let (metallic, roughness) = (metallic * blue, roughness * green);
            Bsdf::MetallicRoughness(MetallicRoughness::of_index(tint(base), metallic, roughness, f0))
        }
        Surface::Conductor(mut c) => {
            c.reflectance = tint(c.reflectance);
            Bsdf::Conductor(c)
        }
        Surface::RoughConductor(mut c) => {
            c.reflectance = tint(c.reflectance);
            Bsdf::RoughConductor(c)
        }
        Surface::Dielectric(mut d) => {
            d.transmittance = tint(d.transmittance);
            Bsdf::Dielectric(if front { d } else { d.turned() })
        }
        Surface::ThinDielectric(mut d) => {
            d.transmittance = tint(d.transmittance);
            Bsdf::ThinDielectric(d)
        }
        Surface::Plastic { albedo, coat } => Bsdf::Plastic(Plastic::new(coat, tint(albedo))),
        Surface::RoughPlastic { albedo, coat } => Bsdf::RoughPlastic(RoughPlastic::new(coat, tint(albedo))),
        Surface::RoughDielectric(mut d) => {
            d.transmittance = tint(d.transmittance);
            Bsdf::RoughDielectric(if front { d } else { d.turned() })
        }
    }
}
