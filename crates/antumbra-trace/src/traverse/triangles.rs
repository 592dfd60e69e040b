//! Leaf blocks of triangles: the filter decides, the law where it cannot, masks are asked last.

use fearless_simd::Simd;

use super::ask::{Ask, Best, Masks};
use super::boxes::{VisitAny, VisitNearest, prefetch};
use super::exact::{Count, ExactVisit};
use super::filter::{Interval, TriangleRay, Verdict, filter, filter_with_t};
use super::gate::Few;
use super::measure;
use super::ray::{FastLine, Limits};
use crate::NO_PRIM;
use crate::law;
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
    /// Its largest triangles (`walls.rs`).
    pub walls: Vec<Few>,
}

/// A line on its way through a [`TriangleTree`], looking for anything; `PLACED`: in the space of an instance.
pub(crate) struct AnyTriangle<'a, S: Simd, M, const PLACED: bool> {
    of: &'a TriangleTree,
    ask: &'a Ask<'a, M>,
    ray: TriangleRay<S>,
    tmax: f32,
}

impl<'a, S: Simd, M: Masks, const PLACED: bool> AnyTriangle<'a, S, M, PLACED> {
    #[inline(always)]
    pub fn new(simd: S, of: &'a TriangleTree, ask: &'a Ask<'a, M>, line: &FastLine) -> Self {
        AnyTriangle { of, ask, ray: TriangleRay::new(simd, line, PLACED), tmax: line.tmax }
    }
}

impl<S: Simd, M: Masks, const PLACED: bool> VisitAny<S> for AnyTriangle<'_, S, M, PLACED> {
    #[inline(always)]
    fn any(&mut self, simd: S, leaf: usize) -> bool {
        let verdict = filter::<S, PLACED>(simd, &self.of.blocks[leaf], &self.ray, self.tmax);
        verdict.lanes() != 0 && blocks(self.of, self.ask, leaf, verdict.lanes(), verdict.hit)
    }

    #[inline(always)]
    fn fetch_leaf(&self, leaf: usize) {
        prefetch(&self.of.blocks, leaf);
    }
}

/// A triangle that may be the closest hit.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Candidate {
    pub leaf: u32,
    pub lane: u32,
    /// Its t is not below this.
    pub from: f32,
}

/// Candidates that are kept before the law is asked.
pub(super) const ROOM: usize = 8;

/// A line on its way through a [`TriangleTree`], looking for the closest hit.
///
/// The law is asked last: certain hits only lower the limit to where their t surely ends, so that few candidates
/// remain for it at the end. With masks it is asked at once, because a hit may not count.
pub(crate) struct NearestTriangle<'a, S: Simd, M, const PLACED: bool> {
    of: &'a TriangleTree,
    ask: &'a Ask<'a, M>,
    ray: TriangleRay<S>,
    best: &'a mut Best,
    candidates: [Candidate; ROOM],
    kept: usize,
}

impl<'a, S: Simd, M: Masks, const PLACED: bool> NearestTriangle<'a, S, M, PLACED> {
    #[inline(always)]
    pub fn new(
        simd: S,
        of: &'a TriangleTree,
        ask: &'a Ask<'a, M>,
        line: &FastLine,
        best: &'a mut Best,
    ) -> Self {
        NearestTriangle::of_ray(of, ask, TriangleRay::new(simd, line, PLACED), best)
    }

    /// The same for a line that is already made ready.
    #[inline(always)]
    pub fn of_ray(
        of: &'a TriangleTree,
        ask: &'a Ask<'a, M>,
        ray: TriangleRay<S>,
        best: &'a mut Best,
    ) -> Self {
        NearestTriangle { of, ask, ray, best, candidates: [Candidate::default(); ROOM], kept: 0 }
    }

    /// Ends the walk: `best` is then the closest hit.
    #[inline(always)]
    pub fn finish(&mut self, simd: S) {
        if self.kept > 0 {
            self.decide(simd);
        }
    }

    /// Ends the walk short of the law: the candidates that it still has to be asked about, and how many they are.
    #[inline(always)]
    pub(super) fn leave(self) -> ([Candidate; ROOM], usize) {
        (self.candidates, self.kept)
    }

