//! One line through a whole world: triangles, shapes, then instances.

use fearless_simd::Simd;

use crate::law::Line;
use crate::object::Object;
use crate::traverse::{
    Answers, AnyTriangle, Ask, Best, CHUNK, Chunk, Count, Desk, ExactTriangles, FastLine, Lines, Masks,
    NearestTriangle, NotCounted, Room, ShapeTree, ShapeVisit, TriangleTree, VisitAny, VisitNearest, any_hit,
    any_hit_exact, nearest_hit, nearest_hit_exact,
};
use crate::world::World;
use crate::{Hits, NO_PRIM, Segments};

/// Which of the entries `from` … `from` + `count` − 1 (at most [`CHUNK`]) are blocked.
#[inline(always)]
pub(crate) fn occluded<S: Simd, M: Masks>(
    simd: S,
    world: &World,
    (segments, lines): (&Segments<'_>, &Lines<'_>),
    (from, count): (usize, usize),
    masks: &M,
    room: &mut Room,
) -> Answers {
    let mut answers = Answers::default();
    if !world.triangles.tree.is_empty() {
        let chunk = Chunk { of: &world.triangles, segments, lines, masks, from, count };
        answers = chunk.blocked(simd, room, |i, line| {
            simd.vectorize(
                #[inline(always)]
                || {
                    any_triangle::<S, M, false>(
                        simd,
                        &world.triangles,
                        &line,
                        &Ask::world(segments, i, masks),
                    )
                },
            )
        });
    }
    if world.shapes.tree.is_empty() && world.places.places.is_empty() {
        return answers;
    }
    simd.vectorize(
        #[inline(always)]
        || {
            for i in 0..count {
                if answers[i / 64] >> (i % 64) & 1 == 1 {
                    continue;
                }
                let ask = Ask::world(segments, from + i, masks);
                if any_other(simd, world, &lines.line(from + i), &ask) {
                    answers[i / 64] |= 1 << (i % 64);
                }
            }
        },
    );
    answers
}

/// The closest hits of the entries `from` … `from` + `count` − 1 (at most [`CHUNK`]), written to `out`.
#[inline(always)]
pub(crate) fn nearest<S: Simd, M: Masks>(
    simd: S,
    world: &World,
    (segments, lines): (&Segments<'_>, &Lines<'_>),
    (from, count): (usize, usize),
    masks: &M,
    desk: &mut Desk,
    out: &mut Hits,
) {
    let mut bests = [Best::none(0.0); CHUNK];
    for (i, best) in bests.iter_mut().enumerate().take(count) {
        best.limit = lines.tmax(from + i);
    }
    if !world.triangles.tree.is_empty() {
        let chunk = Chunk { of: &world.triangles, segments, lines, masks, from, count };
        chunk.nearest(simd, desk, &mut bests, |ask, best| {
            nearest_triangle_exact(&world.triangles, ask, best, &mut NotCounted);
        });
    }
    if !world.shapes.tree.is_empty() || !world.places.places.is_empty() {
        simd.vectorize(
            #[inline(always)]
            || {
                for (i, best) in bests.iter_mut().enumerate().take(count) {
                    let ask = Ask::world(segments, from + i, masks);
                    nearest_other(simd, world, &lines.line(from + i), &ask, best);
                }
            },
        );
    }
    for (i, best) in bests.iter().enumerate().take(count) {
        best.write(from + i, out);
    }
}

#[inline(always)]
fn any_triangle<S: Simd, M: Masks, const PLACED: bool>(
    simd: S,
    of: &TriangleTree,
    line: &FastLine,
    ask: &Ask<'_, M>,
) -> bool {
    if of.limits.hold(line) {
        let mut visit = AnyTriangle::<S, M, PLACED>::new(simd, of, ask, line);
        return any_hit(simd, &of.tree.nodes, line, &mut visit);
    }
    any_triangle_exact(of, ask, &mut NotCounted)
}

#[inline(never)]
#[cold]
pub(crate) fn any_triangle_exact<M: Masks>(
    of: &TriangleTree,
    ask: &Ask<'_, M>,
    count: &mut impl Count,
) -> bool {
    let line = ask.line();
    line.is_valid() && any_hit_exact(&of.tree.nodes, line, &mut ExactTriangles { of, ask }, count)
}

#[inline(always)]
fn nearest_triangle<S: Simd, M: Masks, const PLACED: bool>(
    simd: S,
    of: &TriangleTree,
    line: &FastLine,
    ask: &Ask<'_, M>,
    best: &mut Best,
) {
    if of.limits.hold(line) {
        let mut visit = NearestTriangle::<S, M, PLACED>::new(simd, of, ask, line, best);
        nearest_hit(simd, &of.tree.nodes, line, &mut visit);
        visit.finish(simd);
    } else {
        nearest_triangle_exact(of, ask, best, &mut NotCounted);
    }
}

#[inline(never)]
#[cold]
pub(crate) fn nearest_triangle_exact<M: Masks>(
    of: &TriangleTree,
    ask: &Ask<'_, M>,
    best: &mut Best,
    count: &mut impl Count,
) {
    let line = ask.line();
    if line.is_valid() {
        nearest_hit_exact(&of.tree.nodes, line, best, &mut ExactTriangles { of, ask }, count);
    }
}

