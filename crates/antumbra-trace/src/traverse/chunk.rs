//! Entries of a batch that are answered together: a shaft in front of the tree, packets, and lines for themselves.

use fearless_simd::{Simd, f32x16, prelude::*};

use super::ask::{Ask, Masks};
use super::filter::filter;
use super::flight::{Answers, Flight};
use super::gate::Gate;
use super::packet::{Course, Jobs, Packet};
use super::ray::{FastLine, Lines, power};
#[cfg(doc)]
use super::ready::CHUNK;
use super::ready::Ready;
use super::rules::{Rules, Turns, Way, Ways};
use super::shaft::{Ends, across};
use super::sixteen::PACKET;
use super::triangles::{TriangleTree, blocks};
use crate::layout::Bounds;
use crate::{Segments, TO_POINT};

/// Entries of a batch that are answered together.
pub(crate) struct Chunk<'a, M> {
    pub of: &'a TriangleTree,
    pub segments: &'a Segments<'a>,
    pub lines: &'a Lines<'a>,
    pub masks: &'a M,
    /// First entry.
    pub from: usize,
    /// How many; at most [`CHUNK`].
    pub count: usize,
}

/// What the chunks of a batch hand on: room, and what was learnt.
pub(crate) struct Room {
    ready: Ready,
    jobs: Jobs,
    gate: Gate,
    rules: Rules,
}

impl Room {
    /// Of a new batch that asks `tree`.
    pub fn new(ways: Ways, tree: &TriangleTree) -> Room {
        let rules = Rules::recall(ways, tree.blocks.as_ptr() as usize);
        Room { ready: Ready::EMPTY, jobs: Jobs::NONE, gate: Gate::NONE, rules }
    }

    /// The batch is answered.
    pub fn leave(&self) {
        self.rules.remember();
    }
}

impl<M: Masks> Chunk<'_, M> {
    /// Which entries are blocked by a triangle of world space. `alone` answers for those for which f32 is not proven.
    #[inline(always)]
    pub fn blocked<S: Simd>(
        &self,
        simd: S,
        room: &mut Room,
        alone: impl Fn(usize, FastLine) -> bool,
    ) -> Answers {
        let choice = room.rules.choose(self.segments, self.from);
        let mut turns = Turns::default();
        let answers = self.answers(simd, room, choice.way, &mut turns, alone);
        room.rules.learn(&choice, self.count, &turns, self.of.is_large());
        answers
    }

    /// The same, the way that was chosen.
    #[inline(always)]
    fn answers<S: Simd>(
        &self,
        simd: S,
        room: &mut Room,
        way: Way,
        turns: &mut Turns,
        alone: impl Fn(usize, FastLine) -> bool,
    ) -> Answers {
        let Room { ready, jobs, gate, .. } = room;
        jobs.clear();
        let gated = way == Way::Shaft && self.gate(simd, gate, turns);
        if gated && gate.count == 0 {
            return Answers::default();
        }
        let few = Some(&gate.few).filter(|few| gated && few.count > 0);
        let root = if gated && few.is_none() { &gate.node } else { &self.of.tree.nodes[0] };
        let tree = (self.lines, &self.of.limits, Some(root).filter(|_| few.is_none()));
        let [mut live, wild] = ready.take(simd, tree, (self.from, self.count), None);
        turns.ready += if few.is_none() { self.count } else { 0 };
        let mut flight = Flight::new(self, ready, root, alone);
        flight.wild(&wild);
        let course = match (few, way) {
            (Some(few), _) => Course { few: std::slice::from_ref(few), root: None },
            (None, Way::Walls) => Course { few: &self.of.walls, root: None },
            (None, _) => Course { few: &[], root: Some(root) },
        };
        if way != Way::Alone {
            for (word, lot) in live.iter_mut().enumerate() {
                for part in 0..64 / PACKET {
                    let mask = (*lot >> (PACKET * part)) as u32 & 0xffff;
                    if mask != 0 {
                        let first = 64 * word + PACKET * part;
                        let blocked = self.packet(simd, (ready, &course), (first, mask), jobs, turns);
                        flight.answers[word] |= u64::from(blocked) << (PACKET * part);
                    }
                }
                *lot = if way == Way::Walls { *lot & !flight.answers[word] } else { 0 };
            }
        }
        flight.fly(simd, live, jobs.all(), turns);
        flight.answers
    }

    /// One packet: which of the lines `first` + … in `mask` are blocked.
    #[inline(always)]
    fn packet<S: Simd>(
        &self,
        simd: S,
        (ready, course): (&Ready, &Course<'_>),
        (first, mask): (usize, u32),
        jobs: &mut Jobs,
        turns: &mut Turns,
    ) -> u32 {
        turns.packets += 1;
        let (packet, own) = Packet::new(simd, self, ready, (first, mask), course.root.is_some());
        match own {
            false => packet.follow::<false>(simd, course, mask, jobs, turns),
            true => packet.follow::<true>(simd, course, mask, jobs, turns),
        }
    }

    /// Whether there is a shaft; then `gate` is what the entries can meet.
    #[inline(always)]
    fn gate<S: Simd>(&self, simd: S, gate: &mut Gate, turns: &mut Turns) -> bool {
        if !self.of.limits.are_sound() {
            return false;
        }
        let ends = self.ends(simd);
        if let Some(ends) = &ends {
            turns.looks += gate.set(simd, self.of, &self.of.tree.nodes[0], &ends.grown().shaft(simd));
        }
        ends.is_some()
    }

    /// Where the entries start and end; `None` if some number is not finite, or is larger than 2⁴⁰.
    #[inline(always)]
    fn ends<S: Simd>(&self, simd: S) -> Option<Ends> {
        let columns = self.lines.columns();
        let (mut from, mut to) = (Around::nothing(simd), Around::nothing(simd));
        for at in (self.from..self.from + self.count).step_by(PACKET) {
            from.add([load(simd, columns[0], at), load(simd, columns[1], at), load(simd, columns[2], at)]);
        }
        let from = from.bounds()?;
        let far = f32x16::splat(simd, across(&from, &self.of.tree.bounds));
        for at in (self.from..self.from + self.count).step_by(PACKET) {
            let end = [load(simd, columns[3], at), load(simd, columns[4], at), load(simd, columns[5], at)];
            let reach = load(simd, columns[6], at);
            let size = end[0].abs().max(end[1].abs()).max(end[2].abs());
            let t = reach.min(far / size);
            let to_point = reach.simd_eq(TO_POINT);
            to.add([
                to_point.select(end[0], end[0].mul_add(t, load(simd, columns[0], at))),
                to_point.select(end[1], end[1].mul_add(t, load(simd, columns[1], at))),
                to_point.select(end[2], end[2].mul_add(t, load(simd, columns[2], at))),
            ]);
        }
        let to = to.bounds()?;
        Some(Ends { from, to })
    }

    /// Leaf block `leaf` blocks line `i` of the chunk.
    #[inline(always)]
    pub(super) fn any<S: Simd>(&self, simd: S, ready: &Ready, leaf: usize, i: usize) -> bool {
        let (ray, tmax) = ready.triangle_ray(simd, i);
        let verdict = filter::<S, false>(simd, &self.of.blocks[leaf], &ray, tmax);
        verdict.lanes() != 0 && {
            let ask = Ask::world(self.segments, self.from + i, self.masks);
            blocks(self.of, &ask, leaf, verdict.lanes(), verdict.hit)
        }
    }
}

