//! The faces of a PLY: polygons of any size, cut into triangles.

use super::header::{Element, Encoding, Kind};
use super::numbers::Numbers;
use super::vertices::colors;
use crate::read::polygon::Triangulator;

/// What was read.
#[derive(Default)]
pub(super) struct Faces {
    pub triangles: Vec<[u32; 3]>,
    /// Faces with less than three corners.
    pub small: usize,
    /// A colour a triangle, where one was asked for.
    pub colors: Vec<[f32; 4]>,
}

/// What faces need to know of their file.
pub(super) struct Place<'v> {
    pub encoding: Encoding,
    pub vertices: &'v [[f32; 3]],
    /// Corners that a face may have.
    pub corners: usize,
}

const NAMES: &[&str] = &["vertex_indices", "vertex_index"];

/// Reads the faces; every index is below the number of vertices. `attribute`: the colour of faces to read.
pub(super) fn read(
    e: &Element,
    numbers: &mut Numbers,
    &Place { encoding, vertices, corners }: &Place,
    cutter: &mut Triangulator,
    attribute: Option<&str>,
) -> Result<Faces, String> {
    let Some(list) = e.find(NAMES).filter(|i| e.properties[*i].length.is_some()) else {
        return Err("has no list vertex_indices".into());
    };
    if let Some(faces) = all_triangles(e, encoding, numbers, vertices.len())? {
        return Ok(faces);
    }
    let mut faces = Faces { triangles: Vec::with_capacity(e.count), ..Faces::default() };
    let mut polygon = Vec::new();
    let painted = attribute.and_then(|name| e.colors(Some(name)));
    for row in 0..e.count {
        let mut color = [0.0; 3];
        for (i, p) in e.properties.iter().enumerate() {
            let Some(length) = p.length else {
                let number = numbers.float(p.kind)? as f32;
                let component = painted.and_then(|found| found.iter().position(|at| *at == i));
                component.into_iter().for_each(|c| color[c] = number);
                continue;
            };
            let n = numbers.integer(length)? as usize;
            if n > numbers.left() || n > corners {
                return Err(format!("face {row} announces {n} corners"));
            }
            if i != list {
                (0..n).try_for_each(|_| numbers.float(p.kind).map(drop))?;
                continue;
            }
            polygon.clear();
            for _ in 0..n {
                let index = numbers.integer(p.kind).map_err(|e| format!("face {row}: {e}"))?;
                if index as usize >= vertices.len() {
                    return Err(format!("face {row} has the index {index} of {} vertices", vertices.len()));
                }
                polygon.push(index);
            }
            faces.small += usize::from(n < 3);
            let place = |i: usize| vertices[polygon[i] as usize];
            cutter.cut(n, place, |t| faces.triangles.push(t.map(|i| polygon[i])));
        }
        if let Some(found) = painted {
            let [color] = colors(&[color], e.properties[found[0]].kind)[..] else { continue };
            faces.colors.resize(faces.triangles.len(), color);
        }
    }
    Ok(faces)
}

/// The common case at full speed: nothing but triangles with 32-bit indices in the order of this machine.
fn all_triangles(
    e: &Element,
    encoding: Encoding,
    numbers: &mut Numbers,
    vertices: usize,
) -> Result<Option<Faces>, String> {
    let [p] = &e.properties[..] else { return Ok(None) };
    let plain = p.length == Some(Kind::U8) && matches!(p.kind, Kind::I32 | Kind::U32);
    let Numbers::Bytes(rest, _) = *numbers else { return Ok(None) };
    const ROW: usize = 13;
    let Some(rows) = rest.get(..e.count.saturating_mul(ROW)) else { return Ok(None) };
    if !plain || encoding != Encoding::Little || rows.first().is_some_and(|n| *n != 3) {
        return Ok(None);
    }
    // One pass converts, notices any other count of corners, and finds the largest index.
    let (mut other, mut largest) = (0, 0);
    let triangle = |r: &[u8]| {
        let t: [u32; 3] = bytemuck::pod_read_unaligned(&r[1..]);
        other |= r[0] ^ 3;
        largest = t[0].max(t[1]).max(t[2]).max(largest);
        t
    };
    let triangles: Vec<[u32; 3]> = rows.chunks_exact(ROW).map(triangle).collect();
    if other != 0 {
        return Ok(None);
    }
    // Negative indices are the largest of all as unsigned numbers.
    if largest as usize >= vertices && e.count > 0 {
        let row = triangles.iter().position(|t| t.contains(&largest)).unwrap_or(0);
        return Err(format!("face {row} has the index {} of {vertices} vertices", largest as i32));
    }
    numbers.bytes(rows.len())?;
    Ok(Some(Faces { triangles, ..Faces::default() }))
}
