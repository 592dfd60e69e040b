//! A node: eight padded boxes side by side.

use fearless_simd::{Simd, f32x8, prelude::*, u32x8};

use super::Bounds;

/// Children of a node, lanes of a leaf block.
pub(crate) const WIDTH: usize = 8;

/// Where a box leads: to a node or to a leaf block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Child(pub u32);

impl Child {
    const LEAF: u32 = 1 << 31;
    /// No child; its box is empty, so no ray gets here.
    pub const NONE: Child = Child(u32::MAX);

    /// The node `index`.
    pub fn node(index: usize) -> Child {
        Child(index as u32)
    }

    /// The leaf block `index`.
    pub fn leaf(index: usize) -> Child {
        Child(index as u32 | Child::LEAF)
    }

    /// It is a leaf block.
    #[inline(always)]
    pub fn is_leaf(self) -> bool {
        self.0 & Child::LEAF != 0
    }

    /// Index of the node or leaf block.
    #[inline(always)]
    pub fn index(self) -> usize {
        (self.0 & !Child::LEAF) as usize
    }
}

/// Eight boxes and where they lead, 256 bytes in four cache lines. Boxes come padded (LAW §3); unused lanes hold an
/// empty box. Children stand in the order opposite to that in which an
/// any-hit query of a line without end visits them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// Planes: lower x, y, z, then upper x, y, z; one lane a child.
    pub planes: [[f32; WIDTH]; 6],
    /// The children.
    pub child: [Child; WIDTH],
}

impl Node {
    /// No children.
    pub const EMPTY: Node = Node {
        planes: [
            [f32::INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        child: [Child::NONE; WIDTH],
    };

    /// Sets lane `lane`, padding `bounds` by 2⁻²²·M + 2⁻⁴⁰·`scale` (M: its largest |coordinate|).
    ///
    /// The pad is added in f64 and rounded outward, so that all of it remains.
    pub fn set(&mut self, lane: usize, bounds: &Bounds, scale: f64, child: Child) {
        let pad = bounds.magnitude() * PAD_OWN + scale * PAD_SCALE;
        for axis in 0..3 {
            self.planes[axis][lane] = below(f64::from(bounds.lo[axis]) - pad);
            self.planes[axis + 3][lane] = above(f64::from(bounds.hi[axis]) + pad);
        }
        self.child[lane] = child;
    }

    /// Eight planes.
    #[inline(always)]
    pub fn row(&self, row: Row) -> &[f32; WIDTH] {
        let first = self.planes.as_ptr().cast::<f32>();
        // SAFETY: a `Row` is 0, 8 … 40: its own constructors make no other. So eight of the 48 numbers of `planes` begin
        // there, and they live as long as `self`.
        unsafe { &*first.add(row.0 as usize).cast::<[f32; WIDTH]>() }
    }

    /// How many children there are.
    pub fn count(&self) -> usize {
        self.child.iter().filter(|&&c| c != Child::NONE).count()
    }
}

/// A row of planes in a node, as the place of its first number: 0, 8 … 40.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row(u32);

impl Row {
    /// Lower x.
    pub const FIRST: Row = Row(0);

    /// The lower or upper planes of `axis` (0, 1, 2).
    #[inline(always)]
    pub const fn plane(axis: usize, upper: bool) -> Row {
        Row(((axis % 3 + 3 * upper as usize) * WIDTH) as u32)
    }

    /// The rows of near and far planes on `axis` (0, 1, 2) of eight lines with the direction components `r`.
    #[inline(always)]
    pub fn pairs<S: Simd>(simd: S, r: f32x8<S>, axis: usize) -> [[Row; WIDTH]; 2] {
        let lower = u32x8::splat(simd, (axis % 3 * WIDTH) as u32);
        let upper = lower + (3 * WIDTH) as u32;
        let down = r.simd_lt(0.0);
        let rows = |x: u32x8<S>| x.to_array().map(Row);
        [rows(down.select(upper, lower)), rows(down.select(lower, upper))]
    }
}

/// 2⁻²²
const PAD_OWN: f64 = 1.0 / (1u64 << 22) as f64;
/// 2⁻⁴⁰
const PAD_SCALE: f64 = 1.0 / (1u64 << 40) as f64;

/// The largest f32 ≤ x.
pub(crate) fn below(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) > x { y.next_down() } else { y }
}

/// The smallest f32 ≥ x.
pub(crate) fn above(x: f64) -> f32 {
    let y = x as f32;
    if f64::from(y) < x { y.next_up() } else { y }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_node_is_four_cache_lines() {
        assert_eq!(size_of::<Node>(), 256);
    }

    #[test]
    fn padding_rounds_outward() {
        let bounds = Bounds { lo: [0.1, -3.0, 1e-30], hi: [0.3, -2.0, 7e12] };
        let mut node = Node::EMPTY;
        node.set(3, &bounds, 1e13, Child::leaf(5));
        let pad = bounds.magnitude() * PAD_OWN + 1e13 * PAD_SCALE;
        for axis in 0..3 {
            assert!(f64::from(node.planes[axis][3]) <= f64::from(bounds.lo[axis]) - pad);
            assert!(f64::from(node.planes[axis + 3][3]) >= f64::from(bounds.hi[axis]) + pad);
        }
        assert!(node.child[3].is_leaf() && node.child[3].index() == 5);
    }

    #[test]
    fn directed_rounding_brackets() {
        for x in [0.1, -0.1, 1e-50, -1e-50, 3.0, 1e39, -1e39] {
            assert!(f64::from(below(x)) <= x && x <= f64::from(above(x)));
        }
    }
}
