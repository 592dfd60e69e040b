//! The vertices of a PLY: positions, and normals, colours, texture coordinates where they are.

use antumbra::scene::Mesh;

use super::header::{Element, Encoding, Kind};
use super::numbers::{Numbers, value};
use crate::srgb;

/// A property of a row: its type and where it lies in the row.
#[derive(Clone, Copy)]
struct Column {
    kind: Kind,
    offset: usize,
}

/// Rows of numbers of equal length, in bytes.
struct Table<'a> {
    rows: &'a [u8],
    row: usize,
    big: bool,
}

/// Reads the vertices into a mesh; its colours are those of an attribute if one is asked for.
pub(super) fn read(
    e: &Element,
    encoding: Encoding,
    numbers: &mut Numbers,
    colors: Option<&str>,
) -> Result<Mesh, String> {
    if encoding != Encoding::Ascii
        && let Some(row) = e.row()
    {
        let rows = numbers.bytes(e.count.saturating_mul(row))?;
        return mesh(e, &Table { rows, row, big: encoding == Encoding::Big }, colors);
    }
    // Texts and rows with lists are first brought into rows of f64.
    let mut rows = Vec::with_capacity(e.count * e.properties.len() * 8);
    for _ in 0..e.count {
        for p in &e.properties {
            let number = match p.length {
                None => numbers.float(p.kind)?,
                Some(length) => {
                    (0..numbers.integer(length)?).try_for_each(|_| numbers.float(p.kind).map(drop))?;
                    0.0
                }
            };
            rows.extend_from_slice(&number.to_le_bytes());
        }
    }
    mesh(e, &Table { rows: &rows, row: 0, big: false }, colors)
}

/// `row` 0 stands for rows of f64, whatever the types of the file.
fn mesh(e: &Element, table: &Table, attribute: Option<&str>) -> Result<Mesh, String> {
    let as_doubles = table.row == 0;
    let row = if as_doubles { 8 * e.properties.len() } else { table.row };
    let table = Table { row, ..*table };
    let at = |i: usize| {
        let offset = |p: &super::header::Property| if as_doubles { 8 } else { p.kind.size() };
        let kind = if as_doubles { Kind::F64 } else { e.properties[i].kind };
        Column { kind, offset: e.properties[..i].iter().map(offset).sum() }
    };
    let column = |names: &[&str]| {
        let i = e.find(names).filter(|i| e.properties[*i].length.is_none())?;
        Some(at(i))
    };
    let (Some(x), Some(y), Some(z)) = (column(&["x"]), column(&["y"]), column(&["z"])) else {
        return Err("has no x, y and z".into());
    };
    let mut mesh = Mesh::default();
    mesh.triangles.vertices = table.gather([x, y, z]);
    let normal = [column(&["nx", "normal_x"]), column(&["ny", "normal_y"]), column(&["nz", "normal_z"])];
    if let [Some(x), Some(y), Some(z)] = normal {
        mesh.normals = Some(table.gather([x, y, z]));
    }
    let u = column(&["s", "u", "texture_u", "texture_s", "s0"]);
    let v = column(&["t", "v", "texture_v", "texture_t", "t0"]);
    if let (Some(u), Some(v)) = (u, v) {
        mesh.uvs[0] = Some(table.gather([u, v]));
    }
    if let Some(found) = e.colors(attribute) {
        let kind = e.properties[found[0]].kind;
        mesh.colors = Some(colors(&table.gather(found.map(at)), kind));
    }
    Ok(mesh)
}

/// Bytes and 16-bit numbers are screen colours (sRGB); floats are linear.
pub(super) fn colors(rgb: &[[f32; 3]], kind: Kind) -> Vec<[f32; 4]> {
    let full = match kind {
        Kind::U8 => 255.0,
        Kind::U16 => 65535.0,
        _ => return rgb.iter().map(|c| [c[0], c[1], c[2], 1.0]).collect(),
    };
    let linear = |c: f32| srgb::decode(f64::from(c / full));
    rgb.iter().map(|c| [linear(c[0]), linear(c[1]), linear(c[2]), 1.0]).collect()
}

impl Table<'_> {
    /// N columns as f32. Floats that lie together are copied, others converted one by one.
    fn gather<const N: usize>(&self, columns: [Column; N]) -> Vec<[f32; N]>
    where
        [f32; N]: bytemuck::Pod,
    {
        let first = columns[0].offset;
        let together = |(i, c): (usize, &Column)| c.kind == Kind::F32 && c.offset == first + 4 * i;
        if !self.big && columns.iter().enumerate().all(together) {
            if self.row == 4 * N {
                return bytemuck::pod_collect_to_vec(self.rows);
            }
            let at = |row: &[u8]| bytemuck::pod_read_unaligned(&row[first..first + 4 * N]);
            return self.rows.chunks_exact(self.row).map(at).collect();
        }
        let one =
            |row: &[u8], c: Column| value(&row[c.offset..c.offset + c.kind.size()], c.kind, self.big) as f32;
        self.rows.chunks_exact(self.row).map(|row| columns.map(|c| one(row, c))).collect()
    }
}
