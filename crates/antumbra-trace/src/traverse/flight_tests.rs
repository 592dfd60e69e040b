//! Lines that find no room for what is before them are answered outside the flight, all others in it; also where there
//! are more lines than places, and fewer.

use std::cell::Cell;

use fearless_simd::dispatch;

use super::*;
use crate::layout::{Bounds, Tree, leaf_ids};
use crate::level::SimdLevel;
use crate::traverse::ask::Opaque;
use crate::traverse::ray::Limits;
use crate::traverse::triangles::TriangleTree;
use crate::traverse::{Lines, Room, Ways};
use crate::{NO_PRIM, SegmentBuffer};

/// A chain of nodes in one box: at each, a line leaves seven leaf blocks behind and goes on to the next node. Nothing
/// in the box is hit.
fn chain(nodes: usize) -> TriangleTree {
    let bounds = Bounds { lo: [-1.0; 3], hi: [1.0; 3] };
    let mut tree = Tree { bounds, scale: 8.0, depth: nodes, sah_cost: 1.0, ..Tree::default() };
    for k in 0..nodes {
        let mut node = Node::EMPTY;
        for lane in 0..WIDTH {
            let next = lane == WIDTH - 1 && k + 1 < nodes;
            let child = if next { Child::node(k + 1) } else { Child::leaf(tree.leaves.len()) };
            if !next {
                tree.leaves.push(leaf_ids(std::iter::once(0)));
            }
            node.set(lane, &bounds, tree.scale, child);
        }
        tree.nodes.push(node);
    }
    let beside = [[5.0, 5.0, 5.0], [6.0, 5.0, 5.0], [5.0, 6.0, 5.0]];
    let blocks = vec![TriangleBlock::new(&[beside]); tree.leaves.len()];
    TriangleTree { limits: Limits::of(&tree), tree, blocks, masked: Vec::new(), walls: Vec::new() }
}

/// How many of `count` lines through a chain are answered outside the flight; the flight believes those answers.
fn outside(nodes: usize, count: usize, level: SimdLevel) -> usize {
    let of = chain(nodes);
    let mut asked = SegmentBuffer::default();
    for i in 0..count {
        asked.push_ray([0.001 * i as f32, 0.0, -3.0], [0.0, 0.01, 1.0], f32::INFINITY, NO_PRIM, 0);
    }
    let segments = asked.as_segments();
    let chunk =
        Chunk { of: &of, segments: &segments, lines: &Lines::of(&segments), masks: &Opaque, from: 0, count };
    let alone = Cell::new(0);
    let answer = |_, _| {
        alone.set(alone.get() + 1);
        true
    };
    let level = level.token().expect("available");
    let answers = dispatch!(level, simd => chunk.blocked(simd, &mut Room::new(Ways::Alone, &of), answer));
    assert_eq!(answers.iter().map(|word| word.count_ones() as usize).sum::<usize>(), alone.get());
    alone.get()
}

#[test]
fn lines_without_room_are_answered_outside() {
    // One number lies below all; a node takes one away and adds eight, for which there must be room.
    let fits = (ROOM - WIDTH - 1) / (WIDTH - 1) + 1;
    for level in SimdLevel::available() {
        for count in [0, 1, FLIGHT - 1, FLIGHT, FLIGHT + 1, 100, CHUNK] {
            assert_eq!(outside(fits, count, level), 0, "{count} lines at {level:?}");
            assert_eq!(outside(fits + 1, count, level), count, "{count} lines at {level:?}");
        }
    }
}
