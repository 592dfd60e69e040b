//! The race against Embree 4 on one core: the same rays, one after the other, in turn; median of the ratios of
//! processor time.
//!
//! `ANTUMBRA_EMBREE=/path/to/libembree4.so cargo bench --profile demo -p antumbra-trace --bench embree [-- SCENE …]`
//! (the library is part of the Python wheel `embreex`). `ANTUMBRA_DETAIL` scales the scenes, `ANTUMBRA_MESHES`
//! names a folder of others (`given.rs`) to take in their place, `ANTUMBRA_RESULT` names a JSON file for the numbers,
//! `ANTUMBRA_SIMD` forces a level, `ANTUMBRA_CLASS` picks one class of rays,
//! `ANTUMBRA_THREADS` above 1 races the builds alone, with as many threads, by the clock on the wall.

mod given;
mod library;
mod rays;
mod scenes;

use antumbra_trace::{
    Bits, BuildOptions, Geometry, Hits, Instance, NO_PRIM, Pool, SimdLevel, Triangles, Visibility, Work,
    World,
};
use library::{Embree, Scene as Peer, now, use_wall_clock};
use rays::Class;

const ROUNDS: usize = 7;

fn main() {
    let Ok(path) = std::env::var("ANTUMBRA_EMBREE") else {
        println!("skipped: ANTUMBRA_EMBREE does not name libembree4.so (see the head of this file)");
        return;
    };
    let threads = std::env::var("ANTUMBRA_THREADS").ok().and_then(|v| v.parse().ok()).unwrap_or(1);
    let pool =
        (threads > 1).then(|| rayon::ThreadPoolBuilder::new().num_threads(threads).build().ok()).flatten();
    if pool.is_some() {
        use_wall_clock();
    }
    let Some(embree) = Embree::load(&path, threads) else {
        println!("skipped: {path} is no Embree 4");
        return;
    };
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let detail = std::env::var("ANTUMBRA_DETAIL").ok().and_then(|v| v.parse().ok()).unwrap_or(1.0);
    let mut lines = Vec::new();
    let scenes = match std::env::var_os("ANTUMBRA_MESHES") {
        Some(folder) => given::all(folder.as_ref()),
        None => scenes::all(detail),
    };
    for scene in scenes {
        if wanted.is_empty() || wanted.iter().any(|w| w == scene.name) {
            let mesh = &scene.mesh;
            build_race(&embree, &scene, pool.as_ref(), &mut lines);
            if pool.is_none() {
                race(&embree, &scene, &build(mesh, None).0, &mut lines);
            }
        }
    }
    if let Ok(file) = std::env::var("ANTUMBRA_RESULT") {
        let text = format!("[\n{}\n]\n", lines.join(",\n"));
        if let Err(error) = std::fs::write(&file, text) {
            eprintln!("{file}: {error}");
        }
    }
}

fn level() -> SimdLevel {
    let name = std::env::var("ANTUMBRA_SIMD").unwrap_or_default();
    SimdLevel::ALL.into_iter().find(|l| l.name() == name).unwrap_or_default()
}

/// Builds and its time [s].
fn build(mesh: &Triangles, pool: Option<&rayon::ThreadPool>) -> (World, f64) {
    let geometries = vec![Geometry::Triangles(std::sync::Arc::new(mesh.clone()))];
    let instance = Instance { geometry: 0, transform: None, masked: false };
    let start = now();
    let world = World::build(
        geometries,
        vec![instance],
        &BuildOptions::default(),
        pool.map_or(Pool::serial(), Pool::from),
    );
    let seconds = now() - start;
    match world {
        Ok(world) => (world.with_level(level()), seconds),
        Err(error) => panic!("a scene of the race is unsound: {error}"),
    }
}

/// One class, if only that is wanted.
fn only() -> String {
    std::env::var("ANTUMBRA_CLASS").unwrap_or_default()
}

/// Time and memory of both builders in turn.
fn build_race(
    embree: &Embree,
    scene: &scenes::Scene,
    pool: Option<&rayon::ThreadPool>,
    lines: &mut Vec<String>,
) {
    let n = scene.mesh.indices.len();
    println!("\n{}: {n} triangles", scene.name);
    let mut seconds = [Vec::new(), Vec::new(), Vec::new()];
    let mut bytes = [0, 0, 0];
    let rounds = match n {
        _ if !only().is_empty() => 1,
        0..100_000 => ROUNDS,
        _ => 5,
    };
    for _ in 0..rounds {
        let (world, ours) = build(&scene.mesh, pool);
        seconds[0].push(ours);
        bytes[0] = world.stats().bytes;
        for (k, robust) in [(1, false), (2, true)] {
            let peer = embree.scene(&scene.mesh, robust);
            seconds[k].push(peer.seconds);
            bytes[k] = peer.bytes;
        }
    }
    let [ours, high, robust] = seconds.each_ref().map(|s| median(s));
    let per = bytes.map(|b| b as f64 / n as f64);
    let threads = pool.map_or(1, rayon::ThreadPool::current_num_threads);
    println!(
        "  build, {threads} thread(s): ours {ours:.3} s, Embree HIGH {high:.3} s ({:.2}×), robust {robust:.3} s ({:.2}×)",
        ours / high,
        ours / robust
    );
    println!("  bytes/triangle: ours {:.1}, Embree HIGH {:.1}, robust {:.1}", per[0], per[1], per[2]);
    lines.push(format!(
        "  {{\"scene\": \"{}\", \"triangles\": {n}, \"threads\": {threads}, \"build_seconds\": {seconds:?}, \
         \"bytes_per_triangle\": [{:.2}, {:.2}, {:.2}]}}",
        scene.name, per[0], per[1], per[2]
    ));
}

