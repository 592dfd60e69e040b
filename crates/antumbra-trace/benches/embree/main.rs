//! The race against Embree 4 on one core: the same rays, one after the other, in turn; median of the ratios of
//! processor time.
//!
//! `ANTUMBRA_EMBREE=/path/to/libembree4.so cargo bench --profile demo -p antumbra-trace --bench embree [-- SCENE …]`
//! (the library is part of the Python wheel `embreex`). `ANTUMBRA_DETAIL` scales the scenes, `ANTUMBRA_RESULT` names a
//! JSON file for the numbers, `ANTUMBRA_SIMD` forces a level, `ANTUMBRA_CLASS` picks one class of rays.

mod library;
mod rays;
mod scenes;

use antumbra_trace::{
    Bits, BuildOptions, Geometry, Hits, Instance, Pool, SimdLevel, Triangles, Visibility, World,
};
use library::{Embree, Scene as Peer, now};
use rays::Class;

const ROUNDS: usize = 7;

fn main() {
    let Ok(path) = std::env::var("ANTUMBRA_EMBREE") else {
        println!("skipped: ANTUMBRA_EMBREE does not name libembree4.so (see the head of this file)");
        return;
    };
    let Some(embree) = Embree::load(&path, 1) else {
        println!("skipped: {path} is no Embree 4");
        return;
    };
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let detail = std::env::var("ANTUMBRA_DETAIL").ok().and_then(|v| v.parse().ok()).unwrap_or(1.0);
    let mut lines = Vec::new();
    for scene in scenes::all(detail) {
        if wanted.is_empty() || wanted.iter().any(|w| w == scene.name) {
            race(&embree, &scene, &mut lines);
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
fn build(mesh: &Triangles) -> (World, f64) {
    let geometries = vec![Geometry::Triangles(std::sync::Arc::new(mesh.clone()))];
    let instance = Instance { geometry: 0, transform: None, masked: false };
    let start = now();
    let world = World::build(geometries, vec![instance], &BuildOptions::default(), Pool::serial());
    let seconds = now() - start;
    match world {
        Ok(world) => (world.with_level(level()), seconds),
        Err(error) => panic!("a scene of the race is unsound: {error}"),
    }
}

fn race(embree: &Embree, scene: &scenes::Scene, lines: &mut Vec<String>) {
    let n = scene.mesh.indices.len();
    println!("\n{}: {n} triangles", scene.name);
    let mut seconds = [Vec::new(), Vec::new(), Vec::new()];
    let mut bytes = [0, 0, 0];
    let rounds = if n > 100_000 { 3 } else { ROUNDS };
    for _ in 0..rounds {
        let (world, ours) = build(&scene.mesh);
        seconds[0].push(ours);
        bytes[0] = world.stats().bytes;
        for (k, robust) in [(1, false), (2, true)] {
            let peer = embree.scene(&scene.mesh, robust);
            seconds[k].push(peer.seconds);
            bytes[k] = peer.bytes;
        }
    }
    let [ours, high, robust] = seconds.map(|s| median(&s));
    let per = bytes.map(|b| b as f64 / n as f64);
    println!(
        "  build, 1 thread: ours {ours:.3} s, Embree HIGH {high:.3} s ({:.2}×), robust {robust:.3} s ({:.2}×)",
        ours / high,
        ours / robust
    );
    println!("  bytes/triangle: ours {:.1}, Embree HIGH {:.1}, robust {:.1}", per[0], per[1], per[2]);
    lines.push(format!(
        "  {{\"scene\": \"{}\", \"triangles\": {n}, \"build_seconds\": [{ours:.4}, {high:.4}, {robust:.4}], \
         \"bytes_per_triangle\": [{:.2}, {:.2}, {:.2}]}}",
        scene.name, per[0], per[1], per[2]
    ));
    let world = build(&scene.mesh).0;
    let peers = [embree.scene(&scene.mesh, false), embree.scene(&scene.mesh, true)];
    let only = std::env::var("ANTUMBRA_CLASS").unwrap_or_default();
    for class in rays::classes(scene, &world).into_iter().filter(|c| only.is_empty() || c.name == only) {
        lines.push(measure(scene.name, &world, &peers, &class));
    }
}

/// Ours and both peers in turn on one class.
fn measure(scene: &str, world: &World, peers: &[Peer<'_>; 2], class: &Class) -> String {
    let asked = class.asked.as_segments();
    let n = asked.len();
    let (mut bits, mut hits) = (Bits::default(), Hits::default());
    let (mut blocked, mut prims) = (vec![false; n], vec![0u32; n]);
    let mut ours = Vec::new();
    let mut ratios = [Vec::new(), Vec::new()];
    let mut differ = [0, 0];
    for round in 0..=ROUNDS {
        let time = timed(|| {
            if class.nearest { world.nearest(asked, &mut hits) } else { world.occluded(asked, &mut bits) }
        });
        for (k, peer) in peers.iter().enumerate() {
            let theirs = timed(|| {
                if class.nearest {
                    peer.nearest(&asked, &mut prims);
                } else {
                    peer.occluded(&asked, &mut blocked);
                }
            });
            differ[k] = (0..n)
                .filter(|&i| if class.nearest { hits.prim[i] != prims[i] } else { bits.get(i) != blocked[i] })
                .count();
            if round > 0 {
                ratios[k].push(theirs / time);
            }
        }
        if round > 0 {
            ours.push(n as f64 / time / 1e6);
        }
    }
    let rate = median(&ours);
    let share = if class.nearest { 0.0 } else { bits.count() as f64 / n as f64 };
    let [a, b] = [0, 1].map(|k| (median(&ratios[k]), spread(&ratios[k])));
    println!(
        "  {:<15} {n:>7} rays, {:>3.0} % blocked: {rate:6.2} Mray/s; Embree ×{:.2} ({:.2}–{:.2}), robust ×{:.2} \
         ({:.2}–{:.2}); answers differ {} / {}",
        class.name,
        100.0 * share,
        a.0,
        a.1.0,
        a.1.1,
        b.0,
        b.1.0,
        b.1.1,
        differ[0],
        differ[1]
    );
    format!(
        "  {{\"scene\": \"{scene}\", \"class\": \"{}\", \"rays\": {n}, \"mrays_per_second\": {rate:.3}, \
         \"speed_over_embree\": {:.3}, \"speed_over_embree_robust\": {:.3}, \"spread\": [{:.3}, {:.3}, {:.3}, {:.3}], \
         \"answers_differ\": [{}, {}]}}",
        class.name, a.0, b.0, a.1.0, a.1.1, b.1.0, b.1.1, differ[0], differ[1]
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
