//! The numbers of the law's stage 1 with the three edges side by side: the same operations in the same order on each
//! edge, hence the same bits as the law's own, for the few triangles that are left when a closest hit is decided.

use fearless_simd::{Simd, f64x4, prelude::*};

use crate::law::{Edges, Numbers, TEN_W};
use crate::layout::TriangleBlock;

/// One vector an edge; the fourth lane repeats the first.
#[derive(Clone, Copy)]
struct Four<S: Simd> {
    x: f64x4<S>,
    y: f64x4<S>,
    z: f64x4<S>,
}

impl<S: Simd> Four<S> {
    #[inline(always)]
    fn splat(simd: S, v: &[f64; 3]) -> Four<S> {
        Four { x: f64x4::splat(simd, v[0]), y: f64x4::splat(simd, v[1]), z: f64x4::splat(simd, v[2]) }
    }

    /// Four corners of the triangle in `lane`.
    #[inline(always)]
    fn corners(simd: S, block: &TriangleBlock, lane: usize, which: [usize; 4]) -> Four<S> {
        let [i, j, k, l] = which;
        let row = |axis: usize| {
            let c = |corner: usize| f64::from(block.corners[corner][axis][lane]);
            f64x4::load_array(simd, [c(i), c(j), c(k), c(l)])
        };
        Four { x: row(0), y: row(1), z: row(2) }
    }

    #[inline(always)]
    fn minus(self, b: Four<S>) -> Four<S> {
        Four { x: self.x - b.x, y: self.y - b.y, z: self.z - b.z }
    }

    #[inline(always)]
    fn plus(self, b: Four<S>) -> Four<S> {
        Four { x: self.x + b.x, y: self.y + b.y, z: self.z + b.z }
    }

    #[inline(always)]
    fn abs(self) -> Four<S> {
        Four { x: self.x.abs(), y: self.y.abs(), z: self.z.abs() }
    }

    #[inline(always)]
    fn dot(self, b: Four<S>) -> f64x4<S> {
        (self.x * b.x + self.y * b.y) + self.z * b.z
    }

    #[inline(always)]
    fn cross(self, b: Four<S>) -> Four<S> {
        Four {
            x: self.y * b.z - self.z * b.y,
            y: self.z * b.x - self.x * b.z,
            z: self.x * b.y - self.y * b.x,
        }
    }

    /// The cross product of absolute values with + instead of −.
    #[inline(always)]
    fn cross_bound(self, b: Four<S>) -> Four<S> {
        let (x, y) = (self.abs(), b.abs());
        Four { x: x.y * y.z + x.z * y.y, y: x.z * y.x + x.x * y.z, z: x.x * y.y + x.y * y.x }
    }
}

/// Stage 1 of the line o + t d and the triangle in `lane`, short of its decision.
#[inline(always)]
pub(crate) fn numbers<S: Simd>(
    simd: S,
    (o, d): (&[f64; 3], &[f64; 3]),
    block: &TriangleBlock,
    lane: usize,
) -> Numbers {
    let (o, d) = (Four::splat(simd, o), Four::splat(simd, d));
    let (from, to) =
        (Four::corners(simd, block, lane, [0, 1, 2, 0]), Four::corners(simd, block, lane, [1, 2, 0, 1]));
    let e = to.minus(from);
    let (p, q) = (from.minus(o), to.minus(o));
    let w = d.dot(e.cross(p.plus(q))).to_array();
    let ten_w = f64x4::splat(simd, TEN_W);
    let b = (ten_w * d.abs().dot(e.cross_bound(p.abs().plus(q.abs())))).to_array();
    // Lane 0: e0 × e1 and what is made of it.
    let e1 =
        Four::corners(simd, block, lane, [2, 2, 2, 2]).minus(Four::corners(simd, block, lane, [1, 1, 1, 1]));
    let (n, size) = (e.cross(e1), e.cross_bound(e1));
    let first = |x: f64x4<S>| x.to_array()[0];
    Numbers {
        edges: Edges { w: [w[0], w[1], w[2]], b: [b[0], b[1], b[2]] },
        v: (first(p.dot(n)), first(ten_w * p.abs().dot(size))),
        det: (first(d.dot(n)), first(ten_w * d.abs().dot(size))),
    }
}
