//! Objects: meshes as PLY files in their places, round shapes as such.

use antumbra::scene::{Body, Material, Object, Surface};
use antumbra_math::{Rgb, Transform, Vec3};
use antumbra_trace::Shape;

use super::Writer;
use super::xml::Element;
use crate::write::Job;
use crate::write::solids::about;

impl Writer<'_, '_> {
    /// The shape of an object.
    pub(super) fn shape(&mut self, object: &Object) -> Result<Element, String> {
        let material = self.job.material(object.material);
        let name = if object.name.is_empty() { &material.name } else { &object.name };
        let id = self.ids.give(name, "object");
        let (shape, look) = match &object.body {
            Body::Mesh(_) => self.meshed(object)?,
            Body::Shape(shape) => (round(shape), self.look(object.material, true)?),
        };
        let shape = shape.with("id", id).add(look);
        // A cylinder does not shine.
        let dark = matches!(object.body, Body::Shape(Shape::Cylinder { .. }));
        let Some(emission) = material.emission.filter(|e| !(dark || e.radiance.is_black())) else {
            return Ok(shape);
        };
        if emission.both_sides {
            self.both_sides(Job::place_of(object));
        }
        Ok(shape.add(area(emission.radiance)))
    }

    /// A mesh of a file and its look.
    fn meshed(&mut self, object: &Object) -> Result<(Element, Element), String> {
        let Body::Mesh(m) = object.body else { return Err("no mesh".into()) };
        let (mesh, material) = (self.job.mesh(m), self.job.material(object.material));
        let sets: Vec<u8> = material.textures().map(|t| self.job.texture(t).uv_set).collect();
        let set = sets.first().copied().unwrap_or(0);
        if sets.iter().any(|s| *s != set) {
            let what = "its textures lie on two sets of coordinates: Mitsuba's meshes have one";
            self.warn(Job::place_of(object), what);
        }
        let painted = mesh.colors.as_ref().and_then(|_| tint(material));
        if mesh.colors.is_some() && painted.is_none() {
            let what = "colours of vertices under a texture, or on glass or a blend, are not written";
            self.warn(Job::place_of(object), what);
        }
        let file = self.ply(m, set, painted);
        let mut shape = Element::plugin("shape", "ply").string("filename", &file);
        if mesh.normals.is_none() {
            shape = shape.boolean("face_normals", true);
            // Without normals, Mitsuba turns a mirrored mesh inside out.
            if object.transform.mirrors() {
                shape = shape.boolean("flip_normals", true);
            }
        }
        let look = match painted {
            Some(_) => self.painted_look(object.material)?,
            None => self.look(object.material, false)?,
        };
        Ok((shape.transform("to_world", &object.transform), look))
    }

    /// Light from both sides is not there.
    pub(super) fn both_sides(&mut self, place: String) {
        self.warn(place, "shines from both sides: Mitsuba's lights shine from their front");
    }
}

/// The colour that vertex colours multiply, if they are all that varies.
fn tint(material: &Material) -> Option<Rgb> {
    let color = match material.surface {
        Surface::Diffuse { albedo } => albedo,
        Surface::Plastic { albedo, .. } | Surface::RoughPlastic { albedo, .. } => albedo,
        Surface::MetallicRoughness { base, .. } | Surface::ClearCoat { base, .. } => base,
        Surface::Principled(p) => p.base,
        Surface::Unlit { color } => color,
        _ => return None,
    };
    material.color.is_none().then_some(color)
}

/// A light of a shape.
pub(super) fn area(radiance: Rgb) -> Element {
    Element::plugin("emitter", "area").rgb("radiance", radiance)
}

/// A sphere, disk or cylinder.
pub(super) fn round(shape: &Shape) -> Element {
    match *shape {
        Shape::Sphere { center, radius } => {
            Element::plugin("shape", "sphere").place("point", "center", center).float("radius", radius)
        }
        Shape::Disk { center, normal, radius } => {
            let n = Vec3::from(normal).as_dvec3().normalize();
            let linear = about(n, radius.into(), radius.into());
            let translation = Vec3::from(center).as_dvec3();
            Element::plugin("shape", "disk").transform("to_world", &Transform { linear, translation })
        }
        Shape::Cylinder { p, q, radius } => {
            let shape = Element::plugin("shape", "cylinder");
            shape.place("point", "p0", p).place("point", "p1", q).float("radius", radius)
        }
    }
}
