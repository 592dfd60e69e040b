//! Materials as metallic-roughness with its extensions: the same where the format has it, else the nearest.

use antumbra::bsdf::{BsdfKind, Conductor, Facets, Metal, Principled};
use antumbra::scene::{Alpha, Emission, Material, MaterialId, Surface};
use antumbra_math::Rgb;
use serde_json::{Map, Value, json};

use super::{Writer, number, numbers};
use crate::write::light::split;

/// What a material asks of its mesh.
#[derive(Clone, Copy, Default)]
pub(super) struct Asks {
    /// Sets of texture coordinates.
    pub sets: [bool; 2],
    /// Tangents.
    pub tangents: bool,
}

/// The numbers of the format.
#[derive(Clone, Copy)]
struct Look {
    base: Rgb,
    metallic: f32,
    roughness: f32,
    /// KHR_materials_ior, where it is not 1.5.
    ior: Option<f32>,
    /// The factor of KHR_materials_specular, where it is not 1.
    specular: Option<f32>,
    /// The grey colour of KHR_materials_specular, where an index of refraction would be too large.
    gloss: Option<f32>,
    /// KHR_materials_clearcoat: how much of it is coated, and the roughness of the coat.
    coat: Option<[f32; 2]>,
    /// KHR_materials_transmission.
    through: f32,
    /// A body of glass, not a pane.
    body: bool,
    unlit: bool,
}

/// A rough white surface that is no metal.
const ROUGH: Look = Look {
    base: Rgb::WHITE,
    metallic: 0.0,
    roughness: 1.0,
    ior: None,
    specular: None,
    gloss: None,
    coat: None,
    through: 0.0,
    body: false,
    unlit: false,
};

/// Polished white metal.
const METAL: Look = Look { metallic: 1.0, roughness: 0.0, ..ROUGH };

impl Writer<'_, '_> {
    /// The material of the document for one of the scene; `plain`: without its textures.
    pub(super) fn material(&mut self, id: MaterialId, plain: bool) -> Result<usize, String> {
        if let Some(known) = self.made.materials.get(&(id, plain)) {
            return Ok(*known);
        }
        let index = self.add(self.job.material(id), plain)?;
        self.made.materials.insert((id, plain), index);
        Ok(index)
    }

    /// Adds a material to the document.
    pub(super) fn add(&mut self, m: &Material, plain: bool) -> Result<usize, String> {
        let place = format!("material \"{}\"", m.name);
        self.name_the_lost(m, &place);
        let (look, part) = self.look(m, &place);
        let mut asks = Asks::default();
        let mut pbr = Map::new();
        let [r, g, b] = look.base.0;
        pbr.insert("baseColorFactor".into(), numbers([r, g, b, m.opacity]));
        pbr.insert("metallicFactor".into(), number(look.metallic));
        pbr.insert("roughnessFactor".into(), number(look.roughness));
        let mut extensions = extensions_of(&look);
        let mut written = Map::new();
        if !plain {
            let painted = Material { alpha: m.alpha, cover: m.cover, ..part.clone() };
            if let Some(info) = self.base_texture(&painted, &place, &mut asks)? {
                pbr.insert("baseColorTexture".into(), info);
            }
            if let Some(info) = self.metal_rough(part, &place, &mut asks)? {
                pbr.insert("metallicRoughnessTexture".into(), info);
            }
            if let Some(map) = m.normal.or(part.normal) {
                let mut info = self.plain_texture(map.texture, &mut asks)?;
                info["scale"] = number(map.scale);
                written.insert("normalTexture".into(), info);
                asks.tangents = true;
            }
            let coated = part.blend.filter(|_| matches!(part.surface, Surface::ClearCoat { .. }));
            let shares =
                [(TRANSMISSION, "transmissionTexture", m.blend), (CLEARCOAT, "clearcoatTexture", coated)];
            for (extension, name, texture) in shares {
                if let (Some(written), Some(texture)) = (extensions.get_mut(extension), texture) {
                    written[name] = self.plain_texture(texture, &mut asks)?;
                }
            }
        }
        written.insert("pbrMetallicRoughness".into(), Value::Object(pbr));
        if !m.name.is_empty() {
            written.insert("name".into(), json!(m.name));
        }
        match m.alpha {
            Alpha::Opaque => None,
            Alpha::Mask { cutoff } => {
                written.insert("alphaCutoff".into(), number(cutoff)).or(Some(json!("MASK")))
            }
            Alpha::Blend => Some(json!("BLEND")),
        }
        .and_then(|mode| written.insert("alphaMode".into(), mode));
        self.shine(m.emission, &mut written, &mut extensions);
        if m.emission.map_or(!m.one_sided, |e| e.both_sides) {
            written.insert("doubleSided".into(), json!(true));
        }
        self.extensions.extend(extensions.keys().copied());
        if !extensions.is_empty() {
            written.insert("extensions".into(), json!(extensions));
        }
        self.materials.push(Value::Object(written));
        self.asks.push(asks);
        Ok(self.materials.len() - 1)
    }

