//! Rays put into an order in which neighbours go alike: what one fetched from memory serves the next.
//!
//! Answers do not depend on it. It pays where rays come as they please and visit many boxes each; `docs/performance.md`
//! has the measurement.

use antumbra_trace::{Bits, SegmentBuffer, Segments, TO_POINT, World};

/// Fewer rays than this find too few alike.
const FEWEST: usize = 1 << 15;
/// Rays that are asked first, to see what one costs.
const TRIED: usize = 64;
/// Boxes that a ray visits on average, below which it costs less than its place in the order.
const BOXES: u32 = 20;
/// Cells along each axis, as a power of two.
const CELL_BITS: u32 = 4;
/// Cells and the eight octants of directions.
const KEYS: usize = 1 << (3 * CELL_BITS + 3);

/// Memory that is kept from run to run.
#[derive(Default)]
pub struct Order {
    keys: Vec<u16>,
    starts: Vec<u32>,
    order: Vec<u32>,
    rays: SegmentBuffer,
}

impl Order {
    /// The rays in a better order, and the number of each in the old one; `None` where it does not pay.
    pub fn of(&mut self, world: &World, rays: Segments<'_>) -> Option<(Segments<'_>, &[u32])> {
        if rays.len() < FEWEST || cheap(world, rays) {
            return None;
        }
        self.number(rays);
        if alike(&self.keys) {
            return None;
        }
        self.sort();
        self.rays.pick(rays, &self.order);
        Some((self.rays.as_segments(), &self.order))
    }

    /// A number for each ray: octant of its direction, then the cell of its start, both in Morton order.
    fn number(&mut self, rays: Segments<'_>) {
        self.keys.clear();
        self.keys.resize(rays.len(), 0);
        for (axis, (from, to)) in rays.origin.into_iter().zip(rays.end).enumerate() {
            // A few say where they are; the others are put into the outermost cells.
            let few = from.iter().step_by(32);
            let (low, high) =
                few.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), x| (l.min(*x), h.max(*x)));
            let scale = (1 << CELL_BITS) as f32 / (high - low);
            let scale = if scale.is_finite() { scale } else { 0.0 };
            let octant = 3 * CELL_BITS as usize + axis;
            for (((key, p), q), reach) in self.keys.iter_mut().zip(from).zip(to).zip(rays.reach) {
                let cell = ((p - low) * scale) as i32;
                let behind = *q < if *reach == TO_POINT { *p } else { 0.0 };
                *key |= SPREAD[cell.clamp(0, (1 << CELL_BITS) - 1) as usize] << axis;
                *key |= u16::from(behind) << octant;
            }
        }
    }

    /// Counting sort by number.
    fn sort(&mut self) {
        self.starts.clear();
        self.starts.resize(KEYS + 1, 0);
        self.keys.iter().for_each(|key| self.starts[usize::from(*key) + 1] += 1);
        for k in 0..KEYS {
            self.starts[k + 1] += self.starts[k];
        }
        self.order.clear();
        self.order.resize(self.keys.len(), 0);
        for (i, key) in self.keys.iter().enumerate() {
            let place = &mut self.starts[usize::from(*key)];
            self.order[*place as usize] = i as u32;
            *place += 1;
        }
    }
}

/// The bits of a cell's number, three apart.
const SPREAD: [u16; 1 << CELL_BITS] = {
    let mut spread = [0; 1 << CELL_BITS];
    let mut i = 0;
    while i < spread.len() {
        let mut bit = 0;
        while bit < CELL_BITS {
            spread[i] |= ((i >> bit & 1) << (3 * bit)) as u16;
            bit += 1;
        }
        i += 1;
    }
    spread
};

/// Neighbours go alike as they come: at least half of them share octant and an eighth of the space.
fn alike(keys: &[u16]) -> bool {
    let coarse = |key: u16| key >> (3 * CELL_BITS - 3);
    2 * keys.windows(2).filter(|pair| coarse(pair[0]) == coarse(pair[1])).count() > keys.len()
}

/// Few boxes are visited by rays spread over the run.
fn cheap(world: &World, rays: Segments<'_>) -> bool {
    let (mut few, mut bits, mut work) = (SegmentBuffer::default(), Bits::default(), Vec::new());
    let spread: Vec<u32> = (0..TRIED).map(|k| (k * rays.len() / TRIED) as u32).collect();
    few.pick(rays, &spread);
    world.occluded_counted(few.as_segments(), &mut bits, &mut work);
    work.iter().map(|w| w.boxes).sum::<u32>() < BOXES * TRIED as u32
}
