//! From a batch to the kernels of a SIMD level: one decision a batch.

use fearless_simd::{Simd, dispatch};

use crate::level::SimdLevel;
use crate::traverse::{Asking, CHUNK, Desk, Lines, Masks, Opaque, Room, Ways};
use crate::walk;
use crate::world::World;
use crate::{Bits, Hits, Passes, Segments, Visibility};

impl World {
    /// The same world asked at another SIMD level; the best one if this machine lacks it.
    pub fn with_level(mut self, level: SimdLevel) -> World {
        self.set_level(level);
        self
    }

    /// Asks at another SIMD level from now on; at the best one if this machine lacks it.
    pub fn set_level(&mut self, level: SimdLevel) {
        self.level = level;
    }

    /// Answers in these ways from now on: the same answers.
    #[doc(hidden)]
    pub fn set_ways(&mut self, ways: Ways) {
        self.ways = ways;
    }

    /// The same world, in which hits on masked instances are asked back. Without masks it costs nothing.
    pub fn with_passes<'a, P: Passes>(&'a self, passes: &'a P) -> impl Visibility + 'a {
        Masked { world: self, passes: Asking(passes), ask: self.has_masks() }
    }
}

/// A world whose masks are asked.
struct Masked<'a, P: Passes> {
    world: &'a World,
    passes: Asking<'a, P>,
    ask: bool,
}

/// Masks count as opaque.
impl Visibility for World {
    fn occluded(&self, segments: Segments<'_>, out: &mut Bits) {
        dispatch!(self.level.level(), simd => occluded(simd, self, &segments, &Opaque, out));
    }

    fn nearest(&self, rays: Segments<'_>, out: &mut Hits) {
        dispatch!(self.level.level(), simd => nearest(simd, self, &rays, &Opaque, out));
    }
}

impl<P: Passes> Visibility for Masked<'_, P> {
    fn occluded(&self, segments: Segments<'_>, out: &mut Bits) {
        if !self.ask {
            return self.world.occluded(segments, out);
        }
        let level = self.world.level.level();
        dispatch!(level, simd => occluded(simd, self.world, &segments, &self.passes, out));
    }

    fn nearest(&self, rays: Segments<'_>, out: &mut Hits) {
        if !self.ask {
            return self.world.nearest(rays, out);
        }
        let level = self.world.level.level();
        dispatch!(level, simd => nearest(simd, self.world, &rays, &self.passes, out));
    }
}

#[inline(always)]
pub(crate) fn occluded<S: Simd>(
    simd: S,
    world: &World,
    segments: &Segments<'_>,
    masks: &impl Masks,
    out: &mut Bits,
) {
    out.reset(segments.len());
    let lines = Lines::of(segments);
    let mut room = Room::new(world.ways, &world.triangles);
    for from in (0..segments.len()).step_by(CHUNK) {
        let count = CHUNK.min(segments.len() - from);
        let answers = walk::occluded(simd, world, (segments, &lines), (from, count), masks, &mut room);
        for (k, word) in answers.into_iter().take(count.div_ceil(64)).enumerate() {
            out.set_word(from / 64 + k, word);
        }
    }
    room.leave();
}

#[inline(always)]
fn nearest<S: Simd>(simd: S, world: &World, rays: &Segments<'_>, masks: &impl Masks, out: &mut Hits) {
    out.reset(rays.len());
    let lines = Lines::of(rays);
    let mut desk = Desk::EMPTY;
    for from in (0..rays.len()).step_by(CHUNK) {
        let count = CHUNK.min(rays.len() - from);
        walk::nearest(simd, world, (rays, &lines), (from, count), masks, &mut desk, out);
    }
}
