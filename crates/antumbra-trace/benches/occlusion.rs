//! Masks of occlusion: both methods of Laine and Karras beside single rays, packets and the batch, by radius, by number of
//! directions, and by how many triangles a receiver has in range. Processor time of one thread, in turn.
//!
//! `cargo bench --profile demo -p antumbra-trace --bench occlusion [-- SCENE …]`; `ANTUMBRA_MESHES` names a folder of
//! scenes (`embree/given.rs`), `ANTUMBRA_RESULT` a JSON file for the numbers, `ANTUMBRA_ROUNDS` how often each is timed.

#[path = "embree/clock.rs"]
#[allow(dead_code, reason = "the race against Embree uses more of it")]
mod clock;
#[path = "embree/given.rs"]
mod given;
#[allow(dead_code, reason = "the race against Embree uses more of it")]
#[path = "embree/rays.rs"]
mod rays;
#[path = "embree/scenes.rs"]
mod scenes;

use std::sync::Arc;

use antumbra_trace::occlusion::{Directions, Method, OcclusionWork, Receiver};
use antumbra_trace::start::start_on_triangle;
use antumbra_trace::{
    Bits, BuildOptions, Geometry, Hits, Instance, NO_PRIM, Pool, SegmentBuffer, Visibility, Ways, World,
};
use clock::now;
use scenes::Scene;

/// Radii as a part of the diagonal of the scene.
const RADII: [f32; 3] = [0.01, 0.03, 0.1];
const COUNTS: [usize; 3] = [64, 256, 1024];
/// Most triangles in range of the receivers that are timed together; the last has no end.
const BINS: [u64; 7] = [2, 8, 32, 128, 512, 2048, u64::MAX];
/// Triangles in range from which on a radius is left out: rays have won long before.
const MOST: f64 = 8000.0;
/// Receivers that are timed, and the most of a bin.
const RECEIVERS: usize = 2048;
const OF_BIN: usize = 256;

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let all = match std::env::var_os("ANTUMBRA_MESHES") {
        Some(folder) => given::all(folder.as_ref()),
        None => scenes::all(1.0),
    };
    let mut lines = Vec::new();
    for scene in all.iter().filter(|s| wanted.is_empty() || wanted.iter().any(|w| w == s.name)) {
        let world = build(scene);
        let receivers = receivers(scene, &world);
        let (low, high) = world.bounds();
        let diagonal = (0..3).map(|k| (high[k] - low[k]) * (high[k] - low[k])).sum::<f32>().sqrt();
        println!("\n{}: {} triangles, {} receivers", scene.name, scene.mesh.indices.len(), receivers.len());
        for radius in RADII.into_iter().take_while(|r| in_range(&world, &receivers, r * diagonal) < MOST) {
            for count in COUNTS {
                let row = Row { scene: scene.name, radius, count, most: 0 };
                lines.push(race(&row, &world, &receivers, &directions(count, radius * diagonal)));
            }
            by_range(scene, &world, &receivers, (radius, diagonal), &mut lines);
        }
    }
    if let Ok(file) = std::env::var("ANTUMBRA_RESULT") {
        let text = format!("[\n{}\n]\n", lines.join(",\n"));
        if let Err(error) = std::fs::write(&file, text) {
            eprintln!("{file}: {error}");
        }
    }
}

fn directions(count: usize, radius: f32) -> Directions {
    Directions::new(count, |_| radius).unwrap_or_else(|error| panic!("{error}"))
}

fn build(scene: &Scene) -> World {
    let geometries = vec![Geometry::Triangles(Arc::new(scene.mesh.clone()))];
    let instance = Instance { geometry: 0, transform: None, masked: false };
    World::build(geometries, vec![instance], &BuildOptions::default(), Pool::serial())
        .unwrap_or_else(|error| panic!("a scene of the race is unsound: {error}"))
}

/// Points that the camera sees, in tiles of 8 × 8 pixels spread over the picture, with their exact starts.
fn receivers(scene: &Scene, world: &World) -> Vec<Receiver> {
    let (camera, mut hits) = (rays::camera(scene), Hits::default());
    let asked = camera.as_segments();
    world.nearest(asked, &mut hits);
    let receiver = |i: usize| {
        let corners = scene.mesh.corners(hits.prim[i] as usize).map(|c| c.map(f64::from));
        let (o, d) = (asked.origin_at(i), asked.end_at(i));
        let p = [0, 1, 2].map(|k| f64::from(o[k]) + hits.t[i] * f64::from(d[k]));
        let n = normal(corners, d.map(f64::from));
        Receiver::new(start_on_triangle(p, n, corners), hits.prim[i], 0, n, 0.0)
    };
    // Odd: a row of the picture has 64 tiles.
    let step = (asked.len() / RECEIVERS) | 1;
    let tiles = (0..asked.len() / 64).step_by(step).flat_map(|tile| 64 * tile..64 * tile + 64);
    tiles.filter(|i| hits.prim[*i] != NO_PRIM).map(receiver).collect()
}

/// The unit normal against a direction.
fn normal([a, b, c]: [[f64; 3]; 3], d: [f64; 3]) -> [f64; 3] {
    let (p, q) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    let n = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let length = dot(n, n).sqrt().copysign(-dot(n, d));
    n.map(|x| x / length)
}

