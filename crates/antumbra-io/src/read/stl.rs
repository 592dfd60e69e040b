//! STL, binary and ASCII: triangles without shared vertices, flat.

use antumbra::scene::{Material, Mesh, SceneBuilder};
use antumbra_math::Rgb;
use antumbra_trace::Triangles;

use super::text::{float, plain, show, words};
use super::{Context, GREY};
use crate::error::ReadError;

const HEAD: usize = 84;
/// Normal, three corners, two bytes.
const RECORD: usize = 50;

/// Reads an `.stl`.
pub(super) fn read(bytes: &[u8], context: &Context) -> Result<SceneBuilder, ReadError> {
    if bytes.is_empty() {
        return Err(ReadError::new("", "the file is empty (0 bytes)"));
    }
    let mut scene = SceneBuilder::default();
    let (vertices, kind) = if is_binary(bytes) {
        (binary(bytes, context)?, "STL, binary")
    } else {
        (ascii(&plain(bytes), context)?, "STL, ASCII")
    };
    if vertices.is_empty() {
        let hint = "Check that the model was exported completely.";
        return Err(ReadError::new("", "there is nothing to render: no triangles").hint(hint));
    }
    let n = vertices.len() as u32;
    let indices = (0..n / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let material = scene.material(Material::diffuse(Rgb::grey(GREY)));
    let mesh = scene.mesh(Mesh { triangles: Triangles { vertices, indices }, ..Mesh::default() });
    scene.place("", mesh, material, context.root);
    scene.source = kind.into();
    scene.sky_if_unlit = true;
    Ok(scene)
}

fn announced(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEAD - 4..HEAD)?.try_into().ok().map(u32::from_le_bytes)?;
    usize::try_from(count).ok()
}

/// Many binary files begin with "solid" too: the announced count decides where it fits, else whether it looks like text.
fn is_binary(bytes: &[u8]) -> bool {
    let fits = announced(bytes).is_some_and(|n| HEAD + n * RECORD == bytes.len());
    let start = bytes.get(..bytes.len().min(512)).unwrap_or_default();
    let text = plain(start).trim_ascii_start().starts_with(b"solid") && !plain(start).contains(&0);
    fits || !text
}

fn binary(bytes: &[u8], context: &Context) -> Result<Vec<[f32; 3]>, ReadError> {
    let n = announced(bytes)
        .ok_or_else(|| ReadError::new("header", format!("ends after {} of {HEAD} bytes", bytes.len())))?;
    let records = bytes.get(HEAD..HEAD.saturating_add(n.saturating_mul(RECORD))).ok_or_else(|| {
        let (has, needs) = (bytes.len(), HEAD + n * RECORD);
        let what = format!("announces {n} triangles ({needs} bytes), the file has {has} bytes");
        ReadError::new("header", what).hint("The file is cut short, or its exporter is wrong.")
    })?;
    if n > u32::MAX as usize / 3 {
        return Err(ReadError::new("header", format!("{n} triangles are too many")));
    }
    context.forecast.part(48 * n as u64, n as u64)?;
    let mut vertices: Vec<[f32; 3]> = Vec::with_capacity(3 * n);
    for record in records.chunks_exact(RECORD) {
        vertices.extend_from_slice(&bytemuck::pod_read_unaligned::<[[f32; 3]; 3]>(&record[12..48]));
    }
    Ok(vertices)
}

fn ascii(text: &[u8], context: &Context) -> Result<Vec<[f32; 3]>, ReadError> {
    // A corner takes at least the bytes of "vertex 0 0 0".
    context.take(text.len() as u64 / 13, 12).map_err(|e| ReadError::new("", e))?;
    let mut vertices = Vec::new();
    let mut open = false;
    let mut words = words(text);
    let facet = |n: usize| format!("facet {}", n / 3 + 1);
    while let Some(word) = words.next() {
        match word {
            b"facet" => open = true,
            b"vertex" => {
                let mut p = [0.0; 3];
                for c in &mut p {
                    let Some(token) = words.next() else {
                        return Err(ReadError::new(facet(vertices.len()), "the file ends inside a corner"));
                    };
                    *c = float(token).ok_or_else(|| {
                        ReadError::new(facet(vertices.len()), format!("{} is not a number", show(token)))
                    })?;
                }
                vertices.push(p);
            }
            b"endfacet" => {
                if vertices.len() % 3 != 0 {
                    return Err(ReadError::new(facet(vertices.len()), "does not have three corners"));
                }
                open = false;
            }
            _ => {}
        }
    }
    if open || vertices.len() % 3 != 0 {
        return Err(ReadError::new(facet(vertices.len()), "the file ends inside it"));
    }
    Ok(vertices)
}
