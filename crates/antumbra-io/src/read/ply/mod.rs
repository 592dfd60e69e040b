//! PLY, ASCII and binary of either byte order (G. Turk, "The PLY Polygon File Format", 1994).

mod faces;
mod header;
mod numbers;
mod vertices;

use antumbra::scene::{Material, Mesh, SceneBuilder};
use antumbra_math::Rgb;

use faces::Faces;
use header::{Element, Encoding, Header};
use numbers::Numbers;

use super::polygon::Triangulator;
use super::{Context, Counted, GREY};
use crate::error::ReadError;

const CUT: &str = "The file is cut short, or its exporter is wrong.";

/// Reads a `.ply`.
pub(super) fn read(bytes: &[u8], context: &Context) -> Result<SceneBuilder, ReadError> {
    let header = header::read(bytes, context.limits)?;
    let (mut scene, mut said) = (SceneBuilder::default(), Counted::default());
    let (mesh, _) = body(&header, bytes, context, (&mut said, None))?;
    if mesh.triangles.indices.is_empty() {
        let hint = "Point clouds have no surface; make a mesh of them first.";
        return Err(ReadError::new("", "there is nothing to render: no faces").hint(hint));
    }
    let albedo = if mesh.colors.is_some() { 1.0 } else { GREY };
    let material = scene.material(Material::diffuse(Rgb::grey(albedo)));
    let id = scene.mesh(mesh);
    scene.place("", id, material, context.root);
    let encoding = match header.encoding {
        Encoding::Ascii => "ASCII",
        Encoding::Little => "binary, little endian",
        Encoding::Big => "binary, big endian",
    };
    scene.source = format!("PLY, {encoding}");
    scene.sky_if_unlit = true;
    said.into_scene(&mut scene);
    Ok(scene)
}

/// The mesh of a `.ply` that another format names.
pub(super) fn mesh_of(bytes: &[u8], context: &Context, said: &mut Counted) -> Result<Mesh, ReadError> {
    Ok(body(&header::read(bytes, context.limits)?, bytes, context, (said, None))?.0)
}

/// The same with the colours of an attribute, `vertex_NAME` or `face_NAME`: those of faces apart, one a triangle.
pub(super) fn painted(
    bytes: &[u8],
    context: &Context,
    said: &mut Counted,
    attribute: &str,
) -> Result<(Mesh, Vec<[f32; 4]>), ReadError> {
    body(&header::read(bytes, context.limits)?, bytes, context, (said, Some(attribute)))
}

fn body(
    header: &Header,
    bytes: &[u8],
    context: &Context,
    (said, attribute): (&mut Counted, Option<&str>),
) -> Result<(Mesh, Vec<[f32; 4]>), ReadError> {
    let mut cutter = Triangulator::new();
    let (mesh, Faces { small, colors, .. }) = mesh(header, bytes, context, &mut cutter, attribute)?;
    if small > 0 {
        said.warn("faces", format!("{small} with less than three corners are not drawn"));
    }
    if cutter.gave_up() {
        said.warn("faces", super::INTRICATE);
    }
    Ok((mesh, colors))
}

/// The mesh, and what its faces were besides. What follows the faces is not looked at.
fn mesh(
    header: &Header,
    bytes: &[u8],
    context: &Context,
    cutter: &mut Triangulator,
    attribute: Option<&str>,
) -> Result<(Mesh, Faces), ReadError> {
    let part = |of: &str| attribute.and_then(|a| a.strip_prefix(of)?.strip_prefix('_'));
    // Without an attribute, colours by their usual names; with one of faces, none.
    let vertex = attribute.map(|_| part("vertex").unwrap_or(""));
    let mut numbers = Numbers::new(&bytes[header.data..], header.encoding);
    let mut mesh: Option<Mesh> = None;
    let count = |name: &str| header.elements.iter().find(|e| e.name == name).map_or(0, |e| e.count as u64);
    // Corners, and a triangle of each face at least.
    let places = count("vertex").saturating_add(count("face"));
    context.forecast.part(places.saturating_mul(12), count("face"))?;
    for e in &header.elements {
        let fail = |what: String| ReadError::new(format!("element {}", e.name), what).hint(CUT);
        context.take(e.count as u64, 8 * e.properties.len() as u64 + 48).map_err(fail)?;
        match (e.name.as_str(), &mut mesh) {
            ("vertex", None) => {
                mesh = Some(vertices::read(e, header.encoding, &mut numbers, vertex).map_err(fail)?)
            }
            ("face", Some(mesh)) => {
                let limit = context.limits.corners;
                let vertices = &mesh.triangles.vertices;
                let place = faces::Place { encoding: header.encoding, vertices, corners: limit };
                let mut faces = faces::read(e, &mut numbers, &place, cutter, part("face")).map_err(fail)?;
                mesh.triangles.indices = std::mem::take(&mut faces.triangles);
                return Ok((std::mem::take(mesh), faces));
            }
            ("face", None) => return Err(fail("stands before the vertices".into())),
            _ => skip(e, header.encoding, &mut numbers).map_err(fail)?,
        }
    }
    mesh.map(|m| (m, Faces::default())).ok_or_else(|| ReadError::new("header", "there is no element vertex"))
}

/// Passes over an element that is not asked for.
fn skip(e: &Element, encoding: Encoding, numbers: &mut Numbers) -> Result<(), String> {
    if encoding != Encoding::Ascii
        && let Some(row) = e.row()
    {
        return numbers.bytes(e.count.saturating_mul(row)).map(drop);
    }
    for p in (0..e.count).flat_map(|_| &e.properties) {
        let n = p.length.map_or(Ok(1), |length| numbers.integer(length))?;
        (0..n).try_for_each(|_| numbers.float(p.kind).map(drop))?;
    }
    Ok(())
}
