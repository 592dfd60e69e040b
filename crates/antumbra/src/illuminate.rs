//! The one loop: sensor × estimator × visibility × film. Floor 6.

use std::ops::Range;

use antumbra_math::{Rgb, Vec3, hash};
use antumbra_trace::{Bits, Hits, NO_PRIM, SegmentBuffer, TO_POINT, Visibility};

use crate::estimator::{
    Area, Carried, Draws, Estimator, Found, FoundLight, Options, Proposals, VisibleFraction, plane_of,
};
use crate::film::{Film, Planes};
use crate::light::sampler::Scratch as LightWeights;
use crate::light::{End, LightId};
use crate::receiver::Receiver;
use crate::sampler::{AnySampler, PassPlan};
use crate::scene::{Errand, Look, Ray, Scene};
use crate::sensor::{Looking, Scratch, Sensor, Tile};

/// What is to be computed.
pub struct Job<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its tree.
    pub visibility: &'a dyn Visibility,
    /// Where light is asked for.
    pub sensor: &'a dyn Sensor,
    /// How it is estimated.
    pub estimator: &'a dyn Estimator,
    /// Random numbers.
    pub sampler: AnySampler,
    /// Seed of all streams.
    pub seed: u32,
    /// N of the estimator.
    pub shadow_rays: u32,
    /// Longest path: 0 = what is seen itself, 1 = direct light.
    pub bounces: u32,
    /// All passes.
    pub passes: PassPlan,
    /// Planes beside the picture.
    pub planes: Planes,
    /// What the planes about the lights ask.
    pub light_planes: LightPlanes,
    /// How the scene is looked at.
    pub look: Look,
    /// What the sensor adds where it looks.
    pub seen: crate::sensor::Seen,
    /// Teaching switch: off = nothing blocks.
    pub shadows: bool,
    /// Teaching switch: off = what lies behind a light shadows it too.
    pub distance_test: bool,
}

/// The estimators behind the planes about the lights, which are there whatever estimator makes the picture.
#[derive(Default)]
pub struct LightPlanes {
    /// `unshadowed-direct`: the area form with V = 1, by the very samples of `area`.
    unshadowed: Option<Area>,
    /// `visible-fraction`: mean V over the lights.
    visible: Option<VisibleFraction>,
}

impl LightPlanes {
    /// For those of the planes that are asked for.
    pub fn new(planes: Planes, scene: &Scene, options: Options) -> LightPlanes {
        LightPlanes {
            unshadowed: planes.has(Planes::UNSHADOWED).then(|| Area::new(scene, options)),
            visible: planes.has(Planes::VISIBLE_FRACTION).then(VisibleFraction::mean),
        }
    }
}

/// Rays that were asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Segments (any hit).
    pub segments: u64,
    /// Rays (closest hit), the sensor's too.
    pub rays: u64,
}

/// Buffers of one thread, filled again and again.
#[derive(Default)]
pub struct Buffers {
    scratch: Scratch,
    receivers: Vec<Receiver>,
    next: Vec<Receiver>,
    proposals: Proposals,
    blocked: Bits,
    hits: Hits,
    glances: SegmentBuffer,
    /// Which ray looks for which light.
    glimpsed: Vec<(u32, LightId)>,
    weights: LightWeights,
}

/// Sums what arrives at the cells of `tile` in `passes` into `film`; `None` if it was stopped, the film being worthless
/// then. `stopped` is asked once a batch.
pub fn illuminate(
    job: &Job<'_>,
    tile: Tile,
    passes: Range<u32>,
    film: &mut Film,
    b: &mut Buffers,
    stopped: &dyn Fn() -> bool,
) -> Option<Counts> {
    let mut counts = Counts::default();
    let looking = Looking {
        scene: job.scene,
        visibility: job.visibility,
        look: job.look,
        seen: job.seen,
        sampler: &job.sampler,
        seed: job.seed,
        passes: job.passes,
    };
    let draws = Draws::new(&job.sampler, job.passes, job.shadow_rays);
    b.proposals.beyond_lights = !job.distance_test;
    for pass in passes {
        b.receivers.clear();
        job.sensor.receivers(&looking, tile, pass, &mut b.scratch, film, &mut b.receivers);
        counts.rays += b.scratch.rays.len() as u64;
        light_planes(job, &draws, film, b, &mut counts);
        for _ in 0..job.bounces {
            if b.receivers.is_empty() {
                break;
            }
            bounce(job, &draws, film, b, &mut counts, stopped)?;
        }
        film.next_sample();
    }
    Some(counts)
}

