//! Sixteen lines on their way through a tree together. A node's boxes are first met by the shaft of all of them, eight
//! at once, then by each line, sixteen at once; a leaf block's triangles by sixteen lines, one after the other.

use fearless_simd::{Simd, f32x16, mask32x16, prelude::*, u32x16};

use super::ask::{Ask, Masks};
use super::boxes::{FAR_SLACK, STACK, Stack, prefetch};
use super::chunk::Chunk;
use super::gate::{Few, present};
use super::ready::{Ready, Side16};
use super::rules::{ALONE, Turns};
use super::shaft::{Ends, Shaft, across};
use super::sixteen::{Met, PACKET, Seen, Sixteen};
use super::triangles::blocks;
use super::vector::V3;
use crate::NO_PRIM;
use crate::layout::{Bounds, Child, LeafIds, Node, TriangleBlock, WIDTH};

/// Lines that left their packet, each with where it goes on.
pub(super) struct Jobs {
    of: [(u32, Child); Jobs::ROOM],
    len: usize,
}

impl Jobs {
    const ROOM: usize = 1024;
    /// None.
    pub const NONE: Jobs = Jobs { of: [(0, Child(0)); Jobs::ROOM], len: 0 };

    /// There is no room for another sixteen.
    #[inline(always)]
    pub fn is_full(&self) -> bool {
        self.len + PACKET > Jobs::ROOM
    }

    #[inline(always)]
    fn add(&mut self, line: usize, child: Child) {
        self.of[self.len % Jobs::ROOM] = (line as u32, child);
        self.len += 1;
    }

    /// All of them.
    #[inline(always)]
    pub fn all(&self) -> &[(u32, Child)] {
        &self.of[..self.len.min(Jobs::ROOM)]
    }

    /// Forgets them.
    #[inline(always)]
    pub fn clear(&mut self) {
        self.len = 0;
    }
}

/// What the packets of a chunk ask.
pub(super) struct Course<'a> {
    /// These triangles first.
    pub few: &'a [Few],
    /// Then what is below this node.
    pub root: Option<&'a Node>,
}

/// A packet on its way.
pub(super) struct Packet<'a, S: Simd, M> {
    chunk: &'a Chunk<'a, M>,
    /// Number of its first line in the chunk.
    first: usize,
    boxes: Side16<S>,
    lines: Sixteen<S>,
    c: V3<S>,
    /// Largest |q|∞.
    q: f32,
    shaft: Option<Shaft>,
}

impl<'a, S: Simd, M: Masks> Packet<'a, S, M> {
    /// Lines `first` … `first` + 15 of a chunk, of which `live` matter; and whether their origins differ. `narrow`: with
    /// a shaft of their own.
    #[inline(always)]
    pub fn new(
        simd: S,
        chunk: &'a Chunk<'a, M>,
        ready: &Ready,
        (first, live): (usize, u32),
        narrow: bool,
    ) -> (Self, bool) {
        let boxes = ready.sixteen(simd, first);
        let (o, d) = (boxes.o, boxes.d);
        let active = mask32x16::from_bitmask(simd, u64::from(live));
        let one = live.trailing_zeros() as usize % PACKET;
        let c = [o[0].to_array()[one], o[1].to_array()[one], o[2].to_array()[one]];
        let zero = f32x16::splat(simd, 0.0);
        let q = [
            active.select(o[0] - c[0], zero),
            active.select(o[1] - c[1], zero),
            active.select(o[2] - c[2], zero),
        ];
        let far = q[0].abs().max(q[1].abs()).max(q[2].abs()).reduce_max();
        let own = far > 0.0;
        let m = if own { twice_cross(&d, &q) } else { [zero; 3] };
        let lines = Sixteen { d, q, m, bound: boxes.edge, tmax: boxes.tmax };
        let shaft = if narrow { shaft(simd, chunk, &boxes, active, own, c) } else { None };
        (Packet { chunk, first, boxes, lines, c: V3::splat(simd, c), q: far, shaft }, own)
    }

    /// Which of the lines `live` are blocked, but for those that are left to `jobs`.
    #[inline(always)]
    pub fn follow<const OWN: bool>(
        &self,
        simd: S,
        course: &Course<'_>,
        live: u32,
        jobs: &mut Jobs,
        turns: &mut Turns,
    ) -> u32 {
        let mut left = live;
        for few in course.few {
            if left != 0 {
                left &= !self.few::<OWN>(simd, few, left, turns);
            }
        }
        if let Some(root) = course.root {
            left &= !self.through::<OWN>(simd, root, left, jobs, turns);
        }
        live & !left
    }

