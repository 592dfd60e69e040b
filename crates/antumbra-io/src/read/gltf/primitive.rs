//! Primitives → triangles with their attributes, shared by every node that shows them.

use std::collections::{BTreeMap, HashMap};

use antumbra::scene::{Mesh, MeshId, Tangents};
use antumbra_trace::Triangles;

use super::Reader;
use super::accessor::Pick;
use super::document::Primitive;
use crate::error::ReadError;

/// How a node bends the meshes that it shows.
pub(super) struct Variant<'a> {
    /// Of the morph targets.
    pub weights: &'a [f32],
    /// Index of its skin.
    pub skin: Option<usize>,
}

/// What makes the geometry of a primitive, apart from its look.
#[derive(Clone, PartialEq, Eq, Hash)]
pub(super) struct Key {
    attributes: BTreeMap<String, usize>,
    /// Morph targets with the bits of their weights.
    targets: Vec<(BTreeMap<String, usize>, u32)>,
    indices: Option<usize>,
    mode: u32,
    skin: Option<usize>,
}

/// Meshes that were built already.
#[derive(Default)]
pub(super) struct Meshes {
    done: HashMap<Key, Option<MeshId>>,
    /// The scene announced a mesh of triangles, if only an empty one.
    pub announced: bool,
}

const TRIANGLES: u32 = 4;
const STRIP: u32 = 5;
const FAN: u32 = 6;

