//! Fixed blocks of (tile × passes) over threads, merged in order. Floor 7: the core's only user of threads.
//!
//! A round is a run of passes of one replicate. In a round every tile is computed once, by whichever thread is free;
//! the block of a tile is added to the tile's own film, so nothing hot is shared and sums do not depend on who came first.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::film::Film;
use crate::illuminate::{Buffers, Counts, Job, illuminate};
use crate::sampler::PassPlan;
use crate::sensor::Tile;

/// The longest round: how much a person may lose by stopping.
const LONGEST_ROUND: u32 = 8;

/// How far a render is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Blocks (tile × round) done.
    pub done: u64,
    /// Blocks in all.
    pub total: u64,
    /// Passes that are finished for every tile.
    pub passes_done: u32,
    /// Passes in all.
    pub passes: u32,
}

/// What the watcher of a render wants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    /// Go on.
    Continue,
    /// Stop; finished passes are kept.
    Stop,
}

/// The finished part of a render.
pub struct Finished {
    /// Each tile with its film.
    pub tiles: Vec<(Tile, Film)>,
    /// Passes that every tile has.
    pub passes_done: u32,
    /// Rays of all blocks that were computed.
    pub counts: Counts,
}

/// One tile: its film, and the block of the round that is under way.
struct Slot {
    tile: Tile,
    film: Film,
    block: Film,
    done: bool,
}

/// Runs a job on `threads` threads (0 = all cores); `watch` is called about twenty times a second on this thread.
pub fn run(job: &Job<'_>, threads: u32, watch: &mut dyn FnMut(Progress) -> Flow) -> Finished {
    let tile_slot = |tile: Tile| {
        let cells = tile.cells() as usize;
        Slot { tile, film: Film::tile(cells, job.planes), block: Film::block(cells, job.planes), done: false }
    };
    let mut slots: Vec<Slot> = job.sensor.tiles().into_iter().map(tile_slot).collect();
    let rounds = rounds(&job.passes);
    let shared = Shared { stop: AtomicBool::new(false), done: AtomicU64::new(0), rays: Default::default() };
    let total = rounds.len() as u64 * slots.len() as u64;
    let mut passes_done = 0;
    workers::with(threads, |pool| {
        for round in &rounds {
            let report = |done| Progress { done, total, passes_done, passes: job.passes.count };
            pool.round(job, round.passes.clone(), &mut slots, &shared, &mut |done| watch(report(done)));
            if slots.iter().any(|slot| !slot.done) {
                break;
            }
            for slot in &mut slots {
                slot.film.merge(&slot.block);
                slot.done = false;
                if round.ends_replicate {
                    slot.film.close_replicate();
                }
            }
            passes_done = round.passes.end;
        }
    });
    if passes_done < job.passes.count {
        // A replicate cut short still tells something about the error.
        slots.iter_mut().for_each(|slot| slot.film.close_replicate());
    }
    let counts = Counts {
        segments: shared.rays[0].load(Ordering::Relaxed),
        rays: shared.rays[1].load(Ordering::Relaxed),
    };
    Finished { tiles: slots.into_iter().map(|s| (s.tile, s.film)).collect(), passes_done, counts }
}

/// What threads tell each other: once a block, never in a loop.
struct Shared {
    stop: AtomicBool,
    done: AtomicU64,
    rays: [AtomicU64; 2],
}

struct Round {
    passes: Range<u32>,
    ends_replicate: bool,
}

/// All passes in order, cut at the ends of replicates.
fn rounds(plan: &PassPlan) -> Vec<Round> {
    let mut rounds = Vec::new();
    for r in 0..plan.replicates {
        let (begin, end) = (plan.begin(r), plan.begin(r + 1));
        for from in (begin..end).step_by(LONGEST_ROUND as usize) {
            let to = (from + LONGEST_ROUND).min(end);
            rounds.push(Round { passes: from..to, ends_replicate: to == end });
        }
    }
    rounds
}

/// Computes one block, unless the render was stopped.
fn compute(job: &Job<'_>, passes: Range<u32>, slot: &mut Slot, shared: &Shared, buffers: &mut Buffers) {
    if shared.stop.load(Ordering::Relaxed) {
        return;
    }
    slot.block.clear();
    let counts = illuminate(job, slot.tile, passes, &mut slot.block, buffers);
    slot.done = true;
    shared.rays[0].fetch_add(counts.segments, Ordering::Relaxed);
    shared.rays[1].fetch_add(counts.rays, Ordering::Relaxed);
    shared.done.fetch_add(1, Ordering::Relaxed);
}

#[cfg(feature = "threads")]
mod workers {
    //! A pool of its own for each run: nothing global.

    use std::sync::mpsc::{RecvTimeoutError, channel};
    use std::time::Duration;

    use rayon::prelude::*;

    use super::*;

    /// Between two looks of the watcher.
    const TICK: Duration = Duration::from_millis(50);

    pub(super) struct Pool(Option<rayon::ThreadPool>);

    pub(super) fn with<R>(threads: u32, work: impl FnOnce(&Pool) -> R) -> R {
        // Without a pool (no threads to be had) the calling thread does the work.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads as usize).build().ok();
        work(&Pool(pool))
    }

    impl Pool {
        pub(super) fn round(
            &self,
            job: &Job<'_>,
            passes: Range<u32>,
            slots: &mut [Slot],
            shared: &Shared,
            watch: &mut dyn FnMut(u64) -> Flow,
        ) {
            let Some(pool) = &self.0 else { return serial(job, passes, slots, shared, watch) };
            let (finished, is_finished) = channel::<()>();
            pool.in_place_scope(|scope| {
                scope.spawn(move |_| {
                    slots.par_iter_mut().with_max_len(1).for_each_init(Buffers::default, |b, slot| {
                        compute(job, passes.clone(), slot, shared, b)
                    });
                    drop(finished);
                });
                while is_finished.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                    if watch(shared.done.load(Ordering::Relaxed)) == Flow::Stop {
                        shared.stop.store(true, Ordering::Relaxed);
                    }
                }
            });
            if watch(shared.done.load(Ordering::Relaxed)) == Flow::Stop {
                shared.stop.store(true, Ordering::Relaxed);
            }
        }
    }
}

#[cfg(not(feature = "threads"))]
mod workers {
    //! Without threads: the calling thread does the work.

    use super::*;

    pub(super) struct Pool;

    pub(super) fn with<R>(_threads: u32, work: impl FnOnce(&Pool) -> R) -> R {
        work(&Pool)
    }

    impl Pool {
        pub(super) fn round(
            &self,
            job: &Job<'_>,
            passes: Range<u32>,
            slots: &mut [Slot],
            shared: &Shared,
            watch: &mut dyn FnMut(u64) -> Flow,
        ) {
            serial(job, passes, slots, shared, watch);
        }
    }
}

/// One tile after the other, on the calling thread.
fn serial(
    job: &Job<'_>,
    passes: Range<u32>,
    slots: &mut [Slot],
    shared: &Shared,
    watch: &mut dyn FnMut(u64) -> Flow,
) {
    let mut buffers = Buffers::default();
    for slot in slots {
        compute(job, passes.clone(), slot, shared, &mut buffers);
        if watch(shared.done.load(Ordering::Relaxed)) == Flow::Stop {
            shared.stop.store(true, Ordering::Relaxed);
        }
    }
}
