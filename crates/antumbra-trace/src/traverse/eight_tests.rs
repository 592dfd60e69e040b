//! What is clear for eight pairs side by side is what the law says of each alone, bit by bit; nearly all plain hits are.

use fearless_simd::dispatch;

use super::*;
use crate::law::{self, Line};
use crate::level::SimdLevel;
use crate::{NO_PRIM, SegmentBuffer};

/// A number of a fixed sequence in −1 … 1.
fn number(state: &mut u32) -> f32 {
    *state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    (*state >> 8) as f32 / 8_388_608.0 - 1.0
}

#[test]
fn what_is_clear_is_what_the_law_says() {
    let mut state = 6;
    let mut asked = SegmentBuffer::default();
    let mut blocks = Vec::new();
    for k in 0..8 * 200 {
        let mut point = || [0, 1, 2].map(|_| number(&mut state));
        let corners = [point(), point(), point()];
        let (o, d) = (point(), point());
        let end = [f32::INFINITY, 3.0, 0.5][k % 3];
        if k % 4 == 0 {
            asked.push_segment(o, d.map(|c| 2.0 * c), NO_PRIM, NO_PRIM, 0);
        } else {
            asked.push_ray(o, d, end, NO_PRIM, 0);
        }
        blocks.push(TriangleBlock::new(&[corners]));
    }
    let segments = asked.as_segments();
    for level in SimdLevel::available() {
        let token = level.token().expect("available");
        let (mut hits, mut clear) = (0, 0);
        for from in (0..segments.len()).step_by(WIDTH) {
            let mut pairs = Pairs::NONE;
            (0..WIDTH).for_each(|k| pairs.add(k, (from + k) as u32, 0));
            let lines = Lines::of(&segments);
            let found = dispatch!(token, simd => pairs.decide(simd, (&lines, from), &blocks));
            for k in 0..WIDTH {
                let (line, corners) = (Line::of(&segments, from + k), blocks[from + k].triangle(0));
                let truth = law::triangle(&line, corners);
                hits += usize::from(truth.is_some());
                if found.clear >> k & 1 == 1 {
                    clear += 1;
                    assert_eq!(truth, Some(found.t[k]), "{level:?}");
                    assert_eq!(law::barycentrics(&line, corners), found.uv(k), "{level:?}");
                }
            }
        }
        assert!(hits > 30 && clear == hits, "{clear} of {hits} at {level:?}");
    }
}