/// Segments and rays that are proposed at once, or those of one receiver if they are more: bounds what the buffers take.
const BATCH: usize = 1 << 16;

/// Runs of receivers of which `estimator` makes no more than a batch.
fn runs<'a>(
    receivers: &'a [Receiver],
    draws: &Draws<'_>,
    scene: &Scene,
    estimator: &dyn Estimator,
) -> impl Iterator<Item = &'a [Receiver]> + use<'a> {
    let samples = receivers.first().map_or(1, |at| draws.count(at)) as usize;
    receivers.chunks((BATCH / estimator.most_proposed(scene, samples).max(1)).max(1))
}

/// One step of the loop: the receivers propose, visibility answers, the film sums, the rays make the next receivers.
fn bounce(
    job: &Job<'_>,
    draws: &Draws<'_>,
    film: &mut Film,
    b: &mut Buffers,
    counts: &mut Counts,
    stopped: &dyn Fn() -> bool,
) -> Option<()> {
    let receivers = std::mem::take(&mut b.receivers);
    b.next.clear();
    for run in runs(&receivers, draws, job.scene, job.estimator) {
        if stopped() {
            return None;
        }
        b.proposals.clear();
        job.estimator.propose(job.scene, run, draws, &mut b.proposals);
        for carried in free(job, b, counts) {
            film.add(Planes::BEAUTY, carried.cell, carried.light);
            film.add(carried.plane, carried.cell, carried.light);
        }
        let ends = b.proposals.onward.iter().all(|onward| onward.goes_on.is_none());
        if ends && job.shadows && job.scene.along().few() && !job.scene.has_masks() {
            glance(job, run, film, b, counts);
        } else {
            follow(job, run, film, b, counts);
        }
    }
    b.receivers = std::mem::replace(&mut b.next, receivers);
    Some(())
}

/// What the free segments carry.
fn free<'b>(job: &Job<'_>, b: &'b mut Buffers, counts: &mut Counts) -> impl Iterator<Item = &'b Carried> {
    let segments = b.proposals.segments.as_segments();
    counts.segments += segments.len() as u64;
    if job.shadows {
        job.visibility.occluded(segments, &mut b.blocked);
    } else {
        b.blocked.reset(segments.len());
    }
    let Buffers { proposals, blocked, .. } = b;
    proposals.carried.iter().enumerate().filter(|(i, _)| !blocked.get(*i)).map(|(_, carried)| carried)
}

/// The planes about the lights.
fn light_planes(job: &Job<'_>, draws: &Draws<'_>, film: &mut Film, b: &mut Buffers, counts: &mut Counts) {
    let receivers = std::mem::take(&mut b.receivers);
    if let Some(area) = &job.light_planes.unshadowed {
        for run in runs(&receivers, draws, job.scene, area) {
            b.proposals.clear();
            area.propose(job.scene, run, draws, &mut b.proposals);
            for carried in &b.proposals.carried {
                film.add(Planes::UNSHADOWED, carried.cell, carried.light);
            }
        }
    }
    if let Some(visible) = &job.light_planes.visible {
        for run in runs(&receivers, draws, job.scene, visible) {
            b.proposals.clear();
            visible.propose(job.scene, run, draws, &mut b.proposals);
            for carried in free(job, b, counts) {
                film.add(Planes::VISIBLE_FRACTION, carried.cell, carried.light);
            }
        }
    }
    b.receivers = receivers;
}

