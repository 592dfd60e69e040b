//! Which way a chunk of lines goes: rules by counted work, all in this file. They change how long an answer takes, never the
//! answer.
//!
//! | rule | measured by |
//! |---|---|
//! | a chunk goes one of four ways ([`Way`]): the one that took the least work a line so far | [`Turns`], by kind of line |
//! | the other ways are tried again, more and more seldom | [`SELDOM`] chunks at most between two trials |
//! | eight triangles or fewer behind a shaft are tested without boxes, by packets | `gate.rs` |
//! | a packet has a shaft of its own where its ends are closer together than half the scene | `packet.rs` |
//! | a line leaves its packet where no more than [`ALONE`] of it are left in a box | `packet.rs` |

use std::cell::RefCell;

use crate::{Segments, TO_POINT};

/// So many lines of a packet go on alone.
pub(super) const ALONE: u32 = 1;
/// Most chunks between two trials of ways that were slower.
const SELDOM: u32 = 64;

/// Which ways a world may go. The answers are the same; tests and measurements force them.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ways {
    /// The one that takes the least work.
    #[default]
    Measured,
    /// A shaft for every chunk, a packet for every sixteen lines.
    Together,
    /// A packet for every sixteen lines.
    Packets,
    /// The largest triangles first.
    Walls,
    /// Each line for itself.
    Alone,
}

/// How a chunk is answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Each line for itself, sixteen in flight.
    Alone,
    /// Sixteen lines side by side.
    Packets,
    /// The same behind a shaft of all lines of the chunk.
    Shaft,
    /// Sixteen lines side by side against the largest triangles; then each line for itself.
    Walls,
}

const WAYS: [Way; 4] = [Way::Shaft, Way::Packets, Way::Walls, Way::Alone];

/// What is known of one kind of lines.
#[derive(Clone, Copy, Debug)]
struct Kind {
    /// Work a line, by way; a running mean.
    cost: [f32; WAYS.len()],
    /// Chunks so far, up to the first trials.
    tried: usize,
    /// Chunks until the next trial, and between trials.
    left: u32,
    pause: u32,
    /// The way that is tried next.
    next: usize,
}

impl Kind {
    const NEW: Kind = Kind { cost: [f32::INFINITY; WAYS.len()], tried: 0, left: 0, pause: 2, next: 0 };
    /// Every way is tried so often before there is a choice.
    const FIRST: usize = 2 * WAYS.len();

    fn best(&self) -> usize {
        (1..WAYS.len()).fold(0, |best, k| if self.cost[k] < self.cost[best] { k } else { best })
    }

    fn choose(&mut self) -> usize {
        if self.tried < Kind::FIRST {
            self.tried += 1;
            return self.tried % WAYS.len();
        }
        if self.left > 0 {
            self.left -= 1;
            return self.best();
        }
        (self.left, self.pause) = (self.pause, (2 * self.pause).min(SELDOM));
        self.next = (self.next + 1) % WAYS.len();
        self.next
    }

    fn learn(&mut self, way: usize, cost: f32) {
        let (old, before) = (self.cost[way], self.best());
        // A single chunk counts no more than thrice the mean.
        self.cost[way] = if old < f32::INFINITY { old + 0.25 * (cost.min(3.0 * old) - old) } else { cost };
        if self.best() != before {
            self.pause = 2;
        }
    }
}

/// Kinds of lines: with an end or without, many from one start or each from its own.
const KINDS: usize = 4;

/// What a thread has learnt of the world that it asked last.
#[derive(Clone, Copy, Debug)]
struct Memory {
    world: usize,
    kinds: [Kind; KINDS],
}

thread_local! {
    static MEMORY: RefCell<Memory> = const { RefCell::new(Memory { world: 0, kinds: [Kind::NEW; KINDS] }) };
}

/// The rules while a batch is answered.
#[derive(Clone, Debug)]
pub(super) struct Rules {
    ways: Ways,
    memory: Memory,
}

/// What was done for a chunk, each of which takes about the same time wherever it is done.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Turns {
    /// Lines in flight, at a node and at a leaf block.
    pub nodes: usize,
    pub leaves: usize,
    /// Lines made ready for boxes.
    pub ready: usize,
    /// Nodes that a shaft looked into.
    pub looks: usize,
    /// Packets; their nodes, boxes met by sixteen lines, leaf blocks, and triangles tested.
    pub packets: usize,
    pub packet_nodes: usize,
    pub packet_boxes: usize,
    pub packet_leaves: usize,
    pub packet_triangles: usize,
}

