//! Any-hit queries of many lines at once, each for itself: while one waits for memory, others go on.
//!
//! Lines take turns, one box node or one leaf block a turn; those at nodes first, then those at leaves. So hardly a
//! branch depends on where a single line goes, and what a turn reads was asked for a round before.

use fearless_simd::{Level, Simd, mask32x8, prelude::*, u32x8};

use super::ask::Masks;
use super::chunk::Chunk;
use super::ray::FastLine;
use super::ready::{CHUNK, Lot, Ready};
use super::rules::Turns;
use crate::layout::{Child, Node, TriangleBlock, WIDTH};

/// Lines in flight.
const FLIGHT: usize = 16;

/// Children that a line in flight may have before it.
const ROOM: usize = 64;

/// Answers for one chunk, one bit an entry.
pub(crate) type Answers = [u64; CHUNK / 64];

/// A short list of places in a flight.
#[derive(Clone, Copy)]
struct List {
    of: [u8; FLIGHT],
    len: usize,
}

impl List {
    const EMPTY: List = List { of: [0; FLIGHT], len: 0 };

    /// Adds `k` if `really`; without a branch. Every place is in one list at most and `k` is in none, so there is room
    /// for it.
    #[inline(always)]
    fn add(&mut self, k: usize, really: bool) {
        self.of[self.len % FLIGHT] = k as u8;
        self.len += usize::from(really);
    }

    #[inline(always)]
    fn iter(&self) -> impl Iterator<Item = usize> {
        self.of.iter().take(self.len).map(|k| usize::from(*k) % FLIGHT)
    }
}

/// A chunk on its way.
pub(super) struct Flight<'a, M, A> {
    chunk: &'a Chunk<'a, M>,
    ready: &'a Ready,
    /// Where lines start that nothing else is known of.
    root: &'a Node,
    alone: A,
    /// The lines that have not started.
    live: Lot,
    /// Those that have been on their way before: where each goes on.
    jobs: &'a [(u32, Child)],
    pub answers: Answers,
    /// By place: which line it is.
    line: [u32; FLIGHT],
    /// Where it is.
    at: [Child; FLIGHT],
    /// How much is on its stack; 0: it has come to its end.
    top: [u32; FLIGHT],
    /// What it still has before it, best on top; at the bottom something that is never visited.
    stacks: [[u32; ROOM]; FLIGHT],
}

impl<'a, M: Masks, A: Fn(usize, FastLine) -> bool> Flight<'a, M, A> {
    /// Of a chunk whose lines are `ready`; `alone` answers for those that cannot fly.
    #[inline(always)]
    pub fn new(chunk: &'a Chunk<'a, M>, ready: &'a Ready, root: &'a Node, alone: A) -> Self {
        Flight {
            chunk,
            ready,
            root,
            alone,
            live: Lot::default(),
            jobs: &[],
            answers: Answers::default(),
            line: [0; FLIGHT],
            at: [Child(0); FLIGHT],
            top: [0; FLIGHT],
            stacks: [[Child::leaf(0).0; ROOM]; FLIGHT],
        }
    }

    /// Answers the lines `live` from the root, and `jobs` from where each is.
    #[inline(always)]
    pub fn fly<S: Simd>(&mut self, simd: S, live: Lot, jobs: &'a [(u32, Child)], turns: &mut Turns) {
        (self.live, self.jobs) = (live, jobs);
        let (mut inner, mut leaves) = (List::EMPTY, List::EMPTY);
        for k in 0..FLIGHT {
            self.launch(simd, k, &mut inner, &mut leaves);
        }
        while inner.len + leaves.len > 0 {
            turns.nodes += inner.len;
            inner = self.through_nodes(simd, &inner, &mut leaves);
            turns.leaves += leaves.len;
            leaves = self.through_leaves(simd, &leaves, &mut inner);
        }
    }

    /// One turn of every line in `turn`, which are at nodes; those that are at nodes again.
    #[inline(always)]
    fn through_nodes<S: Simd>(&mut self, simd: S, turn: &List, leaves: &mut List) -> List {
        let mut inner = List::EMPTY;
        for k in turn.iter() {
            self.through_node(simd, k);
            self.sort_in(k, &mut inner, leaves);
        }
        inner
    }

    /// One turn of every line in `turn`, which are at leaf blocks or their ends; those that are there again.
    #[inline(always)]
    fn through_leaves<S: Simd>(&mut self, simd: S, turn: &List, inner: &mut List) -> List {
        let mut leaves = List::EMPTY;
        for k in turn.iter() {
            let i = self.line[k] as usize;
            if self.top[k] > 0 {
                if !self.chunk.any(simd, self.ready, self.at[k].index(), i) {
                    self.top[k] -= 1;
                    self.at[k] = Child(self.stacks[k][self.top[k] as usize % ROOM]);
                    self.sort_in(k, inner, &mut leaves);
                    continue;
                }
                self.block(i);
            }
            self.launch(simd, k, inner, &mut leaves);
        }
        leaves
    }

