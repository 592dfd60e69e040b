//! Where to cut a set of primitives in two: the cheapest plane by the surface-area heuristic.

use super::Measure;
use super::item::Item;
use crate::layout::{Bounds, larger, smaller};

/// Most bins an axis.
pub(crate) const MAX_BINS: usize = 32;

/// Up to this many primitives every cut between two centres is tried.
pub(crate) const SWEEP: usize = 10;

/// A box that grows, four lanes at a time.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(crate) struct Grow {
    lo: [f32; 4],
    hi: [f32; 4],
}

impl Grow {
    /// Holds nothing.
    pub const EMPTY: Grow = Grow { lo: [f32::INFINITY; 4], hi: [f32::NEG_INFINITY; 4] };

    #[inline(always)]
    pub fn add(&mut self, item: &Item) {
        for lane in 0..4 {
            self.lo[lane] = smaller(self.lo[lane], item.lo[lane]);
            self.hi[lane] = larger(self.hi[lane], item.hi[lane]);
        }
    }

    #[inline(always)]
    pub fn add_point(&mut self, p: &[f32; 4]) {
        for lane in 0..4 {
            self.lo[lane] = smaller(self.lo[lane], p[lane]);
            self.hi[lane] = larger(self.hi[lane], p[lane]);
        }
    }

    #[inline(always)]
    pub fn join(&mut self, other: &Grow) {
        for lane in 0..4 {
            self.lo[lane] = smaller(self.lo[lane], other.lo[lane]);
            self.hi[lane] = larger(self.hi[lane], other.hi[lane]);
        }
    }

    pub fn bounds(&self) -> Bounds {
        let (l, h) = (self.lo, self.hi);
        Bounds { lo: [l[0], l[1], l[2]], hi: [h[0], h[1], h[2]] }
    }

    #[inline(always)]
    fn half_area(&self, measure: &Measure) -> f32 {
        measure.half_area_of(&self.lo, &self.hi)
    }
}

/// Maps centres to bins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Binning {
    count: usize,
    from: [f32; 4],
    per_unit: [f32; 4],
}

impl Binning {
    pub fn new(count: usize, centres: &Bounds) -> Binning {
        let (mut from, mut per_unit) = ([0.0; 4], [0.0; 4]);
        for axis in 0..3 {
            let width = centres.hi[axis] - centres.lo[axis];
            from[axis] = centres.lo[axis];
            // 0.999: the largest centre stays in the last bin
            per_unit[axis] = if width > 0.0 { 0.999 * count as f32 / width } else { 0.0 };
        }
        Binning { count, from, per_unit }
    }

    /// The bin of a centre on each axis. NaN and infinities (overflow at the ends of f32) end in the first or last.
    #[inline(always)]
    fn bins(&self, centre: &[f32; 4]) -> [usize; 3] {
        let last = self.count as i32 - 1;
        let mut bins = [0; 3];
        for a in 0..3 {
            let x = (centre[a] - self.from[a]) * self.per_unit[a];
            bins[a] = (x as i32).clamp(0, last) as usize;
        }
        bins
    }

    #[inline(always)]
    fn bin(&self, axis: usize, item: &Item) -> usize {
        let x = (item.centre()[axis] - self.from[axis]) * self.per_unit[axis];
        (x as i32).clamp(0, self.count as i32 - 1) as usize
    }
}

/// Boxes and counts of the bins of all three axes.
#[derive(Clone)]
pub(crate) struct Bins {
    boxes: [[Grow; MAX_BINS]; 3],
    counts: [[u32; MAX_BINS]; 3],
}

impl Bins {
    pub fn of(items: &[Item], binning: &Binning) -> Bins {
        let mut bins = Bins { boxes: [[Grow::EMPTY; MAX_BINS]; 3], counts: [[0; MAX_BINS]; 3] };
        for item in items {
            let at = binning.bins(&item.centre());
            for axis in 0..3 {
                let bin = at[axis] % MAX_BINS;
                bins.boxes[axis][bin].add(item);
                bins.counts[axis][bin] += 1;
            }
        }
        bins
    }