impl Turns {
    /// About how long that takes [ns]: weights with which the ways come out in the order in which they were measured
    /// (docs/performance.md), not measured one by one. In a `large` tree, one beyond
    /// the caches, lines in flight hide what a packet waits for.
    fn cost(&self, large: bool) -> f32 {
        let [alone, wait] = if large { LARGE } else { SMALL };
        let sum = |parts: &[(usize, f32)]| parts.iter().map(|(n, ns)| *n as f32 * ns).sum::<f32>();
        sum(&[(self.ready, 3.0), (self.nodes, alone[0]), (self.leaves, alone[1])])
            + self.looks as f32 * (15.0 + wait[0])
            + sum(&[(self.packets, 90.0), (self.packet_nodes, 15.0 + wait[0]), (self.packet_boxes, 6.0)])
            + sum(&[(self.packet_leaves, 35.0 + wait[1]), (self.packet_triangles, 6.0)])
    }
}

/// A node and a leaf block: for a line in flight, and what a packet waits for them [ns].
const SMALL: [[f32; 2]; 2] = [[9.0, 22.0], [0.0, 0.0]];
const LARGE: [[f32; 2]; 2] = [[12.0, 30.0], [40.0, 60.0]];

/// A choice, to be judged when the chunk is answered.
#[derive(Clone, Copy, Debug)]
pub(super) struct Choice {
    pub way: Way,
    kind: usize,
}

impl Rules {
    /// For a batch that asks `world`, any number that tells worlds apart.
    pub fn recall(ways: Ways, world: usize) -> Rules {
        let known = MEMORY.with(|memory| memory.try_borrow().map(|memory| *memory).ok());
        let new = Memory { world, kinds: [Kind::NEW; KINDS] };
        Rules { ways, memory: known.filter(|memory| memory.world == world).unwrap_or(new) }
    }

    /// Keeps what the batch taught.
    pub fn remember(&self) {
        MEMORY.with(|memory| {
            if let Ok(mut memory) = memory.try_borrow_mut() {
                *memory = self.memory;
            }
        });
    }

    /// The way of the chunk that begins with entry `from`.
    pub fn choose(&mut self, segments: &Segments<'_>, from: usize) -> Choice {
        let kind = kind(segments, from);
        let way = match self.ways {
            Ways::Measured => WAYS[self.memory.kinds[kind].choose()],
            Ways::Together => Way::Shaft,
            Ways::Packets => Way::Packets,
            Ways::Walls => Way::Walls,
            Ways::Alone => Way::Alone,
        };
        Choice { way, kind }
    }

    /// The chunk of `count` entries is answered, with so much work.
    pub fn learn(&mut self, choice: &Choice, count: usize, work: &Turns, large: bool) {
        let cost = work.cost(large) / count.max(1) as f32;
        let way = WAYS.iter().position(|way| *way == choice.way).unwrap_or(0);
        self.memory.kinds[choice.kind].learn(way, cost);
    }
}

/// The kind of entry `from`.
fn kind(segments: &Segments<'_>, from: usize) -> usize {
    let Some(&reach) = segments.reach.get(from) else { return 0 };
    let common = from + 1 < segments.len() && segments.origin_at(from) == segments.origin_at(from + 1);
    usize::from(reach == TO_POINT || reach < f32::INFINITY) + 2 * usize::from(common)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The way that costs least is taken nearly always, and another one soon after it has become the cheaper one.
    #[test]
    fn the_cheapest_way_is_found_and_left() {
        let mut kind = Kind::NEW;
        for cheap in [2, 0, 3, 1] {
            let chosen: Vec<usize> = (0..2000)
                .map(|_| {
                    let way = kind.choose();
                    kind.learn(way, if way == cheap { 1.0 } else { 1.5 });
                    way
                })
                .collect();
            let right = |part: &[usize]| part.iter().filter(|way| **way == cheap).count();
            assert!(right(&chosen[1000..]) > 950, "{cheap}: {}", right(&chosen[1000..]));
        }
    }
}
