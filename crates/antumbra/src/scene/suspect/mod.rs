//! What looks wrong in a scene without being an error: lamps turned inside out, triangles twice at one place, holes,
//! a scale that cannot be meant.

mod mesh;
mod size;

use std::collections::{HashMap, HashSet};

use antumbra_math::DVec3;

use super::{Body, Emits, Scene, Surface};
use size::Extent;

pub use mesh::Surfaces;

/// A patch of n edges has a rim of some 2√n of them; a mesh with far fewer open edges was meant to be closed. This is
/// the square of how many √n they may be.
const HOLE: f64 = 1.0 / 16.0;
/// How many names a sentence lists.
const NAMED: usize = 3;

/// What objects do that looks wrong, by the name of the object.
#[derive(Default)]
struct Found {
    inward_lamps: Vec<String>,
    inward: Vec<String>,
    turned: Vec<String>,
    torn: Vec<String>,
    open_glass: Vec<String>,
}

impl Scene {
    /// What every mesh is as a surface, in the order of [`Scene::meshes`].
    pub fn surfaces(&self) -> Vec<Surfaces> {
        self.meshes.iter().map(|mesh| mesh.surfaces()).collect()
    }

    /// One sentence for each thing that looks wrong; nothing is changed by it. `surfaces`: of [`Scene::surfaces`].
    pub fn looks_wrong(&self, surfaces: &[Surfaces]) -> Vec<String> {
        let boxes = self.boxes();
        let found = self.wrong_objects(surfaces, &boxes);
        let mut said = Vec::new();
        listed(
            &mut said,
            &found.inward_lamps,
            "emits to the inside",
            "emit to the inside",
            " (normals flipped?)",
        );
        listed(&mut said, &found.inward, "is inside out", "are inside out", " (normals flipped?)");
        listed(&mut said, &found.turned, "is flipped in part", "are flipped in part", "");
        listed(&mut said, &found.torn, "is closed but for a hole", "are closed but for a hole", "");
        listed(
            &mut said,
            &found.open_glass,
            "is glass and open",
            "are glass and open",
            ": its rim has no other side",
        );
        said.extend(self.same_place(surfaces));
        let sum = |of: fn(&Surfaces) -> u64| surfaces.iter().map(of).sum::<u64>();
        let some = |n: u64, what: &str, end: &str| {
            (n > 0).then(|| format!("{} {what}{}{end}", thousands(n), if n == 1 { "" } else { "s" }))
        };
        said.extend(some(sum(|s| s.duplicates), "duplicate triangle", ""));
        said.extend(some(sum(|s| s.without_area), "triangle", " without area"));
        said.extend(some(sum(|s| s.backward_normals), "triangle", " with shading normals on the back"));
        self.size_looks_wrong(&boxes, &mut said);
        said
    }

    fn wrong_objects(&self, surfaces: &[Surfaces], boxes: &[Option<Extent>]) -> Found {
        let mut found = Found::default();
        let all = boxes.iter().flatten().copied().reduce(size::join);
        for (i, object) in self.objects.iter().enumerate() {
            let Body::Mesh(mesh) = object.body else { continue };
            let s = &surfaces[mesh as usize];
            let name = || self.name_of(i);
            // A mirrored object keeps its front outside.
            let inward = s.volume.is_some_and(|v| v < 0.0);
            if inward && matches!(object.emits, Emits::Each(..)) {
                found.inward_lamps.push(name());
            } else if inward && !self.is_room(boxes[i], all) {
                found.inward.push(name());
            }
            if s.turned_edges > 0 {
                found.turned.push(format!("{} ({})", name(), edges(s.turned_edges)));
            }
            if s.open_edges > 0 && (s.open_edges as f64).powi(2) <= HOLE * s.edges as f64 {
                found.torn.push(format!("{} ({})", name(), edges(s.open_edges)));
            } else if s.open_edges > 0 && self.is_solid_glass(object.material) {
                found.open_glass.push(name());
            }
        }
        found
    }

    /// A closed mesh about a camera, or about everything else, is looked at from inside.
    fn is_room(&self, own: Option<Extent>, all: Option<Extent>) -> bool {
        let Some([low, high]) = own else { return false };
        let holds = |p: DVec3| p.cmpge(low).all() && p.cmple(high).all();
        let others = self.objects.len() > 1;
        self.cameras.iter().any(|c| holds(c.eye))
            || (others && all.is_some_and(|[a, b]| holds(a) && holds(b)))
    }

    fn is_solid_glass(&self, material: u32) -> bool {
        let surface = &self.materials[material as usize].surface;
        matches!(surface, Surface::Dielectric(_) | Surface::RoughDielectric(_))
    }

    /// Objects of the same triangles in the same place.
    fn same_place(&self, surfaces: &[Surfaces]) -> Option<String> {
        let mut first = HashMap::new();
        let mut pairs = Vec::new();
        for (i, object) in self.objects.iter().enumerate() {
            let Body::Mesh(mesh) = object.body else { continue };
            let place = object.transform.map(|t| {
                let numbers = t.linear.to_cols_array().into_iter().chain(t.translation.to_array());
                numbers.map(f64::to_bits).collect::<Vec<_>>()
            });
            if let Some(other) = first.insert((surfaces[mesh as usize].sum, place), i) {
                pairs.push([other, i]);
            }
        }
        let [a, b] = pairs.first()?.map(|i| self.name_of(i));
        let more = if pairs.len() > 1 {
            format!(" (and {} more like it)", thousands(pairs.len() as u64 - 1))
        } else {
            String::new()
        };
        Some(format!("{b} lies exactly where {a} lies{more}"))
    }

    /// What people call an object: its own name, its mesh's, or its number.
    fn name_of(&self, object: usize) -> String {
        let placed = &self.objects[object];
        let of_mesh = match placed.body {
            Body::Mesh(m) => self.meshes[m as usize].name.as_str(),
            Body::Shape(_) => "",
        };
        match [placed.name.as_str(), of_mesh].into_iter().find(|name| !name.is_empty()) {
            Some(name) => format!("\"{name}\""),
            None => format!("object {object}"),
        }
    }
}

/// "A", "B" and 7 more, each name once, with what they do.
fn listed(said: &mut Vec<String>, names: &[String], one: &str, many: &str, end: &str) {
    let mut seen = HashSet::new();
    let names: Vec<&String> = names.iter().filter(|name| seen.insert(*name)).collect();
    let shown: Vec<&str> = names.iter().take(NAMED).map(|n| n.as_str()).collect();
    match names.len() {
        0 => {}
        1 => said.push(format!("{} {one}{end}", shown[0])),
        n if n <= NAMED => said.push(format!("{} {many}{end}", shown.join(", "))),
        n => {
            said.push(format!("{} and {} more {many}{end}", shown.join(", "), thousands((n - NAMED) as u64)))
        }
    }
}

fn edges(n: u64) -> String {
    format!("{} edge{}", thousands(n), if n == 1 { "" } else { "s" })
}

/// 1,234,567.
fn thousands(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// Three digits, as people write them: 0.0123, 12.3, 12,300, 1.23e9.
fn three_digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.2e}").parse().unwrap_or(x);
    if (1000.0..1e7).contains(&rounded) {
        thousands(rounded as u64)
    } else if (1e-4..1000.0).contains(&rounded) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests;
