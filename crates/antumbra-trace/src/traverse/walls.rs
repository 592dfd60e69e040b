//! The largest triangles of a tree: in a closed room they end nearly every line that has no end of its own, so packets
//! may ask them before the tree.

use super::gate::Few;
use super::triangles::TriangleTree;
use crate::NO_PRIM;
use crate::layout::WIDTH;

/// How many are kept.
const WALLS: usize = 2 * WIDTH;
/// In a smaller tree they would save nothing.
const LEAST: usize = 8;

/// The largest triangles of `of`, by area, in blocks of eight; none if there are few leaf blocks.
pub(crate) fn walls(of: &TriangleTree) -> Vec<Few> {
    if of.blocks.len() < LEAST {
        return Vec::new();
    }
    let mut best = [(0f32, 0usize, 0usize); WALLS];
    for (leaf, (block, ids)) in of.blocks.iter().zip(&of.tree.leaves).enumerate() {
        for (lane, _) in ids.iter().enumerate().filter(|(_, id)| **id != NO_PRIM) {
            let area = doubled_area_squared(&block.triangle(lane));
            if area > best[WALLS - 1].0 {
                let at = best.partition_point(|kept| kept.0 >= area);
                best[at..].rotate_right(1);
                best[at] = (area, leaf, lane);
            }
        }
    }
    let there = best.iter().take_while(|kept| kept.0 > 0.0).count();
    let block = |part: &[(f32, usize, usize)]| {
        let mut few = Few::NONE;
        for (_, leaf, lane) in part {
            few.take(of, *leaf, 1 << lane);
        }
        few
    };
    best[..there].chunks(WIDTH).map(block).collect()
}

/// 4 × the square of the area; only sizes are compared, so rounding does not matter.
fn doubled_area_squared([a, b, c]: &[[f32; 3]; 3]) -> f32 {
    let e = |p: &[f32; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
    let (x, y) = (e(b), e(c));
    let n = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
    n[0] * n[0] + n[1] * n[1] + n[2] * n[2]
}
