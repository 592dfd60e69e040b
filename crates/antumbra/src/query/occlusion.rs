//! Which of many directions are blocked over points: all of a point decided together, or ray by ray.

use antumbra_math::hash;
use antumbra_trace::NO_PRIM;
use antumbra_trace::occlusion::{Directions, DirectionsError, Method, OcclusionWork, Receiver};
use antumbra_trace::start;

use crate::estimator::Falloff;
use crate::scene::Scene;
use crate::schedule::{self, Flow};
use crate::sensor::Query;

/// Points that a thread takes at once: several tiles of method 1.
const CHUNK: usize = 1024;

/// The masks of all points.
#[derive(Clone, Debug, Default)]
pub struct Occlusion {
    /// Bit i of the words of a point: direction i is blocked.
    pub words: Vec<u64>,
    /// Two tangents and the normal of each point.
    pub frames: Vec<[[f32; 3]; 3]>,
    /// What it took.
    pub work: OcclusionWork,
}

/// `count` cosine-weighted directions whose rays end within `radius` (+∞: nowhere): the mean of V over them is
/// (1/π) ∫ V cos θ dω, with the fall-off in the lengths.
pub fn directions(count: usize, radius: f32, falloff: Falloff) -> Result<Directions, DirectionsError> {
    let falloff = if radius.is_finite() { falloff } else { Falloff::None };
    Directions::new(count, |u| falloff.length(radius, u))
}

/// Which directions are blocked over each point; `turned`: each point's directions are turned about its normal by
/// a random angle of its own. `watch` hears how many chunks are done.
pub fn occlusion_masks(
    scene: &Scene,
    queries: &[Query],
    (directions, method): (&Directions, Method),
    turned: bool,
    threads: u32,
    watch: &mut dyn FnMut(u64) -> Flow,
) -> Occlusion {
    let at = |i: usize| {
        let Query { p, n, start } = queries[i];
        let (start, prim) = start.unwrap_or_else(|| (start::start_free(p, n), NO_PRIM));
        let turn = if turned { f64::from(hash::unit_f32(hash::mix32(i as u32))) } else { 0.0 };
        let number = (i as u32).wrapping_mul(directions.len() as u32);
        Receiver::new(start, prim, number, n, turn)
    };
    let mut parts = vec![Occlusion::default(); queries.len().div_ceil(CHUNK)];
    let answer = |from: usize, parts: &mut [Occlusion], receivers: &mut Vec<Receiver>| {
        for (part, k) in parts.iter_mut().zip(from..) {
            let run = k * CHUNK..queries.len().min((k + 1) * CHUNK);
            receivers.clear();
            receivers.extend(run.map(at));
            part.frames = receivers.iter().map(Receiver::frame).collect();
            part.work =
                scene.world().occlusion_masks_with(receivers, directions, method, scene, &mut part.words);
        }
    };
    schedule::chunks(&mut parts, 1, threads, answer, watch);
    let mut out = Occlusion::default();
    for part in parts {
        out.words.extend(part.words);
        out.frames.extend(part.frames);
        out.work += part.work;
    }
    out
}
