//! `serialized`: Mitsuba's own meshes, packed by zlib, versions 3 and 4, several in a file.

use std::io::Read;
use std::rc::Rc;

use antumbra::scene::Mesh;
use flate2::read::ZlibDecoder;

use super::super::Reader;
use super::super::document::Element;
use super::file::{Dress, dressed};
use super::{Body, Placing};
use crate::error::ReadError;
use crate::read::Context;

/// What a mesh has, bit by bit.
const NORMALS: u32 = 0x1;
const COORDINATES: u32 = 0x2;
const COLORS: u32 = 0x8;
const FACE_NORMALS: u32 = 0x10;
const DOUBLE: u32 = 0x2000;

/// The file that was read last.
#[derive(Default)]
pub(in super::super) struct Serialized {
    last: Option<(String, Rc<Vec<u8>>)>,
}

/// One mesh of a file, the first unless `shape_index` says otherwise.
pub(super) fn serialized<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    at: &Placing,
) -> Result<Body, ReadError> {
    let dress = Dress::of(element, at, false)?;
    let index = element.count("shape_index")?.unwrap_or(0);
    let name = element.filename()?;
    let key = format!("serialized {index} {} {name}", dress.words());
    let mesh = reader.mesh(key, |reader| {
        let bytes = reader
            .serialized_file(name)
            .map_err(|e| element.at.error(format!("the file \"{name}\": {e}")))?;
        let decode = |bytes: &[u8], context: &Context, _: &mut _| {
            let mesh = mesh(bytes, index, context).map(|mesh| (mesh, Vec::new()));
            mesh.map_err(|what| ReadError::new(format!("mesh {index}"), what))
        };
        let mut mesh = dressed(reader, element, &bytes, &dress, &decode)?;
        if at.attribute.as_deref() != Some("vertex_color") {
            mesh.colors = None;
        }
        Ok(mesh)
    })?;
    Ok(Body::Mesh(mesh, at.world))
}

impl Reader<'_> {
    /// The bytes of a file, which is opened once for all of its meshes.
    fn serialized_file(&mut self, name: &str) -> Result<Rc<Vec<u8>>, String> {
        if let Some((_, bytes)) = self.serialized.last.as_ref().filter(|last| last.0 == name) {
            return Ok(Rc::clone(bytes));
        }
        let bytes = Rc::new(self.open(name).map_err(|e| e.to_string())?);
        self.context.grant_file(name, bytes.len() as u64);
        self.serialized.last = Some((name.into(), Rc::clone(&bytes)));
        Ok(bytes)
    }
}

/// Mesh `index` of a file.
fn mesh(bytes: &[u8], index: u32, context: &Context) -> Result<Mesh, String> {
    let start = place(bytes, index)?;
    let head = bytes.get(start..).and_then(|b| b.first_chunk()).ok_or("the file is cut short")?;
    let version = version(head)?;
    let mut packed = Packed(ZlibDecoder::new(&bytes[start + 4..]));
    let [flags] = packed.numbers::<1>()?;
    if version == 4 {
        packed.name()?;
    }
    let [vertices, faces] = [packed.long()?, packed.long()?];
    let double = flags & DOUBLE != 0;
    let mut mesh = Mesh::default();
    mesh.triangles.vertices = packed.floats(vertices, double, context)?;
    if flags & NORMALS != 0 {
        mesh.normals = Some(packed.floats(vertices, double, context)?);
    }
    if flags & COORDINATES != 0 {
        mesh.uvs[0] = Some(packed.floats(vertices, double, context)?);
    }
    if flags & COLORS != 0 {
        // What Mitsuba calls vertex_color.
        let colors: Vec<[f32; 3]> = packed.floats(vertices, double, context)?;
        mesh.colors = Some(colors.iter().map(|[r, g, b]| [*r, *g, *b, 1.0]).collect());
    }
    if flags & FACE_NORMALS != 0 {
        mesh.normals = None;
    }
    context.take(faces, 12)?;
    mesh.triangles.indices = packed.rows(faces, |b: [[u8; 4]; 3]| b.map(u32::from_le_bytes))?;
    match mesh.triangles.indices.iter().flatten().find(|i| u64::from(**i) >= vertices) {
        Some(i) => Err(format!("a triangle names vertex {i} of {vertices}")),
        None => Ok(mesh),
    }
}

