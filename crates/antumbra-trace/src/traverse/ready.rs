//! Lines of a batch made ready eight at a time: what boxes and triangles read of each, side by side.

use fearless_simd::{Simd, f32x8, f32x16, mask32x8, prelude::*};

use super::boxes::FAR_SLACK;
use super::filter::{TriangleRay, U};
use super::ray::{Limits, Lines, power};
use super::sixteen::PACKET;
use super::vector::V3;
use crate::TO_POINT;
use crate::layout::{Node, Row, WIDTH};

/// Lines that are made ready together.
pub(crate) const CHUNK: usize = 128;

/// One number a line.
pub(super) type Column = [f32; CHUNK];

/// Where lines enter the children of the root, by child.
pub(crate) type Enters = [Column; WIDTH];

/// Up to [`CHUNK`] lines. What a number means stands at [`BoxRay`](super::ray::BoxRay) and [`TriangleRay`].
pub(crate) struct Ready {
    o: [Column; 3],
    d: [Column; 3],
    r: [Column; 3],
    or: [Column; 3],
    tmax: Column,
    edge: Column,
    /// Rows of the near planes, then of the far ones.
    rows: [[Row; CHUNK]; 6],
    /// Which children of the root each line meets.
    roots: [u8; CHUNK],
}

/// Sixteen lines side by side; names as in [`Ready`].
#[derive(Clone, Copy)]
pub(crate) struct Side16<S: Simd> {
    pub o: [f32x16<S>; 3],
    pub d: [f32x16<S>; 3],
    pub r: [f32x16<S>; 3],
    pub or: [f32x16<S>; 3],
    pub tmax: f32x16<S>,
    pub edge: f32x16<S>,
}

/// Sets of lines of a chunk, one bit a line.
pub(crate) type Lot = [u64; CHUNK / 64];

impl Ready {
    /// No line.
    pub const EMPTY: Ready = Ready {
        o: [[0.0; CHUNK]; 3],
        d: [[0.0; CHUNK]; 3],
        r: [[0.0; CHUNK]; 3],
        or: [[0.0; CHUNK]; 3],
        tmax: [0.0; CHUNK],
        edge: [0.0; CHUNK],
        rows: [[Row::FIRST; CHUNK]; 6],
        roots: [0; CHUNK],
    };

