//! Batches as structures of arrays: segments (or rays) in, bits or hits out.

use crate::{NO_PRIM, PrimId};

/// A `reach` that says: `end` is a point, the question is the open segment from `origin` to it.
pub const TO_POINT: f32 = -1.0;

/// A batch of segments and rays, borrowed. All slices have the same length.
///
/// Entry i is the open segment from `origin` to the point `end` where `reach` is [`TO_POINT`]; else the ray
/// origin + t·`end`, 0 < t < `reach` (`end` is then a direction of any length; `reach` may be +∞).
#[derive(Clone, Copy, Debug)]
pub struct Segments<'a> {
    /// Start, by component.
    pub origin: [&'a [f32]; 3],
    /// End point or direction, by component.
    pub end: [&'a [f32]; 3],
    /// [`TO_POINT`] or the largest t.
    pub reach: &'a [f32],
    /// The primitive it starts on, or [`NO_PRIM`]. If it is flat it never blocks: whoever proposes the segment has
    /// made sure that it leaves on the side of its start. A curved one may block.
    pub first: &'a [PrimId],
    /// The primitive it ends on, or [`NO_PRIM`]: it never blocks.
    pub last: &'a [PrimId],
    /// A number for the `passes` callback (stochastic alpha).
    pub number: &'a [u32],
}

impl Segments<'_> {
    /// Number of entries.
    #[inline]
    pub fn len(&self) -> usize {
        self.reach.len()
    }

    /// There is no entry.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.reach.is_empty()
    }

    /// Start of entry `i`.
    #[inline]
    pub fn origin_at(&self, i: usize) -> [f32; 3] {
        [self.origin[0][i], self.origin[1][i], self.origin[2][i]]
    }

    /// End point or direction of entry `i`.
    #[inline]
    pub fn end_at(&self, i: usize) -> [f32; 3] {
        [self.end[0][i], self.end[1][i], self.end[2][i]]
    }

    /// Entries `from..to` as a batch of their own.
    pub fn slice(&self, range: std::ops::Range<usize>) -> Segments<'_> {
        Segments {
            origin: self.origin.map(|c| &c[range.clone()]),
            end: self.end.map(|c| &c[range.clone()]),
            reach: &self.reach[range.clone()],
            first: &self.first[range.clone()],
            last: &self.last[range.clone()],
            number: &self.number[range],
        }
    }
}

/// An owned batch that is filled and cleared without giving memory back.
#[derive(Clone, Debug, Default)]
pub struct SegmentBuffer {
    origin: [Vec<f32>; 3],
    end: [Vec<f32>; 3],
    reach: Vec<f32>,
    first: Vec<PrimId>,
    last: Vec<PrimId>,
    number: Vec<u32>,
}

impl SegmentBuffer {
    /// The open segment from `p` to the point `q`.
    #[inline]
    pub fn push_segment(&mut self, p: [f32; 3], q: [f32; 3], first: PrimId, last: PrimId, number: u32) {
        self.push(p, q, TO_POINT, first, last, number);
    }

    /// The ray p + t·d, 0 < t < `reach`.
    #[inline]
    pub fn push_ray(&mut self, p: [f32; 3], d: [f32; 3], reach: f32, first: PrimId, number: u32) {
        self.push(p, d, reach, first, NO_PRIM, number);
    }

    /// Any entry; see [`Segments`] for the meaning of each number.
    #[inline]
    pub fn push(&mut self, p: [f32; 3], end: [f32; 3], reach: f32, first: PrimId, last: PrimId, number: u32) {
        for axis in 0..3 {
            self.origin[axis].push(p[axis]);
            self.end[axis].push(end[axis]);
        }
        self.reach.push(reach);
        self.first.push(first);
        self.last.push(last);
        self.number.push(number);
    }

