//! `Material`: diffuse, coateddiffuse, conductor, coatedconductor, dielectric, thindielectric, diffusetransmission, mix.

use antumbra::bsdf::{Facets, Metal};
use antumbra::scene::{Alpha, BumpMap, Channel, Material, MaterialId, NormalMap, Roughness};
use antumbra::texture::Texture;
use antumbra_math::Rgb;

use super::Reader;
use super::parameters::Parameters;
use super::spectrum::{Of, glass};
use super::text::Values;
use super::texture::Paint;
use crate::error::ReadError;
use crate::read::GREY;
use crate::read::text::show;

/// Makes a material.
type Make = fn(&mut Reader, &Parameters) -> Result<Material, ReadError>;

/// Every material that is read. To add one: a function and a line here.
const MATERIALS: [(&str, Make); 10] = [
    ("diffuse", diffuse),
    ("coateddiffuse", coateddiffuse),
    ("conductor", conductor),
    ("coatedconductor", coatedconductor),
    ("dielectric", dielectric),
    ("thindielectric", thindielectric),
    ("diffusetransmission", diffusetransmission),
    ("mix", mix),
    ("interface", interface),
    ("", interface),
];

/// Materials of pbrt-v3 that v4 has under other names.
const OF_V3: [&str; 9] =
    ["matte", "plastic", "uber", "substrate", "glass", "metal", "mirror", "translucent", "disney"];

