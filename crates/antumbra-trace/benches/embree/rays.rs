//! The questions of the race: made once from our own camera hits, asked of both.

use antumbra_trace::{Hits, NO_PRIM, SegmentBuffer, Triangles, Visibility, World};

use crate::scenes::{Rng, Scene};

/// A class of questions about one scene.
pub struct Class {
    pub name: &'static str,
    /// Closest hit, not any hit.
    pub nearest: bool,
    pub asked: SegmentBuffer,
}

type V = [f32; 3];

fn sub(a: V, b: V) -> V {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: V) -> V {
    let length = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt();
    a.map(|x| x / length)
}

/// A point to be lit and the normal towards the eye.
struct Receiver {
    p: V,
    n: V,
}

/// Camera rays in rows of tiles of 8 × 8.
fn camera(scene: &Scene) -> SegmentBuffer {
    let [eye, at] = scene.view;
    let forward = unit(sub(at, eye));
    let right = unit(cross(forward, [0.0, 1.0, 0.0]));
    let up = cross(right, forward);
    let n = scene.rows;
    let mut out = SegmentBuffer::default();
    for tile in 0..(n / 8) * (n / 8) {
        for k in 0..64 {
            let (x, y) = (tile % (n / 8) * 8 + k % 8, tile / (n / 8) * 8 + k / 8);
            let (u, v) = ((x as f32 + 0.5) / n as f32 - 0.5, 0.5 - (y as f32 + 0.5) / n as f32);
            let d = [0, 1, 2].map(|k| forward[k] + 1.2 * (u * right[k] + v * up[k]));
            out.push_ray(eye, d, f32::INFINITY, NO_PRIM, k as u32);
        }
    }
    out
}

fn receivers(scene: &Scene, world: &World, rays: &SegmentBuffer) -> Vec<Receiver> {
    let mut hits = Hits::default();
    world.nearest(rays.as_segments(), &mut hits);
    let asked = rays.as_segments();
    let lift = 2e-6 * scene.mesh.vertices.iter().flatten().fold(0f32, |m, x| m.max(x.abs()));
    let hit = (0..hits.len()).filter(|&i| hits.prim[i] != NO_PRIM);
    hit.map(|i| receiver(&scene.mesh, hits.prim[i], hits.t[i], asked.origin_at(i), asked.end_at(i), lift))
        .collect()
}

fn receiver(mesh: &Triangles, prim: u32, t: f64, o: V, d: V, lift: f32) -> Receiver {
    let [a, b, c] = mesh.corners(prim as usize);
    let n = unit(cross(sub(b, a), sub(c, a)));
    let facing = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
    let n = if facing > 0.0 { n.map(|x| -x) } else { n };
    Receiver { p: [0, 1, 2].map(|k| o[k] + t as f32 * d[k] + n[k] * lift), n }
}

/// A direction about `n` with a cosine density.
fn cosine(n: V, r: &mut Rng) -> V {
    let (u, phi) = (r.unit(), r.unit() * std::f32::consts::TAU);
    let s = u.sqrt();
    let t = unit(cross(n, if n[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }));
    let b = cross(n, t);
    let (x, y, z) = (s * libm::cosf(phi), s * libm::sinf(phi), (1.0 - u).max(1e-6).sqrt());
    [0, 1, 2].map(|k| x * t[k] + y * b[k] + z * n[k])
}

/// All classes of a scene.
pub fn classes(scene: &Scene, world: &World) -> Vec<Class> {
    let camera = camera(scene);
    let receivers = receivers(scene, world, &camera);
    let mut r = Rng(11);
    let (mut area, mut ambient, mut near, mut sun, mut bounce) = Default::default();
    let all: &mut [&mut SegmentBuffer; 5] = &mut [&mut area, &mut ambient, &mut near, &mut sun, &mut bounce];
    let (centre, half) = scene.light;
    for (i, at) in receivers.iter().enumerate() {
        let q = [centre[0] + r.range(-half, half), centre[1], centre[2] + r.range(-half, half)];
        all[0].push_ray(at.p, sub(q, at.p), 1.0, NO_PRIM, i as u32);
        all[1].push_ray(at.p, cosine(at.n, &mut r), f32::INFINITY, NO_PRIM, i as u32);
        all[2].push_ray(at.p, cosine(at.n, &mut r), half, NO_PRIM, i as u32);
        all[3].push_ray(at.p, [0.4, 0.8, 0.3], f32::INFINITY, NO_PRIM, i as u32);
        all[4].push_ray(at.p, cosine(at.n, &mut r), f32::INFINITY, NO_PRIM, i as u32);
    }
    let class = |name, nearest, asked| Class { name, nearest, asked };
    vec![
        class("area light", false, area),
        class("ambient", false, ambient),
        class("ambient, short", false, near),
        class("sun", false, sun),
        class("camera", true, camera),
        class("bounce", true, bounce),
    ]
}
