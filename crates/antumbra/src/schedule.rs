//! Fixed blocks of (tile × passes) over threads, merged in order. Floor 7: the core's only user of threads.
//!
//! A round is a run of passes of one replicate. In a round every tile is computed once, by whichever thread is free;
//! the block of a tile is added to the tile's own film, so nothing hot is shared and sums do not depend on who came first.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::film::Film;
use crate::illuminate::{Buffers, Counts, Job, illuminate};
use crate::sampler::PassPlan;
use crate::scene::{Scene, SceneBuilder, SceneError};
use crate::sensor::Tile;

/// The longest round: how much a person may lose by stopping. The first is a single pass: something to keep, soon.
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

impl Slot {
    /// Takes the block of a finished round.
    fn settle(&mut self, ends_replicate: bool) {
        self.film.merge(&self.block);
        self.done = false;
        if ends_replicate {
            self.film.close_replicate();
        }
    }
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
            let mut look = || {
                let done = shared.done.load(Ordering::Relaxed);
                if watch(Progress { done, total, passes_done, passes: job.passes.count }) == Flow::Stop {
                    shared.stop.store(true, Ordering::Relaxed);
                }
            };
            let block =
                |slot: &mut Slot, b: &mut Buffers| compute(job, round.passes.clone(), slot, &shared, b);
            pool.each(slots.iter_mut().collect(), &block, &mut look);
            if slots.iter().any(|slot| !slot.done) {
                break;
            }
            let settle = |slot: &mut Slot, _: &mut ()| slot.settle(round.ends_replicate);
            pool.each(slots.iter_mut().collect(), &settle, &mut || {});
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
        let mut from = begin;
        while from < end.min(plan.until) {
            let longest = if from == 0 { 1 } else { LONGEST_ROUND };
            let to = (from + longest).min(end).min(plan.until);
            rounds.push(Round { passes: from..to, ends_replicate: to == end });
            from = to;
        }
    }
    rounds
}

/// Computes one block, unless the render was stopped.
fn compute(job: &Job<'_>, passes: Range<u32>, slot: &mut Slot, shared: &Shared, buffers: &mut Buffers) {
    let stopped = || shared.stop.load(Ordering::Relaxed);
    if stopped() {
        return;
    }
    slot.block.clear();
    let Some(counts) = illuminate(job, slot.tile, passes, &mut slot.block, buffers, &stopped) else { return };
    slot.done = true;
    shared.rays[0].fetch_add(counts.segments, Ordering::Relaxed);
    shared.rays[1].fetch_add(counts.rays, Ordering::Relaxed);
    shared.done.fetch_add(1, Ordering::Relaxed);
}

/// Checks a scene and builds its tree on `threads` threads (0 = all cores).
pub fn build(builder: SceneBuilder, threads: u32) -> Result<Scene, SceneError> {
    workers::with(threads, |pool| builder.build_in(pool.for_trees()))
}

/// Answers `out` in chunks of `size` on `threads` threads (0 = all cores), each thread with a `State` of its own;
/// `watch` hears on this thread how many entries are done. Stopped, the rest keeps what it was.
pub fn chunks<T: Send, State: Default>(
    out: &mut [T],
    size: usize,
    threads: u32,
    answer: impl Fn(usize, &mut [T], &mut State) + Sync,
    watch: &mut dyn FnMut(u64) -> Flow,
) {
    let (stop, done) = (AtomicBool::new(false), AtomicU64::new(0));
    let one = |(k, part): (usize, &mut [T]), state: &mut State| {
        if !stop.load(Ordering::Relaxed) {
            answer(k * size, part, state);
            done.fetch_add(part.len() as u64, Ordering::Relaxed);
        }
    };
    let mut look = || {
        if watch(done.load(Ordering::Relaxed)) == Flow::Stop {
            stop.store(true, Ordering::Relaxed);
        }
    };
    if out.len() <= size {
        one((0, out), &mut State::default());
        look();
    } else {
        workers::with(threads, |pool| pool.each(out.chunks_mut(size).enumerate().collect(), &one, &mut look));
    }
}

#[cfg(feature = "threads")]
mod workers {
    //! A pool of its own for each run: nothing global.

    use std::sync::mpsc::{RecvTimeoutError, channel};
    use std::sync::{Mutex, PoisonError};
    use std::time::Duration;

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
        /// The same threads for building trees.
        pub(super) fn for_trees(&self) -> antumbra_trace::Pool<'_> {
            self.0.as_ref().map(antumbra_trace::Pool::from).unwrap_or_default()
        }

        /// Does `work` on every item, the items in any order; `look` is called every tick on the calling thread.
        pub(super) fn each<I: Send, State: Default>(
            &self,
            items: Vec<I>,
            work: &(impl Fn(I, &mut State) + Sync),
            look: &mut dyn FnMut(),
        ) {
            let Some(pool) = &self.0 else { return serial(items, work, look) };
            let queue = Mutex::new(items.into_iter());
            // A thread that panicked while it held the queue has taken its item: the rest goes on.
            let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
            let (finished, is_finished) = channel::<()>();
            pool.in_place_scope(|scope| {
                for _ in 0..pool.current_num_threads() {
                    let (finished, next) = (finished.clone(), &next);
                    scope.spawn(move |_| {
                        let mut state = State::default();
                        while let Some(item) = next() {
                            work(item, &mut state);
                        }
                        drop(finished);
                    });
                }
                drop(finished);
                while is_finished.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                    look();
                }
            });
            look();
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
        pub(super) fn for_trees(&self) -> antumbra_trace::Pool<'_> {
            antumbra_trace::Pool::serial()
        }

        pub(super) fn each<I: Send, State: Default>(
            &self,
            items: Vec<I>,
            work: &(impl Fn(I, &mut State) + Sync),
            look: &mut dyn FnMut(),
        ) {
            serial(items, work, look);
        }
    }
}

/// One item after the other, on the calling thread.
fn serial<I, State: Default>(items: Vec<I>, work: &impl Fn(I, &mut State), look: &mut dyn FnMut()) {
    let mut state = State::default();
    for item in items {
        work(item, &mut state);
        look();
    }
}
