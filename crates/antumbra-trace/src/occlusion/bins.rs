//! Where on the hemisphere there are directions: leaves out triangles so small that they lie between them.

use fearless_simd::{Simd, f32x8, prelude::*, u32x8};

use super::levels::FLOOR;
use super::pairs::Lanes;
use crate::layout::{TriangleBlock, WIDTH};
use crate::traverse::V3;

/// Cells along each side of the map (p, q) = (x + y, x − y) / (|x| + |y| + |z|) of the upper hemisphere.
const SIDE: usize = 128;

/// 2⁻¹⁰: how much a rectangle is grown on each side; what it must hold is below 2⁻¹⁵ (docs/visibility.md §3).
const MARGIN: f32 = 1.0 / 1024.0;

/// Counts of directions.
#[derive(Clone, Debug)]
pub(super) struct Bins {
    /// By corner (i, j) of the cells: directions in the cells before it on both axes.
    before: Vec<u16>,
}

impl Bins {
    /// Of unit vectors with z > 0, by component.
    pub fn new(local: &[Vec<f32>; 3]) -> Bins {
        const ROW: usize = SIDE + 1;
        let mut before = vec![0; ROW * ROW];
        for ((x, y), z) in local[0].iter().zip(&local[1]).zip(&local[2]) {
            let [x, y, z] = [*x, *y, *z].map(f64::from);
            let size = x.abs() + y.abs() + z;
            let cell =
                |v: f64| ((v / size + 1.0) * (0.5 * SIDE as f64)).clamp(0.0, SIDE as f64 - 0.5) as usize;
            before[(cell(x - y) + 1) * ROW + cell(x + y) + 1] += 1;
        }
        for j in 1..ROW {
            for i in 1..ROW {
                let at = j * ROW + i;
                before[at] = before[at] + before[at - 1] + before[at - ROW] - before[at - ROW - 1];
            }
        }
        Bins { before }
    }

    /// No direction lies in the cells from (i0, j0) to (i1, j1).
    #[inline(always)]
    fn is_empty(&self, [i0, i1, j0, j1]: [u32; 4]) -> bool {
        let at = |i: u32, j: u32| self.before[j as usize * (SIDE + 1) + i as usize];
        at(i1 + 1, j1 + 1) + at(i0, j0) == at(i0, j1 + 1) + at(i1 + 1, j0)
    }

    /// Which of the lanes `active` may have a direction in their triangle.
    ///
    /// Where its corners lie in one octant above the horizon, and not at the receiver itself, the map takes straight lines to straight lines: the
    /// triangle lies in the rectangle around its corners.
    #[inline(always)]
    pub fn some<S: Simd>(&self, simd: S, at: &Lanes<S>, block: &TriangleBlock, mut active: u32) -> u32 {
        let [a, b, c] = &block.corners;
        let a = Seen::of(at, V3::load(simd, a));
        let b = Seen::of(at, V3::load(simd, b));
        let c = Seen::of(at, V3::load(simd, c));
        let above = a.z.min(b.z).min(c.z).simd_ge(0.0);
        let (sa, sb, sc) = (a.size(), b.size(), c.size());
        let apart = sa.min(sb).min(sc).simd_ge(FLOOR);
        let one_x = a.x.min(b.x).min(c.x).simd_ge(0.0) | a.x.max(b.x).max(c.x).simd_le(0.0);
        let one_y = a.y.min(b.y).min(c.y).simd_ge(0.0) | a.y.max(b.y).max(c.y).simd_le(0.0);
        let mut small = (above & apart & one_x & one_y).to_bitmask() as u32 & active;
        if small == 0 {
            return active;
        }
        let ((pa, qa), (pb, qb), (pc, qc)) = (a.place(sa), b.place(sb), c.place(sc));
        let low = |v: f32x8<S>| cell(simd, v - MARGIN);
        let high = |v: f32x8<S>| cell(simd, v + MARGIN);
        let (i0, i1) = (low(pa.min(pb).min(pc)), high(pa.max(pb).max(pc)));
        let (j0, j1) = (low(qa.min(qb).min(qc)), high(qa.max(qb).max(qc)));
        while small != 0 {
            let lane = small.trailing_zeros() as usize % WIDTH;
            small &= small - 1;
            if self.is_empty([i0[lane], i1[lane], j0[lane], j1[lane]]) {
                active &= !(1 << lane);
            }
        }
        active
    }
}

/// A corner in the frame of its receiver.
struct Seen<S: Simd> {
    x: f32x8<S>,
    y: f32x8<S>,
    z: f32x8<S>,
}

impl<S: Simd> Seen<S> {
    #[inline(always)]
    fn of(at: &Lanes<S>, corner: V3<S>) -> Seen<S> {
        let v = corner.minus(at.start);
        Seen { x: at.frame[0].dot(v), y: at.frame[1].dot(v), z: at.frame[2].dot(v) }
    }

    /// |x| + |y| + |z| above the horizon.
    #[inline(always)]
    fn size(&self) -> f32x8<S> {
        self.x.abs() + self.y.abs() + self.z
    }

    /// (p, q)
    #[inline(always)]
    fn place(&self, size: f32x8<S>) -> (f32x8<S>, f32x8<S>) {
        ((self.x + self.y) / size, (self.x - self.y) / size)
    }
}

/// The number of a cell along one side.
#[inline(always)]
fn cell<S: Simd>(simd: S, v: f32x8<S>) -> [u32; WIDTH] {
    let k = ((v + 1.0) * (0.5 * SIDE as f32)).max(f32x8::splat(simd, 0.0));
    u32x8::truncate_from(k.min(f32x8::splat(simd, SIDE as f32 - 0.5))).to_array()
}