    pub fn join(mut self, other: &Bins) -> Bins {
        for axis in 0..3 {
            for bin in 0..MAX_BINS {
                self.boxes[axis][bin].join(&other.boxes[axis][bin]);
                self.counts[axis][bin] += other.counts[axis][bin];
            }
        }
        self
    }

    /// The cheapest cut (axis, first bin of the right side) with primitives on both sides, if there is any.
    pub fn cheapest(&self, binning: &Binning, measure: &Measure) -> Option<(usize, usize)> {
        let mut best = f32::INFINITY;
        let mut cut = None;
        for axis in 0..3 {
            if binning.per_unit[axis] == 0.0 {
                continue;
            }
            let mut right = [(0.0, 0u32); MAX_BINS];
            let (mut grown, mut count) = (Grow::EMPTY, 0);
            for bin in (1..binning.count).rev() {
                grown.join(&self.boxes[axis][bin]);
                count += self.counts[axis][bin];
                right[bin] = (grown.half_area(measure) * count as f32, count);
            }
            (grown, count) = (Grow::EMPTY, 0);
            for bin in 1..binning.count {
                grown.join(&self.boxes[axis][bin - 1]);
                count += self.counts[axis][bin - 1];
                let cost = grown.half_area(measure) * count as f32 + right[bin].0;
                if count > 0 && right[bin].1 > 0 && cost < best {
                    best = cost;
                    cut = Some((axis, bin));
                }
            }
        }
        cut
    }
}

/// Puts the primitives whose bin on `axis` is below `bin` first; how many there are. No branch depends on a primitive.
pub(crate) fn partition(items: &mut [Item], binning: &Binning, axis: usize, bin: usize) -> usize {
    let mut left = 0;
    for i in 0..items.len() {
        let goes_left = binning.bin(axis, &items[i]) < bin;
        items.swap(i, left);
        left += usize::from(goes_left);
    }
    left
}

/// Cuts in the middle along the axis on which the centres spread most: for sets that no plane divides well.
pub(crate) fn halve(items: &mut [Item], centres: &Bounds) -> usize {
    let width = |a: usize| centres.hi[a] - centres.lo[a];
    let axis = (1..3).fold(0, |best, a| if width(a) > width(best) { a } else { best });
    let middle = items.len() / 2;
    if width(axis) > 0.0 {
        items.select_nth_unstable_by(middle, |a, b| a.centre()[axis].total_cmp(&b.centre()[axis]));
    }
    middle
}

/// Tries every cut between two centres on each axis; for 2 … [`SWEEP`] primitives.
pub(crate) fn sweep(items: &mut [Item], measure: &Measure) -> usize {
    let n = items.len();
    let mut best = (f32::INFINITY, n / 2);
    let mut order = [0; SWEEP];
    for axis in 0..if n > 2 { 3 } else { 0 } {
        let sorted = sorted_by_centre(items, axis);
        let mut right = [0.0; SWEEP];
        let mut grown = Grow::EMPTY;
        for i in (1..n).rev() {
            grown.add(&items[sorted[i]]);
            right[i] = grown.half_area(measure) * (n - i) as f32;
        }
        grown = Grow::EMPTY;
        let before = best.0;
        for i in 1..n {
            grown.add(&items[sorted[i - 1]]);
            let cost = grown.half_area(measure) * i as f32 + right[i];
            if cost < best.0 {
                best = (cost, i);
            }
        }
        if best.0 < before {
            order = sorted;
        }
    }
    if best.0 < f32::INFINITY {
        let mut copy = [items[0]; SWEEP];
        copy[..n].copy_from_slice(items);
        for i in 0..n {
            items[i] = copy[order[i]];
        }
    }
    best.1
}

/// The order of the centres on an axis, by insertion: stable, hence the same everywhere.
fn sorted_by_centre(items: &[Item], axis: usize) -> [usize; SWEEP] {
    let (mut keys, mut order) = ([0.0; SWEEP], [0; SWEEP]);
    for (filled, item) in items.iter().enumerate().take(SWEEP) {
        let key = 0.5 * item.lo[axis] + 0.5 * item.hi[axis];
        let mut at = filled;
        while at > 0 && keys[at - 1] > key {
            (keys[at], order[at]) = (keys[at - 1], order[at - 1]);
            at -= 1;
        }
        (keys[at], order[at]) = (key, filled);
    }
    order
}