/// Two bytes that tell the format, two of its version.
fn version(head: &[u8; 4]) -> Result<u16, String> {
    match [[head[0], head[1]], [head[2], head[3]]].map(u16::from_le_bytes) {
        [0x041c, version @ (3 | 4)] => Ok(version),
        [0x041c, version] => Err(format!("version {version} of the format: 3 and 4 are read")),
        _ => Err("it does not begin like a mesh of Mitsuba".into()),
    }
}

/// Where mesh `index` begins: the file ends with the place of each, and how many there are.
fn place(bytes: &[u8], index: u32) -> Result<usize, String> {
    const CUT: &str = "the file is cut short";
    let version = version(bytes.first_chunk().ok_or(CUT)?)?;
    if index == 0 {
        return Ok(0);
    }
    let (rest, count) = bytes.split_last_chunk().ok_or(CUT)?;
    let count = u32::from_le_bytes(*count);
    if index >= count {
        return Err(format!("there is no such mesh: the file has {count}"));
    }
    let width = if version == 4 { 8 } else { 4 };
    let back = width * (count - index) as usize;
    let field = rest.len().checked_sub(back).map(|from| &rest[from..from + width]).ok_or(CUT)?;
    let start = field.iter().rev().fold(0, |sum, byte| sum << 8 | u64::from(*byte));
    usize::try_from(start).ok().filter(|start| *start < rest.len()).ok_or_else(|| CUT.into())
}

/// What zlib unpacks, asked for piece by piece.
struct Packed<'b>(ZlibDecoder<&'b [u8]>);

impl Packed<'_> {
    fn bytes(&mut self, into: &mut [u8]) -> Result<(), String> {
        self.0.read_exact(into).map_err(|e| format!("it cannot be unpacked ({e})"))
    }

    fn numbers<const N: usize>(&mut self) -> Result<[u32; N], String> {
        let mut four = [[0; 4]; N];
        self.bytes(four.as_flattened_mut())?;
        Ok(four.map(u32::from_le_bytes))
    }

    fn long(&mut self) -> Result<u64, String> {
        let [low, high] = self.numbers::<2>()?;
        Ok(u64::from(high) << 32 | u64::from(low))
    }

    /// A name, which a zero ends.
    fn name(&mut self) -> Result<(), String> {
        for _ in 0..1 << 16 {
            let mut byte = [0];
            self.bytes(&mut byte)?;
            if byte == [0] {
                return Ok(());
            }
        }
        Err("its name does not end".into())
    }

    /// Rows of N floats.
    fn floats<const N: usize>(
        &mut self,
        count: u64,
        double: bool,
        context: &Context,
    ) -> Result<Vec<[f32; N]>, String> {
        context.take(count, 4 * N as u64)?;
        match double {
            true => self.rows(count, |b: [[u8; 8]; N]| b.map(|b| f64::from_le_bytes(b) as f32)),
            false => self.rows(count, |b: [[u8; 4]; N]| b.map(f32::from_le_bytes)),
        }
    }

    /// Rows of N numbers of `W` bytes; no more room is taken than what is there fills.
    fn rows<const N: usize, const W: usize, T>(
        &mut self,
        count: u64,
        row: impl Fn([[u8; W]; N]) -> T,
    ) -> Result<Vec<T>, String> {
        let mut rows = Vec::new();
        let mut buffer = [[[0; W]; N]; 512];
        let mut left = count;
        while left > 0 {
            let now = left.min(buffer.len() as u64) as usize;
            self.bytes(buffer[..now].as_flattened_mut().as_flattened_mut())?;
            rows.extend(buffer[..now].iter().map(|r| row(*r)));
            left -= now as u64;
        }
        Ok(rows)
    }
}
