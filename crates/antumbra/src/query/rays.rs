//! Segments and rays by the million: chunks over threads, answers in the order of the questions.

use std::ops::Range;

use antumbra_math::hash;
use antumbra_trace::{Bits, Hits, NO_PRIM, PrimId, SegmentBuffer, Visibility};

use super::order::Order;
use crate::scene::{Look, Met, Ray, Scene};
use crate::schedule::{self, Flow};

/// Rays of a chunk: enough for the batch calls, small enough for the cache.
const CHUNK: usize = 4096;
/// Most rays of a chunk: each of their components still lies in the second cache of a core.
const LARGEST: usize = 1 << 18;
/// Chunks into which a long question is cut at least.
const SHARES: usize = 32;

/// Writes the questions of a range into a buffer (it comes empty).
pub type Fill<'a> = dyn Fn(Range<usize>, &mut SegmentBuffer) + Sync + 'a;

/// A ray with what it meets first: small, because there may be millions; everything else follows from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// Origin.
    pub o: [f32; 3],
    /// Direction, of any length.
    pub d: [f32; 3],
    /// Ray parameter; +∞ for a miss.
    pub t: f64,
    /// The primitive, or `NO_PRIM`.
    pub prim: PrimId,
    /// Weights of its second and third corner.
    pub uv: [f32; 2],
}

/// Whether anything lies strictly inside each segment; `watch` hears how many are answered.
pub fn occluded(
    scene: &Scene,
    fill: &Fill<'_>,
    threads: u32,
    out: &mut [bool],
    watch: &mut dyn FnMut(u64) -> Flow,
) {
    type State = (SegmentBuffer, Order, Bits);
    let visibility = scene.visibility(false);
    let answer = |from: usize, out: &mut [bool], (buffer, order, bits): &mut State| {
        buffer.clear();
        fill(from..from + out.len(), buffer);
        match order.of(scene.world(), buffer.as_segments()) {
            None => {
                visibility.occluded(buffer.as_segments(), bits);
                out.iter_mut().enumerate().for_each(|(i, blocked)| *blocked = bits.get(i));
            }
            Some((sorted, order)) => {
                visibility.occluded(sorted, bits);
                order.iter().enumerate().for_each(|(k, i)| out[*i as usize] = bits.get(k));
            }
        }
    };
    // Large chunks find more rays that go alike; every thread should have several.
    let chunk = (out.len() / SHARES).clamp(CHUNK, LARGEST);
    schedule::chunks(out, chunk, threads, answer, watch);
}

/// What each ray meets first.
pub fn closest_hit(
    scene: &Scene,
    fill: &Fill<'_>,
    threads: u32,
    out: &mut [RayHit],
    watch: &mut dyn FnMut(u64) -> Flow,
) {
    let visibility = scene.visibility(false);
    let answer = |from: usize, out: &mut [RayHit], (buffer, hits): &mut (SegmentBuffer, Hits)| {
        buffer.clear();
        fill(from..from + out.len(), buffer);
        let rays = buffer.as_segments();
        visibility.nearest(rays, hits);
        for (i, hit) in out.iter_mut().enumerate() {
            let (o, d) = (rays.origin_at(i), rays.end_at(i));
            *hit = RayHit { o, d, t: hits.t[i], prim: hits.prim[i], uv: hits.uv[i] };
        }
    };
    schedule::chunks(out, CHUNK, threads, answer, watch);
}

impl RayHit {
    /// A ray that met nothing.
    pub const MISS: RayHit =
        RayHit { o: [0.0; 3], d: [0.0; 3], t: f64::INFINITY, prim: NO_PRIM, uv: [0.0; 2] };

    /// Where the ray meets it.
    pub fn position(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| f64::from(self.o[k]) + self.t * f64::from(self.d[k]))
    }

    /// The surface there, ready to ask for light; `None` for a miss.
    pub fn met(&self, scene: &Scene) -> Option<Met> {
        let RayHit { t, prim, uv, .. } = *self;
        let number = self.o.iter().chain(&self.d).fold(0, |h, x| hash::hash2(h, x.to_bits()));
        let ray = Ray { o: self.o.into(), d: self.d.into(), t, prim, uv, number };
        (prim != NO_PRIM).then(|| scene.meet(&ray, &Look::default()))
    }
}
