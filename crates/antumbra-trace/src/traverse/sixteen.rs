//! Sixteen lines side by side against the triangles of a block, one after the other: what of a test does not depend on
//! the line is computed once for all of them (docs/visibility.md §2).

use fearless_simd::{Simd, f32x8, f32x16, mask32x16, prelude::*};

use super::filter::{TINY, U};
use super::vector::V3;
use crate::layout::{TriangleBlock, WIDTH};

/// Lines of a packet.
pub(crate) const PACKET: usize = 16;

/// One number a triangle.
type Row8 = [f32; WIDTH];

/// Eight triangles seen from a point c: A, B, C are the corners minus c.
pub(crate) struct Seen {
    /// e_i × (A_i + A_i+1), by edge.
    pub turn: [[Row8; 3]; 3],
    /// e_i; only for origins of their own.
    edge: [[Row8; 3]; 3],
    /// n = e0 × e1.
    pub normal: [Row8; 3],
    /// P + 2⁻¹²⁰, P = |e0| X |e1|.
    pub span: [Row8; 3],
    /// A·n, and the bound of V.
    pub volume: [Row8; 2],
    /// What the bound of the edges is, but for 40 u D1: E (L + |q|∞), a fifth more for origins of their own.
    pub bound: Row8,
}

impl Seen {
    /// From `c`, or each from its own lane of it; with `OWN` origins, which lie within `q` of it in every component.
    #[inline(always)]
    pub fn of<S: Simd, const OWN: bool>(simd: S, block: &TriangleBlock, c: V3<S>, q: f32) -> Seen {
        let [va, vb, vc] = &block.corners;
        let (va, vb, vc) = (V3::load(simd, va), V3::load(simd, vb), V3::load(simd, vc));
        let (pa, pb, pc) = (va.minus(c), vb.minus(c), vc.minus(c));
        let (e0, e1, e2) = (vb.minus(va), vc.minus(vb), va.minus(vc));
        let [t0, t1, t2] = [e0.cross(pa.plus(pb)), e1.cross(pb.plus(pc)), e2.cross(pc.plus(pa))];
        let (n, e0a, e1a) = (e0.cross(e1), e0.abs(), e1.abs());
        let tiny = f32x8::splat(simd, TINY);
        let span = V3 {
            x: e0a.y.mul_add(e1a.z, e0a.z.mul_add(e1a.y, tiny)),
            y: e0a.z.mul_add(e1a.x, e0a.x.mul_add(e1a.z, tiny)),
            z: e0a.x.mul_add(e1a.y, e0a.y.mul_add(e1a.x, tiny)),
        };
        let edge = f32x8::load_array_ref(simd, &block.edge);
        let (mut far, mut size) = (pa.abs(), pa.abs().largest() + edge);
        if OWN {
            (far.x, far.y, far.z) = (far.x + q, far.y + q, far.z + q);
            size = (size + q) * 1.2;
        }
        Seen {
            turn: [rows(t0), rows(t1), rows(t2)],
            edge: if OWN { [rows(e0), rows(e1), rows(e2)] } else { [[[0.0; WIDTH]; 3]; 3] },
            normal: rows(n),
            span: rows(span),
            volume: [pa.dot(n).to_array(), far.dot(span).mul_add(12.0 * U, tiny).to_array()],
            bound: (edge * size).to_array(),
        }
    }
}

/// By axis.
#[inline(always)]
fn rows<S: Simd>(v: V3<S>) -> [Row8; 3] {
    [v.x.to_array(), v.y.to_array(), v.z.to_array()]
}

/// v · (the vector in `lane` of `of`) + `rest`.
#[inline(always)]
fn dot<S: Simd>(simd: S, v: &[f32x16<S>; 3], of: &[Row8; 3], lane: usize, rest: f32x16<S>) -> f32x16<S> {
    let z = v[2].mul_add(f32x16::splat(simd, of[2][lane]), rest);
    v[0].mul_add(f32x16::splat(simd, of[0][lane]), v[1].mul_add(f32x16::splat(simd, of[1][lane]), z))
}