    /// Lowers the limit by certain hits and keeps what may be closest.
    #[inline(never)]
    fn keep(&mut self, simd: S, leaf: usize, verdict: Verdict, t: &Interval) {
        let mut lanes = verdict.lanes();
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let id = self.of.tree.leaves[leaf][lane];
            let certain = verdict.hit >> lane & 1 == 1;
            let from = if certain { t.from[lane] } else { 0.0 };
            if self.ask.skips(id) || from > self.best.limit {
                continue;
            }
            if certain {
                self.best.limit = self.best.limit.min(t.to[lane]);
            }
            if self.kept == ROOM {
                self.decide(simd);
            }
            self.candidates[self.kept] = Candidate { leaf: leaf as u32, lane: lane as u32, from };
            self.kept += 1;
        }
    }

    /// Asks the law about the candidates that are still within the limit.
    #[inline(never)]
    fn decide(&mut self, simd: S) {
        simd.vectorize(
            #[inline(always)]
            || {
                let (o, d, tmax) = self.ask.numbers();
                for k in 0..self.kept {
                    let Candidate { leaf, lane, from } = self.candidates[k];
                    if from <= self.best.limit {
                        self.weigh(simd, (&o, &d), tmax, leaf as usize, lane as usize);
                    }
                }
            },
        );
        self.kept = 0;
    }

    /// The law of the triangle, by its stage 1 where that suffices.
    #[inline(always)]
    fn weigh(&mut self, simd: S, line: (&[f64; 3], &[f64; 3]), tmax: f64, leaf: usize, lane: usize) {
        let numbers = measure::numbers(simd, line, &self.of.blocks[leaf], lane);
        let t = match law::decide(&numbers, tmax) {
            law::Verdict::Miss => return,
            law::Verdict::Hit(t) => t,
            _ => return offer(self.of, self.ask, leaf, 1 << lane, self.best),
        };
        let prim = self.ask.world_prim(self.of.tree.leaves[leaf][lane]);
        if !self.best.improves(t, prim) {
            return;
        }
        match law::good_weights(&numbers.edges) {
            Some(uv) => self.best.take(t, prim, uv),
            None => offer(self.of, self.ask, leaf, 1 << lane, self.best),
        }
    }
}

impl<S: Simd, M: Masks, const PLACED: bool> VisitNearest<S> for NearestTriangle<'_, S, M, PLACED> {
    #[inline(always)]
    fn nearest(&mut self, simd: S, leaf: usize) -> f32 {
        let (verdict, t) =
            filter_with_t::<S, PLACED>(simd, &self.of.blocks[leaf], &self.ray, self.best.limit);
        if verdict.lanes() != 0 {
            if M::ASK {
                offer(self.of, self.ask, leaf, verdict.lanes(), self.best);
            } else {
                self.keep(simd, leaf, verdict, &t);
            }
        }
        self.best.limit
    }
}

/// One of `lanes` blocks the line; those in `certain` are known to be hit.
#[inline(never)]
pub(crate) fn blocks<M: Masks>(
    of: &TriangleTree,
    ask: &Ask<'_, M>,
    leaf: usize,
    mut lanes: u32,
    certain: u32,
) -> bool {
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize;
        lanes &= lanes - 1;
        let id = of.tree.leaves[leaf][lane];
        if ask.skips(id) {
            continue;
        }
        let masked = M::ASK && of.is_masked(ask, leaf, lane);
        if !masked && certain >> lane & 1 == 1 {
            return true;
        }
        let corners = of.blocks[leaf].triangle(lane);
        let line = ask.line();
        if law::blocks(line, corners) && !(masked && ask.goes_through(id, law::barycentrics(line, corners))) {
            return true;
        }
    }
    false
}

/// Offers the hits among `lanes` to `best`.
#[inline(never)]
pub(super) fn offer<M: Masks>(
    of: &TriangleTree,
    ask: &Ask<'_, M>,
    leaf: usize,
    mut lanes: u32,
    best: &mut Best,
) {
    let line = ask.line();
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize;
        lanes &= lanes - 1;
        let id = of.tree.leaves[leaf][lane];
        if ask.skips(id) {
            continue;
        }
        let corners = of.blocks[leaf].triangle(lane);
        let Some(t) = law::triangle(line, corners) else { continue };
        let prim = ask.world_prim(id);
        if !best.improves(t, prim) {
            continue;
        }
        let uv = law::barycentrics(line, corners);
        if !(M::ASK && of.is_masked(ask, leaf, lane) && ask.goes_through(id, uv)) {
            best.take(t, prim, uv);
        }
    }
}

impl TriangleTree {
    #[inline]
    fn is_masked<M>(&self, ask: &Ask<'_, M>, leaf: usize, lane: usize) -> bool {
        ask.masked || self.masked.get(leaf).is_some_and(|m| m >> lane & 1 == 1)
    }

    /// It is larger than the caches of a core.
    #[inline]
    pub(super) fn is_large(&self) -> bool {
        size_of_val(self.blocks.as_slice()) > 1 << 25
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
