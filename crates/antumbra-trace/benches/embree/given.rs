//! Scenes from files, written by the races of `benches/`: antumbra's own built-in ones as plain triangles.
//!
//! All numbers little-endian, four bytes each: vertices V, faces F (whole); eye, look-at, centre and half edge of the
//! light (10 floats); 3 V floats; 3 F whole numbers.

use std::path::Path;

use antumbra_trace::Triangles;

use crate::scenes::Scene;

/// Those that a folder may have, as NAME.mesh.
const NAMES: [&str; 5] = ["interior", "terrain", "pillars", "hall", "scan"];

/// The scenes of a folder.
pub fn all(folder: &Path) -> Vec<Scene> {
    let read = |name: &'static str| {
        let path = folder.join(name).with_extension("mesh");
        let scene = scene(name, &std::fs::read(&path).ok()?);
        if scene.is_none() {
            println!("skipped: {} is cut short or has too much", path.display());
        }
        scene
    };
    NAMES.into_iter().filter_map(read).collect()
}

fn scene(name: &'static str, bytes: &[u8]) -> Option<Scene> {
    let (words, []) = bytes.as_chunks::<4>() else { return None };
    let (head, rest) = words.split_at_checked(12)?;
    let [v, f] = [0, 1].map(|k| u32::from_le_bytes(head[k]) as usize);
    let at = |k: usize| f32::from_le_bytes(head[k]);
    let three = |k: usize| [at(k), at(k + 1), at(k + 2)];
    let (vertices, faces) = rest.split_at_checked(3 * v)?;
    let mesh = Triangles {
        vertices: vertices.as_chunks().0.iter().map(|p| p.map(f32::from_le_bytes)).collect(),
        indices: faces.as_chunks().0.iter().map(|t| t.map(u32::from_le_bytes)).collect(),
    };
    let sound = faces.len() == 3 * f && mesh.indices.iter().flatten().all(|&i| (i as usize) < v);
    let view = [three(2), three(5)];
    sound.then(|| Scene { name, mesh, view, light: (three(8), at(11)), rows: 512 })
}
