//! Which extensions are read, which only touch looks, and which would hide geometry.

use super::document::Document;
use super::{draco, meshopt};
use crate::error::ReadError;
use crate::read::Counted;

/// Read in full, or read through the fallback that the file brings.
const READ: &[&str] = &[
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_variants",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
    "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",
    // A texture that uses it says what is shown in its place.
    "KHR_texture_basisu",
    draco::NAME,
    meshopt::NAMES[0],
    meshopt::NAMES[1],
];

/// They carry nothing that light would meet.
const NOTHING_TO_SEE: &[&str] =
    &["KHR_xmp", "KHR_xmp_json_ld", "KHR_animation_pointer", "KHR_node_hoverability"];

/// They touch pictures and lights of a kind that can be left out.
const LOOKS: &[&str] = &[
    "MSFT_texture_dds",
    "EXT_texture_avif",
    "EXT_lights_image_based",
    "EXT_lights_ies",
    "MSFT_packing_occlusionRoughnessMetallic",
    "MSFT_packing_normalRoughnessMetallic",
];

fn only_looks(name: &str) -> bool {
    LOOKS.contains(&name) || name.contains("_materials_")
}

/// Refuses what would hide geometry; names once what is left out (materials speak for themselves when they are used).
pub(super) fn check(doc: &Document, said: &mut Counted) -> Result<(), ReadError> {
    for name in &doc.extensions_required {
        let name = name.as_str();
        if READ.contains(&name) || NOTHING_TO_SEE.contains(&name) || only_looks(name) {
            continue;
        }
        let error = ReadError::new(
            "extensionsRequired",
            format!("the file needs {name}, which antumbra does not have: its geometry cannot be read"),
        );
        return Err(error.hint(advice(name)));
    }
    let mut named: Vec<&str> =
        doc.extensions_used.iter().chain(&doc.extensions_required).map(String::as_str).collect();
    named.sort_unstable();
    named.dedup();
    for name in named {
        // Material extensions are named with their materials.
        if !READ.contains(&name) && !NOTHING_TO_SEE.contains(&name) && !name.contains("_materials_") {
            said.warn("extensionsUsed", format!("{name} is not read: the scene is drawn without it"));
        }
    }
    Ok(())
}

/// What a person can do about geometry that cannot be read.
pub(super) fn advice(name: &str) -> &'static str {
    if name == draco::NAME {
        "`pip install \"antumbra[draco]\"` brings its decoder; or write the file without compression:\n\
         `npx @gltf-transform/cli copy IN.glb OUT.glb` unpacks it."
    } else {
        "Export the scene again without this extension."
    }
}