/// Rays that only look for light ask for nothing but the lights that lie along them, as segments do: the first thing in
/// the way ends them, and need not be known.
fn glance(job: &Job<'_>, receivers: &[Receiver], film: &mut Film, b: &mut Buffers, counts: &mut Counts) {
    let (lights, rays) = (job.scene.lights(), b.proposals.rays.as_segments());
    b.glances.clear();
    b.glimpsed.clear();
    for (i, onward) in b.proposals.onward.iter().enumerate() {
        let (from, wi) = (&receivers[onward.from as usize], Vec3::from(rays.end_at(i)));
        for (light, end, prim) in job.scene.along().lights(lights, (from.p, from.prim), wi) {
            let (end, reach) = match end {
                End::Infinity => (wi, f32::INFINITY),
                End::Point(q) => (q, TO_POINT),
            };
            b.glances.push(rays.origin_at(i), end.to_array(), reach, from.prim, prim, rays.number[i]);
            b.glimpsed.push((i as u32, light));
        }
    }
    counts.segments += b.glimpsed.len() as u64;
    job.visibility.occluded(b.glances.as_segments(), &mut b.blocked);
    for (_, (i, light)) in b.glimpsed.iter().enumerate().filter(|(k, _)| !b.blocked.get(*k)) {
        let onward = &b.proposals.onward[*i as usize];
        let (from, wi) = (&receivers[onward.from as usize], Vec3::from(rays.end_at(*i as usize)));
        if let Some(hit) = lights[*light as usize].hit(from.p, wi) {
            let found = FoundLight { from, ray: onward, light: *light, wi };
            find(job, film, &found, hit.radiance, &mut b.weights);
        }
    }
}

/// Adds light that a ray found.
fn find(job: &Job<'_>, film: &mut Film, found: &FoundLight<'_>, radiance: Rgb, weights: &mut LightWeights) {
    let weight = match found.ray.found {
        Found::All => 1.0,
        Found::Weighed => job.estimator.found_weight(job.scene, found, weights),
    };
    let carried = found.ray.throughput * radiance * weight;
    film.add(Planes::BEAUTY, found.from.cell, carried);
    film.add(plane_of(found.from), found.from.cell, carried);
}

/// Follows the rays: adds the light they find, makes receivers of the surfaces where they go on.
fn follow(job: &Job<'_>, receivers: &[Receiver], film: &mut Film, b: &mut Buffers, counts: &mut Counts) {
    let rays = b.proposals.rays.as_segments();
    counts.rays += rays.len() as u64;
    if !rays.is_empty() {
        job.visibility.nearest(rays, &mut b.hits);
    }
    for (i, onward) in b.proposals.onward.iter().enumerate() {
        let from = &receivers[onward.from as usize];
        let (o, wi) = (Vec3::from(rays.origin_at(i)), Vec3::from(rays.end_at(i)));
        let mut find = |light, radiance| {
            find(job, film, &FoundLight { from, ray: onward, light, wi }, radiance, &mut b.weights);
        };
        if !job.shadows {
            job.scene.from_everywhere(from.p, wi).for_each(|(light, radiance)| find(light, radiance));
        } else if b.hits.prim[i] == NO_PRIM {
            job.scene.from_infinity(wi).for_each(|(light, radiance)| find(light, radiance));
        }
        if b.hits.prim[i] == NO_PRIM {
            continue;
        }
        let (t, prim, uv, number) = (b.hits.t[i], b.hits.prim[i], b.hits.uv[i], rays.number[i]);
        let ray = Ray { o, d: wi, t, prim, uv, number };
        let Some(survival) = onward.goes_on else {
            if job.shadows
                && let Some((light, radiance)) = job.scene.emitted(&ray)
            {
                find(light, radiance);
            }
            continue;
        };
        let errand = Errand {
            cell: from.cell,
            stream: if onward.branch == 0 { from.stream } else { hash::hash2(from.stream, onward.branch) },
            index: from.index,
            throughput: onward.throughput * survival,
            bounce: from.bounce + 1,
        };
        let met = job.scene.meet_for(errand, &ray, &job.look);
        if let (Some((light, radiance)), true) = (met.emitted, job.shadows) {
            find(light, radiance);
        }
        b.next.push(met.receiver);
    }
}