/// Shapes and instances.
#[inline(always)]
pub(crate) fn any_other<S: Simd, M: Masks>(
    simd: S,
    world: &World,
    fast: &FastLine,
    ask: &Ask<'_, M>,
) -> bool {
    let line = ask.line();
    if !line.is_valid() {
        return false;
    }
    if !world.shapes.tree.is_empty() && any_shape(simd, &world.shapes, Some(fast), line, ask) {
        return true;
    }
    let places = &world.places;
    let mut visit = PlaceVisit { world, ask, line, best: Best::none(fast.tmax) };
    if !places.limits.hold(fast) {
        return (0..places.places.len()).any(|k| visit.any_in(simd, k));
    }
    (!places.tree.is_empty() && any_hit(simd, &places.tree.nodes, fast, &mut visit))
        || places.wild.iter().any(|&k| visit.any_in(simd, k as usize))
}

/// Shapes and instances.
#[inline(always)]
fn nearest_other<S: Simd, M: Masks>(
    simd: S,
    world: &World,
    fast: &FastLine,
    ask: &Ask<'_, M>,
    best: &mut Best,
) {
    let line = ask.line();
    if !line.is_valid() {
        return;
    }
    if !world.shapes.tree.is_empty() {
        nearest_shape(simd, &world.shapes, Some(fast), line, ask, best);
    }
    let places = &world.places;
    let mut visit = PlaceVisit { world, ask, line, best: *best };
    if places.limits.hold(fast) {
        if !places.tree.is_empty() {
            nearest_hit(simd, &places.tree.nodes, fast, &mut visit);
        }
        places.wild.iter().for_each(|&k| visit.nearest_in(simd, k as usize));
    } else {
        (0..places.places.len()).for_each(|k| visit.nearest_in(simd, k));
    }
    *best = visit.best;
}

/// `fast` is `None` where f32 cannot hold the line.
#[inline(always)]
fn any_shape<S: Simd, M: Masks>(
    simd: S,
    of: &ShapeTree,
    fast: Option<&FastLine>,
    line: &Line,
    ask: &Ask<'_, M>,
) -> bool {
    let mut visit = ShapeVisit { of, ask, line: *line, best: Best::none(0.0) };
    match fast.filter(|fast| of.limits.hold(fast)) {
        Some(fast) => any_hit(simd, &of.tree.nodes, fast, &mut visit),
        None => any_hit_exact(&of.tree.nodes, line, &mut visit, &mut NotCounted),
    }
}

#[inline(always)]
fn nearest_shape<S: Simd, M: Masks>(
    simd: S,
    of: &ShapeTree,
    fast: Option<&FastLine>,
    line: &Line,
    ask: &Ask<'_, M>,
    best: &mut Best,
) {
    let mut visit = ShapeVisit { of, ask, line: *line, best: *best };
    match fast.filter(|fast| of.limits.hold(fast)) {
        Some(fast) => {
            nearest_hit(simd, &of.tree.nodes, &FastLine { tmax: best.limit, ..*fast }, &mut visit);
            *best = visit.best;
        }
        None => nearest_hit_exact(&of.tree.nodes, line, best, &mut visit, &mut NotCounted),
    }
}

/// A line on its way through the tree of instances.
struct PlaceVisit<'a, M> {
    world: &'a World,
    ask: &'a Ask<'a, M>,
    line: &'a Line,
    best: Best,
}

impl<M: Masks> PlaceVisit<'_, M> {
    #[inline(always)]
    fn any_in<S: Simd>(&self, simd: S, k: usize) -> bool {
        let place = &self.world.places.places[k];
        let line = self.line.to_object(&place.object_from_world);
        if !line.is_valid() {
            return false;
        }
        let ask = self.ask.placed(line, place);
        let fast = FastLine::of_line(&line, self.best.limit);
        match &self.world.objects[place.geometry] {
            Some(Object::Triangles(of)) => match fast {
                Some(fast) => any_triangle::<S, M, true>(simd, of, &fast, &ask),
                None => any_triangle_exact(of, &ask, &mut NotCounted),
            },
            Some(Object::Shapes(of)) => any_shape(simd, of, fast.as_ref(), &line, &ask),
            None => false,
        }
    }

    #[inline(always)]
    fn nearest_in<S: Simd>(&mut self, simd: S, k: usize) {
        let place = &self.world.places.places[k];
        let line = self.line.to_object(&place.object_from_world);
        if !line.is_valid() {
            return;
        }
        let ask = self.ask.placed(line, place);
        let fast = FastLine::of_line(&line, self.best.limit);
        let best = &mut self.best;
        match &self.world.objects[place.geometry] {
            Some(Object::Triangles(of)) => match fast {
                Some(fast) => nearest_triangle::<S, M, true>(simd, of, &fast, &ask, best),
                None => nearest_triangle_exact(of, &ask, best, &mut NotCounted),
            },
            Some(Object::Shapes(of)) => nearest_shape(simd, of, fast.as_ref(), &line, &ask, best),
            None => {}
        }
    }

    fn leaf(&self, leaf: usize) -> impl Iterator<Item = usize> + use<M> {
        let ids = self.world.places.tree.leaves[leaf];
        ids.into_iter().filter(|&id| id != NO_PRIM).map(|id| id as usize)
    }
}

impl<S: Simd, M: Masks> VisitAny<S> for PlaceVisit<'_, M> {
    #[inline(always)]
    fn any(&mut self, simd: S, leaf: usize) -> bool {
        for k in self.leaf(leaf) {
            if self.any_in(simd, k) {
                return true;
            }
        }
        false
    }

    #[inline(always)]
    fn fetch_leaf(&self, _: usize) {}
}

impl<S: Simd, M: Masks> VisitNearest<S> for PlaceVisit<'_, M> {
    #[inline(always)]
    fn nearest(&mut self, simd: S, leaf: usize) -> f32 {
        for k in self.leaf(leaf) {
            self.nearest_in(simd, k);
        }
        self.best.limit
    }
}