    /// `count` more entries that start and end on nothing known, numbered from `number`, for the caller to fill.
    pub fn grow(&mut self, count: usize, number: u32) -> Grown<'_> {
        let from = self.len();
        let more = |values: &mut Vec<f32>, value: f32| values.resize(from + count, value);
        self.origin.iter_mut().chain(&mut self.end).for_each(|values| more(values, 0.0));
        more(&mut self.reach, TO_POINT);
        self.first.resize(from + count, NO_PRIM);
        self.last.resize(from + count, NO_PRIM);
        self.number.extend((0..count as u32).map(|k| number.wrapping_add(k)));
        Grown {
            origin: self.origin.each_mut().map(|values| &mut values[from..]),
            end: self.end.each_mut().map(|values| &mut values[from..]),
            reach: &mut self.reach[from..],
        }
    }

    /// Entries of `from` in the given order, in place of what is here.
    pub fn pick(&mut self, from: Segments<'_>, order: &[u32]) {
        fn column<T: Copy>(out: &mut Vec<T>, from: &[T], order: &[u32]) {
            out.clear();
            out.extend(order.iter().map(|i| from[*i as usize]));
        }
        for axis in 0..3 {
            column(&mut self.origin[axis], from.origin[axis], order);
            column(&mut self.end[axis], from.end[axis], order);
        }
        column(&mut self.reach, from.reach, order);
        for (out, from) in
            [(&mut self.first, from.first), (&mut self.last, from.last), (&mut self.number, from.number)]
        {
            column(out, from, order);
        }
    }

    /// Forgets the entries, keeps the memory.
    pub fn clear(&mut self) {
        for axis in 0..3 {
            self.origin[axis].clear();
            self.end[axis].clear();
        }
        self.reach.clear();
        self.first.clear();
        self.last.clear();
        self.number.clear();
    }

    /// Number of entries.
    pub fn len(&self) -> usize {
        self.reach.len()
    }

    /// There is no entry.
    pub fn is_empty(&self) -> bool {
        self.reach.is_empty()
    }

    /// The batch to ask about.
    #[inline]
    pub fn as_segments(&self) -> Segments<'_> {
        Segments {
            origin: [&self.origin[0], &self.origin[1], &self.origin[2]],
            end: [&self.end[0], &self.end[1], &self.end[2]],
            reach: &self.reach,
            first: &self.first,
            last: &self.last,
            number: &self.number,
        }
    }
}

/// Entries that were just added, to be filled component by component; see [`Segments`] for their meaning.
#[derive(Debug)]
pub struct Grown<'a> {
    /// Start; (0, 0, 0) at first.
    pub origin: [&'a mut [f32]; 3],
    /// End point or direction; (0, 0, 0) at first.
    pub end: [&'a mut [f32]; 3],
    /// [`TO_POINT`] at first.
    pub reach: &'a mut [f32],
}

/// One bit an entry.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bits {
    words: Vec<u64>,
    len: usize,
}

impl Bits {
    /// `len` bits, all clear; keeps the memory.
    pub fn reset(&mut self, len: usize) {
        self.words.clear();
        self.words.resize(len.div_ceil(64), 0);
        self.len = len;
    }

    /// Number of bits.
    pub fn len(&self) -> usize {
        self.len
    }

    /// There is no bit.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Bit `i`.
    #[inline]
    pub fn get(&self, i: usize) -> bool {
        (self.words[i / 64] >> (i % 64)) & 1 == 1
    }

    /// Sets bit `i`.
    #[inline]
    pub fn set(&mut self, i: usize) {
        self.words[i / 64] |= 1 << (i % 64);
    }

    /// Sets bits 64·`k` … 64·`k` + 63 at once.
    #[inline]
    pub(crate) fn set_word(&mut self, k: usize, bits: u64) {
        self.words[k] = bits;
    }

    /// Bits 64·`k` … 64·`k` + 63.
    #[inline]
    pub(crate) fn word(&self, k: usize) -> u64 {
        self.words[k]
    }

    /// Number of set bits.
    pub fn count(&self) -> usize {
        self.words.iter().map(|w| w.count_ones() as usize).sum()
    }
}

/// The closest hit of each ray; `prim` is [`NO_PRIM`] and `t` is +∞ for a miss.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hits {
    /// Ray parameter, relative error ≤ 2⁻²⁹ (LAW §1).
    pub t: Vec<f64>,
    /// What was hit.
    pub prim: Vec<PrimId>,
    /// Where on it: barycentric weights of the second and third corner; shapes: 0.
    pub uv: Vec<[f32; 2]>,
}

impl Hits {
    /// `len` misses; keeps the memory.
    pub fn reset(&mut self, len: usize) {
        self.t.clear();
        self.t.resize(len, f64::INFINITY);
        self.prim.clear();
        self.prim.resize(len, NO_PRIM);
        self.uv.clear();
        self.uv.resize(len, [0.0; 2]);
    }

    /// Number of rays asked.
    pub fn len(&self) -> usize {
        self.t.len()
    }

    /// No ray was asked.
    pub fn is_empty(&self) -> bool {
        self.t.is_empty()
    }
}
