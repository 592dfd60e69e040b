//! Looks: each material as bsdf plugins, and what wraps them.

use antumbra::bsdf::{BsdfKind, Facets, Metal, Principled};
use antumbra::scene::{Material, MaterialId, Surface};
use antumbra_math::Rgb;

use super::Writer;
use super::texture::Part;
use super::xml::Element;

/// Mitsuba dims light that grazes a bent surface unless this is false.
const GRAZING: &str = "use_shadowing_function";

/// With which of its textures a material is written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Dress {
    /// All of them.
    Textured,
    /// None: round shapes show none.
    Plain,
    /// Its colour is that of the vertices.
    Painted,
}

impl Writer<'_, '_> {
    /// Names the look of a material, which stands before the shapes; `plain`: without its textures.
    pub(super) fn look(&mut self, id: MaterialId, plain: bool) -> Result<Element, String> {
        let name = match self.looks.get(&(id, plain)) {
            Some(known) => known.clone(),
            None => {
                let material = self.job.material(id);
                let name = self.ids.give(&material.name, "material");
                let dress = if plain { Dress::Plain } else { Dress::Textured };
                let bsdf = self.whole(material, dress)?.with("id", name.clone());
                self.bsdfs.push(bsdf);
                self.looks.insert((id, plain), name.clone());
                name
            }
        };
        Ok(Element::new("ref").with("id", name))
    }

    /// The look of a material under vertex colours, written out.
    pub(super) fn painted_look(&mut self, id: MaterialId) -> Result<Element, String> {
        self.whole(self.job.material(id), Dress::Painted)
    }

    fn whole(&mut self, m: &Material, dress: Dress) -> Result<Element, String> {
        let bsdf = self.sided(m, dress)?;
        self.masked(m, dress, bsdf)
    }

    /// Its two sides, or the two that it blends.
    fn sided(&mut self, m: &Material, dress: Dress) -> Result<Element, String> {
        if let Surface::Blend { first, second, weight } = m.surface {
            let parts = [first, second].map(|id| self.job.material(id));
            let part = m.blend.filter(|_| dress != Dress::Plain).map(|id| (id, Part::One(0)));
            let weight = self.measure("weight", weight, part)?;
            let [first, second] = [self.sided(parts[0], dress)?, self.sided(parts[1], dress)?];
            return Ok(Element::plugin("bsdf", "blendbsdf").add(weight).add(first).add(second));
        }
        let front = self.leaf(m, dress)?;
        let glass = match m.surface {
            Surface::Principled(numbers) => numbers.spec_trans > 0.0,
            Surface::Dielectric(_)
            | Surface::ThinDielectric(_)
            | Surface::RoughDielectric(_)
            | Surface::RoughThinDielectric(_) => true,
            _ => false,
        };
        let twosided = || Element::plugin("bsdf", "twosided");
        match m.back {
            Some(back) => {
                let back = self.leaf(self.job.material(back), dress)?;
                Ok(twosided().add(front).add(back))
            }
            None if glass || m.one_sided => Ok(front),
            None => Ok(twosided().add(front)),
        }
    }

    /// One side, with what bends its normal.
    fn leaf(&mut self, m: &Material, dress: Dress) -> Result<Element, String> {
        let mut bsdf = self.plain(m, dress)?;
        if dress == Dress::Plain {
            return Ok(bsdf);
        }
        let place = format!("material \"{}\"", m.name);
        if let Some(map) = m.normal {
            if map.scale != 1.0 {
                self.warn(place, "scales its map of normals, which Mitsuba does not: written unscaled");
            }
            let texture = self.job.texture(map.texture);
            let file = self.picture(&texture.image, Part::Numbers, Rgb::WHITE)?;
            let map = self.bitmap("normalmap", texture, &file);
            let wrap = Element::plugin("bsdf", "normalmap").boolean(GRAZING, false);
            bsdf = wrap.add(map).add(bsdf);
        }
        if let Some(map) = m.bump {
            let texture = self.job.texture(map.texture);
            let file = self.picture(&texture.image, Part::One(0), Rgb::WHITE)?;
            let heights = self.bitmap("", texture, &file);
            let wrap = Element::plugin("bsdf", "bumpmap").boolean(GRAZING, false);
            bsdf = wrap.add(heights).float("scale", map.scale).add(bsdf);
        }
        Ok(bsdf)
    }

