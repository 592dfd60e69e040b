//! One class of rays: ours and Embree's ways in turn. One warm-up round tries all of Embree's; its single rays and the
//! three fastest ways then run against ours.

use antumbra_trace::{Bits, Hits, NO_PRIM, SegmentBuffer, Segments, Visibility, Work, World};

use crate::library::Scene as Peer;
use crate::packets::Mode;
use crate::rays::Class;
use crate::{ROUNDS, median, spread, timed};

/// How many of the fastest ways run in every round.
const FASTEST: usize = 3;

/// What one class took.
#[derive(Default)]
struct Result {
    /// Peers' time over ours, by round: single rays default, single rays robust, the fastest way of the round.
    ratios: [Vec<f64>; 3],
    /// Our rate by round [Mray/s], and that of the fastest way.
    rates: [Vec<f64>; 2],
    /// Answers in which single rays differ from ours.
    differ: [usize; 2],
    /// The name of the way that was fastest most often.
    best: String,
    /// Share of blocked entries.
    blocked: f64,
    /// Boxes and primitives that an entry visits in our tree, walked alone.
    work: [f64; 2],
}

/// Prints a class and says it in JSON.
pub fn measure(scene: &str, world: &World, peers: &[Peer<'_>; 2], class: &Class) -> String {
    let result = if class.nearest { nearest(world, peers, class) } else { occluded(world, peers, class) };
    let (n, [rate, best_rate]) = (class.asked.len(), result.rates.each_ref().map(|r| median(r)));
    let [a, b, best] = result.ratios.each_ref().map(|r| (median(r), spread(r)));
    let ([boxes, primitives], [c, d]) = (result.work, result.differ);
    println!(
        "  {:<19} {n:>7} rays, {:>3.0} % blocked: {rate:6.2} Mray/s; Embree ×{:.2} ({:.2}–{:.2}), robust ×{:.2} \
         ({:.2}–{:.2}), best ×{:.2} ({:.2}–{:.2}) by {} at {best_rate:.2}; answers differ {c} / {d}; {boxes:.0} boxes, \
         {primitives:.1} primitives",
        class.name,
        100.0 * result.blocked,
        a.0,
        a.1.0,
        a.1.1,
        b.0,
        b.1.0,
        b.1.1,
        best.0,
        best.1.0,
        best.1.1,
        result.best
    );
    format!(
        "  {{\"scene\": \"{scene}\", \"class\": \"{}\", \"rays\": {n}, \"mrays_per_second\": {rate:.3}, \
         \"speed_over_embree\": {:.3}, \"speed_over_embree_robust\": {:.3}, \"speed_over_best\": {:.3}, \
         \"best_mode\": \"{}\", \"best_mrays_per_second\": {best_rate:.3}, \
         \"spread\": [{:.3}, {:.3}, {:.3}, {:.3}, {:.3}, {:.3}], \"answers_differ\": [{c}, {d}], \
         \"blocked\": {:.4}, \"boxes\": {boxes:.2}, \"primitives\": {primitives:.2}}}",
        class.name,
        a.0,
        b.0,
        best.0,
        result.best,
        a.1.0,
        a.1.1,
        b.1.0,
        b.1.1,
        best.1.0,
        best.1.1,
        result.blocked
    )
}

/// A way to ask Embree: its time by round.
struct Way {
    mode: Mode,
    seconds: Vec<f64>,
}

/// Any hit.
fn occluded(world: &World, peers: &[Peer<'_>; 2], class: &Class) -> Result {
    let asked = class.asked.as_segments();
    let mut across = SegmentBuffer::default();
    across.pick(asked, &class.transposed());
    let n = asked.len();
    let (mut bits, mut blocked) = (Bits::default(), vec![false; n]);
    let mut out = Result::default();
    let race = |way: &mut Way, blocked: &mut [bool]| {
        let rays = if way.mode.transposed { across.as_segments() } else { asked };
        way.seconds.push(timed(|| peers[usize::from(way.mode.robust)].occluded(&rays, way.mode, blocked)));
    };
    world.occluded(asked, &mut bits);
    let mut ways: Vec<Way> = Mode::all(class.strata > 1)
        .into_iter()
        .map(|mode| Way { mode, seconds: Vec::new() })
        .filter(|way| way.mode.width > 1 || !way.mode.transposed)
        .collect();
    for way in &mut ways {
        race(way, &mut blocked);
        if way.mode.width == 1 {
            out.differ[usize::from(way.mode.robust)] = (0..n).filter(|&i| bits.get(i) != blocked[i]).count();
        }
    }
    let single = |way: &Way| way.mode.width == 1;
    let warm = |way: &mut Way| std::mem::take(&mut way.seconds)[0];
    let mut timed_once: Vec<(f64, Way)> = ways.into_iter().map(|mut way| (warm(&mut way), way)).collect();
    timed_once.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut ways: Vec<Way> = timed_once
        .into_iter()
        .enumerate()
        .filter(|(rank, (_, way))| *rank < FASTEST || single(way))
        .map(|(_, (_, way))| way)
        .collect();
    for _ in 0..ROUNDS {
        let ours = timed(|| world.occluded(asked, &mut bits));
        for way in &mut ways {
            race(way, &mut blocked);
        }
        let last = |way: &Way| way.seconds.last().copied().unwrap_or(f64::INFINITY);
        for way in ways.iter().filter(|way| single(way)) {
            out.ratios[usize::from(way.mode.robust)].push(last(way) / ours);
        }
        let best = ways.iter().map(last).fold(f64::INFINITY, f64::min);
        out.ratios[2].push(best / ours);
        out.rates[0].push(n as f64 / ours / 1e6);
        out.rates[1].push(n as f64 / best / 1e6);
    }
    let fastest = ways.iter().min_by(|a, b| median(&a.seconds).total_cmp(&median(&b.seconds)));
    out.best = fastest.map_or(String::new(), |way| way.mode.name());
    out.blocked = bits.count() as f64 / n as f64;
    let few = few(&class.asked);
    let mut work = Vec::new();
    world.occluded_counted(few.as_segments(), &mut bits, &mut work);
    out.work = mean(&work);
    out
}

/// Closest hit: single rays only.
fn nearest(world: &World, peers: &[Peer<'_>; 2], class: &Class) -> Result {
    let asked: Segments<'_> = class.asked.as_segments();
    let n = asked.len();
    let (mut hits, mut prims) = (Hits::default(), vec![(0u32, 0f32); n]);
    let mut out = Result { best: "1".into(), ..Result::default() };
    for round in 0..=ROUNDS {
        let ours = timed(|| world.nearest(asked, &mut hits));
        let mut best = f64::INFINITY;
        for (k, peer) in peers.iter().enumerate() {
            let theirs = timed(|| peer.nearest(&asked, &mut prims));
            // Two triangles may lie on each other: another one at the same t is no other answer.
            let other = |i: &usize| {
                let (prim, t) = (prims[*i].0, f64::from(prims[*i].1));
                let far = (hits.t[*i] - t).abs() > 1e-5 * t;
                hits.prim[*i] != prim && (far || hits.prim[*i] == NO_PRIM || prim == NO_PRIM)
            };
            out.differ[k] = (0..n).filter(other).count();
            best = best.min(theirs);
            if round > 0 {
                out.ratios[k].push(theirs / ours);
            }
        }
        if round > 0 {
            out.ratios[2].push(best / ours);
            out.rates[0].push(n as f64 / ours / 1e6);
            out.rates[1].push(n as f64 / best / 1e6);
        }
    }
    let few = few(&class.asked);
    let mut work = Vec::new();
    world.nearest_counted(few.as_segments(), &mut hits, &mut work);
    out.work = mean(&work);
    out
}

/// Every 16th entry: counting is slow.
fn few(asked: &SegmentBuffer) -> SegmentBuffer {
    let mut out = SegmentBuffer::default();
    out.pick(asked.as_segments(), &(0..asked.len() as u32).step_by(16).collect::<Vec<_>>());
    out
}

fn mean(work: &[Work]) -> [f64; 2] {
    let mean = |of: fn(&Work) -> u32| work.iter().map(|w| f64::from(of(w))).sum::<f64>() / work.len() as f64;
    [mean(|w| w.boxes), mean(|w| w.primitives)]
}