impl Reader<'_> {
    /// The mesh of a primitive; `None` if it has no triangles.
    pub(super) fn mesh(
        &mut self,
        p: &Primitive,
        variant: &Variant,
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
        self.meshes.announced = true;
        let weight = |i: usize| variant.weights.get(i).copied().unwrap_or(0.0);
        let targets = p.targets.iter().enumerate().filter(|(i, _)| weight(*i) != 0.0);
        let targets = targets.map(|(i, t)| (t.clone(), weight(i).to_bits())).collect();
        let (attributes, indices) = (p.attributes.clone(), p.indices);
        let key = Key { attributes, targets, indices, mode, skin: variant.skin };
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
        let n = self.accessors.count(position)?;
        let mut indices = self.triangles(p, key.mode, n)?;
        if indices.is_empty() {
            self.said.warn(place, "a primitive has no triangles: left out");
            return Ok(None);
        }
        let used = compact(&mut indices, n);
        let pick = used.as_deref();
        let mut vertices = self.accessors.floats::<3>(position, pick).map_err(|e| of(e, "POSITION"))?;
        let mut normals = self.attribute(p, "NORMAL", n, |r, i| r.accessors.floats::<3>(i, pick))?;
        self.morph(key, "POSITION", pick, n, &mut vertices)?;
        if let Some(normals) = &mut normals {
            self.morph(key, "NORMAL", pick, n, normals)?;
        }
        if let Some(skin) = key.skin {
            self.bend(p, skin, n, pick, &mut vertices, normals.as_deref_mut())?;
        }
        let uvs = [
            self.attribute(p, "TEXCOORD_0", n, |r, i| r.accessors.floats::<2>(i, pick))?,
            self.attribute(p, "TEXCOORD_1", n, |r, i| r.accessors.floats::<2>(i, pick))?,
        ];
        let tangents = self.tangents(p, key, n, pick)?;
        let colors = self.attribute(p, "COLOR_0", n, |r, i| r.colors(i, pick))?;
        let triangles = Triangles { vertices, indices };
        Ok(Some(Mesh { name: name.into(), triangles, normals, uvs, tangents, colors }))
    }

    /// The tangents that the file gives, where a normal map asks for them; those of bent meshes are made anew.
    fn tangents(
        &mut self,
        p: &Primitive,
        key: &Key,
        n: u64,
        pick: Pick,
    ) -> Result<Option<Tangents>, ReadError> {
        let material = self.wanted(p).and_then(|i| self.doc.materials.get(i));
        let mapped = material.is_some_and(|m| m.normal_texture.is_some());
        if !mapped || key.skin.is_some() || !key.targets.is_empty() || !p.attributes.contains_key("NORMAL") {
            return Ok(None);
        }
        let values = self.attribute(p, "TANGENT", n, |r, i| r.accessors.floats::<4>(i, pick))?;
        Ok(values.map(Tangents::of_vertices))
    }

    /// An attribute with one value a vertex; left out with a warning if its count is another.
    pub(super) fn attribute<T>(
        &mut self,
        p: &Primitive,
        name: &str,
        vertices: u64,
        read: impl Fn(&Self, usize) -> Result<Vec<T>, ReadError>,
    ) -> Result<Option<Vec<T>>, ReadError> {
        let Some(&index) = p.attributes.get(name) else { return Ok(None) };
        if self.accessors.count(index)? != vertices {
            let text = format!("{name} does not have one value for each vertex: left out");
            self.said.warn(format!("accessor {index}"), text);
            return Ok(None);
        }
        read(self, index).map(Some).map_err(|e| of(e, name))
    }

    /// Linear colours; alpha 1 where there is none.
    fn colors(&self, index: usize, pick: Pick) -> Result<Vec<[f32; 4]>, ReadError> {
        if self.accessors.lanes(index)? == 4 {
            return self.accessors.floats::<4>(index, pick);
        }
        let rgb = self.accessors.floats::<3>(index, pick)?;
        Ok(rgb.iter().map(|c| [c[0], c[1], c[2], 1.0]).collect())
    }

    /// Adds the morph targets with their weights.
    fn morph(
        &self,
        key: &Key,
        name: &str,
        pick: Pick,
        vertices: u64,
        values: &mut [[f32; 3]],
    ) -> Result<(), ReadError> {
        for (target, weight) in &key.targets {
            let Some(&index) = target.get(name) else { continue };
            let count = self.accessors.count(index)?;
            if count != vertices {
                let what = format!("a morph target has {count} values for {vertices} vertices");
                return Err(of(ReadError::new(format!("accessor {index}"), what), name));
            }
            let offsets = self.accessors.floats::<3>(index, pick).map_err(|e| of(e, name))?;
            let weight = f32::from_bits(*weight);
            for (value, offset) in values.iter_mut().zip(&offsets) {
                (0..3).for_each(|i| value[i] += weight * offset[i]);
            }
        }
        Ok(())
    }

    /// The triangles of a list, strip or fan; every index is below `vertices`.
    fn triangles(&mut self, p: &Primitive, mode: u32, vertices: u64) -> Result<Vec<[u32; 3]>, ReadError> {
        let fail = |what: String| ReadError::new("", what);
        let Some(index) = p.indices else {
            // Without indices the vertices are taken in their order.
            let n = u32::try_from(vertices).map_err(|_| fail(format!("{vertices} vertices are too many")))?;
            self.context.take(u64::from(n), 12).map_err(fail)?;
            return Ok(assemble(mode, n as usize, |i| i as u32));
        };
        if mode == TRIANGLES && self.accessors.count(index)? % 3 != 0 {
            let text = "the indices do not make whole triangles: the rest is left";
            self.said.warn(format!("accessor {index}"), text);
        }
        let flat = self.accessors.integers::<1>(index, None).map_err(|e| of(e, "indices"))?;
        let largest = flat.iter().fold(0, |m, i| m.max(i[0]));
        if u64::from(largest) >= vertices && !flat.is_empty() {
            // The largest number of each width restarts strips in some interfaces; glTF forbids it, so it is wrong too.
            let what = format!("has the index {largest} of {vertices} vertices");
            return Err(of(ReadError::new(format!("accessor {index}"), what), "indices"));
        }
        if mode == TRIANGLES {
            return Ok(whole_triangles(flat));
        }
        self.context.take(flat.len() as u64, 12).map_err(fail)?;
        Ok(assemble(mode, flat.len(), |i| flat[i][0]))
    }
}

/// Many primitives may share one large list of vertices: one that uses less than half of it gets the used ones only,
/// and its indices are changed.
fn compact(triangles: &mut [[u32; 3]], vertices: u64) -> Option<Vec<u32>> {
    let flat = triangles.as_flattened_mut();
    if flat.len() as u64 >= vertices / 2 {
        return None;
    }
    let mut used = flat.to_vec();
    used.sort_unstable();
    used.dedup();
    for index in flat {
        // Every index is in the list, so the place is found.
        *index = used.partition_point(|u| u < index) as u32;
    }
    Some(used)
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
pub(super) fn of(e: ReadError, role: &str) -> ReadError {
    ReadError { place: format!("{} ({role})", e.place).trim_start().into(), ..e }
}