    /// The plugin nearest to a surface.
    fn plain(&mut self, m: &Material, dress: Dress) -> Result<Element, String> {
        let place = format!("material \"{}\"", m.name);
        let new = |kind: &str| Element::plugin("bsdf", kind);
        Ok(match m.surface {
            Surface::Diffuse { albedo } => new("diffuse").add(self.color("reflectance", albedo, m, dress)?),
            Surface::DiffuseTransmission(d) => {
                self.warn(
                    place,
                    "lets light through evenly, which Mitsuba does not have: written by what it reflects",
                );
                new("diffuse").add(self.color("reflectance", d.reflectance, m, dress)?)
            }
            Surface::Unlit { color } => {
                self.warn(
                    place,
                    "shows its colour whatever the light: Mitsuba has no such look, written as diffuse",
                );
                new("diffuse").add(self.color("reflectance", color, m, dress)?)
            }
            Surface::Mirror { reflectance } => {
                new("conductor").add(self.color("specular_reflectance", reflectance, m, dress)?)
            }
            Surface::Conductor(_) | Surface::RoughConductor(_) | Surface::CoatedConductor(_) => {
                self.metallic(m, dress)?
            }
            Surface::Dielectric(d) => {
                let glass = ior(new("dielectric"), d.index_below().unwrap_or(1.5));
                self.glass(glass, m, d.transmittance, d.reflectance, dress)?
            }
            Surface::ThinDielectric(d) => {
                self.glass(ior(new("thindielectric"), d.eta()), m, d.transmittance, d.reflectance, dress)?
            }
            Surface::RoughThinDielectric(d) => {
                self.warn(
                    place,
                    "is a pane of ground glass, which Mitsuba does not have: written as a clear one",
                );
                self.glass(ior(new("thindielectric"), d.eta()), m, d.transmittance, d.reflectance, dress)?
            }
            Surface::RoughDielectric(d) => {
                let glass = ior(new("roughdielectric"), d.index_below().unwrap_or(1.5));
                let glass = self.glass(glass, m, d.transmittance, d.reflectance, dress)?;
                self.rough(glass, m, d.facets(), dress)?
            }
            Surface::Plastic { .. } | Surface::RoughPlastic { .. } => self.plastic(m, dress)?,
            Surface::MetallicRoughness { base, metallic, roughness, f0 } => {
                self.metallic_roughness(m, (base, metallic, roughness), f0, dress)?
            }
            Surface::ClearCoat { base, metallic, roughness, f0, strength, coat_roughness } => {
                let bsdf = self.metallic_roughness(m, (base, metallic, roughness), f0, dress)?;
                self.coat(bsdf, m, strength, coat_roughness)
            }
            Surface::Principled(numbers) => self.principled(m, numbers, dress)?,
            Surface::Blend { .. } => return Err("a blend on the back of a material".into()),
        })
    }

    /// Metal; a coat over it is left out.
    fn metallic(&mut self, m: &Material, dress: Dress) -> Result<Element, String> {
        let (of, reflectance, facets) = match m.surface {
            Surface::Conductor(c) => (c.metal, c.reflectance, None),
            Surface::RoughConductor(c) => (c.metal, c.reflectance, Some(c.facets())),
            Surface::CoatedConductor(c) => {
                let what =
                    "is metal under a clear coat, which Mitsuba does not have: written without the coat";
                self.warn(format!("material \"{}\"", m.name), what);
                (c.metal(), c.reflectance, c.facets())
            }
            _ => return Err("no metal".into()),
        };
        let color = self.color("specular_reflectance", reflectance, m, dress)?;
        let kind = if facets.is_some() { "roughconductor" } else { "conductor" };
        let bsdf = metal(Element::plugin("bsdf", kind), &of).add(color);
        match facets {
            Some(facets) => self.rough(bsdf, m, facets, dress),
            None => Ok(bsdf),
        }
    }

