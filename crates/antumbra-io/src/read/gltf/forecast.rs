//! What the accessors of a document announce, before any of them is read.

use std::collections::BTreeSet;

use super::document::Document;
use super::node;
use crate::error::ReadError;
use crate::read::{Context, Counted};

/// Holds the meshes that the scene shows against the memory that it may take.
pub(super) fn tell(doc: &Document, context: &Context) -> Result<(), ReadError> {
    let placed = node::walk(doc, &context.root, &mut Counted::default())?;
    let meshes: BTreeSet<usize> = placed.iter().filter_map(|p| doc.nodes[p.node].mesh).collect();
    let count = |accessor: usize| doc.accessors.get(accessor).map_or(0, |a| a.count);
    for primitive in meshes.iter().filter_map(|m| doc.meshes.get(*m)).flat_map(|m| &m.primitives) {
        // Lines and points are not drawn.
        if primitive.mode.is_some_and(|mode| mode < 4) {
            continue;
        }
        let named = |(name, accessor): (&String, &usize)| count(*accessor).saturating_mul(size(name));
        let kept = primitive.attributes.iter().map(named).fold(0, u64::saturating_add);
        let corners = primitive.indices.or(primitive.attributes.get("POSITION").copied()).map_or(0, count);
        // Strips and fans have a triangle for each corner, lists one for each three.
        let triangles = if primitive.mode.unwrap_or(4) == 4 { corners / 3 } else { corners };
        context.forecast.part(kept.saturating_add(triangles.saturating_mul(12)), triangles)?;
    }
    Ok(())
}

/// Bytes that an element of an attribute takes once it is read.
fn size(attribute: &str) -> u64 {
    match attribute {
        "POSITION" | "NORMAL" => 12,
        "TEXCOORD_0" | "TEXCOORD_1" => 8,
        "COLOR_0" => 16,
        _ => 0,
    }
}
