//! Meshes: primitives → triangles with their attributes, shared by every node that shows them.

use std::collections::{BTreeMap, HashMap};

use antumbra::scene::{Mesh, MeshId};
use antumbra_math::{DVec3, Transform};
use antumbra_trace::Triangles;

use super::Reader;
use super::document::Primitive;
use super::extensions::advice;
use super::material::named;
use super::node::{Placed, trs};
use crate::error::ReadError;

/// What makes the geometry of a primitive, apart from its look.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Key {
    attributes: BTreeMap<String, usize>,
    targets: Vec<(BTreeMap<String, usize>, u32)>,
    indices: Option<usize>,
    mode: u32,
}

/// Meshes that were built already.
#[derive(Default)]
pub(super) struct Meshes {
    done: HashMap<Key, Option<MeshId>>,
    triangles_met: bool,
    pub skinned: bool,
}

impl Meshes {
    /// The scene announced a mesh of triangles, if only an empty one.
    pub(super) fn announced(&self) -> bool {
        self.triangles_met
    }
}

/// Bytes of an object with its name, for the account of memory.
const OBJECT: u64 = 256;

const TRIANGLES: u32 = 4;
const STRIP: u32 = 5;
const FAN: u32 = 6;
const DRACO: &str = "KHR_draco_mesh_compression";

