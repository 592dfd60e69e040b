//! How a surface reflects at a point: which of blended materials, with its textures looked up.

use antumbra_math::{Rgb, hash};

use super::{Body, Channel, Look, Material, Placed, Scene, Surface, TextureId};
use crate::bsdf::{Bsdf, ClearCoat, Diffuse, MetallicRoughness, Mirror, Plastic, Principled, RoughPlastic};

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
        let gloss = |c: Rgb| match self.texel(at, material.gloss) {
            Some([r, g, b, _]) => c * Rgb([r, g, b]),
            None => c,
        };
        let tint = |c| self.tinted(c, material, at);
        let metal_rough = || self.metal_rough(material, at);
        match material.surface {
            Surface::Principled(numbers) => return self.principled(numbers, material, at, front),
            Surface::ClearCoat { .. } => return self.clear_coat(material, at),
            _ => {}
        }
        if let Some(roughness) = &material.roughness {
            let texel = self.number(at, roughness.channel);
            if let Some(surface) = roughness.at(&material.surface, texel) {
                return reflection(&surface, front, tint, gloss, metal_rough);
            }
        }
        reflection(&material.surface, front, tint, gloss, metal_rough)
    }

    /// Disney's model with its textures looked up.
    #[inline(never)]
    fn principled(&self, numbers: Principled, material: &Material, at: At<'_>, front: bool) -> Bsdf {
        let [metal, rough] = self.metal_rough(material, at);
        let [through, ..] = self.texel(at, material.blend).unwrap_or([1.0; 4]);
        let looked_up = Principled {
            base: self.tinted(numbers.base, material, at).map(|c| c.clamp(0.0, 1.0)),
            metallic: (numbers.metallic * metal).clamp(0.0, 1.0),
            roughness: (numbers.roughness * rough).clamp(0.0, 1.0),
            spec_trans: (numbers.spec_trans * through).clamp(0.0, 1.0),
            ..numbers
        };
        // Nothing passes: both sides look alike.
        let alike = front || numbers.spec_trans <= 0.0;
        Bsdf::Principled(if alike { looked_up } else { looked_up.turned() })
    }

    /// Metallic-roughness under its coat, with the textures looked up.
    #[inline(never)]
    fn clear_coat(&self, material: &Material, at: At<'_>) -> Bsdf {
        let Surface::ClearCoat { base, metallic, roughness, f0, strength, coat_roughness } = material.surface
        else {
            return Bsdf::Diffuse(Diffuse { albedo: Rgb::BLACK });
        };
        let [metal, rough] = self.metal_rough(material, at);
        let [coated, ..] = self.texel(at, material.blend).unwrap_or([1.0; 4]);
        let base = self.tinted(base, material, at);
        let base = MetallicRoughness::of_index(base, metallic * metal, roughness * rough, f0);
        Bsdf::ClearCoat(ClearCoat::new(base, strength * coated, coat_roughness))
    }

    /// Factors of metallic and of roughness.
    fn metal_rough(&self, material: &Material, at: At<'_>) -> [f32; 2] {
        let rough = material.roughness.as_ref().map(|r| r.channel);
        match (material.metallic, rough) {
            (Some(m), Some(r)) if m.texture == r.texture => {
                let texel = self.texel(at, Some(m.texture)).unwrap_or([1.0; 4]);
                [m, r].map(|c| texel[usize::from(c.component & 3)])
            }
            both => [both.0, both.1].map(|c| c.map_or(1.0, |c| self.number(at, c))),
        }
    }

    /// One number of a texture at a point; 1 where a mesh has none.
    fn number(&self, at: At<'_>, channel: Channel) -> f32 {
        let texel = self.texel(at, Some(channel.texture)).unwrap_or([1.0; 4]);
        texel[usize::from(channel.component & 3)]
    }

    /// The look of an object's side at a point: of a blend, the one that `number` draws.
    #[inline]
    pub(super) fn material_at(&self, at: At<'_>, front: bool, number: u32) -> &Material {
        let side = |id: u32| match self.materials[id as usize].back {
            Some(back) if !front => &self.materials[back as usize],
            _ => &self.materials[id as usize],
        };
        let mut material = side(at.0.material);
        if !matches!(material.surface, Surface::Blend { .. }) {
            return material;
        }
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

/// The BSDF of a surface on its front or back; `tint` and `gloss` multiply its colours by those of textures, `metal_rough`
/// gives the factors of metallic and roughness.
fn reflection(
    surface: &Surface,
    front: bool,
    tint: impl Fn(Rgb) -> Rgb,
    gloss: impl Fn(Rgb) -> Rgb,
    metal_rough: impl Fn() -> [f32; 2],
) -> Bsdf {
    match *surface {
        Surface::Diffuse { albedo } => Bsdf::Diffuse(Diffuse { albedo: tint(albedo) }),
        Surface::DiffuseTransmission(mut d) => {
            (d.reflectance, d.transmittance) = (tint(d.reflectance), gloss(d.transmittance));
            Bsdf::DiffuseTransmission(d.kept())
        }
        Surface::Mirror { reflectance } => Bsdf::Mirror(Mirror { reflectance: tint(reflectance) }),
        // An unlit one's colour is shown by `shown`; of a blend, `material_at` has drawn one; the others have their own.
        Surface::Unlit { .. }
        | Surface::Blend { .. }
        | Surface::Principled(_)
        | Surface::ClearCoat { .. } => Bsdf::Diffuse(Diffuse { albedo: Rgb::BLACK }),
        Surface::MetallicRoughness { base, metallic, roughness, f0 } => {
            let [metal, rough] = metal_rough();
            let (metallic, roughness) = (metallic * metal, roughness * rough);
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
        Surface::CoatedConductor(mut c) => {
            c.reflectance = tint(c.reflectance);
            Bsdf::CoatedConductor(c)
        }
        Surface::Dielectric(mut d) => {
            (d.transmittance, d.reflectance) = (tint(d.transmittance), gloss(d.reflectance));
            Bsdf::Dielectric(if front { d } else { d.turned() })
        }
        Surface::ThinDielectric(mut d) => {
            (d.transmittance, d.reflectance) = (tint(d.transmittance), gloss(d.reflectance));
            Bsdf::ThinDielectric(d)
        }
        Surface::Plastic { albedo, coat, gloss: factor } => {
            Bsdf::Plastic(Plastic::new(coat, tint(albedo)).with_gloss(gloss(factor)))
        }
        Surface::RoughPlastic { albedo, coat, gloss: factor } => {
            Bsdf::RoughPlastic(RoughPlastic::new(coat, tint(albedo)).with_gloss(gloss(factor)))
        }
        Surface::RoughThinDielectric(mut d) => {
            (d.transmittance, d.reflectance) = (tint(d.transmittance), gloss(d.reflectance));
            Bsdf::RoughThinDielectric(d)
        }
        Surface::RoughDielectric(mut d) => {
            (d.transmittance, d.reflectance) = (tint(d.transmittance), gloss(d.reflectance));
            Bsdf::RoughDielectric(if front { d } else { d.turned() })
        }
    }
}
