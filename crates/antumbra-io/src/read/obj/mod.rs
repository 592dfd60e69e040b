//! Wavefront OBJ with its materials (Alias|Wavefront, "Advanced Visualizer Manual", appendix B1).
//!
//! One mesh for each group and material. Normals are the file's; else a smoothing group makes them, else faces are flat.

mod mtl;
mod parse;

use std::collections::HashMap;

use antumbra::scene::{MaterialId, Mesh, SceneBuilder};

use mtl::Libraries;
use parse::{Corner, Face, NONE, Obj};

use super::polygon::{Triangulator, newell};
use super::text::plain;
use super::{Context, Counted};
use crate::error::ReadError;
use crate::srgb;

/// Where the normal of a corner comes from: corners with the same origin share a vertex.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Normal {
    /// The file's.
    Given(u32),
    /// The mean about the position, in a smoothing group.
    Smooth(u32),
    /// Of the face of this number.
    Flat(u32),
    /// The mesh has none.
    None,
}

/// How many vertices of one position are looked at: beyond, a copy costs less than looking for it.
const NEAR: usize = 64;

/// The vertices that a mesh has for each position of the file, each with the one before it.
struct Vertices {
    last: Vec<u32>,
    made: Vec<(Corner, Normal, u32)>,
}

impl Vertices {
    fn new(positions: usize) -> Vertices {
        Vertices { last: vec![NONE; positions], made: Vec::new() }
    }

    /// The number of a corner's vertex, and whether it is new.
    fn of(&mut self, c: &Corner, normal: Normal) -> (u32, bool) {
        let last = &mut self.last[c.v as usize];
        let mut at = *last;
        for _ in 0..NEAR {
            let Some((corner, its, before)) = self.made.get(at as usize) else { break };
            if (corner.vt, *its) == (c.vt, normal) {
                return (at, false);
            }
            at = *before;
        }
        let new = self.made.len() as u32;
        self.made.push((*c, normal, *last));
        *last = new;
        (new, true)
    }

    /// Forgets them all, for the next mesh.
    fn clear(&mut self) {
        self.made.drain(..).for_each(|(c, ..)| self.last[c.v as usize] = NONE);
    }
}

/// Sum of the vector areas of the faces about a position, in a smoothing group.
type Smooth = HashMap<(u32, u32), [f64; 3]>;

/// Reads an `.obj`.
pub(super) fn read(bytes: &[u8], context: &Context) -> Result<SceneBuilder, ReadError> {
    if bytes.is_empty() {
        return Err(ReadError::new("", "the file is empty (0 bytes)"));
    }
    let obj = parse::parse(&plain(bytes))?;
    if obj.faces.is_empty() {
        let hint = "Check that the model was exported with its faces.";
        return Err(ReadError::new("", "there is nothing to render: no faces").hint(hint));
    }
    let (mut scene, mut said) = (SceneBuilder::default(), Counted::default());
    let mut libraries = Libraries::default();
    obj.libraries.iter().for_each(|line| libraries.load(line, context, &mut said));
    let smooth = smooth(&obj);
    let mut cutter = Triangulator::new();
    let mut vertices = Vertices::new(obj.positions.len());
    let mut materials: HashMap<&str, MaterialId> = HashMap::new();
    for (group, material, faces) in parts(&obj) {
        let mesh = mesh(&obj, group, &faces, &smooth, (&mut cutter, &mut vertices));
        let id = *materials.entry(material).or_insert_with(|| {
            let look = libraries.material(material, !obj.colors.is_empty(), context, &mut scene, &mut said);
            scene.material(look)
        });
        let mesh = scene.mesh(mesh);
        scene.place(group, mesh, id, context.root);
    }
    if obj.not_drawn > 0 {
        said.warn(
            "",
            format!("{} points, lines and faces of less than three corners are not drawn", obj.not_drawn),
        );
    }
    if obj.curved > 0 {
        said.warn("", format!("{} curves and free-form surfaces are not drawn", obj.curved));
    }
    if cutter.gave_up() {
        said.warn("faces", super::INTRICATE);
    }
    scene.source = "OBJ".into();
    scene.sky_if_unlit = true;
    said.into_scene(&mut scene);
    Ok(scene)
}

/// All faces of an `.obj` that another format names, as one mesh without materials: its normals are the file's, or none.
pub(super) fn mesh_of(bytes: &[u8], _: &Context, said: &mut Counted) -> Result<Mesh, ReadError> {
    let mut obj = parse::parse(&plain(bytes))?;
    obj.colors.clear();
    obj.faces.iter_mut().for_each(|face| face.smoothing = 0);
    let mut cutter = Triangulator::new();
    let all: Vec<usize> = (0..obj.faces.len()).collect();
    let mut vertices = Vertices::new(obj.positions.len());
    let mesh = mesh(&obj, "", &all, &Smooth::new(), (&mut cutter, &mut vertices));
    if cutter.gave_up() {
        said.warn("faces", super::INTRICATE);
    }
    Ok(mesh)
}

