//! Segments and rays that are hard: aimed at corners and edges, in planes and box faces, from afar, wrongly made.

use antumbra_trace::{NO_PRIM, SegmentBuffer, Triangles};

use crate::rng::{Rng, mix, to_f32, to_f64};

/// `n` questions about `mesh`, whose extent is about `scale` around `centre`. Triangles have the numbers from `base` on.
pub fn questions(
    r: &mut Rng,
    mesh: &Triangles,
    n: usize,
    scale: f64,
    centre: [f64; 3],
    base: u32,
) -> SegmentBuffer {
    let mut out = SegmentBuffer::default();
    for i in 0..n {
        let prims = [skip(r, mesh, base), skip(r, mesh, base)];
        let target = target(r, mesh);
        let origin = origin(r, mesh, target, scale, centre);
        let number = i as u32;
        match r.below(10) {
            0..4 => {
                // Beyond the target, at it, or short of it.
                let reach = [0.5, 1.0, 1.5, 2.0][r.below(4) as usize];
                let q = [0, 1, 2].map(|k| origin[k] + reach * (target[k] - origin[k]));
                out.push_segment(to_f32(origin), to_f32(q), prims[0], prims[1], number);
            }
            4..8 => {
                let length = r.signed_power(-6.0, 6.0).abs();
                let d = [0, 1, 2].map(|k| (target[k] - origin[k]) * length);
                let reach = [f32::INFINITY, 1.0, (1.0 / length) as f32, 1e30][r.below(4) as usize];
                out.push_ray(to_f32(origin), to_f32(d), reach, prims[0], number);
            }
            8 => {
                let mut d = [0.0f32; 3];
                d[r.below(3) as usize] = if r.below(2) == 0 { 1.0 } else { -1.0 };
                d[r.below(3) as usize] += [0.0, 1e-20, 1e-42][r.below(3) as usize];
                out.push_ray(to_f32(origin), d, f32::INFINITY, prims[0], number);
            }
            _ => strange(r, &mut out, to_f32(origin), to_f32(target), number),
        }
    }
    out
}

/// `n` bundles of 100 to 300 questions each that start in a small box and end in one, or go about the same way; with
/// runs of common origins, and now and then a strange one among them.
pub fn bundles(
    r: &mut Rng,
    mesh: &Triangles,
    n: usize,
    scale: f64,
    centre: [f64; 3],
    base: u32,
) -> SegmentBuffer {
    let mut out = SegmentBuffer::default();
    for _ in 0..n {
        let sizes = [0.0, 1e-7, 1e-3, 0.05, 0.5];
        let [from, to] = [0; 2].map(|_| scale * sizes[r.below(5) as usize]);
        let goal = target(r, mesh);
        let start = origin(r, mesh, goal, scale, centre);
        let beyond = [0.5, 1.0, 1.5, 2.0][r.below(4) as usize];
        let run = [1, 4, 16, 23][r.below(4) as usize];
        let kind = r.below(4);
        let near = |r: &mut Rng, p: [f64; 3], size: f64| {
            let e = r.cube(size);
            [0, 1, 2].map(|k| p[k] + e[k])
        };
        let mut p = start;
        for k in 0..100 + r.below(200) as usize {
            if k % run == 0 {
                p = near(r, start, from);
            }
            let (q, number) = (near(r, goal, to), out.len() as u32);
            let prims = [skip(r, mesh, base), skip(r, mesh, base)];
            let d = [0, 1, 2].map(|a| beyond * (q[a] - p[a]));
            match kind {
                _ if r.below(200) == 0 => strange(r, &mut out, to_f32(p), to_f32(q), number),
                0 | 1 => {
                    let q = [0, 1, 2].map(|a| p[a] + d[a]);
                    out.push_segment(to_f32(p), to_f32(q), prims[0], prims[1], number);
                }
                2 => out.push_ray(to_f32(p), to_f32(d), 1.0, prims[0], number),
                _ => out.push_ray(to_f32(p), to_f32(d), f32::INFINITY, prims[0], number),
            }
        }
    }
    out
}

/// Mostly no primitive, else one to skip.
fn skip(r: &mut Rng, mesh: &Triangles, base: u32) -> u32 {
    if r.below(3) > 0 { NO_PRIM } else { base + r.below(mesh.indices.len() as u64) as u32 }
}

/// A point of the mesh: corner, edge, face; by a nudge beside it.
fn target(r: &mut Rng, mesh: &Triangles) -> [f64; 3] {
    let c = mesh.corners(r.below(mesh.indices.len() as u64) as usize).map(to_f64);
    let p = match r.below(4) {
        0 => c[r.below(3) as usize],
        1 => mix([0.5, 0.5], [c[0], c[1]]),
        _ => mix(r.weights(), c),
    };
    if r.below(2) == 0 { p } else { p.map(|x| f64::from(r.nudge(x as f32))) }
}

/// Where a question starts.
fn origin(r: &mut Rng, mesh: &Triangles, target: [f64; 3], scale: f64, centre: [f64; 3]) -> [f64; 3] {
    let around = |r: &mut Rng, size: f64| {
        let p = r.cube(size * scale);
        [0, 1, 2].map(|k| centre[k] + p[k])
    };
    match r.below(8) {
        0 => to_f64(mesh.vertices[r.below(mesh.vertices.len() as u64) as usize]),
        // In a coordinate plane through the target: a zero component in the direction.
        1 | 2 => {
            let mut o = around(r, 2.0);
            let axis = r.below(3) as usize;
            o[axis] = target[axis];
            if r.below(2) == 0 {
                o[(axis + 1) % 3] = target[(axis + 1) % 3];
            }
            o
        }
        3 => around(r, 1000.0),
        4 => around(r, 1e12),
        _ => around(r, 1.5),
    }
}

/// What nobody should ask, but may.
fn strange(r: &mut Rng, out: &mut SegmentBuffer, p: [f32; 3], q: [f32; 3], number: u32) {
    let bad = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38, 1e-44, 0.0][r.below(6) as usize];
    let mut odd = p;
    odd[r.below(3) as usize] = bad;
    match r.below(6) {
        0 => out.push_segment(p, p, NO_PRIM, NO_PRIM, number),
        1 => out.push_segment(odd, q, NO_PRIM, NO_PRIM, number),
        2 => out.push_segment(p, odd, NO_PRIM, NO_PRIM, number),
        3 => out.push_ray(p, odd, f32::INFINITY, NO_PRIM, number),
        4 => out.push_ray(odd, q, 1.0, NO_PRIM, number),
        _ => out.push_ray(p, q, [f32::NAN, 0.0, -0.0, -2.0, 1e-45][r.below(5) as usize], NO_PRIM, number),
    }
}
