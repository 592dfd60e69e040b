//! Materials, shapes and lights from the word for their kind and their numbers by name.

use std::collections::HashMap;

use antumbra::bsdf::{Facets, Metal, Principled};
use antumbra::light::sky::{SUN_HALF_ANGLE, Sky};
use antumbra::light::{Directional, Disk, Environment, Light, Point, Rectangle, Sphere, Spot, Sun, Triangle};
use antumbra::math::{Rgb, Vec3};
use antumbra::scene::{Emission, Material};
use antumbra::trace::{Shape, Triangles};
use pyo3::prelude::*;

use crate::errors;

/// Numbers by name, as the dataclasses of Python give them.
pub struct Fields(HashMap<String, Vec<f64>>);

/// The fields that are places of the world.
const PLACES: [&str; 8] = ["position", "center", "corner", "a", "b", "c", "p0", "p1"];

impl Fields {
    /// The numbers, places relative to `origin`.
    pub fn about(mut fields: HashMap<String, Vec<f64>>, origin: [f64; 3]) -> Fields {
        for name in PLACES {
            for (c, o) in fields.get_mut(name).into_iter().flatten().zip(origin) {
                *c -= o;
            }
        }
        Fields(fields)
    }

    fn numbers(&self, name: &str, n: usize) -> PyResult<&[f64]> {
        match self.0.get(name) {
            Some(v) if v.len() == n => Ok(v),
            _ => Err(errors::value(format!("{name}: {n} numbers are needed"))),
        }
    }

    fn number(&self, name: &str) -> PyResult<f32> {
        Ok(self.numbers(name, 1)?[0] as f32)
    }

    fn vector(&self, name: &str) -> PyResult<[f32; 3]> {
        let v = self.numbers(name, 3)?;
        Ok([v[0] as f32, v[1] as f32, v[2] as f32])
    }

    fn vec3(&self, name: &str) -> PyResult<Vec3> {
        Ok(Vec3::from(self.vector(name)?))
    }

    /// α = roughness²; `None` = polished.
    fn facets(&self) -> PyResult<Option<Facets>> {
        let roughness = self.number("roughness")?;
        Ok((roughness > 0.0).then(|| Facets::isotropic(roughness * roughness)))
    }

    fn rgb(&self, name: &str) -> PyResult<Rgb> {
        Ok(Rgb(self.vector(name)?))
    }
}

fn unknown<T>(what: &str, kind: &str) -> PyResult<T> {
    Err(errors::value(format!("there is no {what} \"{kind}\"")))
}