/// The faces of each group and material, in the order of the file.
fn parts(obj: &Obj) -> Vec<(&str, &str, Vec<usize>)> {
    let mut parts: Vec<(&str, &str, Vec<usize>)> = Vec::new();
    let mut known: HashMap<(&str, &str), usize> = HashMap::new();
    let (mut last, mut part) = ((NONE, NONE), 0);
    for (i, face) in obj.faces.iter().enumerate() {
        if last != (face.group, face.material) {
            last = (face.group, face.material);
            let names =
                (obj.groups[face.group as usize].as_str(), obj.materials[face.material as usize].as_str());
            part = *known.entry(names).or_insert_with(|| {
                parts.push((names.0, names.1, Vec::new()));
                parts.len() - 1
            });
        }
        parts[part].2.push(i);
    }
    parts
}

fn corners<'a>(obj: &'a Obj, face: &Face) -> &'a [Corner] {
    &obj.corners[face.first..face.first + face.count]
}

fn has_normals(corners: &[Corner]) -> bool {
    corners.iter().all(|c| c.vn != NONE)
}

/// Twice the vector area of a face.
fn area(obj: &Obj, corners: &[Corner]) -> [f64; 3] {
    newell(corners.len(), |i| obj.positions[corners[i].v as usize])
}

/// The normals of all smoothing groups.
fn smooth(obj: &Obj) -> Smooth {
    let mut sums = Smooth::new();
    for face in obj.faces.iter().filter(|f| f.smoothing > 0) {
        let corners = corners(obj, face);
        if has_normals(corners) {
            continue;
        }
        let area = area(obj, corners);
        for corner in corners {
            let sum = sums.entry((corner.v, face.smoothing)).or_default();
            (0..3).for_each(|i| sum[i] += area[i]);
        }
    }
    sums
}

/// The mesh of some faces, with vertices of its own.
fn mesh(
    obj: &Obj,
    name: &str,
    faces: &[usize],
    smooth: &Smooth,
    (cutter, vertices): (&mut Triangulator, &mut Vertices),
) -> Mesh {
    let face = |i: &usize| &obj.faces[*i];
    let with_normals = faces.iter().map(face).any(|f| f.smoothing > 0 || has_normals(corners(obj, f)));
    let with_uvs = faces.iter().map(face).flat_map(|f| corners(obj, f)).any(|c| c.vt != NONE);
    let mut mesh = Mesh { name: name.into(), ..Mesh::default() };
    let (mut normals, mut uvs, mut colors) = (Vec::new(), Vec::new(), Vec::new());
    vertices.clear();
    let mut polygon: Vec<u32> = Vec::new();
    for index in faces {
        let face = face(index);
        let corners = corners(obj, face);
        let origin = |c: &Corner| match (with_normals, has_normals(corners), face.smoothing) {
            (false, ..) => Normal::None,
            (true, true, _) => Normal::Given(c.vn),
            (true, false, 0) => Normal::Flat(*index as u32),
            (true, false, group) => Normal::Smooth(group),
        };
        let origins = corners.iter().map(origin);
        polygon.clear();
        for (c, origin) in corners.iter().zip(origins) {
            let (vertex, is_new) = vertices.of(c, origin);
            if is_new {
                mesh.triangles.vertices.push(obj.positions[c.v as usize]);
                let normal = match origin {
                    Normal::Given(vn) => obj.normals[vn as usize],
                    Normal::Smooth(group) => unit(smooth.get(&(c.v, group)).copied().unwrap_or_default()),
                    Normal::Flat(_) => unit(area(obj, corners)),
                    Normal::None => [0.0; 3],
                };
                normals.push(normal);
                uvs.push(obj.uvs.get(c.vt as usize).copied().unwrap_or_default());
                colors.extend(obj.colors.get(c.v as usize).map(screen_color));
            }
            polygon.push(vertex);
        }
        let place = |i: usize| obj.positions[corners[i].v as usize];
        let triangles = &mut mesh.triangles.indices;
        cutter.cut(corners.len(), place, |t| triangles.push(t.map(|i| polygon[i])));
    }
    mesh.normals = with_normals.then_some(normals);
    mesh.uvs[0] = with_uvs.then_some(uvs);
    mesh.colors = (!obj.colors.is_empty()).then_some(colors);
    mesh
}

/// Brought to length 1, so that areas of any size stay f32.
fn unit(n: [f64; 3]) -> [f32; 3] {
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    if length > 0.0 { n.map(|c| (c / length) as f32) } else { [0.0; 3] }
}

/// Vertex colours of OBJ are screen colours (sRGB).
fn screen_color(c: &[f32; 3]) -> [f32; 4] {
    let [r, g, b] = c.map(|c| srgb::decode(f64::from(c)));
    [r, g, b, 1.0]
}
