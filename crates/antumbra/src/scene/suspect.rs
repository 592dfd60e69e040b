//! What looks wrong in a scene without being an error: lamps turned inside out, triangles twice at one place.

use std::collections::{HashMap, HashSet};

use antumbra_math::DVec3;

use super::{Body, Emits, Scene, SceneMesh};

impl Scene {
    /// One sentence for each thing that looks wrong; nothing is changed by it.
    pub fn looks_wrong(&self) -> Vec<String> {
        let mut said: Vec<String> = self
            .inward_lamps()
            .map(|name| format!("\"{name}\" emits to the inside (normals flipped?)"))
            .collect();
        let twice: usize = self.meshes.iter().map(duplicates).sum();
        if twice > 0 {
            said.push(format!("{twice} duplicate triangle{}", if twice == 1 { "" } else { "s" }));
        }
        said
    }

    /// Closed emissive meshes whose front is inside.
    fn inward_lamps(&self) -> impl Iterator<Item = &str> {
        let lamps = self.objects.iter().filter(|o| matches!(o.emits, Emits::Each(_)));
        lamps.filter_map(|object| {
            let Body::Mesh(mesh) = object.body else { return None };
            let mirrored = object.transform.is_some_and(|t| t.linear.determinant() < 0.0);
            let volume = enclosed(&self.meshes[mesh as usize])?;
            ((volume < 0.0) != mirrored).then_some(object.name.as_str())
        })
    }
}

/// Signed volume of a mesh whose every edge has one neighbour that runs the other way; positive if its front is outside.
fn enclosed(mesh: &SceneMesh) -> Option<f64> {
    let place = |v: u32| mesh.triangles.vertices[v as usize].map(f32::to_bits);
    let mut edges: HashMap<_, i32> = HashMap::new();
    for [a, b, c] in &mesh.triangles.indices {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (from, to) = (place(*from), place(*to));
            *edges.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
        }
    }
    if edges.is_empty() || edges.values().any(|balance| *balance != 0) {
        return None;
    }
    let corner = |v: u32| DVec3::from(mesh.triangles.vertices[v as usize].map(f64::from));
    let middle = corner(mesh.triangles.indices[0][0]);
    let volume = |[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [*a, *b, *c].map(|v| corner(v) - middle);
        a.dot(b.cross(c)) / 6.0
    };
    Some(mesh.triangles.indices.iter().map(volume).sum())
}

/// How many triangles lie exactly where another one of the mesh lies, whichever way round.
fn duplicates(mesh: &SceneMesh) -> usize {
    let mut seen = HashSet::with_capacity(mesh.triangles.indices.len());
    let place = |v: u32| mesh.triangles.vertices[v as usize].map(f32::to_bits);
    let mut twice = 0;
    for triangle in &mesh.triangles.indices {
        let mut corners = triangle.map(place);
        corners.sort_unstable();
        twice += usize::from(!seen.insert(corners));
    }
    twice
}

#[cfg(test)]
mod tests {
    use antumbra_math::Rgb;
    use antumbra_trace::Triangles;

    use super::super::{Material, SceneBuilder};

    const CORNERS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    const OUTWARD: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

    fn lamp(indices: Vec<[u32; 3]>) -> Vec<String> {
        let mut builder = SceneBuilder::new("lamp");
        let glow = builder.material(Material::light(Rgb::WHITE));
        builder.object("Lamp", Triangles { vertices: CORNERS.to_vec(), indices }, glow);
        builder.build().unwrap().looks_wrong()
    }

    #[test]
    fn a_lamp_turned_inside_out_is_named() {
        assert_eq!(lamp(OUTWARD.to_vec()), Vec::<String>::new());
        let inward = OUTWARD.map(|[a, b, c]| [a, c, b]).to_vec();
        assert_eq!(lamp(inward), ["\"Lamp\" emits to the inside (normals flipped?)"]);
        // An open lamp has no inside.
        assert_eq!(lamp(vec![[0, 1, 2]]), Vec::<String>::new());
    }

    #[test]
    fn triangles_twice_at_one_place_are_counted() {
        assert_eq!(lamp(vec![[0, 1, 2], [1, 2, 0], [2, 1, 0], [0, 1, 3]]), ["2 duplicate triangles"]);
    }
}
