//! Meshes in their places: once at each node, or at each of its instances (EXT_mesh_gpu_instancing).

use antumbra_math::{DVec3, Transform};

use super::Reader;
use super::material::named;
use super::node::{Placed, trs};
use super::primitive::Variant;
use crate::error::ReadError;

/// Bytes of an object with its name, for the account of memory.
const OBJECT: u64 = 256;

impl Reader<'_> {
    /// Places the mesh of a node.
    pub(super) fn place_mesh(&mut self, at: &Placed, index: usize) -> Result<(), ReadError> {
        let doc = self.doc;
        let node = &doc.nodes[at.node];
        let Some(mesh) = doc.meshes.get(index) else {
            let what = format!("mesh {index} is named; there are {}", doc.meshes.len());
            return Err(ReadError::new(format!("node {}", named(at.node, &node.name)), what));
        };
        let name = if node.name.is_empty() { &mesh.name } else { &node.name };
        let weights = node.weights.as_ref().unwrap_or(&mesh.weights);
        let skin = node.skin.and_then(|s| self.skin(s));
        // A skin puts its vertices into the world by itself.
        let places = if skin.is_some() { vec![Transform::IDENTITY] } else { self.instances(at)? };
        let variant = Variant { weights, skin };
        for primitive in &mesh.primitives {
            let place = format!("mesh {}", named(index, &mesh.name));
            let told = |e: ReadError| {
                let place =
                    if e.place.is_empty() { place.clone() } else { format!("{} of {place}", e.place) };
                ReadError { place, ..e }
            };
            let Some(id) = self.mesh(primitive, &variant, &mesh.name, &place).map_err(told)? else {
                continue;
            };
            let material = self.material(self.wanted(primitive));
            self.context.take(places.len() as u64, OBJECT).map_err(|e| told(ReadError::new("", e)))?;
            for place in &places {
                self.scene.place(name, id, material, *place);
            }
        }
        Ok(())
    }

    /// Object → world of each instance of a node.
    fn instances(&self, at: &Placed) -> Result<Vec<Transform>, ReadError> {
        #[derive(Default, serde::Deserialize)]
        #[serde(default, rename_all = "UPPERCASE")]
        struct Attributes {
            translation: Option<usize>,
            rotation: Option<usize>,
            scale: Option<usize>,
        }
        let Some(extension) = self.doc.nodes[at.node].extensions.get("EXT_mesh_gpu_instancing") else {
            return Ok(vec![at.world]);
        };
        let fail = |what: String| ReadError::new(format!("node {}: EXT_mesh_gpu_instancing", at.node), what);
        let attributes = extension.get("attributes").cloned().unwrap_or_default();
        let a: Attributes = serde_json::from_value(attributes).map_err(|e| fail(e.to_string()))?;
        let floats3 = |index: Option<usize>| index.map(|i| self.accessors.floats::<3>(i, None)).transpose();
        let (t, s) = (floats3(a.translation)?, floats3(a.scale)?);
        let r = a.rotation.map(|i| self.accessors.floats::<4>(i, None)).transpose()?;
        let counts = [t.as_ref().map(Vec::len), s.as_ref().map(Vec::len), r.as_ref().map(Vec::len)];
        let Some(n) = counts.iter().flatten().next().copied() else { return Ok(vec![at.world]) };
        if counts.iter().flatten().any(|c| *c != n) {
            return Err(fail(format!("its attributes have different counts {counts:?}")));
        }
        let three = |v: &Option<Vec<[f32; 3]>>, i: usize, default: f64| {
            v.as_ref().map_or(DVec3::splat(default), |v| DVec3::from_array(v[i].map(f64::from)))
        };
        let instance = |i: usize| {
            let q = r.as_ref().map_or([0.0, 0.0, 0.0, 1.0], |r| r[i].map(f64::from));
            at.world.after(&trs(three(&t, i, 0.0), q, three(&s, i, 1.0)))
        };
        Ok((0..n).map(instance).collect())
    }
}
