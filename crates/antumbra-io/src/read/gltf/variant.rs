//! KHR_materials_variants: other materials for the same primitives, chosen by a name.

use serde::Deserialize;

use super::Reader;
use super::document::{Document, Primitive};
use crate::error::ReadError;

const NAME: &str = "KHR_materials_variants";

/// Which material a primitive has in some variants.
#[derive(Deserialize)]
struct Mapping {
    material: usize,
    variants: Vec<usize>,
}

/// The names of the variants that the file has.
pub(super) fn names(doc: &Document) -> Vec<String> {
    let list = doc.extensions.get(NAME).and_then(|e| e.get("variants")?.as_array());
    let name = |v: &serde_json::Value| v.get("name").and_then(|n| n.as_str()).unwrap_or_default().to_string();
    list.map_or(Vec::new(), |l| l.iter().map(name).collect())
}

/// The index of the variant of a name.
pub(super) fn find(doc: &Document, wanted: Option<&str>) -> Result<Option<usize>, ReadError> {
    let Some(wanted) = wanted else { return Ok(None) };
    let names = names(doc);
    if names.is_empty() {
        let what = format!("the variant \"{wanted}\" is asked for; the file has no variants");
        return Err(ReadError::new(NAME, what).hint("Leave the option away."));
    }
    let found = names.iter().position(|n| n == wanted);
    found.map(Some).ok_or_else(|| {
        let what = format!("there is no variant \"{wanted}\"");
        ReadError::new(NAME, what).hint(format!("There are: {}.", names.join(", ")))
    })
}

impl Reader<'_> {
    /// The material of a primitive in the variant that is wanted.
    pub(super) fn wanted(&self, p: &Primitive) -> Option<usize> {
        let mapped = self.variant.and_then(|wanted| {
            let mappings = p.extensions.get(NAME)?.get("mappings")?;
            let mappings = Vec::<Mapping>::deserialize(mappings).ok()?;
            mappings.iter().find(|m| m.variants.contains(&wanted)).map(|m| m.material)
        });
        mapped.or(p.material)
    }
}
