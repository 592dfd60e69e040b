//! KHR_draco_mesh_compression: primitives that are unpacked by a decoder which the caller brings.

use std::collections::{BTreeMap, HashMap};

use serde::Deserialize;

use super::document::{Document, Primitive};
use super::extensions::advice;
use crate::error::ReadError;
use crate::read::Context;

pub(super) const NAME: &str = "KHR_draco_mesh_compression";

/// An attribute that is wanted of a Draco mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DracoAttribute {
    /// Its number in the mesh.
    pub id: u32,
    /// The type that its numbers shall have, as glTF numbers them (5120 i8, 5121 u8, 5122 i16, 5123 u16, 5125 u32, 5126 f32).
    pub component: u32,
}

/// A Draco mesh as the decoder gives it back.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DracoMesh {
    /// Three a triangle.
    pub indices: Vec<u32>,
    /// The bytes of each attribute that was wanted, little endian, vertex after vertex.
    pub attributes: Vec<Vec<u8>>,
}

/// Why there is no mesh.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DracoError {
    /// The library of the decoder is not installed.
    Missing,
    /// What the library says about the bytes.
    Broken(String),
}

/// Unpacks the bytes of one primitive.
pub type DracoDecoder = fn(&[u8], &[DracoAttribute]) -> Result<DracoMesh, DracoError>;

/// What the extension says of a primitive.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Packed {
    buffer_view: usize,
    attributes: BTreeMap<String, u32>,
}

/// The bytes of the accessors of all packed primitives; those that bring plain bytes for other readers are left to them.
pub(super) fn unpack<'a>(
    doc: &Document,
    view: impl Fn(usize) -> Result<&'a [u8], String>,
    context: &Context,
) -> Result<HashMap<usize, Vec<u8>>, ReadError> {
    let mut done = HashMap::new();
    for (m, mesh) in doc.meshes.iter().enumerate() {
        for primitive in &mesh.primitives {
            let place = || format!("mesh {}", super::material::named(m, &mesh.name));
            let Some(value) = primitive.extensions.get(NAME) else { continue };
            let fail = |what: String| ReadError::new(place(), format!("{NAME}: {what}")).hint(advice(NAME));
            let packed = Packed::deserialize(value).map_err(|e| fail(e.to_string()))?;
            if !is_plain(doc, primitive) {
                let data = view(packed.buffer_view).map_err(fail)?;
                one(doc, primitive, &packed, data, context, &mut done).map_err(fail)?;
            }
        }
    }
    Ok(done)
}

/// The primitive has its vertices in plain bytes too.
fn is_plain(doc: &Document, p: &Primitive) -> bool {
    let position = p.attributes.get("POSITION").and_then(|i| doc.accessors.get(*i));
    position.is_some_and(|a| a.buffer_view.is_some())
}

fn one(
    doc: &Document,
    p: &Primitive,
    packed: &Packed,
    data: &[u8],
    context: &Context,
    done: &mut HashMap<usize, Vec<u8>>,
) -> Result<(), String> {
    let decode = context.draco.ok_or("this geometry is packed, and no decoder is there")?;
    let accessor = |i: usize| doc.accessors.get(i).ok_or(format!("accessor {i} is named; there is none"));
    let mut wanted = Vec::new();
    for (name, id) in &packed.attributes {
        let Some(&index) = p.attributes.get(name) else { continue };
        let a = accessor(index)?;
        let size = super::accessor::element_size(a).ok_or(format!("accessor {index} is of no known type"))?;
        context.take(a.count, size as u64)?;
        let attribute = DracoAttribute { id: *id, component: a.component_type };
        wanted.push((index, a.count as usize * size, attribute));
    }
    let asked: Vec<_> = wanted.iter().map(|w| w.2).collect();
    let mesh = decode(data, &asked).map_err(|e| match e {
        DracoError::Missing => "this geometry is packed, and its decoder is not installed".to_string(),
        DracoError::Broken(why) => format!("the packed data are broken ({why})"),
    })?;
    for ((index, needed, _), bytes) in wanted.into_iter().zip(mesh.attributes) {
        if bytes.len() != needed {
            return Err(format!("accessor {index} needs {needed} bytes; {} were packed", bytes.len()));
        }
        done.insert(index, bytes);
    }
    if let Some(index) = p.indices {
        let a = accessor(index)?;
        if a.count != mesh.indices.len() as u64 {
            return Err(format!(
                "accessor {index} has {} indices; {} were packed",
                a.count,
                mesh.indices.len()
            ));
        }
        let size = super::accessor::element_size(a).unwrap_or(0);
        let fits = |i: &u32| size == 4 || (*i >> (8 * size.max(1))) == 0;
        if !matches!(size, 1 | 2 | 4) || !mesh.indices.iter().all(fits) {
            return Err(format!("accessor {index} does not hold the indices that were packed"));
        }
        done.insert(
            index,
            mesh.indices.iter().flat_map(|i| i.to_le_bytes().into_iter().take(size)).collect(),
        );
    }
    Ok(())
}
