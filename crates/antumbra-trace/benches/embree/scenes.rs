//! The scenes of the race, made from numbers: open land, few large boxes, many small ones, fine detail, a room.

use antumbra_trace::Triangles;

/// A scene: geometry, where it is looked at from, what lights it.
pub struct Scene {
    pub name: &'static str,
    pub mesh: Triangles,
    /// Eye and what it looks at.
    pub view: [[f32; 3]; 2],
    /// A square light: centre and half edge, horizontal.
    pub light: ([f32; 3], f32),
    /// Height of the picture of receivers.
    pub rows: usize,
}

/// splitmix64: the same scenes everywhere.
pub struct Rng(pub u64);

impl Rng {
    pub fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }

    pub fn range(&mut self, a: f32, b: f32) -> f32 {
        a + (b - a) * self.unit()
    }
}

/// All of them; `detail` 1 = full size.
pub fn all(detail: f32) -> Vec<Scene> {
    vec![interior(detail), terrain(), pillars(), hall(detail), scan(detail)]
}

/// Value noise in [0, 1], three octaves.
fn noise(p: [f32; 3]) -> f32 {
    (0..3).map(|k| octave(p.map(|x| x * (1 << (2 * k)) as f32)) / (1 << (2 * k)) as f32).sum::<f32>() * 0.75
}

fn octave(p: [f32; 3]) -> f32 {
    let at = |c: [i32; 3]| {
        let seed =
            c[0].wrapping_mul(73_856_093) ^ c[1].wrapping_mul(19_349_663) ^ c[2].wrapping_mul(83_492_791);
        Rng(seed as u64).unit()
    };
    let base = p.map(|x| x.floor());
    let f = [0, 1, 2].map(|k| {
        let t = p[k] - base[k];
        t * t * (3.0 - 2.0 * t)
    });
    let c = base.map(|x| x as i32);
    let mut sum = 0.0;
    for k in 0..8 {
        let bit = |axis: usize| k >> axis & 1;
        let weight = |axis: usize| if bit(axis) == 1 { f[axis] } else { 1.0 - f[axis] };
        sum += weight(0) * weight(1) * weight(2) * at([c[0] + bit(0), c[1] + bit(1), c[2] + bit(2)]);
    }
    sum
}

/// A sheet of n × n quads through `place(u, v)`, u and v in [0, 1].
fn sheet(mesh: &mut Triangles, n: u32, place: impl Fn(f32, f32) -> [f32; 3]) {
    let first = mesh.vertices.len() as u32;
    for j in 0..=n {
        mesh.vertices.extend((0..=n).map(|i| place(i as f32 / n as f32, j as f32 / n as f32)));
    }
    for j in 0..n {
        for i in 0..n {
            let v = first + j * (n + 1) + i;
            mesh.indices.push([v, v + 1, v + n + 1]);
            mesh.indices.push([v + 1, v + n + 2, v + n + 1]);
        }
    }
}

/// A box about `c` with half edges along three vectors.
fn block(mesh: &mut Triangles, c: [f32; 3], axes: [[f32; 3]; 3]) {
    let first = mesh.vertices.len() as u32;
    for k in 0..8 {
        let sign = |axis: usize| if k >> axis & 1 == 1 { 1.0 } else { -1.0 };
        mesh.vertices.push(
            [0, 1, 2].map(|x| c[x] + sign(0) * axes[0][x] + sign(1) * axes[1][x] + sign(2) * axes[2][x]),
        );
    }
    for [a, b, c, d] in [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]] {
        mesh.indices.push([first + a, first + b, first + c]);
        mesh.indices.push([first + a, first + c, first + d]);
    }
}

/// An upright box.
fn upright(mesh: &mut Triangles, c: [f32; 3], half: [f32; 3]) {
    block(mesh, c, [[half[0], 0.0, 0.0], [0.0, half[1], 0.0], [0.0, 0.0, half[2]]]);
}

fn ball(mesh: &mut Triangles, n: u32, c: [f32; 3], radius: impl Fn([f32; 3]) -> f32) {
    sheet(mesh, n, |u, v| {
        let (theta, phi) = (v * std::f32::consts::PI, u * std::f32::consts::TAU);
        let (st, ct) = (libm::sinf(theta), libm::cosf(theta));
        let d = [st * libm::cosf(phi), ct, st * libm::sinf(phi)];
        let r = radius(d);
        [0, 1, 2].map(|k| c[k] + r * d[k])
    });
}

/// 31k triangles of hills.
fn terrain() -> Scene {
    let mut mesh = Triangles::default();
    sheet(&mut mesh, 125, |u, v| {
        let (x, z) = (u * 100.0 - 50.0, v * 100.0 - 50.0);
        [x, 14.0 * noise([x * 0.06, 0.0, z * 0.06]), z]
    });
    let view = [[-45.0, 25.0, -45.0], [0.0, 5.0, 0.0]];
    Scene { name: "terrain", mesh, view, light: ([20.0, 40.0, 10.0], 8.0), rows: 512 }
}