/// A metal as Python sees it: symbol, η, k.
type MetalRow = (&'static str, [f32; 3], [f32; 3]);

/// The metals that have a name.
#[pyfunction]
pub fn metals() -> Vec<MetalRow> {
    let row = |name| Metal::named(name).map(|m| (name, m.eta.0, m.k.0));
    Metal::names().filter_map(row).collect()
}

/// A material of `antumbra.materials`; `emission` is the radiance of its front.
pub fn material(kind: &str, fields: &Fields, emission: Option<[f32; 3]>) -> PyResult<Material> {
    let material = match kind {
        "Diffuse" => Material::diffuse(fields.rgb("albedo")?),
        "DiffuseTransmission" => {
            Material::diffuse_transmission(fields.rgb("reflectance")?, fields.rgb("transmittance")?)
        }
        "Mirror" => Material::mirror(fields.rgb("reflectance")?),
        "MetallicRoughness" => Material::metallic_roughness(
            fields.rgb("base")?,
            fields.number("metallic")?,
            fields.number("roughness")?,
        ),
        "ClearCoat" => Material::metallic_roughness(
            fields.rgb("base")?,
            fields.number("metallic")?,
            fields.number("roughness")?,
        )
        .coated(fields.number("strength")?, fields.number("coat_roughness")?),
        "Principled" => Material::principled(Principled {
            base: fields.rgb("base")?,
            metallic: fields.number("metallic")?,
            roughness: fields.number("roughness")?,
            anisotropic: fields.number("anisotropic")?,
            eta: fields.number("ior")?,
            spec_trans: fields.number("spec_trans")?,
            spec_tint: fields.number("spec_tint")?,
            sheen: fields.number("sheen")?,
            sheen_tint: fields.number("sheen_tint")?,
            clearcoat: fields.number("clearcoat")?,
            clearcoat_gloss: fields.number("clearcoat_gloss")?,
            flatness: fields.number("flatness")?,
            turned: false,
        }),
        "Conductor" => {
            Material::conductor(Metal { eta: fields.rgb("eta")?, k: fields.rgb("k")? }, fields.facets()?)
        }
        "Dielectric" => Material::dielectric(fields.number("ior")?, fields.facets()?),
        "Plastic" => {
            let nonlinear = fields.number("nonlinear")? != 0.0;
            Material::plastic(fields.rgb("albedo")?, fields.number("ior")?, fields.facets()?, nonlinear)
        }
        "Blend" => {
            let id = |name| Ok::<_, PyErr>(fields.numbers(name, 1)?[0] as u32);
            Material::blend(id("first")?, id("second")?, fields.number("weight")?)
        }
        "ThinDielectric" => Material::thin_dielectric(fields.number("ior")?, fields.facets()?),
        _ => return unknown("material", kind),
    };
    Ok(emitting(material, emission))
}

/// The same with a radiance of its front.
pub fn emitting(material: Material, emission: Option<[f32; 3]>) -> Material {
    let emission = emission.map(|radiance| Emission { radiance: Rgb(radiance), both_sides: false });
    Material { emission, ..material }
}

/// The numbers of the two materials of a `antumbra.materials.TwoSided`: front and back.
pub fn sides(fields: &Fields) -> PyResult<[u32; 2]> {
    let id = |name| Ok::<_, PyErr>(fields.numbers(name, 1)?[0] as u32);
    Ok([id("front")?, id("back")?])
}

/// What a shape of `antumbra.shapes` is made of: a shape of the tree, or two triangles.
pub enum Made {
    /// A shape of the tree.
    Shape(Shape),
    /// Triangles.
    Mesh(Triangles),
}

/// A shape of `antumbra.shapes`.
pub fn shape(kind: &str, fields: &Fields) -> PyResult<Made> {
    Ok(Made::Shape(match kind {
        "Sphere" => Shape::Sphere { center: fields.vector("center")?, radius: fields.number("radius")? },
        "Disk" => Shape::Disk {
            center: fields.vector("center")?,
            normal: fields.vector("normal")?,
            radius: fields.number("radius")?,
        },
        "Cylinder" => Shape::Cylinder {
            p: fields.vector("p0")?,
            q: fields.vector("p1")?,
            radius: fields.number("radius")?,
        },
        "Rectangle" => return rectangle(fields).map(Made::Mesh),
        _ => return unknown("shape", kind),
    }))
}

fn rectangle(fields: &Fields) -> PyResult<Triangles> {
    let (corner, u, v) = (fields.vec3("corner")?, fields.vec3("u")?, fields.vec3("v")?);
    let corners = [corner, corner + u, corner + u + v, corner + v];
    Ok(Triangles { vertices: corners.map(Into::into).to_vec(), indices: vec![[0, 1, 2], [0, 2, 3]] })
}

/// A sky of `antumbra.lights`, angles in radians.
pub fn sky(fields: &Fields) -> PyResult<Sky> {
    let one = |name| Ok::<f64, PyErr>(fields.numbers(name, 1)?[0]);
    let half_angle = SUN_HALF_ANGLE / one("distance")?;
    Ok(Sky {
        elevation: one("elevation")?,
        azimuth: one("azimuth")?,
        turbidity: one("turbidity")?,
        albedo: one("albedo")?,
        half_angle,
    })
}

/// A light of `antumbra.lights`.
pub fn light(kind: &str, fields: &Fields) -> PyResult<Light> {
    let radiance = || fields.rgb("radiance");
    Ok(match kind {
        "Point" => Point { position: fields.vec3("position")?, intensity: fields.rgb("intensity")? }.into(),
        "Spot" => {
            let range = fields.0.contains_key("range").then(|| fields.number("range")).transpose()?;
            let (position, direction) = (fields.vec3("position")?, fields.vec3("direction")?);
            let (inner, outer) = (fields.number("inner")?, fields.number("outer")?);
            Spot::new(position, direction, fields.rgb("intensity")?, inner, outer, range).into()
        }
        "Directional" => Directional::new(fields.vec3("to_light")?, fields.rgb("irradiance")?).into(),
        "Sun" => Sun::new(fields.vec3("to_light")?, fields.number("half_angle")?, radiance()?).into(),
        "Rectangle" => {
            Rectangle::new(fields.vec3("corner")?, fields.vec3("u")?, fields.vec3("v")?, radiance()?).into()
        }
        "Disk" => {
            let (center, normal) = (fields.vec3("center")?, fields.vec3("normal")?);
            Disk::new(center, normal, fields.number("radius")?, radiance()?).into()
        }
        "Triangle" => {
            Triangle::new(fields.vec3("a")?, fields.vec3("b")?, fields.vec3("c")?, radiance()?).into()
        }
        "Sphere" => Sphere::new(fields.vec3("center")?, fields.number("radius")?, radiance()?).into(),
        "Environment" => Environment::constant(radiance()?).into(),
        _ => return unknown("light", kind),
    })
}