    /// emissiveFactor and its strength.
    fn shine(&mut self, emission: Option<Emission>, written: &mut Map<String, Value>, more: &mut Extensions) {
        let Some(Emission { radiance, .. }) = emission.filter(|e| !e.radiance.is_black()) else { return };
        let (color, strength) = split(radiance);
        written.insert("emissiveFactor".into(), numbers(color.0));
        if strength != 1.0 {
            more.insert("KHR_materials_emissive_strength", json!({"emissiveStrength": number(strength)}));
        }
    }

    /// What no number of the format can say.
    fn name_the_lost(&mut self, m: &Material, place: &str) {
        let black = matches!(m.surface, Surface::Diffuse { albedo } if albedo.is_black());
        for (lost, what) in [
            (m.one_sided && !black, "is black from behind: glTF has no such side"),
            (m.back.is_some(), "has another look on its back: written with that of its front"),
            (m.bump.is_some(), "is bent by heights, which glTF does not know: written without them"),
            (m.gloss.is_some(), "has a texture on what it mirrors: written without it"),
        ] {
            if lost {
                self.warn(place, what);
            }
        }
    }

    /// The numbers of a material, and the one whose textures go with them.
    fn look<'m>(&mut self, m: &'m Material, place: &str) -> (Look, &'m Material)
    where
        Self: 'm,
    {
        let Surface::Blend { first, second, weight } = m.surface else {
            return (self.nearest(&m.surface, place), m);
        };
        let parts = [first, second].map(|id| self.job.material(id));
        let glass = match parts[1].surface {
            Surface::Dielectric(_) | Surface::RoughDielectric(_) => Some(true),
            Surface::ThinDielectric(_) | Surface::RoughThinDielectric(_) => Some(false),
            _ => None,
        };
        let opaque =
            matches!(parts[0].surface, Surface::MetallicRoughness { .. } | Surface::ClearCoat { .. });
        if let (true, Some(body)) = (opaque, glass) {
            let look = self.nearest(&parts[0].surface, place);
            return (Look { through: weight, body, ..look }, parts[0]);
        }
        // The share that has a gloss at all.
        if let [Surface::Diffuse { albedo }, Surface::MetallicRoughness { base, metallic: 0.0, .. }] =
            parts.map(|part| part.surface)
            && albedo == base
            && m.blend.is_none()
        {
            let look = self.nearest(&parts[1].surface, place);
            return (Look { specular: Some(weight), ..look }, parts[1]);
        }
        self.warn(place, "blends two looks: written as one, with the mean of their numbers");
        let mean = m.blend.map_or(1.0, |t| self.job.texture(t).image.mean().0[0]);
        let t = weight * mean;
        let looks = parts.map(|part| self.look(part, place));
        let [(a, _), (b, _)] = looks;
        let mix = |a: f32, b: f32| a + (b - a) * t;
        let heavier = looks[usize::from(t > 0.5)];
        let look = Look {
            base: a.base.lerp(b.base, t),
            metallic: mix(a.metallic, b.metallic),
            roughness: mix(a.roughness, b.roughness),
            through: mix(a.through, b.through),
            ..heavier.0
        };
        (look, heavier.1)
    }

    /// The numbers nearest to a surface; says where they are not the same.
    fn nearest(&mut self, surface: &Surface, place: &str) -> Look {
        let mut said = |what: &str| self.warn(place, format!("{what}: written as the nearest that glTF has"));
        let facets = surface.facets();
        if surface.is_stretched() || facets.is_some_and(Facets::is_beckmann) {
            said("has facets of two widths, or Beckmann's");
        }
        match *surface {
            Surface::Diffuse { albedo } => Look { base: albedo, specular: Some(0.0), ..ROUGH },
            Surface::DiffuseTransmission(d) => {
                said("lets light through evenly");
                Look { base: d.reflectance, specular: Some(0.0), ..ROUGH }
            }
            Surface::Unlit { color } => Look { base: color, unlit: true, ..ROUGH },
            Surface::MetallicRoughness { base, metallic, roughness, f0 } => {
                Look { base, metallic, roughness, ..of_reflectance(f0) }
            }
            Surface::ClearCoat { base, metallic, roughness, f0, strength, coat_roughness } => {
                let coat = Some([strength, coat_roughness]);
                Look { base, metallic, roughness, coat, ..of_reflectance(f0) }
            }
            Surface::Principled(p) => {
                said("is Disney's model");
                disney(&p)
            }
            Surface::Mirror { reflectance } => {
                said("is a perfect mirror");
                Look { base: reflectance, metallic: 1.0, roughness: 0.0, ..ROUGH }
            }
            Surface::Conductor(Conductor { metal, reflectance }) => {
                said("is a metal by its η and k");
                metallic(&metal, reflectance, None)
            }
            Surface::RoughConductor(c) => {
                said("is a metal by its η and k");
                metallic(&c.metal, c.reflectance, facets)
            }
            Surface::CoatedConductor(c) => {
                said("is metal under a clear coat");
                Look { coat: Some([1.0, rough(c.coat())]), ..metallic(&c.metal(), c.reflectance, c.facets()) }
            }
            Surface::Plastic { albedo, coat, .. } => {
                said("is plastic");
                Look { base: albedo, roughness: 0.0, ior: other(coat.eta()), ..ROUGH }
            }
            Surface::RoughPlastic { albedo, coat, .. } => {
                said("is plastic");
                Look { base: albedo, roughness: rough(facets), ior: other(coat.eta()), ..ROUGH }
            }
            Surface::Dielectric(_)
            | Surface::RoughDielectric(_)
            | Surface::ThinDielectric(_)
            | Surface::RoughThinDielectric(_) => self.glass(surface, place),
            // Parts that are blends are looked through before.
            Surface::Blend { .. } => ROUGH,
        }
    }

    fn glass(&mut self, surface: &Surface, place: &str) -> Look {
        let (eta, transmittance, reflectance, body) = match surface {
            Surface::Dielectric(d) => (d.index_below(), d.transmittance, d.reflectance, true),
            Surface::RoughDielectric(d) => (d.index_below(), d.transmittance, d.reflectance, true),
            Surface::ThinDielectric(d) => (Some(d.eta()), d.transmittance, d.reflectance, false),
            Surface::RoughThinDielectric(d) => (Some(d.eta()), d.transmittance, d.reflectance, false),
            _ => (None, Rgb::WHITE, Rgb::WHITE, true),
        };
        let eta = eta.unwrap_or(1.5);
        if eta < 1.0 {
            self.warn(
                place,
                "is thinner than what is around it: glTF has no such glass, written with its inverse",
            );
        }
        if reflectance != Rgb::WHITE {
            self.warn(place, "dims what it mirrors: glTF's glass does not");
        }
        let ior = other(if eta < 1.0 { 1.0 / eta } else { eta });
        Look { base: transmittance, roughness: rough(surface.facets()), ior, through: 1.0, body, ..ROUGH }
    }
}

