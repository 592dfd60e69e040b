//! One question: an entry of a batch in the space of one set of primitives, and its best answer so far.

use std::cell::OnceCell;

use crate::law::Line;
use crate::place::Place;
use crate::{Hits, NO_PRIM, Passes, PrimId, Segments};

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
    /// The primitive that it starts on, numbered as here.
    pub first: PrimId,
    /// The primitive that it ends on, numbered as here.
    pub last: PrimId,
}

impl<'a, M: Masks> Ask<'a, M> {
    /// In world space.
    #[inline(always)]
    pub fn world(segments: &'a Segments<'a>, i: usize, masks: &'a M) -> Ask<'a, M> {
        let (first, last) = (segments.first[i], segments.last[i]);
        Ask { segments, i, masks, line: OnceCell::new(), base: 0, masked: false, first, last }
    }

    /// The same entry in the space of an instance.
    #[inline(always)]
    pub fn placed(&self, line: Line, place: &Place) -> Ask<'a, M> {
        let (base, masked) = (place.base, place.masked);
        let local = |prim: PrimId| if prim.wrapping_sub(base) < place.count { prim - base } else { NO_PRIM };
        Ask {
            segments: self.segments,
            i: self.i,
            masks: self.masks,
            line: OnceCell::from(line),
            base,
            masked,
            first: local(self.first),
            last: local(self.last),
        }
    }

    /// The line as the law takes it.
    #[inline]
    pub fn line(&self) -> &Line {
        self.line.get_or_init(|| Line::of(self.segments, self.i))
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
