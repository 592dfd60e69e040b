//! How much memory a scene will take, said before it is taken.

use std::cell::Cell;
use std::collections::HashSet;
use std::sync::Arc;

use antumbra::scene::{Mesh, SceneBuilder};
use antumbra::texture::Texels;

use crate::error::ReadError;

/// Peak of building the tree of rays [bytes a triangle], measured beside what the scene was read into
/// (`docs/performance.md`).
const TREE: u64 = 128;

/// What is known of the memory that a scene will take [bytes], against what it may.
#[derive(Debug)]
pub(crate) struct Forecast {
    limit: Option<u64>,
    /// The file, and the largest of those beside it.
    file: u64,
    beside: Cell<u64>,
    /// Corners, triangles' corners, normals, coordinates and colours.
    kept: Cell<u64>,
    triangles: Cell<u64>,
}

impl Forecast {
    /// Of a file of so many bytes. Without a limit nothing is refused.
    pub(crate) fn new(limit: Option<u64>, file: u64) -> Forecast {
        Forecast { limit, file, beside: Cell::new(0), kept: Cell::new(0), triangles: Cell::new(0) }
    }

    /// Anything may be refused, so that counting is worth it.
    pub(crate) fn is_asked(&self) -> bool {
        self.limit.is_some()
    }

    /// A file beside it has so many bytes.
    pub(crate) fn beside(&self, bytes: u64) {
        self.beside.set(self.beside.get().max(bytes));
    }

    /// A part will keep so many bytes and triangles; refuses when all parts so far take more than the limit.
    pub(crate) fn part(&self, kept: u64, triangles: u64) -> Result<(), ReadError> {
        self.kept.set(self.kept.get().saturating_add(kept));
        self.triangles.set(self.triangles.get().saturating_add(triangles));
        self.check()
    }

    /// What was read, counted in earnest: meshes and pictures of any format.
    pub(crate) fn whole(&self, scene: &SceneBuilder) -> Result<(), ReadError> {
        // Many textures may show the same picture.
        let mut seen = HashSet::new();
        let pictures = scene.textures.iter().filter(|t| seen.insert(Arc::as_ptr(&t.image)));
        let texels = pictures.map(|t| match &t.image.texels {
            Texels::Srgb8(t) | Texels::Linear8(t) => 4 * t.len(),
            Texels::Float(t) => 12 * t.len(),
        });
        let kept = scene.meshes.iter().map(bytes_of).chain(texels).sum::<usize>();
        let triangles = scene.meshes.iter().map(|m| m.triangles.indices.len()).sum::<usize>();
        self.kept.set(kept as u64);
        self.triangles.set(triangles as u64);
        self.check()
    }

    /// The larger of two peaks: of reading, which still has the files, and of building the tree, which has not.
    fn peak(&self) -> u64 {
        let reading = self.file.saturating_add(self.beside.get());
        let tree = self.triangles.get().saturating_mul(TREE);
        self.kept.get().saturating_add(reading.max(tree))
    }

    fn check(&self) -> Result<(), ReadError> {
        let (Some(limit), peak) = (self.limit, self.peak()) else { return Ok(()) };
        if peak <= limit {
            return Ok(());
        }
        let of = match self.triangles.get() {
            0 => String::new(),
            n => format!(" for {n} triangles"),
        };
        let what =
            format!("would take about {} of memory or more{of}, the limit is {}", words(peak), words(limit));
        Err(ReadError::new("", what).hint("Allow more (--max-memory, max_memory=), or read a simpler model."))
    }
}

/// What a mesh keeps.
fn bytes_of(mesh: &Mesh) -> usize {
    let corners = 12 * (mesh.triangles.vertices.len() + mesh.triangles.indices.len());
    let normals = mesh.normals.as_ref().map_or(0, |n| 12 * n.len());
    let uvs = mesh.uvs.iter().flatten().map(|uv| 8 * uv.len()).sum::<usize>();
    corners + normals + uvs + mesh.colors.as_ref().map_or(0, |c| 16 * c.len())
}

/// Bytes with a unit: 1.5 GiB.
fn words(bytes: u64) -> String {
    const UNITS: [&str; 4] = ["KiB", "MiB", "GiB", "TiB"];
    let mut size = bytes as f64 / 1024.0;
    let mut unit = 0;
    while size >= 1024.0 && unit + 1 < UNITS.len() {
        size /= 1024.0;
        unit += 1;
    }
    format!("{size:.1} {}", UNITS[unit])
}

/// Bytes of "4G", "500M" or a plain number; K, M, G and T are powers of 1024, `None` for what is no size.
pub fn size_of(text: &str) -> Option<u64> {
    let text = text.trim();
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let power = match text[digits.len()..].to_ascii_uppercase().as_str() {
        "" | "B" => 0,
        "K" | "KB" | "KIB" => 1,
        "M" | "MB" | "MIB" => 2,
        "G" | "GB" | "GIB" => 3,
        "T" | "TB" | "TIB" => 4,
        _ => return None,
    };
    let bytes = digits.trim_end().parse::<f64>().ok()? * (1u64 << (10 * power)) as f64;
    (bytes >= 1.0 && bytes.is_finite()).then_some(bytes as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_units() {
        let sizes = ["4G", "1.5 GiB", "500M", "64k", "1000000", "1e6"].map(size_of);
        let bytes = [4 << 30, 3 << 29, 500 << 20, 64 << 10, 1_000_000, 1_000_000].map(Some);
        assert_eq!(sizes, bytes);
        assert_eq!(["", "G", "-1G", "0", "4X", "nan", "inf"].map(size_of), [None; 7]);
        assert_eq!([words(3 << 29), words(1 << 19)], ["1.5 GiB", "512.0 KiB"]);
    }

    /// Numbers of a hostile header do not wrap round.
    #[test]
    fn the_largest_counts_are_refused() {
        let forecast = Forecast::new(Some(1 << 40), 1);
        assert!(forecast.part(1 << 20, 1).is_ok());
        assert!(forecast.part(u64::MAX, u64::MAX).is_err());
        assert!(Forecast::new(None, 1).part(u64::MAX, u64::MAX).is_ok());
    }
}
