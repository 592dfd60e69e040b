//! Which of many directions are blocked, all of a receiver together: S. Laine and T. Karras, "Two Methods for Fast
//! Ray-Cast Ambient Occlusion" (2010).
//!
//! A triangle blocks the directions between three planes through the receiver. A table says of each plane which
//! directions lie surely on its positive side, and which perhaps; for those between, the filter of packets and the law
//! decide. So every method gives the bits of `Brute` asked of the same rays (docs/visibility.md §3).

mod bins;
mod decide;
mod directions;
mod levels;
mod mixed;
mod occluder_major;
mod pairs;
mod receiver_major;
mod region;
mod table;

use fearless_simd::{Simd, dispatch};

pub use directions::{COUNTS, Directions, DirectionsError, Receiver};

use crate::dispatch::occluded;
use crate::traverse::{Ask, Asking, FastLine, Lines, Masks, Opaque};
use crate::walk::any_other;
use crate::world::World;
use crate::{Bits, Passes, SegmentBuffer};
use decide::Judge;

/// Directions of a block of a mask.
const BITS: usize = 256;

/// 256 bits of a mask.
type Block = [u64; 4];

/// Of 1024 directions.
const MOST_BLOCKS: usize = 4;

/// How the masks are found: always the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Method {
    /// Method 1, occluder-major: each triangle to all receivers of a tile that it may reach.
    Occluders,
    /// Method 2, receiver-major: each receiver through the tree.
    #[default]
    Receivers,
    /// Every direction is a ray of its own.
    Rays,
}

/// What it took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OcclusionWork {
    /// Boxes tested.
    pub boxes: u64,
    /// Pairs of a receiver (with a direction still free) and a triangle that were looked at.
    pub pairs: u64,
    /// Those of them in which the triangle may be met: in range, above the horizon.
    pub in_range: u64,
    /// Those of them whose triangle is so small that it lies between the directions.
    pub between: u64,
    /// Directions of such pairs that the table left open.
    pub tested: u64,
    /// Those of them that went to the law.
    pub law: u64,
    /// Rays that were cast instead: all, or where f32 is not proven.
    pub rays: u64,
}

impl std::ops::AddAssign for OcclusionWork {
    fn add_assign(&mut self, more: OcclusionWork) {
        let OcclusionWork { boxes, pairs, in_range, between, tested, law, rays } = more;
        self.boxes += boxes;
        self.pairs += pairs;
        self.in_range += in_range;
        self.between += between;
        self.tested += tested;
        self.law += law;
        self.rays += rays;
    }
}

impl World {
    /// For each receiver the directions that are blocked: bit i of its [`Directions::words`] words is direction i.
    /// Masks count as opaque.
    ///
    /// Law: equals `Brute` asked of [`Receiver::rays`], bit for bit, whatever the method.
    pub fn occlusion_masks(
        &self,
        receivers: &[Receiver],
        directions: &Directions,
        method: Method,
        out: &mut Vec<u64>,
    ) -> OcclusionWork {
        dispatch!(self.level.level(), simd => all(simd, self, (receivers, directions), method, &Opaque, out))
    }

    /// [`occlusion_masks`](World::occlusion_masks), in which hits on masked instances are asked back.
    pub fn occlusion_masks_with<P: Passes>(
        &self,
        receivers: &[Receiver],
        directions: &Directions,
        method: Method,
        passes: &P,
        out: &mut Vec<u64>,
    ) -> OcclusionWork {
        if !self.has_masks() {
            return self.occlusion_masks(receivers, directions, method, out);
        }
        let masks = Asking(passes);
        dispatch!(self.level.level(), simd => all(simd, self, (receivers, directions), method, &masks, out))
    }
}

