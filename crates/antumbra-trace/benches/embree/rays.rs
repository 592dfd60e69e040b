//! The questions of the race: made once from our own camera hits, asked of both.

use antumbra_trace::{Hits, NO_PRIM, SegmentBuffer, Triangles, Visibility, World};

use crate::scenes::{Rng, Scene};

/// A class of questions about one scene.
pub struct Class {
    pub name: &'static str,
    /// Closest hit, not any hit.
    pub nearest: bool,
    /// Rays of one receiver, side by side.
    pub strata: usize,
    pub asked: SegmentBuffer,
}

/// Strata of a receiver with many rays: 4 × 4.
const STRATA: usize = 16;

impl Class {
    /// The order in which every 16 entries are the same stratum of 16 receivers; entries that fill no such group stay.
    pub fn transposed(&self) -> Vec<u32> {
        let (n, group) = (self.asked.len(), 16 * self.strata);
        (0..n)
            .map(|i| {
                let (first, k) = (i / group * group, i % group);
                let whole = first + group <= n;
                (if whole { first + k % 16 * self.strata + k / 16 } else { i }) as u32
            })
            .collect()
    }
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

/// Camera rays in rows of tiles of 8 × 8, each of four blocks of 4 × 4.
pub fn camera(scene: &Scene) -> SegmentBuffer {
    let [eye, at] = scene.view;
    let forward = unit(sub(at, eye));
    let right = unit(cross(forward, [0.0, 1.0, 0.0]));
    let up = cross(right, forward);
    let n = scene.rows;
    let mut out = SegmentBuffer::default();
    for tile in 0..(n / 8) * (n / 8) {
        for k in 0..64 {
            let (i, j) = (k / 16 % 2 * 4 + k % 4, k / 32 * 4 + k / 4 % 4);
            let (x, y) = (tile % (n / 8) * 8 + i, tile / (n / 8) * 8 + j);
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

/// A direction about `n` with a cosine density, from stratum k of 4 × 4.
fn cosine(n: V, k: usize, r: &mut Rng) -> V {
    let [u, v] = stratum(k, r);
    let (s, phi) = (u.sqrt(), v * std::f32::consts::TAU);
    let t = unit(cross(n, if n[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] }));
    let b = cross(n, t);
    let (x, y, z) = (s * libm::cosf(phi), s * libm::sinf(phi), (1.0 - u).max(1e-6).sqrt());
    [0, 1, 2].map(|k| x * t[k] + y * b[k] + z * n[k])
}

/// A point of the unit square in stratum k of 4 × 4.
fn stratum(k: usize, r: &mut Rng) -> [f32; 2] {
    [(k % 4) as f32, (k / 4 % 4) as f32].map(|cell| (cell + r.unit()) / 4.0)
}

/// All classes of a scene; those with many rays a receiver ask for every fourth tile.
pub fn classes(scene: &Scene, world: &World) -> Vec<Class> {
    let camera = camera(scene);
    let receivers = receivers(scene, world, &camera);
    let few: Vec<&Receiver> = receivers.chunks(64).step_by(4).flatten().collect();
    let all: Vec<&Receiver> = receivers.iter().collect();
    let mut r = Rng(11);
    let (centre, half) = scene.light;
    let infinity = f32::INFINITY;
    // Beside the centre, which may be a point of an edge of the scene's own lamp: every ray would end there exactly.
    let point = [centre[0] + 0.4 * half, centre[1] - 0.5 * half, centre[2] + 0.2 * half];
    let mut light = |at: &Receiver, k: usize, r: &mut Rng| {
        let [u, v] = stratum(k, r);
        let q = [centre[0] + half * (2.0 * u - 1.0), centre[1], centre[2] + half * (2.0 * v - 1.0)];
        (sub(q, at.p), 1.0)
    };
    let mut made =
        |name, of: &[&Receiver], strata, ray: &mut dyn FnMut(&Receiver, usize, &mut Rng) -> (V, f32)| {
            let mut asked = SegmentBuffer::default();
            for at in of {
                for k in 0..strata {
                    // One ray a receiver takes any stratum.
                    let stratum = if strata == 1 { (r.unit() * STRATA as f32) as usize } else { k };
                    let (d, reach) = ray(at, stratum, &mut r);
                    asked.push_ray(at.p, d, reach, NO_PRIM, (asked.len()) as u32);
                }
            }
            Class { name, nearest: false, strata, asked }
        };
    let mut out = vec![
        made("area light", &all, 1, &mut light),
        made("area light × 16", &few, STRATA, &mut light),
        made("point light", &all, 1, &mut |at, _, _| (sub(point, at.p), 1.0)),
        made("sun", &all, 1, &mut |_, _, _| ([0.4, 0.8, 0.3], infinity)),
        made("ambient", &all, 1, &mut |at, k, r| (cosine(at.n, k, r), infinity)),
        made("ambient × 16", &few, STRATA, &mut |at, k, r| (cosine(at.n, k, r), infinity)),
        made("ambient, short", &all, 1, &mut |at, k, r| (cosine(at.n, k, r), half)),
        made("ambient, short × 16", &few, STRATA, &mut |at, k, r| (cosine(at.n, k, r), half)),
        made("bounce", &all, 1, &mut |at, k, r| (cosine(at.n, k, r), infinity)),
    ];
    out.last_mut().into_iter().for_each(|bounce| bounce.nearest = true);
    out.push(Class { name: "camera", nearest: true, strata: 1, asked: camera });
    out
}
