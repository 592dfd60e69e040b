//! Leaf blocks of triangles: the filter decides, the law where it cannot, masks are asked last.

use fearless_simd::Simd;

use super::ask::{Ask, Best, Masks};
use super::boxes::Visit;
use super::exact::{Count, ExactVisit};
use super::filter::{TriangleRay, filter};
use super::ray::{FastLine, Limits};
use crate::NO_PRIM;
use crate::law::{self, Line};
use crate::layout::{Tree, TriangleBlock};

/// A tree over triangles.
#[derive(Clone, Debug, Default)]
pub(crate) struct TriangleTree {
    pub tree: Tree,
    /// One a leaf of `tree`.
    pub blocks: Vec<TriangleBlock>,
    /// Which lanes of a leaf are masked; empty if none is.
    pub masked: Vec<u8>,
    pub limits: Limits,
}

/// A line on its way through a [`TriangleTree`]; `PLACED`: in the space of an instance.
pub(crate) struct TriangleVisit<'a, S: Simd, M, const PLACED: bool> {
    of: &'a TriangleTree,
    ask: &'a Ask<'a, M>,
    ray: TriangleRay<S>,
    best: Best,
}

impl<'a, S: Simd, M: Masks, const PLACED: bool> TriangleVisit<'a, S, M, PLACED> {
    #[inline(always)]
    pub fn new(simd: S, of: &'a TriangleTree, ask: &'a Ask<'a, M>, line: &FastLine, best: Best) -> Self {
        TriangleVisit { of, ask, ray: TriangleRay::new(simd, line, PLACED), best }
    }

    /// The closest hit after the walk.
    #[inline(always)]
    pub fn best(self) -> Best {
        self.best
    }
}

impl<S: Simd, M: Masks, const PLACED: bool> Visit<S> for TriangleVisit<'_, S, M, PLACED> {
    #[inline(always)]
    fn any(&mut self, simd: S, leaf: usize) -> bool {
        let verdict = filter::<S, PLACED>(simd, &self.of.blocks[leaf], &self.ray, self.best.limit);
        verdict.lanes() != 0 && blocks(self.of, self.ask, leaf, verdict.lanes(), verdict.hit)
    }

    #[inline(always)]
    fn nearest(&mut self, simd: S, leaf: usize) -> f32 {
        let verdict = filter::<S, PLACED>(simd, &self.of.blocks[leaf], &self.ray, self.best.limit);
        if verdict.lanes() != 0 {
            offer(self.of, self.ask, leaf, verdict.lanes(), &mut self.best);
        }
        self.best.limit
    }
}

/// One of `lanes` blocks the line; those in `certain` are known to be hit.
#[inline(never)]
fn blocks<M: Masks>(of: &TriangleTree, ask: &Ask<'_, M>, leaf: usize, mut lanes: u32, certain: u32) -> bool {
    let mut line: Option<Line> = None;
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize;
        lanes &= lanes - 1;
        let id = of.tree.leaves[leaf][lane];
        if id == NO_PRIM || id == ask.first || id == ask.last {
            continue;
        }
        let masked = M::ASK && of.is_masked(ask, leaf, lane);
        if !masked && certain >> lane & 1 == 1 {
            return true;
        }
        let corners = of.blocks[leaf].triangle(lane);
        let line = line.get_or_insert_with(|| ask.line());
        if law::blocks(line, corners) && !(masked && ask.goes_through(id, law::barycentrics(line, corners))) {
            return true;
        }
    }
    false
}

/// Offers the hits among `lanes` to `best`.
#[inline(never)]
fn offer<M: Masks>(of: &TriangleTree, ask: &Ask<'_, M>, leaf: usize, mut lanes: u32, best: &mut Best) {
    let line = ask.line();
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize;
        lanes &= lanes - 1;
        let id = of.tree.leaves[leaf][lane];
        if id == NO_PRIM || id == ask.first || id == ask.last {
            continue;
        }
        let corners = of.blocks[leaf].triangle(lane);
        let Some(t) = law::triangle(&line, corners) else { continue };
        let prim = ask.world_prim(id);
        if !best.improves(t, prim) {
            continue;
        }
        let masked = M::ASK && of.is_masked(ask, leaf, lane);
        if !(masked && ask.goes_through(id, law::barycentrics(&line, corners))) {
            best.offer(t, prim, Some(corners));
        }
    }
}

impl TriangleTree {
    #[inline]
    fn is_masked<M>(&self, ask: &Ask<'_, M>, leaf: usize, lane: usize) -> bool {
        ask.masked || self.masked.get(leaf).is_some_and(|m| m >> lane & 1 == 1)
    }

    /// Primitives in a leaf.
    fn count(&self, leaf: usize) -> usize {
        self.tree.leaves[leaf].iter().filter(|&&id| id != NO_PRIM).count()
    }
}

/// The f64 way through a [`TriangleTree`]: the law decides alone.
pub(crate) struct ExactTriangles<'a, M> {
    pub of: &'a TriangleTree,
    pub ask: &'a Ask<'a, M>,
}

impl<M: Masks> ExactVisit for ExactTriangles<'_, M> {
    fn any(&mut self, leaf: usize, count: &mut impl Count) -> bool {
        count.primitives(self.of.count(leaf));
        blocks(self.of, self.ask, leaf, 0xff, 0)
    }

    fn nearest(&mut self, leaf: usize, best: &mut Best, count: &mut impl Count) {
        count.primitives(self.of.count(leaf));
        offer(self.of, self.ask, leaf, 0xff, best);
    }
}
