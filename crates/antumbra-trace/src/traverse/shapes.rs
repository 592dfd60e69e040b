//! Leaf blocks of spheres, disks and cylinders: one f64 formula each, no filter.

use fearless_simd::Simd;

use super::ask::{Ask, Best, Masks};
use super::boxes::{VisitAny, VisitNearest};
use super::exact::{Count, ExactVisit, NotCounted};
use super::ray::Limits;
use crate::law::{self, Line};
use crate::layout::Tree;
use crate::{NO_PRIM, PrimId, Shape};

/// A shape with its number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbered {
    pub prim: PrimId,
    pub shape: Shape,
    pub masked: bool,
}

/// A tree over shapes; its leaves hold indices into `shapes`.
#[derive(Clone, Debug)]
pub(crate) struct ShapeTree {
    pub tree: Tree,
    pub shapes: Vec<Numbered>,
    pub limits: Limits,
}

/// A line on its way through a [`ShapeTree`].
pub(crate) struct ShapeVisit<'a, M> {
    pub of: &'a ShapeTree,
    pub ask: &'a Ask<'a, M>,
    /// The law's line.
    pub line: Line,
    pub best: Best,
}

impl<M: Masks> ShapeVisit<'_, M> {
    /// The shapes of a leaf that may block: not those that the line starts or ends on by the rules of a batch.
    fn shapes(&self, leaf: usize) -> impl Iterator<Item = &Numbered> {
        let ids = self.of.tree.leaves[leaf];
        ids.into_iter().filter(|&id| id != NO_PRIM).map(|id| &self.of.shapes[id as usize]).filter(|s| {
            let flat = matches!(s.shape, Shape::Disk { .. });
            let skipped = self.ask.ends_on(s.prim) || (flat && self.ask.starts_on(s.prim));
            !skipped
        })
    }

    fn goes_through(&self, s: &Numbered) -> bool {
        M::ASK && (s.masked || self.ask.masked) && self.ask.goes_through(s.prim, [0.0; 2])
    }
}

impl<M: Masks> ExactVisit for ShapeVisit<'_, M> {
    fn any(&mut self, leaf: usize, count: &mut impl Count) -> bool {
        count.primitives(self.shapes(leaf).count());
        self.shapes(leaf).any(|s| law::shape(&self.line, &s.shape).is_some() && !self.goes_through(s))
    }

    fn nearest(&mut self, leaf: usize, best: &mut Best, count: &mut impl Count) {
        count.primitives(self.shapes(leaf).count());
        for s in self.shapes(leaf) {
            let Some(t) = law::shape(&self.line, &s.shape) else { continue };
            let prim = self.ask.world_prim(s.prim);
            if best.improves(t, prim) && !self.goes_through(s) {
                best.take(t, prim, [0.0; 2]);
            }
        }
    }
}

impl<S: Simd, M: Masks> VisitAny<S> for ShapeVisit<'_, M> {
    #[inline(always)]
    fn any(&mut self, _: S, leaf: usize) -> bool {
        ExactVisit::any(self, leaf, &mut NotCounted)
    }

    #[inline(always)]
    fn fetch_leaf(&self, _: usize) {}
}

impl<S: Simd, M: Masks> VisitNearest<S> for ShapeVisit<'_, M> {
    #[inline(always)]
    fn nearest(&mut self, _: S, leaf: usize) -> f32 {
        let mut best = self.best;
        ExactVisit::nearest(self, leaf, &mut best, &mut NotCounted);
        self.best = best;
        best.limit
    }
}
