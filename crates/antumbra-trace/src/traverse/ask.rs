//! One question: an entry of a batch in the space of one set of primitives, and its best answer so far.

use std::cell::OnceCell;

use crate::law::Line;
use crate::place::Place;
use crate::{Hits, NO_PRIM, Passes, PrimId, Segments, TO_POINT};

/// What happens at masked primitives.
pub(crate) trait Masks: Sync {
    /// There is someone to ask.
    const ASK: bool;
    /// The ray goes through.
    fn passes(&self, number: u32, prim: PrimId, uv: [f32; 2]) -> bool;
}

/// Masks block.
pub(crate) struct Opaque;

impl Masks for Opaque {
    const ASK: bool = false;
    #[inline(always)]
    fn passes(&self, _: u32, _: PrimId, _: [f32; 2]) -> bool {
        false
    }
}

/// Masks ask back.
pub(crate) struct Asking<'a, P: Passes>(pub &'a P);

impl<P: Passes> Masks for Asking<'_, P> {
    const ASK: bool = true;
    #[inline]
    fn passes(&self, number: u32, prim: PrimId, uv: [f32; 2]) -> bool {
        self.0.passes(number, prim, uv)
    }
}

/// Entry `i` of `segments`, in world space or in that of an instance.
pub(crate) struct Ask<'a, M> {
    segments: &'a Segments<'a>,
    i: usize,
    masks: &'a M,
    /// The line as the law takes it: in world space made when it is first needed.
    line: OnceCell<Line>,
    /// World number of the set's primitive 0.
    base: PrimId,
    /// All primitives here are masked (instances; in world space each says so itself).
    pub masked: bool,
}

impl<'a, M: Masks> Ask<'a, M> {
    /// In world space.
    #[inline(always)]
    pub fn world(segments: &'a Segments<'a>, i: usize, masks: &'a M) -> Ask<'a, M> {
        Ask { segments, i, masks, line: OnceCell::new(), base: 0, masked: false }
    }

    /// The same entry in the space of an instance.
    #[inline(always)]
    pub fn placed(&self, line: Line, place: &Place) -> Ask<'a, M> {
        let (segments, i, masks) = (self.segments, self.i, self.masks);
        Ask { segments, i, masks, line: OnceCell::from(line), base: place.base, masked: place.masked }
    }

    /// Primitive `id` of a leaf is none, or one that the batch says never blocks this entry if it is flat.
    #[inline]
    pub fn skips(&self, id: PrimId) -> bool {
        id == NO_PRIM || self.starts_on(id) || self.ends_on(id)
    }

    /// The entry starts on primitive `id`.
    #[inline]
    pub fn starts_on(&self, id: PrimId) -> bool {
        self.world_prim(id) == self.segments.first[self.i]
    }

    /// The entry ends on primitive `id`.
    #[inline]
    pub fn ends_on(&self, id: PrimId) -> bool {
        self.world_prim(id) == self.segments.last[self.i]
    }

    /// The line as the law takes it.
    #[inline]
    pub fn line(&self) -> &Line {
        self.line.get_or_init(|| Line::of(self.segments, self.i))
    }

    /// Origin, rounded direction and tmax of [`line`](Ask::line), which must be valid.
    #[inline(always)]
    pub fn numbers(&self) -> ([f64; 3], [f64; 3], f64) {
        if let Some(line) = self.line.get() {
            return (line.o, line.d, line.tmax);
        }
        let wide = |v: [f32; 3]| [f64::from(v[0]), f64::from(v[1]), f64::from(v[2])];
        let (o, e) = (wide(self.segments.origin_at(self.i)), wide(self.segments.end_at(self.i)));
        let reach = self.segments.reach[self.i];
        if reach == TO_POINT {
            return (o, [e[0] - o[0], e[1] - o[1], e[2] - o[2]], 1.0);
        }
        (o, e, f64::from(reach))
    }

    /// World number of primitive `id`.
    #[inline]
    pub fn world_prim(&self, id: PrimId) -> PrimId {
        self.base + id
    }

    /// Primitive `id`, hit at `uv`, lets the line through.
    #[inline]
    pub fn goes_through(&self, id: PrimId, uv: [f32; 2]) -> bool {
        self.masks.passes(self.segments.number[self.i], self.world_prim(id), uv)
    }
}

/// The closest hit so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Best {
    /// Its t, from the law; +∞ without a hit.
    pub t: f64,
    /// Its world number.
    pub prim: PrimId,
    /// No primitive beyond this t matters: the asked tmax, later t (1 + 2⁻²⁸) rounded up.
    pub limit: f32,
    /// Where on it.
    pub uv: [f32; 2],
}

impl Best {
    /// No hit before `tmax`.
    pub fn none(tmax: f32) -> Best {
        Best { t: f64::INFINITY, prim: NO_PRIM, limit: tmax, uv: [0.0; 2] }
    }

    /// Takes the hit of `prim` at `t` and `uv`, which [`improves`](Best::improves).
    #[inline]
    pub fn take(&mut self, t: f64, prim: PrimId, uv: [f32; 2]) {
        (self.t, self.prim, self.uv) = (t, prim, uv);
        let limit = t * (1.0 + 1.0 / 268_435_456.0);
        let up = limit as f32;
        self.limit = self.limit.min(if f64::from(up) < limit { up.next_up() } else { up });
    }

    /// A hit of `prim` at `t` is closer, or as close with a smaller number.
    #[inline]
    pub fn improves(&self, t: f64, prim: PrimId) -> bool {
        t < self.t || (t == self.t && prim < self.prim)
    }

    /// Writes it as entry `i`, which is a miss so far.
    #[inline]
    pub fn write(&self, i: usize, out: &mut Hits) {
        (out.t[i], out.prim[i], out.uv[i]) = (self.t, self.prim, self.uv);
    }
}