    /// Through the boxes of the node that the line at place `k` is at, to the best child or back to what is left.
    #[inline(always)]
    fn through_node<S: Simd>(&mut self, simd: S, k: usize) {
        let node = &self.chunk.of.tree.nodes[self.at[k].index()];
        let (pass, _) = self.ready.meet(simd, node, self.line[k] as usize);
        self.descend(simd, node, pass, k);
    }

    /// On to the best of the children `pass` of `node`, or back to what is left.
    #[inline(always)]
    fn descend<S: Simd>(&mut self, simd: S, node: &Node, pass: mask32x8<S>, k: usize) {
        let top = self.top[k] as usize;
        let Some(room) = self.stacks[k].get_mut(top..top + WIDTH) else { return self.give_up(k) };
        let count = push(simd, node, pass, room);
        let top = top + count - 1;
        self.top[k] = top as u32;
        self.at[k] = Child(self.stacks[k][top % ROOM]);
    }

    /// Lets the next line fly at place `k`, if there is one.
    #[inline(always)]
    fn launch<S: Simd>(&mut self, simd: S, k: usize, inner: &mut List, leaves: &mut List) {
        let Some(word) = self.live.iter().position(|word| *word != 0) else {
            return self.resume(k, inner, leaves);
        };
        let i = 64 * word + self.live[word].trailing_zeros() as usize;
        self.live[word] &= self.live[word] - 1;
        (self.line[k], self.top[k]) = (i as u32, 1);
        let root = self.root;
        self.descend(simd, root, mask32x8::from_bitmask(simd, self.ready.roots(i)), k);
        self.sort_in(k, inner, leaves);
    }

    /// Lets the next job fly at place `k`, if there is one.
    #[inline(always)]
    fn resume(&mut self, k: usize, inner: &mut List, leaves: &mut List) {
        while let Some(((line, child), rest)) = self.jobs.split_first() {
            self.jobs = rest;
            if self.answers[*line as usize % CHUNK / 64] >> (line % 64) & 1 == 0 {
                (self.line[k], self.at[k], self.top[k]) = (*line, *child, 1);
                return self.sort_in(k, inner, leaves);
            }
        }
    }

    /// Answers the lines that cannot fly.
    #[inline(always)]
    pub fn wild(&mut self, wild: &Lot) {
        for (k, word) in wild.iter().enumerate() {
            let mut left = *word;
            while left != 0 {
                self.by_itself(64 * k + left.trailing_zeros() as usize);
                left &= left - 1;
            }
        }
    }

    /// Where the line at place `k` goes on; what it needs there is asked for.
    #[inline(always)]
    fn sort_in(&mut self, k: usize, inner: &mut List, leaves: &mut List) {
        let at = self.at[k];
        fetch(&self.chunk.of.tree.nodes, &self.chunk.of.blocks, at);
        inner.add(k, !at.is_leaf());
        leaves.add(k, at.is_leaf());
    }

    /// Line `i` is blocked.
    #[inline(always)]
    fn block(&mut self, i: usize) {
        self.answers[i % CHUNK / 64] |= 1 << (i % 64);
    }

    /// The line at place `k` has no room for what is before it.
    #[inline(never)]
    #[cold]
    fn give_up(&mut self, k: usize) {
        self.by_itself(self.line[k] as usize);
        (self.at[k], self.top[k]) = (Child::leaf(0), 0);
    }

    /// Answers line `i` outside the flight.
    #[inline(never)]
    #[cold]
    fn by_itself(&mut self, i: usize) {
        let entry = self.chunk.from + i;
        if (self.alone)(entry, self.chunk.lines.line(entry)) {
            self.block(i);
        }
    }
}

/// Writes the children in `pass`, best last; how many.
#[inline(always)]
fn push<S: Simd>(simd: S, node: &Node, pass: mask32x8<S>, room: &mut [u32]) -> usize {
    let mut met = pass.to_bitmask() as u32;
    let count = met.count_ones() as usize;
    if packs(simd.level()) {
        let children = u32x8::load_array(simd, node.child.map(|c| c.0));
        children.compress(pass).store_slice(room);
    } else {
        for slot in room.iter_mut().take(count) {
            *slot = node.child[met.trailing_zeros() as usize % WIDTH].0;
            met &= met - 1;
        }
    }
    count
}

/// The level has an instruction or two for [`compress`](SimdBase::compress).
#[inline(always)]
fn packs(level: Level) -> bool {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    return matches!(level, Level::Avx2(_) | Level::Avx512(_));
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    {
        let _ = level;
        false
    }
}

/// Asks for the memory of `child`; no branch depends on what it is.
#[inline(always)]
fn fetch(nodes: &[Node], blocks: &[TriangleBlock], child: Child) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        const { assert!(size_of::<Node>() == 256 && size_of::<TriangleBlock>() == 320) };
        let more = if child.is_leaf() { 64 } else { 0 };
        let base = if child.is_leaf() { blocks.as_ptr().cast::<i8>() } else { nodes.as_ptr().cast::<i8>() };
        let at = base.wrapping_add(child.index() * (256 + more));
        for line in [0, 64, 128, 192, 192 + more] {
            // SAFETY: a prefetch has no effect on memory or registers and cannot fault, whatever the address.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(line)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (nodes, blocks, child);
}

#[cfg(test)]
#[path = "flight_tests.rs"]
mod tests;