/// The box around points that come sixteen at a time.
struct Around<S: Simd> {
    lo: [f32x16<S>; 3],
    hi: [f32x16<S>; 3],
    /// All are numbers of at most 2⁴⁰.
    fine: bool,
}

impl<S: Simd> Around<S> {
    #[inline(always)]
    fn nothing(simd: S) -> Around<S> {
        let (low, high) = (f32x16::splat(simd, f32::INFINITY), f32x16::splat(simd, f32::NEG_INFINITY));
        Around { lo: [low; 3], hi: [high; 3], fine: true }
    }

    #[inline(always)]
    fn add(&mut self, p: [f32x16<S>; 3]) {
        for (a, p) in p.into_iter().enumerate() {
            self.fine &= p.abs().simd_le(power(40)).all_true();
            (self.lo[a], self.hi[a]) = (self.lo[a].min(p), self.hi[a].max(p));
        }
    }

    #[inline(always)]
    fn bounds(&self) -> Option<Bounds> {
        let (lo, hi) = (&self.lo, &self.hi);
        self.fine.then(|| Bounds {
            lo: [lo[0].reduce_min(), lo[1].reduce_min(), lo[2].reduce_min()],
            hi: [hi[0].reduce_max(), hi[1].reduce_max(), hi[2].reduce_max()],
        })
    }
}

/// Sixteen numbers of a column from `from` on; beyond its end the one at `from`.
#[inline(always)]
fn load<S: Simd>(simd: S, column: &[f32], from: usize) -> f32x16<S> {
    if let Some(all) = column.get(from..from + PACKET) {
        return f32x16::from_slice(simd, all);
    }
    let mut all = [column[from]; PACKET];
    for (to, x) in all.iter_mut().zip(&column[from..]) {
        *to = *x;
    }
    f32x16::load_array(simd, all)
}