/// Extensions of a material by name.
type Extensions = std::collections::BTreeMap<&'static str, Value>;

const TRANSMISSION: &str = "KHR_materials_transmission";
const CLEARCOAT: &str = "KHR_materials_clearcoat";

fn extensions_of(look: &Look) -> Extensions {
    let mut all = Extensions::new();
    if let Some(ior) = look.ior {
        all.insert("KHR_materials_ior", json!({"ior": number(ior)}));
    }
    if look.specular.is_some() || look.gloss.is_some() {
        let mut specular = json!({"specularFactor": number(look.specular.unwrap_or(1.0))});
        if let Some(gloss) = look.gloss {
            specular["specularColorFactor"] = numbers([gloss; 3]);
        }
        all.insert("KHR_materials_specular", specular);
    }
    if let Some([factor, roughness]) = look.coat {
        let coat = json!({"clearcoatFactor": number(factor), "clearcoatRoughnessFactor": number(roughness)});
        all.insert(CLEARCOAT, coat);
    }
    if look.through > 0.0 {
        all.insert(TRANSMISSION, json!({"transmissionFactor": number(look.through)}));
        if look.body {
            all.insert("KHR_materials_volume", json!({"thicknessFactor": 1.0}));
        }
    }
    if look.unlit {
        all.insert("KHR_materials_unlit", json!({}));
    }
    all
}

