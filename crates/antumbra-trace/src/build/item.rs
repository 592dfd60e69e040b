//! A primitive as the builder sees it: its box, its area, its number.

use crate::layout::{Bounds, larger, smaller};

/// Box, area and number, 32 bytes. The fourth lanes carry what is no coordinate, so that boxes grow four lanes at a
/// time; nothing is computed with them.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(crate) struct Item {
    /// Smallest corner; the number, as bits.
    pub lo: [f32; 4],
    /// Largest corner; the area that blocks [scene units²].
    pub hi: [f32; 4],
}

impl Item {
    /// A primitive with box `bounds` that blocks `area`.
    pub fn new(id: u32, bounds: &Bounds, area: f32) -> Item {
        let (l, h) = (bounds.lo, bounds.hi);
        Item { lo: [l[0], l[1], l[2], f32::from_bits(id)], hi: [h[0], h[1], h[2], area] }
    }

    /// A triangle.
    pub fn triangle(id: u32, c: [[f32; 3]; 3]) -> Item {
        let edge = |to: usize, axis: usize| f64::from(c[to][axis]) - f64::from(c[0][axis]);
        let (u, v) = ([0, 1, 2].map(|a| edge(1, a)), [0, 1, 2].map(|a| edge(2, a)));
        let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let area = 0.5 * (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        Item::new(id, &Bounds::of_corners(c), area as f32)
    }

    /// Its number.
    #[inline(always)]
    pub fn id(&self) -> u32 {
        self.lo[3].to_bits()
    }

    /// The area that it blocks.
    #[inline(always)]
    pub fn area(&self) -> f32 {
        self.hi[3]
    }

    /// Centre of its box; the fourth lane is 0 (bits of a number would be computed with as a denormal, which is slow).
    #[inline(always)]
    pub fn centre(&self) -> [f32; 4] {
        let (l, h) = (&self.lo, &self.hi);
        [0.5 * l[0] + 0.5 * h[0], 0.5 * l[1] + 0.5 * h[1], 0.5 * l[2] + 0.5 * h[2], 0.0]
    }
}

/// The smallest box around `items`.
pub(crate) fn bounds_of(items: &[Item]) -> Bounds {
    let mut b = Bounds::EMPTY;
    for item in items {
        for axis in 0..3 {
            b.lo[axis] = smaller(b.lo[axis], item.lo[axis]);
            b.hi[axis] = larger(b.hi[axis], item.hi[axis]);
        }
    }
    b
}
