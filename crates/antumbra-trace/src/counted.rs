//! What a line costs: the queries once more, with counters. Same answers, through f64, slower.

use crate::law::Line;
use crate::object::Object;
use crate::traverse::{
    Ask, Best, Count, ExactTriangles, ExactVisit, Opaque, ShapeTree, ShapeVisit, TriangleTree, any_hit_exact,
    nearest_hit_exact,
};
use crate::world::World;
use crate::{Bits, Hits, Segments};

/// What one line visited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Boxes tested.
    pub boxes: u32,
    /// Primitives tested.
    pub primitives: u32,
}

impl Count for Work {
    fn boxes(&mut self, n: usize) {
        self.boxes += n as u32;
    }

    fn primitives(&mut self, n: usize) {
        self.primitives += n as u32;
    }
}

impl World {
    /// [`occluded`](crate::Visibility::occluded), and what each entry visited.
    pub fn occluded_counted(&self, segments: Segments<'_>, out: &mut Bits, work: &mut Vec<Work>) {
        out.reset(segments.len());
        work.clear();
        for i in 0..segments.len() {
            let mut count = Work::default();
            if self.any(&Ask::world(&segments, i, &Opaque), &mut count) {
                out.set(i);
            }
            work.push(count);
        }
    }

    /// [`nearest`](crate::Visibility::nearest), and what each ray visited.
    pub fn nearest_counted(&self, rays: Segments<'_>, out: &mut Hits, work: &mut Vec<Work>) {
        out.reset(rays.len());
        work.clear();
        for i in 0..rays.len() {
            let mut count = Work::default();
            let best = self.closest(&Ask::world(&rays, i, &Opaque), &mut count);
            best.write(i, out);
            work.push(count);
        }
    }

    fn any(&self, ask: &Ask<'_, Opaque>, count: &mut Work) -> bool {
        let line = ask.line();
        if !line.is_valid() {
            return false;
        }
        any_triangle(&self.triangles, ask, line, count)
            || any_shape(&self.shapes, ask, line, count)
            || self.places.places.iter().any(|place| {
                let line = line.to_object(&place.object_from_world);
                let ask = ask.placed(line, place);
                count.boxes(1);
                line.is_valid()
                    && match &self.objects[place.geometry] {
                        Some(Object::Triangles(of)) => any_triangle(of, &ask, &line, count),
                        Some(Object::Shapes(of)) => any_shape(of, &ask, &line, count),
                        None => false,
                    }
            })
    }

    fn closest(&self, ask: &Ask<'_, Opaque>, count: &mut Work) -> Best {
        let line = ask.line();
        let mut best = Best::none(line.tmax as f32);
        if !line.is_valid() {
            return best;
        }
        nearest_triangle(&self.triangles, ask, line, &mut best, count);
        nearest_shape(&self.shapes, ask, line, &mut best, count);
        for place in &self.places.places {
            let line = line.to_object(&place.object_from_world);
            let ask = ask.placed(line, place);
            count.boxes(1);
            match &self.objects[place.geometry] {
                Some(Object::Triangles(of)) => nearest_triangle(of, &ask, &line, &mut best, count),
                Some(Object::Shapes(of)) => nearest_shape(of, &ask, &line, &mut best, count),
                None => {}
            }
        }
        best
    }
}

fn any_triangle(of: &TriangleTree, ask: &Ask<'_, Opaque>, line: &Line, count: &mut Work) -> bool {
    !of.tree.is_empty() && any_hit_exact(&of.tree.nodes, line, &mut ExactTriangles { of, ask }, count)
}

fn any_shape(of: &ShapeTree, ask: &Ask<'_, Opaque>, line: &Line, count: &mut Work) -> bool {
    let mut visit = ShapeVisit { of, ask, line: *line, best: Best::none(0.0) };
    !of.tree.is_empty() && any_hit_exact(&of.tree.nodes, line, &mut visit, count)
}

fn nearest_triangle(
    of: &TriangleTree,
    ask: &Ask<'_, Opaque>,
    line: &Line,
    best: &mut Best,
    count: &mut Work,
) {
    closest_in(&of.tree, line, best, &mut ExactTriangles { of, ask }, count);
}

fn nearest_shape(of: &ShapeTree, ask: &Ask<'_, Opaque>, line: &Line, best: &mut Best, count: &mut Work) {
    let mut visit = ShapeVisit { of, ask, line: *line, best: *best };
    closest_in(&of.tree, line, best, &mut visit, count);
}

fn closest_in(
    tree: &crate::layout::Tree,
    line: &Line,
    best: &mut Best,
    visit: &mut impl ExactVisit,
    count: &mut Work,
) {
    if !tree.is_empty() && line.is_valid() {
        nearest_hit_exact(&tree.nodes, line, best, visit, count);
    }
}