/// A dielectric that reflects `f0` straight on.
fn of_reflectance(f0: f32) -> Look {
    // Beyond, the index grows without end.
    let gloss = (f0 > 0.5).then_some(f0 / 0.04);
    Look { ior: if gloss.is_some() { None } else { index(f0) }, gloss, ..ROUGH }
}

/// A metal by what it reflects straight on.
fn metallic(metal: &Metal, reflectance: Rgb, facets: Option<Facets>) -> Look {
    Look { base: reflectance * straight_on(metal), roughness: rough(facets), ..METAL }
}

/// What metallic-roughness, coat and transmission have of Disney's model.
fn disney(p: &Principled) -> Look {
    let ior = other(if p.eta < 1.0 { 1.0 / p.eta } else { p.eta });
    let (base, metallic, roughness) = (p.base, p.metallic, p.roughness);
    // Its coat is a quarter of glTF's.
    let coat = (p.clearcoat > 0.0).then(|| [0.25 * p.clearcoat, p.coat_alpha().sqrt()]);
    Look { base, metallic, roughness, ior, coat, through: p.spec_trans, body: true, ..ROUGH }
}

/// The perceptual roughness of facets, of the mean of two widths.
fn rough(facets: Option<Facets>) -> f32 {
    let [u, v] = facets.map_or([0.0; 2], Facets::alpha);
    (u * v).sqrt().sqrt()
}

/// An index of refraction that is not the usual one.
fn other(ior: f32) -> Option<f32> {
    (ior != 1.5).then_some(ior)
}

/// The index whose reflectance straight on is `f0`: n = (1 + √f0) / (1 − √f0).
fn index(f0: f32) -> Option<f32> {
    let root = f0.sqrt();
    // 0.04 is 1.5 to the last digits.
    ((f0 - 0.04).abs() > 1e-7).then(|| (1.0 + root) / (1.0 - root))
}

/// What a metal reflects straight on: ((η−1)² + k²) / ((η+1)² + k²).
fn straight_on(metal: &Metal) -> Rgb {
    Rgb(std::array::from_fn(|c| {
        let (n, k) = (metal.eta.0[c], metal.k.0[c]);
        ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k)
    }))
}
