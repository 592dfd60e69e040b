//! What surfaces reflect from one direction into another.

use antumbra_math::Vec3;

use super::RayHit;
use crate::scene::Scene;
use crate::schedule::{self, Flow};

/// Entries that a thread takes at once.
const CHUNK: usize = 1024;

/// ω_o and ω_i of an entry, both away from the surface; `None` leaves its answer at 0.
pub type Directions<'a> = dyn Fn(usize) -> Option<[Vec3; 2]> + Sync + 'a;

/// f_r(ω_o, ω_i) [1/sr] at what each ray met, without the cosine; 0 where it met nothing and for directions below the
/// surface.
pub fn brdf(
    scene: &Scene,
    hits: &[RayHit],
    directions: &Directions<'_>,
    threads: u32,
    watch: &mut dyn FnMut(u64) -> Flow,
) -> Vec<[f32; 3]> {
    let mut out = vec![[0.0; 3]; hits.len()];
    let answer = |from: usize, out: &mut [[f32; 3]], _: &mut ()| {
        for (i, out) in out.iter_mut().enumerate() {
            let (Some([wo, wi]), Some(met)) = (directions(from + i), hits[from + i].met(scene)) else {
                continue;
            };
            let at = met.receiver;
            if at.sees_side(wo) && at.sees_side(wi) {
                *out = at.bsdf.eval(at.to_local(wo), at.to_local(wi)).0;
            }
        }
    };
    schedule::chunks(&mut out, CHUNK, threads, answer, watch);
    out
}