    /// Takes entries `from` … `from` + `count` − 1 of `lines`; `count` ≤ [`CHUNK`]. Which of them meet a child of
    /// `root`, and for which f32 is not proven; without a root no line will meet boxes. Where they enter the children goes to `enters`, if it is wanted.
    #[inline(always)]
    pub fn take<S: Simd>(
        &mut self,
        simd: S,
        (lines, limits, root): (&Lines<'_>, &Limits, Option<&Node>),
        (from, count): (usize, usize),
        mut enters: Option<&mut Enters>,
    ) -> [Lot; 2] {
        let (mut live, mut wild) = (Lot::default(), Lot::default());
        for block in 0..count.div_ceil(WIDTH) {
            let tree = (lines, limits, root);
            let [good, met] = self.eight(simd, tree, from + WIDTH * block, block, enters.as_deref_mut());
            let there = 0xff >> WIDTH.saturating_sub(count - WIDTH * block);
            live[block / 8 % live.len()] |= (good & met & there) << (8 * (block % 8));
            wild[block / 8 % wild.len()] |= (!good & there) << (8 * (block % 8));
        }
        [live, wild]
    }

    /// Takes eight entries as block `block`: for which of them f32 is proven, and which meet a child of `root`.
    #[inline(always)]
    fn eight<S: Simd>(
        &mut self,
        simd: S,
        (lines, limits, root): (&Lines<'_>, &Limits, Option<&Node>),
        from: usize,
        block: usize,
        enters: Option<&mut Enters>,
    ) -> [u64; 2] {
        let columns = lines.columns();
        let read = |k: usize| load(simd, columns[k], from);
        let o = [read(0), read(1), read(2)];
        let reach = read(6);
        let to_point = reach.simd_eq(TO_POINT);
        let end = [read(3), read(4), read(5)];
        // Written out: with `map` on an array a closure is a call that knows no SIMD level.
        let d = [
            to_point.select(end[0] - o[0], end[0]),
            to_point.select(end[1] - o[1], end[1]),
            to_point.select(end[2] - o[2], end[2]),
        ];
        let tmax = to_point.select(f32x8::splat(simd, 1.0), reach);
        let [ax, ay, az] = [d[0].abs(), d[1].abs(), d[2].abs()];
        let size = ax.max(ay).max(az);
        let good = limits.hold_eight(simd, &o, &d, size, tmax);
        let at = WIDTH * block;
        put(&mut self.tmax, at, tmax);
        put(&mut self.edge, at, (ax + ay + az) * 1.00001 * (40.0 * U));
        for a in 0..3 {
            put(&mut self.o[a], at, o[a]);
            put(&mut self.d[a], at, d[a]);
        }
        let Some(root) = root else { return [good, 0xff] };
        let eta = size * power(-60);
        let r = [reciprocal(simd, d[0], eta), reciprocal(simd, d[1], eta), reciprocal(simd, d[2], eta)];
        let or = [-(o[0] * r[0]), -(o[1] * r[1]), -(o[2] * r[2])];
        for a in 0..3 {
            put(&mut self.r[a], at, r[a]);
            put(&mut self.or[a], at, or[a]);
            let [near, far] = Row::pairs(simd, r[a], a);
            self.rows[a][at..at + WIDTH].copy_from_slice(&near);
            self.rows[a + 3][at..at + WIDTH].copy_from_slice(&far);
        }
        let children = meet_each(simd, root, (&r, &or, tmax), at, enters);
        self.roots[at..at + WIDTH].copy_from_slice(&transposed(children).to_le_bytes());
        [good, children.to_le_bytes().into_iter().fold(0, |any, line| any | u64::from(line))]
    }

    /// Which children of the root line `i` meets.
    #[inline(always)]
    pub fn roots(&self, i: usize) -> u64 {
        u64::from(self.roots[i % CHUNK])
    }

    /// Which boxes of `node` line `i` meets, and where it enters them (as [`meet`](super::boxes::meet)).
    #[inline(always)]
    pub fn meet<S: Simd>(&self, simd: S, node: &Node, i: usize) -> (mask32x8<S>, f32x8<S>) {
        self.meet_before(simd, node, i, self.tmax[i % CHUNK])
    }

    /// As [`meet`](Ready::meet), before another `tmax`.
    #[inline(always)]
    pub fn meet_before<S: Simd>(&self, simd: S, node: &Node, i: usize, tmax: f32) -> (mask32x8<S>, f32x8<S>) {
        let i = i % CHUNK;
        let at = |row: usize, a: usize| {
            let plane = f32x8::load_array_ref(simd, node.row(self.rows[row][i]));
            plane.mul_add(f32x8::splat(simd, self.r[a][i]), f32x8::splat(simd, self.or[a][i]))
        };
        let zero = f32x8::splat(simd, 0.0);
        let enter = at(0, 0).max(at(1, 1)).max(at(2, 2).max(zero));
        let leave = at(3, 0).min(at(4, 1)).min(at(5, 2).min(f32x8::splat(simd, tmax)));
        (enter.simd_le(leave * FAR_SLACK), enter)
    }

    /// Lines `first` … `first` + 15 side by side.
    #[inline(always)]
    pub fn sixteen<S: Simd>(&self, simd: S, first: usize) -> Side16<S> {
        let first = first % CHUNK / PACKET * PACKET;
        let read = |c: &Column| f32x16::from_slice(simd, &c[first..first + PACKET]);
        let three = |c: &[Column; 3]| [read(&c[0]), read(&c[1]), read(&c[2])];
        Side16 {
            o: three(&self.o),
            d: three(&self.d),
            r: three(&self.r),
            or: three(&self.or),
            tmax: read(&self.tmax),
            edge: read(&self.edge),
        }
    }

    /// Line `i` as a leaf block sees it, and its tmax.
    #[inline(always)]
    pub fn triangle_ray<S: Simd>(&self, simd: S, i: usize) -> (TriangleRay<S>, f32) {
        let i = i % CHUNK;
        let three = |c: &[Column; 3]| V3::splat(simd, [c[0][i], c[1][i], c[2][i]]);
        (TriangleRay::world(simd, three(&self.o), three(&self.d), self.edge[i]), self.tmax[i])
    }
}

/// 1/d, or ±1/η where |d| < η.
#[inline(always)]
fn reciprocal<S: Simd>(simd: S, d: f32x8<S>, eta: f32x8<S>) -> f32x8<S> {
    f32x8::splat(simd, 1.0) / d.abs().simd_lt(eta).select(eta.copysign(d), d)
}

/// Eight numbers of a column; zeros beyond its end.
#[inline(always)]
fn load<S: Simd>(simd: S, column: &[f32], from: usize) -> f32x8<S> {
    if let Some(eight) = column.get(from..from + WIDTH) {
        return f32x8::from_slice(simd, eight);
    }
    let mut eight = [0.0; WIDTH];
    for (to, x) in eight.iter_mut().zip(&column[from..]) {
        *to = *x;
    }
    f32x8::load_array(simd, eight)
}

#[inline(always)]
fn put<S: Simd>(column: &mut Column, at: usize, eight: f32x8<S>) {
    eight.store_slice(&mut column[at..at + WIDTH]);
}

/// Which of eight lines meet each child of `node`: one byte a child, one bit a line. `enters`: as for
/// [`take`](Ready::take), from line `first` on.
#[inline(always)]
fn meet_each<S: Simd>(
    simd: S,
    node: &Node,
    (r, or, tmax): (&[f32x8<S>; 3], &[f32x8<S>; 3], f32x8<S>),
    first: usize,
    mut enters: Option<&mut Enters>,
) -> u64 {
    let mut met = 0;
    for child in 0..node.count() % (WIDTH + 1) {
        let at = |row: usize| f32x8::splat(simd, node.planes[row][child]).mul_add(r[row % 3], or[row % 3]);
        let (mut enter, mut leave) = (f32x8::splat(simd, 0.0), tmax);
        for axis in 0..3 {
            let (lower, upper) = (at(axis), at(axis + 3));
            enter = enter.max(lower.min(upper));
            leave = leave.min(lower.max(upper));
        }
        if let Some(enters) = enters.as_deref_mut() {
            put(&mut enters[child], first, enter);
        }
        met |= enter.simd_le(leave * FAR_SLACK).to_bitmask() << (8 * child);
    }
    met
}

/// Bit j of byte i becomes bit i of byte j.
#[inline(always)]
fn transposed(mut x: u64) -> u64 {
    for (by, which) in [(7, 0x00aa_00aa_00aa_00aa), (14, 0x0000_cccc_0000_cccc), (28, 0x0000_0000_f0f0_f0f0)]
    {
        let swapped = (x ^ x >> by) & which;
        x ^= swapped ^ swapped << by;
    }
    x
}