    /// Which of the lines `live` are blocked by what is below `root`, but for those that are left to `jobs`.
    #[inline(always)]
    fn through<const OWN: bool>(
        &self,
        simd: S,
        root: &Node,
        live: u32,
        jobs: &mut Jobs,
        turns: &mut Turns,
    ) -> u32 {
        let tree = &self.chunk.of.tree;
        let mut stack = Stack::<(Child, u32), STACK>::new();
        let mut left = live;
        self.descend(simd, root, left, &mut stack, turns);
        while let Some((child, mask)) = stack.pop() {
            let mask: u32 = mask & left;
            if mask == 0 {
                continue;
            }
            if mask.count_ones() <= ALONE && !jobs.is_full() {
                let mut alone = mask;
                while alone != 0 {
                    jobs.add(self.first + alone.trailing_zeros() as usize, child);
                    alone &= alone - 1;
                }
                continue;
            }
            if child.is_leaf() {
                left &= !self.leaf::<OWN>(simd, child.index(), mask, turns);
                if left == 0 {
                    break;
                }
            } else {
                self.descend(simd, &tree.nodes[child.index()], mask, &mut stack, turns);
            }
        }
        live & !left
    }

    /// Puts the children of `node` that some of the lines `mask` meet on the stack, the best on top.
    #[inline(always)]
    fn descend(
        &self,
        simd: S,
        node: &Node,
        mask: u32,
        stack: &mut Stack<(Child, u32), STACK>,
        turns: &mut Turns,
    ) {
        let mut met = match &self.shaft {
            Some(shaft) => shaft.meets(simd, node),
            None => (1u32 << node.count()) - 1,
        };
        turns.packet_nodes += 1;
        turns.packet_boxes += met.count_ones() as usize;
        while met != 0 {
            let lane = met.trailing_zeros() as usize % WIDTH;
            met &= met - 1;
            let mask = mask & self.meets(simd, node, lane);
            if mask != 0 {
                let child = node.child[lane];
                if child.is_leaf() {
                    prefetch(&self.chunk.of.blocks, child.index());
                } else {
                    prefetch(&self.chunk.of.tree.nodes, child.index());
                }
                stack.push((child, mask));
            }
        }
    }

    /// Which lines meet the box in `lane` of `node`.
    #[inline(always)]
    fn meets(&self, simd: S, node: &Node, lane: usize) -> u32 {
        let line = &self.boxes;
        let (mut enter, mut leave) = (f32x16::splat(simd, 0.0), line.tmax);
        for axis in 0..3 {
            let lower = f32x16::splat(simd, node.planes[axis][lane]).mul_add(line.r[axis], line.or[axis]);
            let upper = f32x16::splat(simd, node.planes[axis + 3][lane]).mul_add(line.r[axis], line.or[axis]);
            enter = enter.max(lower.min(upper));
            leave = leave.min(lower.max(upper));
        }
        enter.simd_le(leave * FAR_SLACK).to_bitmask() as u32
    }

    /// Which of the lines `mask` a leaf block blocks.
    #[inline(always)]
    fn leaf<const OWN: bool>(&self, simd: S, leaf: usize, mask: u32, turns: &mut Turns) -> u32 {
        let (of, ids) = (self.chunk.of, &self.chunk.of.tree.leaves[leaf]);
        let count = present(ids).count_ones() as usize;
        self.triangles::<OWN>(simd, (&of.blocks[leaf], ids, count), mask, |lane| (leaf, lane), turns)
    }

    /// Which of the lines `mask` a few triangles block.
    #[inline(always)]
    fn few<const OWN: bool>(&self, simd: S, few: &Few, mask: u32, turns: &mut Turns) -> u32 {
        let place = |k: usize| (few.from[k].0 as usize, few.from[k].1 as usize);
        self.triangles::<OWN>(simd, (&few.block, &few.ids, few.count), mask, place, turns)
    }

    /// Which of the lines `mask` the first `count` triangles of a block hit, where `place` says whence they are.
    #[inline(always)]
    fn triangles<const OWN: bool>(
        &self,
        simd: S,
        (block, ids, count): (&TriangleBlock, &LeafIds, usize),
        mask: u32,
        place: impl Fn(usize) -> (usize, usize),
        turns: &mut Turns,
    ) -> u32 {
        turns.packet_leaves += 1;
        let seen = Seen::of::<S, OWN>(simd, block, self.c, self.q);
        let mut left = mask;
        for (lane, &id) in ids.iter().enumerate().take(count) {
            turns.packet_triangles += 1;
            let met = self.lines.test::<OWN>(simd, &seen, lane, left);
            if met.hit | met.open != 0 {
                left &= !self.decide(simd, id, place(lane), &met);
                if left == 0 {
                    break;
                }
            }
        }
        mask & !left
    }