/// All classes of rays of a scene.
fn race(embree: &Embree, scene: &scenes::Scene, world: &World, lines: &mut Vec<String>) {
    let only = only();
    let peers = [embree.scene(&scene.mesh, false), embree.scene(&scene.mesh, true)];
    for class in rays::classes(scene, world).into_iter().filter(|c| only.is_empty() || c.name == only) {
        lines.push(measure(scene.name, world, &peers, &class));
    }
}

/// What one class took: ratios against both peers, their answers, our rate and work.
struct Result {
    /// Peers' time over ours, by round: default, robust.
    ratios: [Vec<f64>; 2],
    /// Our rate by round [Mray/s].
    rates: Vec<f64>,
    /// Answers in which they differ from ours.
    differ: [usize; 2],
    /// Share of blocked entries.
    blocked: f64,
    /// Boxes and primitives that an entry visits in our tree.
    work: [f64; 2],
}

/// Ours and both peers in turn on one class.
fn run(world: &World, peers: &[Peer<'_>; 2], class: &Class) -> Result {
    let asked = class.asked.as_segments();
    let n = asked.len();
    let (mut bits, mut hits) = (Bits::default(), Hits::default());
    let (mut blocked, mut prims) = (vec![false; n], vec![(0u32, 0f32); n]);
    let mut out =
        Result { ratios: Default::default(), rates: vec![], differ: [0; 2], blocked: 0.0, work: [0.0; 2] };
    for round in 0..=ROUNDS {
        let ours = timed(|| match class.nearest {
            true => world.nearest(asked, &mut hits),
            false => world.occluded(asked, &mut bits),
        });
        for (k, peer) in peers.iter().enumerate() {
            let theirs = timed(|| match class.nearest {
                true => peer.nearest(&asked, &mut prims),
                false => peer.occluded(&asked, &mut blocked),
            });
            // Two triangles may lie on each other: another one at the same t is no other answer.
            let other = |i: usize| {
                let (prim, t) = (prims[i].0, f64::from(prims[i].1));
                let far = (hits.t[i] - t).abs() > 1e-5 * t;
                hits.prim[i] != prim && (far || hits.prim[i] == NO_PRIM || prim == NO_PRIM)
            };
            let differs = |i: &usize| if class.nearest { other(*i) } else { bits.get(*i) != blocked[*i] };
            out.differ[k] = (0..n).filter(differs).count();
            if round > 0 {
                out.ratios[k].push(theirs / ours);
            }
        }
        if round > 0 {
            out.rates.push(n as f64 / ours / 1e6);
        }
    }
    let mut work = Vec::new();
    if class.nearest {
        world.nearest_counted(asked, &mut hits, &mut work);
    } else {
        world.occluded_counted(asked, &mut bits, &mut work);
        out.blocked = bits.count() as f64 / n as f64;
    }
    let mean = |of: fn(&Work) -> u32| work.iter().map(|w| f64::from(of(w))).sum::<f64>() / n as f64;
    out.work = [mean(|w| w.boxes), mean(|w| w.primitives)];
    out
}

/// Prints a class and says it in JSON.
fn measure(scene: &str, world: &World, peers: &[Peer<'_>; 2], class: &Class) -> String {
    let result = run(world, peers, class);
    let (n, rate) = (class.asked.len(), median(&result.rates));
    let [a, b] = [0, 1].map(|k| (median(&result.ratios[k]), spread(&result.ratios[k])));
    let ([boxes, primitives], [c, d]) = (result.work, result.differ);
    println!(
        "  {:<15} {n:>7} rays, {:>3.0} % blocked: {rate:6.2} Mray/s; Embree ×{:.2} ({:.2}–{:.2}), robust ×{:.2} \
         ({:.2}–{:.2}); answers differ {c} / {d}; {boxes:.0} boxes, {primitives:.1} primitives",
        class.name,
        100.0 * result.blocked,
        a.0,
        a.1.0,
        a.1.1,
        b.0,
        b.1.0,
        b.1.1
    );
    format!(
        "  {{\"scene\": \"{scene}\", \"class\": \"{}\", \"rays\": {n}, \"mrays_per_second\": {rate:.3}, \
         \"speed_over_embree\": {:.3}, \"speed_over_embree_robust\": {:.3}, \
         \"spread\": [{:.3}, {:.3}, {:.3}, {:.3}], \"answers_differ\": [{c}, {d}], \
         \"boxes\": {boxes:.2}, \"primitives\": {primitives:.2}}}",
        class.name, a.0, b.0, a.1.0, a.1.1, b.1.0, b.1.1
    )
}

fn timed(work: impl FnOnce()) -> f64 {
    let start = now();
    work();
    now() - start
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}

fn spread(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, 0.0), |(lo, hi), &v| (lo.min(v), hi.max(v)))
}
