//! No point of a segment lies where its shaft says that nothing is: boxes and triangles through which a segment goes
//! are always met, at every scale; and most of what lies beside is not.

#![allow(clippy::needless_range_loop, reason = "an axis or a lane is the same place in several arrays")]

use fearless_simd::dispatch;

use super::*;
use crate::layout::{Child, WIDTH};
use crate::level::SimdLevel;

use super::super::filter::rng::{Rng, amount, mix, to_f32, to_f64};

/// A box of points about `c`.
fn bounds(r: &mut Rng, c: [f64; 3], size: f64) -> Bounds {
    let flat = r.below(4) as usize;
    let mut p = [0; 2].map(|_| r.cube(size));
    if flat < 3 {
        p[1][flat] = p[0][flat];
    }
    let [p, q] = p.map(|p| to_f32([0, 1, 2].map(|k| c[k] + p[k])));
    Bounds { lo: [0, 1, 2].map(|k| smaller(p[k], q[k])), hi: [0, 1, 2].map(|k| larger(p[k], q[k])) }
}

/// A point of a box: often a corner.
fn inside(r: &mut Rng, b: &Bounds) -> [f64; 3] {
    [0, 1, 2].map(|k| match r.below(3) {
        0 => f64::from(b.lo[k]),
        1 => f64::from(b.hi[k]),
        _ => {
            let w = r.unit();
            (w * f64::from(b.lo[k]) + (1.0 - w) * f64::from(b.hi[k]))
                .clamp(f64::from(b.lo[k]), f64::from(b.hi[k]))
        }
    })
}

/// A triangle near `x`, of which a part touches it: a corner or a point inside.
fn around(r: &mut Rng, x: [f64; 3], size: f64) -> [[f32; 3]; 3] {
    let corner = to_f32(x);
    let other = |r: &mut Rng| {
        let e = r.cube(size);
        to_f32([0, 1, 2].map(|k| x[k] + e[k]))
    };
    [corner, other(r), other(r)]
}

#[test]
fn what_a_segment_meets_its_shaft_meets() {
    let mut r = Rng::new(31);
    let (mut asked, mut beside) = (0, 0);
    for _ in 0..amount(20_000, 2_000_000) {
        let s = libm::exp2(r.range(-100.0, 38.0).round());
        let near = [1.0, 0.1, 1e-3, 1e-6][r.below(4) as usize];
        let (a, b) = (r.cube(s), r.cube(s));
        let (from, to) = (bounds(&mut r, a, s * near), bounds(&mut r, b, s * near));
        let mut node = Node::EMPTY;
        let mut triangles = [[[0.0; 3]; 3]; WIDTH];
        let mut met = 0;
        for lane in 0..WIDTH {
            let (p, q) = (inside(&mut r, &from), inside(&mut r, &to));
            // A point of the segment that is an f32 point: an end of it.
            let x = if lane % 2 == 0 { to_f64(to_f32(p)) } else { mix([0.5, 0.5], [p, q]) };
            let size = s * [1.0, 1e-2, 1e-5][r.below(3) as usize];
            let beyond = r.below(2) == 0;
            let away = r.cube(size);
            let x = if beyond { [0, 1, 2].map(|k| x[k] + away[k]) } else { x };
            let t = around(&mut r, x, size);
            triangles[lane] = t;
            let mut own = Bounds::of_corners(t);
            if lane % 2 == 1 {
                // The point itself is in the box.
                for k in 0..3 {
                    own.lo[k] = smaller(own.lo[k], crate::layout::below(x[k]));
                    own.hi[k] = larger(own.hi[k], crate::layout::above(x[k]));
                }
            }
            node.set(lane, &own, 4.0 * s, Child::leaf(lane));
            met |= u32::from(!beyond) << lane;
        }
        let block = TriangleBlock::new(&triangles);
        for level in SimdLevel::available() {
            let token = level.token().unwrap_or_else(fearless_simd::Level::baseline);
            let shaft = dispatch!(token, simd => Shaft::of(simd, &from, &to));
            let boxes = dispatch!(token, simd => shaft.meets(simd, &node));
            assert_eq!(boxes & met, met, "{level:?} {from:?} {to:?} {node:?}");
            let hit = dispatch!(token, simd => shaft.triangles(simd, &block, 4.0 * s as f32));
            // Even lanes have a corner that is a point of the hull.
            assert_eq!(hit & met & 0x55, met & 0x55, "{level:?} {from:?} {to:?} {triangles:?}");
            asked += WIDTH;
            beside += (boxes.count_zeros() - 24) as usize;
        }
    }
    assert!(beside * 8 > asked, "{beside} of {asked}");
}
