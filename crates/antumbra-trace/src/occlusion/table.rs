//! The table of half-spaces: for every plane through the receiver, which directions lie on its positive side for certain,
//! and which perhaps.

use super::{BITS, Block};

/// Cells along each side of the map of the upper hemisphere. Even: then the two creases of the map are diagonals of
/// cells.
pub(super) const SIDE: usize = 32;

/// 2⁻⁹: up to how much a normal may be off, as a part of its length.
pub(super) const OFF: f32 = 1.0 / 512.0;

/// [`OFF`], and 2⁻¹⁶ for the rounding of a cell's number (docs/visibility.md §3).
const MARGIN: f64 = OFF as f64 + 1.0 / 65_536.0;

/// The cell of normals that are off by more: nothing is known.
pub(super) const UNKNOWN: u32 = (SIDE * SIDE) as u32;

/// Masks by the direction of a plane's normal m. Cells are squares of the octahedral map of the upper hemisphere,
/// (p, q) = (x + y, x − y) / (|x| + |y| + |z|); the lower one is the same with sides exchanged.
#[derive(Clone, Debug)]
pub(super) struct HalfSpaces {
    /// Blocks a mask.
    blocks: usize,
    /// By cell: blocks of directions surely on the positive side, then of those perhaps there.
    cells: Vec<Block>,
}

impl HalfSpaces {
    /// For unit vectors, by component.
    pub fn new(local: &[Vec<f32>; 3]) -> HalfSpaces {
        let blocks = local[0].len().div_ceil(BITS);
        let mut corners = Vec::with_capacity((SIDE + 1) * (SIDE + 1) * 2 * blocks);
        for j in 0..=SIDE {
            for i in 0..=SIDE {
                sides(corner(i, j), local, blocks, &mut corners);
            }
        }
        let mut cells = vec![[0; 4]; (SIDE * SIDE + 1) * 2 * blocks];
        for cell in 0..SIDE * SIDE {
            let at = |di: usize, dj: usize| ((cell / SIDE + dj) * (SIDE + 1) + cell % SIDE + di) * 2 * blocks;
            let around = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
            for b in 0..blocks {
                for w in 0..4 {
                    let all = |k: usize| around.iter().fold(!0, |m, c| m & corners[c + k][w]);
                    cells[cell * 2 * blocks + b][w] = all(b);
                    cells[cell * 2 * blocks + blocks + b][w] = !all(blocks + b);
                }
            }
        }
        let unknown = SIDE * SIDE * 2 * blocks + blocks;
        cells[unknown..].fill([!0; 4]);
        HalfSpaces { blocks, cells }
    }

    /// The half-space of a cell's normals, or of their opposites.
    #[inline(always)]
    pub fn get(&self, cell: u32, opposite: bool) -> Half<'_> {
        let first = cell as usize * 2 * self.blocks;
        let (one, two) = self.cells[first..first + 2 * self.blocks].split_at(self.blocks);
        if opposite {
            Half { surely: two, perhaps: one, turn: !0 }
        } else {
            Half { surely: one, perhaps: two, turn: 0 }
        }
    }
}

/// Directions on the positive side of a plane.
#[derive(Clone, Copy)]
pub(super) struct Half<'a> {
    surely: &'a [Block],
    perhaps: &'a [Block],
    /// All bits of words to turn over.
    turn: u64,
}

impl Half<'_> {
    /// Those surely there.
    #[inline(always)]
    pub fn surely(&self, block: usize) -> Block {
        self.surely[block].map(|w| w ^ self.turn)
    }

    /// Those perhaps there.
    #[inline(always)]
    pub fn perhaps(&self, block: usize) -> Block {
        self.perhaps[block].map(|w| w ^ self.turn)
    }
}

/// The normal at a corner of the grid, not of unit length.
fn corner(i: usize, j: usize) -> [f64; 3] {
    let at = |k: usize| 2.0 * k as f64 / SIDE as f64 - 1.0;
    let (p, q) = (at(i), at(j));
    [0.5 * (p + q), 0.5 * (p - q), 1.0 - p.abs().max(q.abs())]
}

/// Appends the directions above the plane of normal `m` by more than the margin, then those below it by as much.
fn sides(m: [f64; 3], local: &[Vec<f32>; 3], blocks: usize, out: &mut Vec<Block>) {
    let margin = MARGIN * m.iter().map(|c| c * c).sum::<f64>().sqrt();
    let first = out.len();
    out.resize(first + 2 * blocks, [0; 4]);
    for i in 0..local[0].len() {
        let side: f64 = (0..3).map(|k| m[k] * f64::from(local[k][i])).sum();
        let bit = 1u64 << (i % 64);
        if side > margin {
            out[first + i / BITS][i % BITS / 64] |= bit;
        } else if side < -margin {
            out[first + blocks + i / BITS][i % BITS / 64] |= bit;
        }
    }
}
