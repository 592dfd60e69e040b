//! The race against Embree 4 on one core: the same rays in turn, median of the ratios of processor time; against its
//! single rays and against the fastest of its single rays and packets.
//!
//! `ANTUMBRA_EMBREE=/path/to/libembree4.so cargo bench --profile demo -p antumbra-trace --bench embree [-- SCENE …]`
//! (the library is part of the Python wheel `embreex`). `ANTUMBRA_DETAIL` scales the scenes, `ANTUMBRA_MESHES`
//! names a folder of others (`given.rs`) to take in their place, `ANTUMBRA_RESULT` names a JSON file for the numbers,
//! `ANTUMBRA_SIMD` forces a level, `ANTUMBRA_WAYS` (together, packets, walls, alone) a way, `ANTUMBRA_CLASS` picks one class of rays,
//! `ANTUMBRA_THREADS` above 1 races the builds alone, with as many threads, by the clock on the wall.

mod clock;
mod given;
mod library;
mod packets;
mod race;
mod rays;
mod scenes;

use antumbra_trace::{BuildOptions, Geometry, Instance, Pool, SimdLevel, Triangles, Ways, World};
use clock::{now, use_wall_clock};
use library::Embree;

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

fn ways() -> Ways {
    match std::env::var("ANTUMBRA_WAYS").as_deref() {
        Ok("together") => Ways::Together,
        Ok("packets") => Ways::Packets,
        Ok("walls") => Ways::Walls,
        Ok("alone") => Ways::Alone,
        _ => Ways::Measured,
    }
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
        Ok(mut world) => {
            world.set_level(level());
            world.set_ways(ways());
            (world, seconds)
        }
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
        lines.push(race::measure(scene.name, world, &peers, &class));
    }
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
