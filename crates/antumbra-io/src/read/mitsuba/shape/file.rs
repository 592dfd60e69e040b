//! Meshes of files: PLY and OBJ, with the normals that Mitsuba gives them.

use antumbra::scene::Mesh;
use antumbra_trace::Triangles;

use super::super::Reader;
use super::super::document::Element;
use super::{Body, Placing};
use crate::error::ReadError;
use crate::read::tessellate::{face_the_normals, flip, smooth};
use crate::read::{Context, Counted, obj, ply};

/// A mesh with the colours of its faces, one a triangle or none.
pub(super) type Painted = (Mesh, Vec<[f32; 4]>);

/// Reads the one mesh of a file.
pub(super) type Decode<'d> = &'d dyn Fn(&[u8], &Context, &mut Counted) -> Result<Painted, ReadError>;

/// How the mesh of a file is dressed.
pub(super) struct Dress {
    face_normals: bool,
    flip_normals: bool,
    flip_tex_coords: bool,
    /// Its own transform mirrors it.
    mirrored: bool,
    /// The attribute that its look shows.
    attribute: Option<String>,
}

/// `ply`.
pub(super) fn ply<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    at: &Placing,
) -> Result<Body, ReadError> {
    let attribute = at.attribute.as_deref().unwrap_or("");
    let decode = |bytes: &[u8], context: &Context, said: &mut Counted| match attribute {
        "" => Ok((ply::mesh_of(bytes, context, said)?, Vec::new())),
        _ => ply::painted(bytes, context, said, attribute),
    };
    from_file(reader, element, at, &decode, false)
}

/// `obj`: one mesh, whatever groups and materials the file has.
pub(super) fn obj<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    at: &Placing,
) -> Result<Body, ReadError> {
    let decode = |bytes: &[u8], context: &Context, said: &mut Counted| {
        Ok((obj::mesh_of(bytes, context, said)?, Vec::new()))
    };
    from_file(reader, element, at, &decode, true)
}

fn from_file<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    at: &Placing,
    decode: Decode,
    upwards: bool,
) -> Result<Body, ReadError> {
    let dress = Dress::of(element, at, upwards)?;
    let name = element.filename()?;
    let key = format!("file {} {} {name}", element.plugin(), dress.words());
    let mesh = reader.mesh(key, |reader| {
        let bytes = reader.open(name);
        let bytes = bytes.map_err(|e| element.at.error(format!("the file \"{name}\": {e}")))?;
        reader.context.grant_file(name, bytes.len() as u64);
        dressed(reader, element, &bytes, &dress, decode)
    })?;
    Ok(Body::Mesh(mesh, at.world))
}

/// The mesh of a file's bytes, dressed.
pub(super) fn dressed<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    bytes: &[u8],
    dress: &Dress,
    decode: Decode,
) -> Result<Mesh, ReadError> {
    let name = element.filename()?;
    let mut said = Counted::default();
    let (mut mesh, faces) = decode(bytes, reader.context, &mut said).map_err(|e| {
        let colon = if e.place.is_empty() { "" } else { ": " };
        ReadError { place: format!("{}: {name}{colon}{}", element.at.words(), e.place), ..e }
    })?;
    reader.said.take_from(said, &format!("{}: {name}", element.at.words()));
    mesh.name = super::name(element);
    // Mitsuba shows the colours of vertices through a texture of their own only.
    if dress.attribute.is_none() {
        mesh.colors = None;
    }
    dress.put_on(&mut mesh);
    if faces.is_empty() {
        return Ok(mesh);
    }
    reader.context.take(faces.len() as u64, 3 * 48).map_err(|what| element.at.error(what))?;
    Ok(apart(&mesh, &faces))
}

/// Each triangle with corners of its own, of the colour of its face.
fn apart(mesh: &Mesh, faces: &[[f32; 4]]) -> Mesh {
    let corners: Vec<usize> = mesh.triangles.indices.iter().flatten().map(|i| *i as usize).collect();
    let at = |i: &usize| mesh.triangles.vertices[*i];
    let vertices: Vec<_> = corners.iter().map(at).collect();
    let indices = (0..corners.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Mesh {
        name: mesh.name.clone(),
        triangles: Triangles { vertices, indices },
        normals: mesh.normals.as_ref().map(|all| corners.iter().map(|i| all[*i]).collect()),
        uvs: [mesh.uvs[0].as_ref().map(|all| corners.iter().map(|i| all[*i]).collect()), None],
        colors: Some(faces.iter().flat_map(|color| [*color; 3]).collect()),
        tangents: None,
    }
}

impl Dress {
    /// What an element asks for; `upwards`: v grows upwards in the file.
    pub(super) fn of(element: &Element, at: &Placing, upwards: bool) -> Result<Dress, ReadError> {
        Ok(Dress {
            face_normals: element.boolean("face_normals", false)?,
            flip_normals: element.boolean("flip_normals", false)?,
            flip_tex_coords: element.boolean("flip_tex_coords", upwards)?,
            mirrored: at.mirrored,
            attribute: at.attribute.clone(),
        })
    }

    /// Tells it from others.
    pub(super) fn words(&self) -> String {
        let flags = [self.face_normals, self.flip_normals, self.flip_tex_coords, self.mirrored];
        format!("{flags:?} {:?}", self.attribute)
    }

    fn put_on(&self, mesh: &mut Mesh) {
        if self.face_normals {
            mesh.normals = None;
        }
        let given = mesh.normals.is_some();
        if given {
            face_the_normals(mesh);
        } else if !self.face_normals {
            mesh.normals = Some(smooth(mesh));
        }
        // The scene keeps the outside of a mirrored mesh outside; Mitsuba only does so where the file gives normals.
        if self.flip_normals != (self.mirrored && !given) {
            flip(mesh);
        }
        if self.flip_tex_coords {
            mesh.uvs[0].iter_mut().flatten().for_each(|uv| uv[1] = 1.0 - uv[1]);
        }
    }
}