    /// Which lines triangle `id` blocks, of those that do or may hit it.
    #[inline(always)]
    fn decide(&self, simd: S, id: u32, (leaf, lane): (usize, usize), met: &Met) -> u32 {
        let counts = !self.skips(simd, id);
        let mut left = (met.hit | met.open) & counts;
        let mut out = 0;
        if !M::ASK {
            out = met.hit & counts;
            left = met.open & counts;
        }
        while left != 0 {
            let line = left.trailing_zeros();
            left &= left - 1;
            out |= u32::from(self.blocks(id, (leaf, lane), line, met.hit >> line & 1)) << line;
        }
        out
    }

    /// Whether triangle `id` blocks one line, which hits it if `certain` is 1.
    #[inline(never)]
    #[cold]
    fn blocks(&self, id: u32, (leaf, lane): (usize, usize), line: u32, certain: u32) -> bool {
        let chunk = self.chunk;
        let ask = Ask::world(chunk.segments, chunk.from + self.first + line as usize, chunk.masks);
        id != NO_PRIM && blocks(chunk.of, &ask, leaf, 1 << lane, certain << lane)
    }

    /// Which lines start or end on triangle `id`.
    #[inline(always)]
    fn skips(&self, simd: S, id: u32) -> u32 {
        let (segments, at) = (self.chunk.segments, self.chunk.from + self.first);
        let of = |ids: &[u32]| match ids.get(at..at + PACKET) {
            Some(all) => u32x16::from_slice(simd, all).simd_eq(u32x16::splat(simd, id)).to_bitmask() as u32,
            None => {
                let rest = ids.get(at..).unwrap_or_default();
                rest.iter().enumerate().fold(0, |out, (k, it)| out | u32::from(*it == id) << k)
            }
        };
        of(segments.first) | of(segments.last)
    }
}

/// The shaft of the lines `active`, where it is narrow enough to say something.
#[inline(always)]
fn shaft<S: Simd, M>(
    simd: S,
    chunk: &Chunk<'_, M>,
    lines: &Side16<S>,
    active: mask32x16<S>,
    own: bool,
    c: [f32; 3],
) -> Option<Shaft> {
    let from = if own { around(simd, &lines.o, active) } else { Bounds { lo: c, hi: c } };
    let (scene, d) = (&chunk.of.tree.bounds, &lines.d);
    let far = f32x16::splat(simd, across(&from, scene)) / d[0].abs().max(d[1].abs()).max(d[2].abs());
    let t = lines.tmax.min(far);
    let to = [d[0].mul_add(t, lines.o[0]), d[1].mul_add(t, lines.o[1]), d[2].mul_add(t, lines.o[2])];
    let to = around(simd, &to, active);
    let ends = Ends { from, to }.grown();
    let wide = (0..3).map(|a| scene.hi[a] - scene.lo[a]).fold(0.0, crate::layout::larger);
    if ends.width() < 0.5 * wide { Some(ends.shaft(simd)) } else { None }
}

/// The box around the points `active`.
#[inline(always)]
fn around<S: Simd>(simd: S, v: &[f32x16<S>; 3], active: mask32x16<S>) -> Bounds {
    let (low, high) = (f32x16::splat(simd, f32::INFINITY), f32x16::splat(simd, f32::NEG_INFINITY));
    let lo = [active.select(v[0], low), active.select(v[1], low), active.select(v[2], low)];
    let hi = [active.select(v[0], high), active.select(v[1], high), active.select(v[2], high)];
    Bounds {
        lo: [lo[0].reduce_min(), lo[1].reduce_min(), lo[2].reduce_min()],
        hi: [hi[0].reduce_max(), hi[1].reduce_max(), hi[2].reduce_max()],
    }
}

/// 2 a × b.
#[inline(always)]
fn twice_cross<S: Simd>(a: &[f32x16<S>; 3], b: &[f32x16<S>; 3]) -> [f32x16<S>; 3] {
    [
        a[1].mul_sub(b[2], a[2] * b[1]) * 2.0,
        a[2].mul_sub(b[0], a[0] * b[2]) * 2.0,
        a[0].mul_sub(b[1], a[1] * b[0]) * 2.0,
    ]
}
