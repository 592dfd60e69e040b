//! Meshes of files: PLY and OBJ, with the normals that Mitsuba gives them.

use antumbra::scene::Mesh;

use super::super::Reader;
use super::super::document::Element;
use super::{Body, Placing};
use crate::error::ReadError;
use crate::read::tessellate::{face_the_normals, flip, smooth};
use crate::read::{Context, Counted, obj, ply};

/// Reads the one mesh of a file.
type Decode = fn(&[u8], &Context, &mut Counted) -> Result<Mesh, ReadError>;

/// How the mesh of a file is dressed.
struct Dress {
    face_normals: bool,
    flip_normals: bool,
    flip_tex_coords: bool,
    /// The world mirrors it.
    mirrored: bool,
}

/// `ply`.
pub(super) fn ply<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    at: &Placing,
) -> Result<Body, ReadError> {
    from_file(reader, element, at, ply::mesh_of, false)
}

/// `obj`: one mesh, whatever groups and materials the file has.
pub(super) fn obj<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    at: &Placing,
) -> Result<Body, ReadError> {
    from_file(reader, element, at, obj::mesh_of, true)
}

fn from_file<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    at: &Placing,
    decode: Decode,
    upwards: bool,
) -> Result<Body, ReadError> {
    let dress = Dress {
        face_normals: element.boolean("face_normals", false)?,
        flip_normals: element.boolean("flip_normals", false)?,
        flip_tex_coords: element.boolean("flip_tex_coords", upwards)?,
        mirrored: at.world.mirrors(),
    };
    let name = element.filename()?;
    let flags = [dress.face_normals, dress.flip_normals, dress.flip_tex_coords, dress.mirrored];
    let key = format!("file {} {flags:?} {name}", element.plugin());
    let mesh = reader.mesh(key, |reader| {
        let bytes = reader.context.files.open(name);
        let bytes = bytes.map_err(|e| element.at.error(format!("the file \"{name}\": {e}")))?;
        reader.context.grant(bytes.len() as u64);
        let mut said = Counted::default();
        let mut mesh = decode(&bytes, reader.context, &mut said).map_err(|e| {
            let colon = if e.place.is_empty() { "" } else { ": " };
            ReadError { place: format!("{}: {name}{colon}{}", element.at.words(), e.place), ..e }
        })?;
        reader.said.take_from(said, &format!("{}: {name}", element.at.words()));
        mesh.name = super::name(element);
        // Mitsuba shows the colours of vertices through a texture of their own only.
        mesh.colors = None;
        dress.put_on(&mut mesh);
        Ok(mesh)
    })?;
    Ok(Body::Mesh(mesh, at.world))
}

impl Dress {
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