    /// A clear coat over a diffuse base.
    fn plastic(&mut self, m: &Material, dress: Dress) -> Result<Element, String> {
        let (kind, albedo, eta, nonlinear, factor) = match m.surface {
            Surface::Plastic { albedo, coat, gloss } => {
                ("plastic", albedo, coat.eta(), coat.is_nonlinear(), gloss)
            }
            Surface::RoughPlastic { albedo, coat, gloss } => {
                ("roughplastic", albedo, coat.eta(), coat.is_nonlinear(), gloss)
            }
            _ => return Err("no plastic".into()),
        };
        let bsdf = ior(Element::plugin("bsdf", kind), eta).boolean("nonlinear", nonlinear);
        let bsdf = bsdf.add(self.color("diffuse_reflectance", albedo, m, dress)?);
        let gloss = m.gloss.filter(|_| dress != Dress::Plain);
        let bsdf = bsdf.add(self.paint("specular_reflectance", factor, gloss)?);
        Ok(match m.surface.facets() {
            Some(facets) => self.one_width(bsdf, m, facets),
            None => bsdf,
        })
    }

    /// The plugin nearest to metallic-roughness.
    fn metallic_roughness(
        &mut self,
        m: &Material,
        look: (Rgb, f32, f32),
        f0: f32,
        dress: Dress,
    ) -> Result<Element, String> {
        let what = "is metallic-roughness: written as principled, which is darker where rough metal is meant";
        self.warn(format!("material \"{}\"", m.name), what);
        let bsdf = self.base_metal_rough(m, look, dress)?;
        // Straight on, 0.08 is Mitsuba's largest.
        let specular = f0 / 0.08;
        Ok(if specular <= 1.0 {
            bsdf.float("specular", specular)
        } else {
            bsdf.float("eta", (1.0 + f0.sqrt()) / (1.0 - f0.sqrt()))
        })
    }

    /// A clear coat as principled has it.
    fn coat(&mut self, bsdf: Element, m: &Material, strength: f32, roughness: f32) -> Element {
        let what = "is under a clear coat: written as that of principled, which is a quarter as strong";
        self.warn(format!("material \"{}\"", m.name), what);
        let mean = m.blend.map_or(1.0, |t| self.job.texture(t).image.mean().0[0]);
        // α = 0.1 + (0.001 − 0.1) gloss.
        let gloss = ((0.1 - roughness * roughness) / 0.099).clamp(0.0, 1.0);
        bsdf.float("clearcoat", strength * mean).float("clearcoat_gloss", gloss)
    }

    /// Disney's model: the same.
    fn principled(&mut self, m: &Material, p: Principled, dress: Dress) -> Result<Element, String> {
        let bsdf = self.base_metal_rough(m, (p.base, p.metallic, p.roughness), dress)?;
        let through = m.blend.filter(|_| dress != Dress::Plain).map(|id| (id, Part::One(0)));
        let bsdf = bsdf.float("eta", p.eta).add(self.measure("spec_trans", p.spec_trans, through)?);
        let rest = [
            ("anisotropic", p.anisotropic),
            ("spec_tint", p.spec_tint),
            ("sheen", p.sheen),
            ("sheen_tint", p.sheen_tint),
            ("clearcoat", p.clearcoat),
            ("clearcoat_gloss", p.clearcoat_gloss),
            ("flatness", p.flatness),
        ];
        let given = rest.into_iter().filter(|(_, value)| *value != 0.0);
        Ok(given.fold(bsdf, |bsdf, (name, value)| bsdf.float(name, value)))
    }

