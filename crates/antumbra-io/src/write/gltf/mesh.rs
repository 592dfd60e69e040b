//! Objects in their places: nodes with meshes of one primitive, geometry shared.

use std::collections::BTreeMap;

use antumbra::scene::{Body, MaterialId, Mesh, Object};
use antumbra_math::{DVec3, Transform};
use serde_json::{Value, json};

use super::{Writer, tangents};
use crate::write::Job;
use crate::write::solids::{self, Solid};

/// Where geometry comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Source {
    /// A mesh of the scene.
    Mesh(u32),
    /// A unit solid.
    Solid(Solid),
    /// A mesh that only the object or light of this number has.
    Own(usize),
}

/// The accessors of a geometry.
#[derive(Clone, Default)]
pub(super) struct Geometry {
    name: String,
    vertices: usize,
    attributes: BTreeMap<String, usize>,
    indices: Option<usize>,
}

impl Writer<'_, '_> {
    /// The node of an object.
    pub(super) fn object(&mut self, object: &Object) -> Result<(), String> {
        match &object.body {
            Body::Mesh(m) if solids::is_square(&object.transform) => {
                let mesh = self.job.mesh(*m);
                let id = self.mesh(Source::Mesh(*m), mesh, object.material)?;
                self.place(&object.name, id, &object.transform);
            }
            Body::Mesh(m) => {
                let mesh = solids::moved(self.job.mesh(*m), &object.transform);
                let id = self.mesh(Source::Own(self.nodes.len()), &mesh, object.material)?;
                self.place(&object.name, id, &Transform::IDENTITY);
            }
            Body::Shape(shape) => {
                let shines = self.job.material(object.material).emission.is_some();
                let (solid, at) = solids::of(shape, shines);
                let text = format!("{}s are meshes in glTF: written as fine ones", solid.name());
                self.warn(Job::place_of(object), text);
                let id = self.mesh(Source::Solid(solid), &solid.mesh(), object.material)?;
                self.place(&object.name, id, &at);
            }
        }
        Ok(())
    }

    /// A node with a mesh.
    pub(super) fn place(&mut self, name: &str, mesh: usize, at: &Transform) {
        let mut node = json!({"mesh": mesh});
        if at.linear == Transform::IDENTITY.linear {
            if at.translation != DVec3::ZERO {
                node["translation"] = json!(at.translation.to_array());
            }
        } else {
            node["matrix"] = matrix(at);
        }
        self.node(name, node);
    }

    /// The mesh of a geometry with a material.
    fn mesh(&mut self, source: Source, mesh: &Mesh, material: MaterialId) -> Result<usize, String> {
        // Textures lie on meshes only.
        let plain = matches!(source, Source::Solid(_));
        let material = self.material(material, plain)?;
        self.mesh_of(source, mesh, material)
    }

    /// The same with a material of the document.
    pub(super) fn mesh_of(&mut self, source: Source, mesh: &Mesh, material: usize) -> Result<usize, String> {
        if let Some(known) = self.made.meshes.get(&(source, material)) {
            return Ok(*known);
        }
        let asks = self.asks[material];
        let tangents = mesh.tangents.as_ref().filter(|_| asks.tangents && mesh.normals.is_some());
        let key = (source, tangents.is_some());
        let mut geometry = match (self.made.geometries.get(&key), tangents) {
            (Some(known), _) => known.clone(),
            (None, None) => self.geometry(mesh, None),
            (None, Some(tangents)) => {
                let (split, values) = tangents::split(mesh, tangents);
                self.geometry(&split, Some(&values))
            }
        };
        for set in 0..2 {
            let name = format!("TEXCOORD_{set}");
            let asked = asks.sets[set..].contains(&true);
            // Where a mesh has no coordinates, textures are looked up at (0, 0).
            if asked && !geometry.attributes.contains_key(&name) {
                let zeros = self.buffer.vectors(&vec![[0.0f32; 2]; geometry.vertices], false);
                geometry.attributes.insert(name, zeros);
            }
        }
        self.made.geometries.insert(key, geometry.clone());
        let mut primitive = json!({"attributes": geometry.attributes, "material": material});
        if let Some(indices) = geometry.indices {
            primitive["indices"] = json!(indices);
        }
        let mut written = json!({"primitives": [primitive]});
        if !geometry.name.is_empty() {
            written["name"] = json!(geometry.name);
        }
        self.meshes.push(written);
        self.made.meshes.insert((source, material), self.meshes.len() - 1);
        Ok(self.meshes.len() - 1)
    }

    fn geometry(&mut self, mesh: &Mesh, tangents: Option<&[[f32; 4]]>) -> Geometry {
        let vertices = &mesh.triangles.vertices;
        let buffer = &mut self.buffer;
        let mut attributes = BTreeMap::new();
        attributes.insert("POSITION".to_string(), buffer.vectors(vertices, true));
        if let Some(normals) = &mesh.normals {
            attributes.insert("NORMAL".into(), buffer.vectors(&unit(normals), false));
        }
        for (set, uvs) in mesh.uvs.iter().enumerate() {
            if let Some(uvs) = uvs {
                attributes.insert(format!("TEXCOORD_{set}"), buffer.vectors(uvs, false));
            }
        }
        // A second set stands beside a first one.
        if attributes.contains_key("TEXCOORD_1") && !attributes.contains_key("TEXCOORD_0") {
            let zeros = buffer.vectors(&vec![[0.0f32; 2]; vertices.len()], false);
            attributes.insert("TEXCOORD_0".into(), zeros);
        }
        if let Some(colors) = &mesh.colors {
            attributes.insert("COLOR_0".into(), buffer.vectors(colors, false));
        }
        if let Some(tangents) = tangents.filter(|t| are_tangents(t)) {
            attributes.insert("TANGENT".into(), buffer.vectors(tangents, false));
        }
        let in_order =
            mesh.triangles.indices.as_flattened().iter().enumerate().all(|(i, v)| i == *v as usize);
        let in_order = in_order && mesh.triangles.indices.len() * 3 == vertices.len();
        let indices = (!in_order).then(|| buffer.indices(&mesh.triangles.indices, vertices.len()));
        Geometry { name: mesh.name.clone(), vertices: vertices.len(), attributes, indices }
    }
}

/// How far from 1 the length of a vector may be.
const UNIT: f32 = 1e-4;

/// Normals of length 1; those that are so already stay as they are, to the bit.
fn unit(normals: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let one = |n: &[f32; 3]| {
        let wide = DVec3::from(n.map(f64::from));
        if (wide.length() - 1.0).abs() <= f64::from(UNIT) {
            return *n;
        }
        // A normal of no length is nobody's: any does.
        wide.normalize_or(DVec3::Z).as_vec3().to_array()
    };
    normals.iter().map(one).collect()
}

/// They are what the format asks of tangents.
fn are_tangents(tangents: &[[f32; 4]]) -> bool {
    tangents
        .iter()
        .all(|[x, y, z, w]| ((x * x + y * y + z * z).sqrt() - 1.0).abs() <= UNIT && (*w == 1.0 || *w == -1.0))
}

/// The columns of a 4 × 4 matrix.
pub(super) fn matrix(t: &Transform) -> Value {
    let columns = [t.linear.x_axis, t.linear.y_axis, t.linear.z_axis, t.translation];
    let lasts = [0.0, 0.0, 0.0, 1.0];
    columns.iter().zip(lasts).flat_map(|(c, last)| [c.x, c.y, c.z, last]).map(|x| json!(x)).collect()
}