/// What is timed together.
struct Row {
    scene: &'static str,
    radius: f32,
    count: usize,
    /// Most triangles in range, if receivers were chosen by them.
    most: u64,
}

/// The contestants: rays in four ways, then the two methods.
const NAMES: [&str; 6] = ["alone", "packets", "transposed", "batch", "occluders", "receivers"];

/// Prints and returns the rates [10⁶ directions/s] of all contestants; their bits are compared.
fn race(row: &Row, world: &World, receivers: &[Receiver], directions: &Directions) -> String {
    let rounds = std::env::var("ANTUMBRA_ROUNDS").ok().and_then(|v| v.parse().ok()).unwrap_or(3);
    let (mut rays, mut turned, mut bits) =
        (SegmentBuffer::default(), SegmentBuffer::default(), Bits::default());
    receivers.iter().for_each(|at| at.rays(directions, &mut rays));
    turned.pick(rays.as_segments(), &transposed(receivers.len(), directions.len()));
    let (mut world, mut words, mut work) = (world.clone(), Vec::new(), OcclusionWork::default());
    let (mut seconds, mut blocked) = ([const { Vec::new() }; 6], [0; 6]);
    for _ in 0..rounds {
        for (k, seconds) in seconds.iter_mut().enumerate() {
            let ways = [Ways::Alone, Ways::Packets, Ways::Packets, Ways::Measured];
            world.set_ways(ways.get(k).copied().unwrap_or(Ways::Measured));
            let start = now();
            match k {
                2 => world.occluded(turned.as_segments(), &mut bits),
                0 | 1 | 3 => world.occluded(rays.as_segments(), &mut bits),
                4 => work = world.occlusion_masks(receivers, directions, Method::Occluders, &mut words),
                _ => work = world.occlusion_masks(receivers, directions, Method::Receivers, &mut words),
            }
            seconds.push(now() - start);
            let ones = words.iter().map(|w: &u64| w.count_ones() as usize).sum();
            blocked[k] = if k < 4 { bits.count() } else { ones };
        }
    }
    assert_eq!(blocked, [blocked[0]; 6], "{}: the ways do not agree", row.scene);
    let rate = |s: &Vec<f64>| rays.len() as f64 / s.iter().copied().fold(f64::INFINITY, f64::min) / 1e6;
    let rates: Vec<String> = seconds.iter().map(|s| format!("{:.1}", rate(s))).collect();
    let per = |n: u64| n as f64 / receivers.len() as f64;
    let Row { scene, radius, count, most } = row;
    let (in_range, tested) = (per(work.in_range), per(work.tested) / *count as f64);
    let open = 1.0 - blocked[0] as f64 / rays.len() as f64;
    let named: Vec<String> =
        NAMES.iter().zip(&rates).map(|(name, rate)| format!("{name} {rate:>6}")).collect();
    println!(
        "  R {radius:<4} N {count:<4} {:>5} receivers, in range {in_range:>7.1}, tested {tested:>5.2}, open {:>3.0} %: {}",
        receivers.len(),
        100.0 * open,
        named.join(", ")
    );
    format!(
        "  {{\"scene\": \"{scene}\", \"radius\": {radius}, \"directions\": {count}, \"most\": {most}, \"receivers\": {}, \
         \"in_range\": {in_range:.2}, \"tested\": {tested:.3}, \"open\": {open:.4}, \"rates\": [{}]}}",
        receivers.len(),
        rates.join(", ")
    )
}

/// Every 16 rays are the same direction of 16 receivers.
fn transposed(receivers: usize, directions: usize) -> Vec<u32> {
    let order = (0..receivers).step_by(16).flat_map(|first| {
        let group = first..(first + 16).min(receivers);
        (0..directions).flat_map(move |i| group.clone().map(move |at| (at * directions + i) as u32))
    });
    order.collect()
}

/// Mean number of triangles in range, of some receivers.
fn in_range(world: &World, all: &[Receiver], radius: f32) -> f64 {
    let some: Vec<Receiver> = all.iter().step_by(32).copied().collect();
    let probe = directions(64, radius);
    let work = world.occlusion_masks(&some, &probe, Method::Receivers, &mut Vec::new());
    work.in_range as f64 / some.len().max(1) as f64
}

/// Receivers by the number of triangles in their range.
fn by_range(
    scene: &Scene,
    world: &World,
    all: &[Receiver],
    (radius, diagonal): (f32, f32),
    lines: &mut Vec<String>,
) {
    let (mut words, probe) = (Vec::new(), directions(64, radius * diagonal));
    let mut bins = [const { Vec::new() }; BINS.len()];
    for at in all {
        let work = world.occlusion_masks(std::slice::from_ref(at), &probe, Method::Receivers, &mut words);
        let bin = BINS.iter().position(|most| work.in_range <= *most).unwrap_or(BINS.len() - 1);
        bins[bin].push(*at);
    }
    for (bin, most) in bins.iter().zip(BINS).filter(|(bin, _)| bin.len() >= OF_BIN) {
        // Runs of neighbours, spread over the bin.
        let step = bin.len() / OF_BIN;
        let some: Vec<Receiver> = bin.chunks(16).step_by(step).flatten().copied().collect();
        for count in COUNTS {
            let row = Row { scene: scene.name, radius, count, most };
            lines.push(race(&row, world, &some, &directions(count, radius * diagonal)));
        }
    }
}