impl Reader<'_> {
    /// The material of a plugin, added to the scene.
    pub(super) fn material(
        &mut self,
        p: &Parameters,
        plugin: &str,
        name: &str,
    ) -> Result<MaterialId, ReadError> {
        let made = match MATERIALS.iter().find(|m| m.0 == plugin) {
            Some((_, make)) => make(self, p)?,
            None if OF_V3.contains(&plugin) => {
                return Err(super::of_v3(p.error("this is a material of pbrt-v3")));
            }
            None => {
                self.lacks(p, "drawn grey");
                return Ok(self.scene.material(Material::diffuse(Rgb::grey(GREY)).named(name)));
            }
        };
        let made = self.bent(made, p)?;
        self.name_the_unread(p);
        Ok(self.scene.material(made.named(name)))
    }

    /// With the picture of normals or the heights that bend its normal.
    fn bent(&mut self, material: Material, p: &Parameters) -> Result<Material, ReadError> {
        let mut material = material;
        if p.has("displacement") {
            let heights = self.number(p, "displacement", 0.0)?;
            if let Some(texture) = &heights.image {
                let texture = self.intern(texture);
                material.bump = Some(BumpMap { texture, scale: heights.factor.0[0] });
            }
        }
        if let Some(name) = p.text("normalmap")?
            && let Some(image) = self.picture(p, name, false, false)
        {
            // v = 0 is the lower edge, as of every texture.
            let map = [1.0, 0.0, 0.0, 0.0, -1.0, 1.0];
            let texture = self.intern(&Texture { map, ..Texture::new(image) });
            material.normal = Some(NormalMap { texture, scale: 1.0 });
        }
        Ok(material)
    }

    /// `material` in the colour of the parameter `name`.
    fn tinted(
        &mut self,
        material: Material,
        p: &Parameters,
        name: &str,
        default: f32,
    ) -> Result<Material, ReadError> {
        let paint = self.paint(p, name, default)?;
        Ok(self.in_colour(material, &paint))
    }

    fn in_colour(&mut self, mut material: Material, paint: &Paint) -> Material {
        material.surface.tint(paint.factor);
        material.color = paint.image.as_ref().map(|texture| self.intern(texture));
        material
    }

    /// The facets of one width along each tangent: textures count by their means. `None`: polished.
    fn even_facets(
        &mut self,
        p: &Parameters,
        prefix: &str,
        default: f32,
    ) -> Result<Option<Facets>, ReadError> {
        let alpha = remapped(p)?;
        let mean = self.scalar(p, &format!("{prefix}roughness"), default)?;
        let [u, v] = ["uroughness", "vroughness"].map(|name| format!("{prefix}{name}"));
        let [u, v] = [self.scalar(p, &u, mean)?, self.scalar(p, &v, mean)?].map(alpha);
        // As smooth as pbrt takes for polished (its EffectivelySmooth).
        Ok((u.max(v) >= 1e-3).then(|| Facets::new(u, v)))
    }

    /// The facets of `roughness`, or of `uroughness` and `vroughness` (of an interface, with its prefix): α = √roughness
    /// unless the file says otherwise. `None`: polished.
    fn facets(
        &mut self,
        p: &Parameters,
        prefix: &str,
        default: f32,
    ) -> Result<Option<(Facets, Option<Roughness>)>, ReadError> {
        let both = self.number(p, &format!("{prefix}roughness"), default)?;
        let [u, v] = ["uroughness", "vroughness"].map(|name| format!("{prefix}{name}"));
        if let Some(texture) = both.image.clone().filter(|_| !p.has(&u) && !p.has(&v)) {
            // Texels that are α, and a factor of 1.
            let paint = Paint { factor: both.factor, image: Some(texture) };
            let paint = self.each(&p.at, &paint, remapped(p)?)?;
            let Some(texture) = paint.image else { return Ok(None) };
            let channel = Channel { texture: self.intern(&texture), component: 0 };
            return Ok(Some((Facets::isotropic(1.0), Some(Roughness::new(channel, false)))));
        }
        Ok(self.even_facets(p, prefix, default)?.map(|facets| (facets, None)))
    }

    /// An index of refraction, by number or by glass.
    fn index(&mut self, p: &Parameters, name: &str) -> Result<f32, ReadError> {
        let eta = match p.get(name) {
            None => 1.5,
            Some(given) => match &*given.values {
                Values::Texts(texts) if texts.len() == 1 && glass(&texts[0]).is_some() => {
                    glass(&texts[0]).unwrap_or(1.5)
                }
                _ => self.color_of(given, p, Of::Matter)?.mean(),
            },
        };
        // pbrt takes 0 for 1: what has no index lets all light through.
        let eta = if eta == 0.0 { 1.0 } else { eta };
        if (0.1..=10.0).contains(&eta) {
            return Ok(eta);
        }
        Err(p.error(format!("\"{name}\" is {eta}: an index of refraction from 0.1 to 10 is needed")))
    }

    /// The metal of `eta` and `k`, or of `reflectance`; copper if the file says nothing.
    fn metal(&mut self, p: &Parameters, prefix: &str) -> Result<Metal, ReadError> {
        if p.has("reflectance") {
            if p.has(&format!("{prefix}eta")) || p.has(&format!("{prefix}k")) {
                return Err(p.error("\"reflectance\" and \"eta\", \"k\" exclude each other"));
            }
            let r = self.color(p, "reflectance", 0.5)?;
            // The k that reflects r head on where η = 1.
            let k = r.map(|r| 2.0 * r.clamp(0.0, 0.9999).sqrt() / (1.0 - r.clamp(0.0, 0.9999)).sqrt());
            return Ok(Metal { eta: Rgb::WHITE, k });
        }
        let copper = Metal::named("Cu").unwrap_or(Metal { eta: Rgb::WHITE, k: Rgb::grey(3.0) });
        let of = |reader: &mut Self, name: &str, default: Rgb| {
            let name = format!("{prefix}{name}");
            if p.has(&name) { reader.color(p, &name, 1.0) } else { Ok(default) }
        };
        let metal = Metal { eta: of(self, "eta", copper.eta)?, k: of(self, "k", copper.k)? };
        if metal.is_possible() {
            return Ok(metal);
        }
        Err(p.error("a metal's eta must be above 0 and its k not below"))
    }

    /// The materials that a mixture names.
    fn parts(&mut self, p: &Parameters) -> Result<[MaterialId; 2], ReadError> {
        let names = p.texts("materials")?;
        let [first, second] = names else {
            return Err(p.error(format!("\"string materials\" takes two names, {} are here", names.len())));
        };
        let id = |name: &String| {
            self.materials.get(name).copied().ok_or_else(|| {
                let what = format!("no material is called {}", show(name.as_bytes()));
                p.error(what).hint("MakeNamedMaterial must stand before what uses it.")
            })
        };
        Ok([id(first)?, id(second)?])
    }
}

/// Roughness → α: its root, unless the file says otherwise.
fn remapped(p: &Parameters) -> Result<impl Fn(f32) -> f32 + use<>, ReadError> {
    let remap = p.boolean("remaproughness", true)?;
    Ok(move |x: f32| if remap { x.max(0.0).sqrt() } else { x.max(0.0) })
}

/// ρ/π.
fn diffuse(reader: &mut Reader, p: &Parameters) -> Result<Material, ReadError> {
    reader.tinted(Material::diffuse(Rgb::WHITE), p, "reflectance", 0.5)
}

/// A clear coat over a diffuse base. pbrt follows light within the coat; ours is the same coat without thickness.
fn coateddiffuse(reader: &mut Reader, p: &Parameters) -> Result<Material, ReadError> {
    within_the_coat(reader, p);
    let eta = reader.index(p, "eta")?;
    let facets = reader.facets(p, "", 0.0)?;
    let (facets, roughness) = facets.map_or((None, None), |(facets, texture)| (Some(facets), texture));
    let coat = Material { roughness, ..Material::plastic(Rgb::WHITE, eta, facets, true) };
    reader.tinted(coat, p, "reflectance", 0.5)
}

