//! Through the boxes in f64: for lines outside the conditions of the f32 way (far origins, extreme directions), and to
//! count what a line visits. Right for every line that the law takes; one box at a time.

use super::ask::Best;
use crate::law::Line;
use crate::layout::{Child, Node, WIDTH};

/// 1 + 2⁻²⁰: four f64 roundings and the 2⁻⁴⁰ of rule G (LAW §6) are far below it.
const FAR_SLACK: f64 = 1.0 + 1.0 / 1_048_576.0;

/// What is visited.
pub(crate) trait Count {
    /// Boxes looked at.
    fn boxes(&mut self, n: usize);
    /// Primitives looked at.
    fn primitives(&mut self, n: usize);
}

/// Nobody counts.
pub(crate) struct NotCounted;

impl Count for NotCounted {
    #[inline(always)]
    fn boxes(&mut self, _: usize) {}
    #[inline(always)]
    fn primitives(&mut self, _: usize) {}
}

/// What is done at a leaf block.
pub(crate) trait ExactVisit {
    /// Something in leaf block `leaf` blocks the line.
    fn any(&mut self, leaf: usize, count: &mut impl Count) -> bool;
    /// Looks for closer hits in leaf block `leaf`.
    fn nearest(&mut self, leaf: usize, best: &mut Best, count: &mut impl Count);
}

/// Where the line enters child `lane`'s box, if it meets it before `tmax`.
///
/// plane − o and the quotient are rounded once each and d (of a segment) once: relative errors of 2⁻⁵³ each, wherever
/// the origin is. Boxes hold their primitives with a pad, so an axis with d = 0 needs none.
fn meet(node: &Node, lane: usize, line: &Line, tmax: f64) -> Option<f64> {
    let (mut enter, mut leave) = (0f64, tmax);
    for axis in 0..3 {
        let (lo, hi) = (f64::from(node.planes[axis][lane]), f64::from(node.planes[axis + 3][lane]));
        let (o, d) = (line.o[axis], line.d[axis]);
        if d == 0.0 {
            if !(lo <= o && o <= hi) {
                return None;
            }
            continue;
        }
        let (near, far) = if d > 0.0 { (lo, hi) } else { (hi, lo) };
        enter = enter.max((near - o) / d);
        leave = leave.min((far - o) / d);
    }
    (enter <= leave * FAR_SLACK).then_some(enter)
}

/// Anything blocks the line. `line` is valid.
pub(crate) fn any_hit_exact(
    nodes: &[Node],
    line: &Line,
    visit: &mut impl ExactVisit,
    count: &mut impl Count,
) -> bool {
    let ends = line.tmax < f64::INFINITY;
    let mut stack = vec![(0.0, Child::node(0))];
    while let Some((_, at)) = stack.pop() {
        if at.is_leaf() {
            if visit.any(at.index(), count) {
                return true;
            }
            continue;
        }
        let node = &nodes[at.index()];
        count.boxes(node.count());
        let first = stack.len();
        let met = |lane| Some((meet(node, lane, line, line.tmax)?, node.child[lane]));
        // The best child ends on top: in stored order, or the nearest (as the f32 way does).
        stack.extend((0..WIDTH).filter_map(met));
        if ends {
            stack[first..].sort_by(|a, b| b.0.total_cmp(&a.0));
        }
    }
    false
}

/// Visits all that may hold the closest hit, nearer boxes first. `line` is valid.
pub(crate) fn nearest_hit_exact(
    nodes: &[Node],
    line: &Line,
    best: &mut Best,
    visit: &mut impl ExactVisit,
    count: &mut impl Count,
) {
    let mut stack = vec![(0.0, Child::node(0))];
    while let Some((enter, at)) = stack.pop() {
        if enter > f64::from(best.limit) * FAR_SLACK {
            continue;
        }
        if at.is_leaf() {
            visit.nearest(at.index(), best, count);
            continue;
        }
        let node = &nodes[at.index()];
        count.boxes(node.count());
        let first = stack.len();
        let limit = f64::from(best.limit);
        let met = (0..WIDTH).filter_map(|lane| Some((meet(node, lane, line, limit)?, node.child[lane])));
        stack.extend(met);
        stack[first..].sort_by(|a, b| b.0.total_cmp(&a.0));
    }
}
