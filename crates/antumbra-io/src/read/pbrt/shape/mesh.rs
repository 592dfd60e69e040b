//! trianglemesh, plymesh.

use antumbra::scene::Mesh;
use antumbra_trace::Triangles;

use super::super::Reader;
use super::super::parameters::Parameters;
use super::{Body, Placing};
use crate::error::ReadError;
use crate::read::tessellate::{face_the_normals, flip};
use crate::read::{Counted, ply};

/// Turned to the side that pbrt takes for its front: that of its normals, if it has some.
pub(super) fn turned(mut mesh: Mesh, reverse: bool) -> Mesh {
    face_the_normals(&mut mesh);
    if reverse {
        flip(&mut mesh);
    }
    mesh
}

/// Rows of N numbers.
pub(super) fn rows<const N: usize>(p: &Parameters, name: &str) -> Result<Option<Vec<[f32; N]>>, ReadError> {
    let Some(numbers) = p.list(name)? else { return Ok(None) };
    if !numbers.len().is_multiple_of(N) {
        let what = format!("\"{name}\" has {} numbers: not a multiple of {N}", numbers.len());
        return Err(p.error(what));
    }
    Ok(Some(numbers.chunks_exact(N).map(|c| std::array::from_fn(|i| c[i] as f32)).collect()))
}

/// Rows of N numbers, one for each of `count` vertices.
pub(super) fn attribute<const N: usize>(
    p: &Parameters,
    name: &str,
    count: usize,
) -> Result<Option<Vec<[f32; N]>>, ReadError> {
    let rows = rows::<N>(p, name)?;
    match &rows {
        Some(rows) if rows.len() != count => {
            Err(p.error(format!("\"{name}\" has {} entries, \"P\" has {count}", rows.len())))
        }
        _ => Ok(rows),
    }
}

/// Faces of N corners by `indices`, or the one face of N vertices.
pub(super) fn faces<const N: usize>(p: &Parameters, vertices: usize) -> Result<Vec<[u32; N]>, ReadError> {
    let Some(given) = p.list("indices")? else {
        return match vertices == N {
            true => Ok(vec![std::array::from_fn(|i| i as u32)]),
            false => Err(p.error("\"integer indices\" is missing")),
        };
    };
    if !given.len().is_multiple_of(N) {
        return Err(p.error(format!("\"indices\" has {} numbers: not a multiple of {N}", given.len())));
    }
    if let Some(wrong) = given.iter().find(|i| !(0.0..vertices as f64).contains(*i) || i.fract() != 0.0) {
        return Err(p.error(format!("\"indices\" holds {wrong}: \"P\" has {vertices} points")));
    }
    Ok(given.chunks_exact(N).map(|c| std::array::from_fn(|i| c[i] as u32)).collect())
}

/// `P`, `N`, `uv`, `indices`.
pub(super) fn trianglemesh(
    reader: &mut Reader,
    p: &Parameters,
    at: &Placing,
) -> Result<Option<Body>, ReadError> {
    p.pass_over(&["S", "faceIndices"]);
    let Some(vertices) = rows::<3>(p, "P")? else { return Err(p.error("\"point3 P\" is missing")) };
    let indices = faces::<3>(p, vertices.len())?;
    let normals = attribute::<3>(p, "N", vertices.len())?;
    let uvs = attribute::<2>(p, "uv", vertices.len())?;
    let uvs = if uvs.is_some() { uvs } else { attribute::<2>(p, "st", vertices.len())? };
    let mesh =
        Mesh { triangles: Triangles { vertices, indices }, normals, uvs: [uvs, None], ..Mesh::default() };
    Ok(reader.mesh(turned(mesh, at.reverse)))
}

/// The mesh of a file, read once.
pub(super) fn plymesh(reader: &mut Reader, p: &Parameters, at: &Placing) -> Result<Option<Body>, ReadError> {
    let Some(name) = p.text("filename")? else { return Err(p.error("\"string filename\" is missing")) };
    if p.has("displacement") {
        let what = format!("\"displacement\" of {} is not read: drawn as the file has it", p.words);
        reader.said.warn(p.at.words(), what);
        p.pass_over(&["displacement", "displacement.edgelength", "displacement.texture"]);
    }
    let key = format!("{} {name}", at.reverse);
    if let Some(id) = reader.shapes.meshes.get(&key) {
        return Ok(Some(Body::Mesh(*id)));
    }
    let bytes = reader.open(name).map_err(|why| p.error(format!("the file \"{name}\": {why}")))?;
    let mut said = Counted::default();
    let mesh = ply::mesh_of(&bytes, reader.context, &mut said).map_err(|e| {
        let colon = if e.place.is_empty() { "" } else { ": " };
        ReadError { place: format!("{}: {name}{colon}{}", p.at.words(), e.place), ..e }
    })?;
    reader.said.take_from(said, &format!("{}: {name}", p.at.words()));
    // pbrt does not look at colours of vertices.
    let mesh = Mesh { name: super::stem(name), colors: None, ..mesh };
    let body = reader.mesh(turned(mesh, at.reverse));
    if let Some(Body::Mesh(id)) = body {
        reader.shapes.meshes.insert(key, id);
    }
    Ok(body)
}