/// Eight pillars on a ground: 98 triangles.
fn pillars() -> Scene {
    let mut mesh = Triangles::default();
    sheet(&mut mesh, 1, |u, v| [u * 20.0 - 10.0, 0.0, v * 20.0 - 10.0]);
    for k in 0..8 {
        let (i, j) = ((k % 4) as f32, (k / 4) as f32);
        upright(&mut mesh, [i * 3.0 - 4.5, 1.5, j * 4.0 - 2.0], [0.3, 1.5, 0.3]);
    }
    Scene {
        name: "pillars",
        mesh,
        view: [[-8.0, 6.0, -9.0], [0.0, 1.0, 0.0]],
        light: ([0.0, 8.0, 0.0], 1.0),
        rows: 512,
    }
}

/// 10⁵ small turned boxes in a closed hall: 1.2 million triangles.
fn hall(detail: f32) -> Scene {
    let mut mesh = Triangles::default();
    upright(&mut mesh, [0.0, 10.0, 0.0], [30.0, 10.0, 30.0]);
    let mut r = Rng(5);
    for _ in 0..(1e5 * detail) as usize {
        let c = [r.range(-29.0, 29.0), r.range(0.2, 19.0), r.range(-29.0, 29.0)];
        let mut v = || [r.range(-0.12, 0.12), r.range(-0.12, 0.12), r.range(-0.12, 0.12)];
        let axes = [v(), v(), v()];
        block(&mut mesh, c, axes);
    }
    let view = [[-28.0, 10.0, -28.0], [0.0, 6.0, 0.0]];
    Scene { name: "hall", mesh, view, light: ([0.0, 19.5, 0.0], 3.0), rows: 512 }
}

/// A finely displaced ball over a floor: 2.1 million triangles.
fn scan(detail: f32) -> Scene {
    let mut mesh = Triangles::default();
    sheet(&mut mesh, 4, |u, v| [u * 8.0 - 4.0, -1.1, v * 8.0 - 4.0]);
    let n = (1024.0 * detail.sqrt()) as u32;
    ball(&mut mesh, n, [0.0; 3], |d| 0.9 + 0.25 * noise(d.map(|x| 6.0 * x + 20.0)));
    Scene {
        name: "scan",
        mesh,
        view: [[-1.8, 1.2, -2.2], [0.0; 3]],
        light: ([1.5, 4.0, 0.5], 0.7),
        rows: 512,
    }
}

/// A furnished room: walls, tables, spheres, cushions, leaves; half a million triangles.
fn interior(detail: f32) -> Scene {
    let mut mesh = Triangles::default();
    upright(&mut mesh, [0.0, 1.5, 0.0], [4.0, 1.5, 4.0]);
    let mut r = Rng(3);
    for _ in 0..14 {
        let (x, z) = (r.range(-3.3, 3.3), r.range(-3.3, 3.3));
        upright(&mut mesh, [x, 0.7, z], [0.5, 0.02, 0.4]);
        for k in 0..4 {
            let (sx, sz) = ((k % 2) as f32 * 0.9 - 0.45, (k / 2) as f32 * 0.7 - 0.35);
            upright(&mut mesh, [x + sx, 0.34, z + sz], [0.02, 0.34, 0.02]);
        }
        ball(&mut mesh, (60.0 * detail.sqrt()) as u32, [x, 0.82, z], |_| 0.1);
    }
    for _ in 0..10 {
        let c = [r.range(-3.3, 3.3), 0.2, r.range(-3.3, 3.3)];
        ball(&mut mesh, (110.0 * detail.sqrt()) as u32, c, |d| {
            0.25 + 0.08 * noise([d[0] * 9.0 + c[0], d[1] * 9.0, d[2] * 9.0 + c[2]])
        });
    }
    for _ in 0..(75_000.0 * detail) as usize {
        let c = [r.range(2.0, 3.9), r.range(0.3, 2.6), r.range(2.0, 3.9)];
        let mut v = || [0, 1, 2].map(|k| c[k] + r.range(-0.035, 0.035));
        let first = mesh.vertices.len() as u32;
        let corners = [v(), v(), v(), v()];
        mesh.vertices.extend(corners);
        mesh.indices.push([first, first + 1, first + 2]);
        mesh.indices.push([first, first + 2, first + 3]);
    }
    let view = [[-3.6, 1.9, -3.6], [0.8, 0.7, 0.8]];
    Scene { name: "interior", mesh, view, light: ([0.0, 2.95, 0.0], 1.0), rows: 512 }
}