/// Sixteen lines: what triangles read of them.
#[derive(Clone, Copy)]
pub(crate) struct Sixteen<S: Simd> {
    pub d: [f32x16<S>; 3],
    /// q = o − c; 0 for a common origin.
    pub q: [f32x16<S>; 3],
    /// 2 d × q; 0 for a common origin.
    pub m: [f32x16<S>; 3],
    /// 40 u D1.
    pub bound: f32x16<S>,
    pub tmax: f32x16<S>,
}

/// Which lines hit a triangle for certain, and for which only the law can say.
pub(crate) struct Met {
    pub hit: u32,
    pub open: u32,
}

impl<S: Simd> Sixteen<S> {
    /// Decides what f32 can decide about the triangle in `lane` and the lines `active`.
    #[inline(always)]
    pub fn test<const OWN: bool>(&self, simd: S, seen: &Seen, lane: usize, active: u32) -> Met {
        let lane = lane % WIDTH;
        let (w0, w1, w2) = (
            self.edge::<OWN>(simd, seen, 0, lane),
            self.edge::<OWN>(simd, seen, 1, lane),
            self.edge::<OWN>(simd, seen, 2, lane),
        );
        let bound = self.bound * seen.bound[lane];
        let (low, high) = (w0.min(w1).min(w2), w0.max(w1).max(w2));
        let outside = low.simd_lt(-bound) & high.simd_gt(bound);
        let undecided = active & !(outside.to_bitmask() as u32);
        if undecided == 0 {
            return Met { hit: 0, open: 0 };
        }
        let inside = (low.simd_gt(bound) | high.simd_lt(-bound)).to_bitmask() as u32;
        let (d, zero) = (&self.d, f32x16::splat(simd, 0.0));
        let det = dot(simd, d, &seen.normal, lane, zero);
        let tiny = f32x16::splat(simd, TINY);
        let size = [d[0].abs(), d[1].abs(), d[2].abs()];
        let bd = dot(simd, &size, &seen.span, lane, zero).mul_add(12.0 * U, tiny);
        let [v, bv] = [f32x16::splat(simd, seen.volume[0][lane]), f32x16::splat(simd, seen.volume[1][lane])];
        let v = if OWN { v - dot(simd, &self.q, &seen.normal, lane, zero) } else { v };
        let (hit, miss) = self.before_end(simd, (det, bd), (v, bv));
        let hit = (hit.to_bitmask() as u32) & inside & undecided;
        Met { hit, open: undecided & !hit & !(miss.to_bitmask() as u32) }
    }

    /// w of edge `i` of the triangle in `lane`.
    #[inline(always)]
    fn edge<const OWN: bool>(&self, simd: S, seen: &Seen, i: usize, lane: usize) -> f32x16<S> {
        let zero = f32x16::splat(simd, 0.0);
        let own = if OWN { dot(simd, &self.m, &seen.edge[i], lane, zero) } else { zero };
        dot(simd, &self.d, &seen.turn[i], lane, own)
    }

    /// Whether 0 < V/D < tmax holds for certain, or fails for certain; as in the filter of one line.
    #[inline(always)]
    pub fn before_end(
        &self,
        simd: S,
        (det, bd): (f32x16<S>, f32x16<S>),
        (v, bv): (f32x16<S>, f32x16<S>),
    ) -> (mask32x16<S>, mask32x16<S>) {
        let sv = det.simd_lt(0.0).select(-v, v);
        let size = det.abs();
        let (far, bf) = (self.tmax.mul_sub(size, sv), self.tmax.mul_add(bd, bv));
        let sure = size.simd_gt(bd);
        let ends = far.simd_gt(bf) | self.tmax.simd_eq(f32x16::splat(simd, f32::INFINITY));
        let hit = sure & sv.simd_gt(bv) & ends;
        let miss = sure & (sv.simd_lt(-bv) | far.simd_lt(-bf));
        (hit, miss)
    }
}

#[cfg(test)]
#[path = "sixteen_tests.rs"]
mod tests;