#[inline(always)]
fn all<S: Simd, M: Masks>(
    simd: S,
    world: &World,
    (receivers, directions): (&[Receiver], &Directions),
    method: Method,
    masks: &M,
    out: &mut Vec<u64>,
) -> OcclusionWork {
    let mut asked = Asked { world, receivers, directions, masks, rows: Vec::new(), work: Default::default() };
    asked.rows.resize(receivers.len() * directions.blocks(), [0; 4]);
    let everybody = 0..receivers.len() as u32;
    let (mut fit, rest): (Vec<u32>, Vec<u32>) =
        everybody.partition(|m| method != Method::Rays && asked.fits(*m));
    if !world.triangles.tree.is_empty() && !fit.is_empty() {
        asked.triangles(simd, method, &mut fit);
    }
    if !world.shapes.tree.is_empty() || !world.places.places.is_empty() {
        asked.others(simd, &fit);
    }
    asked.cast(simd, &rest);
    out.clear();
    let words = directions.words();
    out.extend(asked.rows.chunks(directions.blocks()).flat_map(|row| &row.as_flattened()[..words]));
    asked.work
}

/// A question and its answer so far.
struct Asked<'a, M> {
    world: &'a World,
    receivers: &'a [Receiver],
    directions: &'a Directions,
    masks: &'a M,
    /// Blocked directions, by receiver.
    rows: Vec<Block>,
    work: OcclusionWork,
}

/// Receivers whose rays are cast together.
const TOGETHER: usize = 64;

impl<M: Masks> Asked<'_, M> {
    /// The rays of receiver `m` fulfil the conditions of the f32 way (LAW §3, §4).
    fn fits(&self, m: u32) -> bool {
        let at = &self.receivers[m as usize];
        self.world.triangles.limits.hold(&FastLine { o: at.start, d: at.frame()[2], tmax: 1.0 })
    }

    /// World-space triangles, for the receivers `fit`.
    #[inline(always)]
    fn triangles<S: Simd>(&mut self, simd: S, method: Method, fit: &mut [u32]) {
        let (of, directions) = (&self.world.triangles, self.directions);
        let mut judge = Judge { of, directions, masks: self.masks, work: self.work };
        simd.vectorize(
            #[inline(always)]
            || {
                if method == Method::Occluders {
                    return occluder_major::walk(simd, &mut judge, self.receivers, fit, &mut self.rows);
                }
                let mut stack = Vec::new();
                for m in fit {
                    receiver_major::walk(simd, &mut judge, (self.receivers, *m), &mut stack, &mut self.rows);
                }
            },
        );
        self.work = judge.work;
    }

    /// Shapes and instances, in the directions that are still free.
    #[inline(always)]
    fn others<S: Simd>(&mut self, simd: S, fit: &[u32]) {
        let (blocks, n) = (self.directions.blocks(), self.directions.len());
        let mut rays = SegmentBuffer::default();
        for m in fit {
            rays.clear();
            self.receivers[*m as usize].rays(self.directions, &mut rays);
            let segments = rays.as_segments();
            let lines = Lines::of(&segments);
            let row = &mut self.rows[*m as usize * blocks..][..blocks];
            for i in 0..n {
                let word = &mut row[i / BITS][i % BITS / 64];
                if *word >> (i % 64) & 1 == 0 {
                    let ask = Ask::world(&segments, i, self.masks);
                    self.work.rays += 1;
                    *word |= u64::from(any_other(simd, self.world, &lines.line(i), &ask)) << (i % 64);
                }
            }
        }
    }

    /// Casts every ray of the receivers `rest`.
    #[inline(always)]
    fn cast<S: Simd>(&mut self, simd: S, rest: &[u32]) {
        let (blocks, words) = (self.directions.blocks(), self.directions.words());
        let (mut rays, mut bits) = (SegmentBuffer::default(), Bits::default());
        for members in rest.chunks(TOGETHER) {
            rays.clear();
            members.iter().for_each(|m| self.receivers[*m as usize].rays(self.directions, &mut rays));
            occluded(simd, self.world, &rays.as_segments(), self.masks, &mut bits);
            self.work.rays += rays.len() as u64;
            for (k, m) in members.iter().enumerate() {
                let row = self.rows[*m as usize * blocks..][..blocks].as_flattened_mut();
                row.iter_mut().take(words).enumerate().for_each(|(w, out)| *out = bits.word(k * words + w));
            }
        }
    }
}
