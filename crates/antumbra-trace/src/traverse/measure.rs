//! The numbers of the law's stage 1 with the three edges side by side: the same operations in the same order on each
//! edge, hence the same bits as the law's own, for the few triangles that are left when a closest hit is decided.

use std::ops::{Add, Mul, Sub};

use fearless_simd::{Simd, f64x4, f64x8, prelude::*};

use crate::law::{Edges, Numbers, TEN_W};
use crate::layout::TriangleBlock;

/// f64 numbers side by side.
pub(super) trait Wide: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// Absolute values.
    fn size(self) -> Self;
}

impl<S: Simd> Wide for f64x4<S> {
    #[inline(always)]
    fn size(self) -> Self {
        self.abs()
    }
}

impl<S: Simd> Wide for f64x8<S> {
    #[inline(always)]
    fn size(self) -> Self {
        self.abs()
    }
}

/// Vectors side by side, with the law's operations.
#[derive(Clone, Copy)]
pub(super) struct Vectors<F> {
    pub x: F,
    pub y: F,
    pub z: F,
}

impl<F: Wide> Vectors<F> {
    #[inline(always)]
    pub fn minus(self, b: Self) -> Self {
        Vectors { x: self.x - b.x, y: self.y - b.y, z: self.z - b.z }
    }

    #[inline(always)]
    pub fn plus(self, b: Self) -> Self {
        Vectors { x: self.x + b.x, y: self.y + b.y, z: self.z + b.z }
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        Vectors { x: self.x.size(), y: self.y.size(), z: self.z.size() }
    }

    #[inline(always)]
    pub fn dot(self, b: Self) -> F {
        (self.x * b.x + self.y * b.y) + self.z * b.z
    }

    #[inline(always)]
    pub fn cross(self, b: Self) -> Self {
        Vectors {
            x: self.y * b.z - self.z * b.y,
            y: self.z * b.x - self.x * b.z,
            z: self.x * b.y - self.y * b.x,
        }
    }

    /// The cross product of absolute values with + instead of −.
    #[inline(always)]
    pub fn cross_bound(self, b: Self) -> Self {
        let (x, y) = (self.abs(), b.abs());
        Vectors { x: x.y * y.z + x.z * y.y, y: x.z * y.x + x.x * y.z, z: x.x * y.y + x.y * y.x }
    }

    /// w and its bound of the edge `self` between points that lie at `p` and `q` from the origin of a line along `d`.
    #[inline(always)]
    pub fn edge(self, d: Self, p: Self, q: Self, ten_w: F) -> [F; 2] {
        let bound = ten_w * d.abs().dot(self.cross_bound(p.abs().plus(q.abs())));
        [d.dot(self.cross(p.plus(q))), bound]
    }
}

/// One vector an edge; the fourth lane repeats the first.
type Four<S> = Vectors<f64x4<S>>;

#[inline(always)]
fn splat<S: Simd>(simd: S, v: &[f64; 3]) -> Four<S> {
    Four { x: f64x4::splat(simd, v[0]), y: f64x4::splat(simd, v[1]), z: f64x4::splat(simd, v[2]) }
}

/// Four corners of the triangle in `lane`.
#[inline(always)]
fn corners<S: Simd>(simd: S, block: &TriangleBlock, lane: usize, [i, j, k, l]: [usize; 4]) -> Four<S> {
    let row = |axis: usize| {
        let c = |corner: usize| f64::from(block.corners[corner][axis][lane]);
        f64x4::load_array(simd, [c(i), c(j), c(k), c(l)])
    };
    Four { x: row(0), y: row(1), z: row(2) }
}

/// Stage 1 of the line o + t d and the triangle in `lane`, short of its decision.
#[inline(always)]
pub(crate) fn numbers<S: Simd>(
    simd: S,
    (o, d): (&[f64; 3], &[f64; 3]),
    block: &TriangleBlock,
    lane: usize,
) -> Numbers {
    let (o, d) = (splat(simd, o), splat(simd, d));
    let (from, to) = (corners(simd, block, lane, [0, 1, 2, 0]), corners(simd, block, lane, [1, 2, 0, 1]));
    let e = to.minus(from);
    let (p, q) = (from.minus(o), to.minus(o));
    let ten_w = f64x4::splat(simd, TEN_W);
    let [w, b] = e.edge(d, p, q, ten_w).map(|x| x.to_array());
    // Lane 0: e0 × e1 and what is made of it.
    let e1 = corners(simd, block, lane, [2, 2, 2, 2]).minus(corners(simd, block, lane, [1, 1, 1, 1]));
    let (n, size) = (e.cross(e1), e.cross_bound(e1));
    let first = |x: f64x4<S>| x.to_array()[0];
    Numbers {
        edges: Edges { w: [w[0], w[1], w[2]], b: [b[0], b[1], b[2]] },
        v: (first(p.dot(n)), first(ten_w * p.abs().dot(size))),
        det: (first(d.dot(n)), first(ten_w * d.abs().dot(size))),
    }
}
