//! What segments cost: boxes and primitives that any hit and closest hit visit.

use std::ops::Range;

use antumbra_trace::{Bits, Hits, SegmentBuffer, Visibility, Work};

use super::Fill;
use crate::scene::Scene;
use crate::schedule::{self, Flow};

/// Segments of a chunk.
const CHUNK: usize = 1024;

/// What one segment visited.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Visited {
    /// To learn whether anything blocks it.
    pub any: Work,
    /// To learn what it meets first.
    pub closest: Work,
    /// Something blocks it: what [`occluded`](super::occluded) answers.
    pub blocked: bool,
}

/// Counts for each segment; `watch` hears how many are done. Where a scene has alpha masks, the counts are those of the
/// same surfaces without them.
pub fn visits(
    scene: &Scene,
    fill: &Fill<'_>,
    threads: u32,
    out: &mut [Visited],
    watch: &mut dyn FnMut(u64) -> Flow,
) {
    type State = (SegmentBuffer, Bits, Hits, [Vec<Work>; 2]);
    let visibility = scene.visibility(false);
    let answer = |from: usize, out: &mut [Visited], (buffer, bits, hits, work): &mut State| {
        let run: Range<usize> = from..from + out.len();
        buffer.clear();
        fill(run, buffer);
        let segments = buffer.as_segments();
        let [any, closest] = work;
        scene.world().occluded_counted(segments, bits, any);
        scene.world().nearest_counted(segments, hits, closest);
        visibility.occluded(segments, bits);
        for (i, out) in out.iter_mut().enumerate() {
            *out = Visited { any: any[i], closest: closest[i], blocked: bits.get(i) };
        }
    };
    schedule::chunks(out, CHUNK, threads, answer, watch);
}
