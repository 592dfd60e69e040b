//! A leaf block: up to eight triangles side by side, with all that the f32 filter reads.

use super::WIDTH;

/// 2⁻⁴⁰, the floor of a stored edge length (LAW §4).
const EDGE_FLOOR: f32 = 1.0 / (1u64 << 40) as f32;

/// Eight triangles, 320 bytes in five cache lines. Unused lanes repeat the first triangle; their id is `NO_PRIM`.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct TriangleBlock {
    /// Corner, axis, lane.
    pub corners: [[[f32; WIDTH]; 3]; 3],
    /// E of LAW §4: at least 1.0001 times the largest |component| of an edge, never below 2⁻⁴⁰.
    pub edge: [f32; WIDTH],
}

impl TriangleBlock {
    /// The block of one to eight triangles.
    pub fn new(triangles: &[[[f32; 3]; 3]]) -> TriangleBlock {
        let mut block = TriangleBlock { corners: [[[0.0; WIDTH]; 3]; 3], edge: [EDGE_FLOOR; WIDTH] };
        let Some(first) = triangles.first() else { return block };
        for lane in 0..WIDTH {
            let corners = triangles.get(lane).unwrap_or(first);
            for corner in 0..3 {
                for axis in 0..3 {
                    block.corners[corner][axis][lane] = corners[corner][axis];
                }
            }
            block.edge[lane] = edge_bound(corners);
        }
        block
    }

    /// The corners of the triangle in `lane`.
    #[inline]
    pub fn triangle(&self, lane: usize) -> [[f32; 3]; 3] {
        let c = &self.corners;
        let mut out = [[0.0; 3]; 3];
        for corner in 0..3 {
            for axis in 0..3 {
                out[corner][axis] = c[corner][axis][lane];
            }
        }
        out
    }
}

/// E: the largest |component| of an edge, in f64 (exact to 2⁻⁵³), times 1.0002, rounded to f32 (loses 2⁻²⁴).
fn edge_bound(c: &[[f32; 3]; 3]) -> f32 {
    let mut longest = 0f64;
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        for axis in 0..3 {
            longest = longest.max((f64::from(c[to][axis]) - f64::from(c[from][axis])).abs());
        }
    }
    ((longest * 1.0002) as f32).max(EDGE_FLOOR)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_five_cache_lines() {
        assert_eq!(size_of::<TriangleBlock>(), 320);
    }

    #[test]
    fn lanes_beyond_the_last_repeat_the_first() {
        let a = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
        let b = [[0.0; 3]; 3];
        let block = TriangleBlock::new(&[a, b]);
        assert_eq!(block.triangle(0), a);
        assert_eq!(block.triangle(1), b);
        assert_eq!(block.triangle(7), a);
        assert!(block.edge[0] >= 2.0 * 1.0001 && block.edge[1] == EDGE_FLOOR);
    }
}