/// How a coat is followed, and the fog in it.
fn within_the_coat(reader: &mut Reader, p: &Parameters) {
    p.pass_over(&["thickness", "maxdepth", "nsamples", "g"]);
    if p.has("albedo") {
        reader.said.warn(p.at.words(), format!("\"albedo\" of {} is not read: its coat is clear", p.words));
        p.pass_over(&["albedo"]);
    }
}

/// Metal, polished or rough.
fn conductor(reader: &mut Reader, p: &Parameters) -> Result<Material, ReadError> {
    metallic(reader, p, "")
}

/// Metal under a clear coat. What lies between them takes no light here.
fn coatedconductor(reader: &mut Reader, p: &Parameters) -> Result<Material, ReadError> {
    within_the_coat(reader, p);
    let eta = reader.index(p, "interface.eta")?;
    let coat = reader.even_facets(p, "interface.", 0.0)?;
    let facets = reader.even_facets(p, "conductor.", 0.0)?;
    if eta < 1.0 {
        let what = format!("\"interface.eta\" is {eta}: a coat that is thinner than air is drawn as none");
        reader.said.warn(p.at.words(), what);
    }
    if coat.is_some() {
        let what = "the rough coat of a coatedconductor is drawn by a model: it gives back too much light, the more the \
                    rougher it is (0.16 of all at a roughness alpha of 0.1, up to 0.45 at 1)";
        reader.said.warn(p.at.words(), what);
    }
    Ok(Material::coated_conductor(eta, coat, reader.metal(p, "conductor.")?, facets))
}

fn metallic(reader: &mut Reader, p: &Parameters, prefix: &str) -> Result<Material, ReadError> {
    let metal = reader.metal(p, prefix)?;
    Ok(match reader.facets(p, prefix, 0.0)? {
        None => Material::conductor(metal, None),
        Some((facets, roughness)) => Material { roughness, ..Material::conductor(metal, Some(facets)) },
    })
}

/// A body of glass.
fn dielectric(reader: &mut Reader, p: &Parameters) -> Result<Material, ReadError> {
    let eta = reader.index(p, "eta")?;
    Ok(match reader.facets(p, "", 0.0)? {
        None => Material::dielectric(eta, None),
        Some((facets, roughness)) => Material { roughness, ..Material::dielectric(eta, Some(facets)) },
    })
}

/// A pane.
fn thindielectric(reader: &mut Reader, p: &Parameters) -> Result<Material, ReadError> {
    Ok(Material::thin_dielectric(reader.index(p, "eta")?, None))
}

/// ρ/π on the side of the light, τ/π on the other.
fn diffusetransmission(reader: &mut Reader, p: &Parameters) -> Result<Material, ReadError> {
    let scale = p.float("scale", 1.0)? as f32;
    let paint = |reader: &mut Reader, name: &str| {
        let paint = reader.paint(p, name, 0.25)?;
        Ok::<_, ReadError>(Paint { factor: paint.factor * scale, ..paint })
    };
    let (reflectance, transmittance) = (paint(reader, "reflectance")?, paint(reader, "transmittance")?);
    if (reflectance.mean() + transmittance.mean()).max() > 1.0 + 1e-4 {
        let what = "a diffusetransmission gives back more light than it gets: its two shares are scaled down";
        reader.said.warn(p.at.words(), what);
    }
    let mut material = Material::diffuse_transmission(Rgb::WHITE, Rgb::WHITE);
    material.surface.set_gloss(transmittance.factor);
    material.gloss = transmittance.image.as_ref().map(|texture| reader.intern(texture));
    Ok(reader.in_colour(material, &reflectance))
}

/// (1 − amount) of the first material, amount of the second.
fn mix(reader: &mut Reader, p: &Parameters) -> Result<Material, ReadError> {
    let [first, second] = reader.parts(p)?;
    let amount = reader.number(p, "amount", 0.5)?;
    Ok(match &amount.image {
        None => Material::blend(first, second, amount.factor.0[0]),
        Some(texture) => {
            let blend = Some(reader.intern(texture));
            Material { blend, ..Material::blend(first, second, amount.factor.0[0]) }
        }
    })
}

/// Nothing that light meets.
fn interface(_: &mut Reader, _: &Parameters) -> Result<Material, ReadError> {
    Ok(Material { alpha: Alpha::Blend, opacity: 0.0, ..Material::diffuse(Rgb::BLACK) })
}