impl Reader<'_> {
    /// Places the mesh of a node, once or at each of its instances (EXT_mesh_gpu_instancing).
    pub(super) fn place_mesh(&mut self, at: &Placed, index: usize) -> Result<(), ReadError> {
        let doc = self.doc;
        let node = &doc.nodes[at.node];
        let Some(mesh) = doc.meshes.get(index) else {
            let what = format!("mesh {index} is named; there are {}", doc.meshes.len());
            return Err(ReadError::new(format!("node {}", named(at.node, &node.name)), what));
        };
        self.meshes.skinned |= node.skin.is_some();
        let name = if node.name.is_empty() { &mesh.name } else { &node.name };
        let weights = node.weights.as_ref().unwrap_or(&mesh.weights);
        let places = self.instances(at)?;
        for primitive in &mesh.primitives {
            let place = format!("mesh {}", named(index, &mesh.name));
            let told = |e: ReadError| {
                let place =
                    if e.place.is_empty() { place.clone() } else { format!("{} of {place}", e.place) };
                ReadError { place, ..e }
            };
            let Some(id) = self.mesh(primitive, weights, &mesh.name, &place).map_err(told)? else { continue };
            let material = self.material(primitive.material);
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
        let floats3 = |index: Option<usize>| index.map(|i| self.accessors.floats::<3>(i)).transpose();
        let (t, s) = (floats3(a.translation)?, floats3(a.scale)?);
        let r = a.rotation.map(|i| self.accessors.floats::<4>(i)).transpose()?;
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

    /// The mesh of a primitive; `None` if it has no triangles.
    fn mesh(
        &mut self,
        p: &Primitive,
        weights: &[f32],
        name: &str,
        place: &str,
    ) -> Result<Option<MeshId>, ReadError> {
        let mode = p.mode.unwrap_or(TRIANGLES);
        if mode > FAN {
            return Err(ReadError::new("", format!("a primitive has the unknown mode {mode}")));
        }
        if mode < TRIANGLES {
            self.said.warn(place, "points and lines are not drawn");
            return Ok(None);
        }
        self.meshes.triangles_met = true;
        let weight = |i: usize| weights.get(i).copied().unwrap_or(0.0);
        let targets = p.targets.iter().enumerate().filter(|(i, _)| weight(*i) != 0.0);
        let targets = targets.map(|(i, t)| (t.clone(), weight(i).to_bits())).collect();
        let key = Key { attributes: p.attributes.clone(), targets, indices: p.indices, mode };
        if let Some(known) = self.meshes.done.get(&key) {
            return Ok(*known);
        }
        let mesh = self.build(p, &key, name, place)?;
        let id = mesh.map(|m| self.scene.mesh(m));
        self.meshes.done.insert(key, id);
        Ok(id)
    }

    fn build(
        &mut self,
        p: &Primitive,
        key: &Key,
        name: &str,
        place: &str,
    ) -> Result<Option<Mesh>, ReadError> {
        let Some(&position) = p.attributes.get("POSITION") else {
            self.said.warn(place, "a primitive has no positions: left out");
            return Ok(None);
        };
        if p.extensions.contains_key(DRACO) && !self.accessors.is_backed(position) {
            let what = format!("is compressed with {DRACO}, and the file brings no fallback");
            return Err(ReadError::new("", what).hint(advice(DRACO)));
        }
        let mut vertices = self.accessors.floats::<3>(position).map_err(|e| of(e, "POSITION"))?;
        let n = vertices.len();
        let indices = self.triangles(p, key.mode, n)?;
        if indices.is_empty() {
            self.said.warn(place, "a primitive has no triangles: left out");
            return Ok(None);
        }
        let mut normals = self.attribute(p, "NORMAL", n, |r, i| r.accessors.floats::<3>(i))?;
        self.morph(key, "POSITION", &mut vertices)?;
        if let Some(normals) = &mut normals {
            self.morph(key, "NORMAL", normals)?;
        }
        let uvs = [
            self.attribute(p, "TEXCOORD_0", n, |r, i| r.accessors.floats::<2>(i))?,
            self.attribute(p, "TEXCOORD_1", n, |r, i| r.accessors.floats::<2>(i))?,
        ];
        let colors = self.attribute(p, "COLOR_0", n, Self::colors)?;
        let triangles = Triangles { vertices, indices };
        Ok(Some(Mesh { name: name.into(), triangles, normals, uvs, colors }))
    }

    /// An attribute with one value a vertex; left out with a warning if its count is another.
    fn attribute<T>(
        &mut self,
        p: &Primitive,
        name: &str,
        vertices: usize,
        read: impl Fn(&Self, usize) -> Result<Vec<T>, ReadError>,
    ) -> Result<Option<Vec<T>>, ReadError> {
        let Some(&index) = p.attributes.get(name) else { return Ok(None) };
        if self.accessors.count(index)? != vertices as u64 {
            let text = format!("{name} does not have one value for each vertex: left out");
            self.said.warn(format!("accessor {index}"), text);
            return Ok(None);
        }
        read(self, index).map(Some).map_err(|e| of(e, name))
    }

    /// Linear colours; alpha 1 where there is none.
    fn colors(&self, index: usize) -> Result<Vec<[f32; 4]>, ReadError> {
        if self.accessors.lanes(index)? == 4 {
            return self.accessors.floats::<4>(index);
        }
        let rgb = self.accessors.floats::<3>(index)?;
        Ok(rgb.iter().map(|c| [c[0], c[1], c[2], 1.0]).collect())
    }

    /// Adds the morph targets with their weights.
    fn morph(&self, key: &Key, name: &str, values: &mut [[f32; 3]]) -> Result<(), ReadError> {
        for (target, weight) in &key.targets {
            let Some(&index) = target.get(name) else { continue };
            let offsets = self.accessors.floats::<3>(index).map_err(|e| of(e, name))?;
            let weight = f32::from_bits(*weight);
            for (value, offset) in values.iter_mut().zip(&offsets) {
                (0..3).for_each(|i| value[i] += weight * offset[i]);
            }
        }
        Ok(())
    }

    /// The triangles of a list, strip or fan; every index is below `vertices`.
    fn triangles(&mut self, p: &Primitive, mode: u32, vertices: usize) -> Result<Vec<[u32; 3]>, ReadError> {
        let fail = |what: String| ReadError::new("", what);
        let Some(index) = p.indices else {
            // Without indices the vertices are taken in their order.
            let n = u32::try_from(vertices).map_err(|_| fail(format!("{vertices} vertices are too many")))?;
            self.context.take(u64::from(n), 12).map_err(fail)?;
            return Ok(assemble(mode, n as usize, |i| i as u32));
        };
        if !p.attributes.is_empty() && mode == TRIANGLES && self.accessors.count(index)? % 3 != 0 {
            self.said.warn(
                format!("accessor {index}"),
                "the indices do not make whole triangles: the rest is left",
            );
        }
        let flat = self.accessors.integers::<1>(index).map_err(|e| of(e, "indices"))?;
        let largest = flat.iter().fold(0, |m, i| m.max(i[0]));
        if largest as usize >= vertices && !flat.is_empty() {
            // The largest value of each width restarts strips in some interfaces; glTF forbids it, so it is an error too.
            let what = format!("has the index {largest} of {vertices} vertices");
            return Err(of(ReadError::new(format!("accessor {index}"), what), "indices"));
        }
        if mode == TRIANGLES {
            return Ok(whole_triangles(flat));
        }
        Ok(assemble(mode, flat.len(), |i| flat[i][0]))
    }
}

/// Three indices a triangle, without a copy where the allocation allows it.
fn whole_triangles(mut flat: Vec<[u32; 1]>) -> Vec<[u32; 3]> {
    flat.truncate(flat.len() / 3 * 3);
    if flat.capacity() != flat.len() {
        flat.shrink_to_fit();
    }
    bytemuck::allocation::try_cast_vec(flat).unwrap_or_else(|(_, flat)| bytemuck::pod_collect_to_vec(&flat))
}

/// Triangles of `n` corners (glTF 2.0, section 3.7.2.1).
fn assemble(mode: u32, n: usize, at: impl Fn(usize) -> u32) -> Vec<[u32; 3]> {
    let count = if mode == TRIANGLES { n / 3 } else { n.saturating_sub(2) };
    let corner = |i: usize| match mode {
        STRIP if i % 2 == 1 => [i, i + 2, i + 1],
        STRIP => [i, i + 1, i + 2],
        FAN => [0, i + 1, i + 2],
        _ => [3 * i, 3 * i + 1, 3 * i + 2],
    };
    (0..count).map(|i| corner(i).map(&at)).collect()
}

/// The error with the role of its accessor.
fn of(e: ReadError, role: &str) -> ReadError {
    ReadError { place: format!("{} ({role})", e.place).trim_start().into(), ..e }
}