    /// principled with what metallic-roughness has of it, textured.
    fn base_metal_rough(
        &mut self,
        m: &Material,
        (base, metallic, roughness): (Rgb, f32, f32),
        dress: Dress,
    ) -> Result<Element, String> {
        let bsdf = Element::plugin("bsdf", "principled").add(self.color("base_color", base, m, dress)?);
        let textured = dress != Dress::Plain;
        let metal = m.metallic.filter(|_| textured).map(|c| (c.texture, Part::One(c.component)));
        let rough = m.roughness.as_ref().filter(|_| textured);
        let rough = rough.map(|r| (r.channel.texture, Part::One(r.channel.component)));
        let bsdf = bsdf.add(self.measure("metallic", metallic, metal)?);
        Ok(bsdf.add(self.measure("roughness", roughness, rough)?))
    }

    /// The colour of a surface, with its texture or that of the vertices.
    fn color(&mut self, name: &str, color: Rgb, m: &Material, dress: Dress) -> Result<Element, String> {
        match dress {
            Dress::Plain => self.paint(name, color, None),
            Dress::Textured => self.paint(name, color, m.color),
            Dress::Painted => {
                let texture = Element::plugin("texture", "mesh_attribute").with("name", name);
                Ok(texture.string("name", "vertex_color"))
            }
        }
    }

    fn glass(
        &mut self,
        bsdf: Element,
        m: &Material,
        transmittance: Rgb,
        reflectance: Rgb,
        dress: Dress,
    ) -> Result<Element, String> {
        let gloss = m.gloss.filter(|_| dress != Dress::Plain);
        let bsdf = bsdf.add(self.paint("specular_reflectance", reflectance, gloss)?);
        Ok(bsdf.add(self.color("specular_transmittance", transmittance, m, dress)?))
    }

    /// Its facets, with the texture of their widths.
    fn rough(
        &mut self,
        bsdf: Element,
        m: &Material,
        facets: Facets,
        dress: Dress,
    ) -> Result<Element, String> {
        let bsdf = bsdf.string("distribution", if facets.is_beckmann() { "beckmann" } else { "ggx" });
        let part = m.roughness.as_ref().filter(|_| dress != Dress::Plain).map(|r| {
            let component = r.channel.component;
            (r.channel.texture, if r.squared { Part::Square(component) } else { Part::One(component) })
        });
        let [u, v] = facets.alpha();
        if u == v {
            return Ok(bsdf.add(self.measure("alpha", u, part)?));
        }
        let both = [self.measure("alpha_u", u, part)?, self.measure("alpha_v", v, part)?];
        Ok(bsdf.all(both))
    }

    /// The facets of a coat, which has one width in Mitsuba.
    fn one_width(&mut self, bsdf: Element, m: &Material, facets: Facets) -> Element {
        let [u, v] = facets.alpha();
        if u != v || m.roughness.is_some() {
            let what = "is plastic whose roughness varies: Mitsuba's has one width, its mean is written";
            self.warn(format!("material \"{}\"", m.name), what);
        }
        let mean = m.roughness.as_ref().map_or(1.0, |r| {
            let Rgb(mean) = self.job.texture(r.channel.texture).image.mean();
            let mean = mean[usize::from(r.channel.component.min(2))];
            if r.squared { mean * mean } else { mean }
        });
        let bsdf = bsdf.string("distribution", if facets.is_beckmann() { "beckmann" } else { "ggx" });
        bsdf.float("alpha", (u * v).sqrt() * mean)
    }
}

fn metal(bsdf: Element, metal: &Metal) -> Element {
    bsdf.rgb("eta", metal.eta).rgb("k", metal.k)
}

/// n inside over n outside.
fn ior(bsdf: Element, eta: f32) -> Element {
    bsdf.float("int_ior", eta).float("ext_ior", 1)
}
