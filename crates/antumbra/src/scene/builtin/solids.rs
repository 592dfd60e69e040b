//! Meshes of simple bodies. All are closed unless their sentence says "open"; fronts look outwards.

use antumbra_math::{DVec3, Transform, real};
use antumbra_trace::Triangles;

use super::noise::TURN;
use crate::scene::{MaterialId, Mesh, SceneBuilder};

/// An open parallelogram; its front is the side of u × v.
pub fn quad(corner: DVec3, u: DVec3, v: DVec3) -> Triangles {
    let vertices = [corner, corner + u, corner + u + v, corner + v].map(single).to_vec();
    Triangles { vertices, indices: vec![[0, 1, 2], [0, 2, 3]] }
}

/// A box between two corners: 12 triangles.
pub fn cuboid(low: DVec3, high: DVec3) -> Triangles {
    shell(&[low.x, high.x], &[low.y, high.y], &[low.z, high.z], |p| p)
}

/// The surface of a grid box: the grid points (x, y, z) on its outside, each passed through `map`. Coordinates rise.
/// The root of boxes, rounded boxes, balls and everything that is bent from them.
pub fn shell(xs: &[f64], ys: &[f64], zs: &[f64], mut map: impl FnMut(DVec3) -> DVec3) -> Triangles {
    let (nx, ny, nz) = (xs.len() - 1, ys.len() - 1, zs.len() - 1);
    let around = 2 * (nx + nz);
    // Counter-clockwise seen from above: the corner that column c of the sides stands on.
    let side = |c: usize| match c {
        c if c < nz => (0, c),
        c if c < nz + nx => (c - nz, nz),
        c if c < 2 * nz + nx => (nx, 2 * nz + nx - c),
        c => (around - c, 0),
    };
    let mut vertices = Vec::with_capacity(around * (ny + 1) + 2 * (nx - 1) * (nz - 1));
    for &y in ys {
        for c in 0..around {
            let (i, k) = side(c);
            vertices.push(single(map(DVec3::new(xs[i], y, zs[k]))));
        }
    }
    for y in [ys[0], ys[ny]] {
        for &x in &xs[1..nx] {
            for &z in &zs[1..nz] {
                vertices.push(single(map(DVec3::new(x, y, z))));
            }
        }
    }
    let mut indices = Vec::with_capacity(2 * (around * ny + 2 * nx * nz));
    for j in 0..ny {
        for c in 0..around {
            let next = (c + 1) % around;
            square(&mut indices, [(j, c), (j, next), (j + 1, next), (j + 1, c)].map(|(j, c)| j * around + c));
        }
    }
    let lid = |top: bool, i: usize, k: usize| {
        let ring = if top { ny * around } else { 0 };
        let inner = (ny + 1) * around + if top { (nx - 1) * (nz - 1) } else { 0 };
        match (i, k) {
            (0, k) => ring + k,
            (i, k) if k == nz => ring + nz + i,
            (i, k) if i == nx => ring + nz + nx + (nz - k),
            (i, 0) => ring + 2 * nz + nx + (nx - i),
            (i, k) => inner + (i - 1) * (nz - 1) + k - 1,
        }
    };
    for i in 0..nx {
        for k in 0..nz {
            let down = [(i, k), (i + 1, k), (i + 1, k + 1), (i, k + 1)];
            square(&mut indices, down.map(|(i, k)| lid(false, i, k)));
            let up = [(i, k), (i, k + 1), (i + 1, k + 1), (i + 1, k)];
            square(&mut indices, up.map(|(i, k)| lid(true, i, k)));
        }
    }
    Triangles { vertices, indices }
}

/// A unit ball of 12 n² triangles of about the same size, each direction passed through `map`.
pub fn ball(n: u32, mut map: impl FnMut(DVec3) -> DVec3) -> Triangles {
    // Equal angles, not equal lengths, on the cube's edge.
    let grid: Vec<f64> =
        (0..=n).map(|i| real::tan((f64::from(i) / f64::from(n) - 0.5) * (TURN / 4.0))).collect();
    shell(&grid, &grid, &grid, |p| map(p.normalize()))
}

/// A box around the origin whose edges are rounded in n steps: 12 (2n + 1)² triangles.
pub fn rounded_box(half: DVec3, radius: f64, n: u32) -> Triangles {
    let inner = half - DVec3::splat(radius);
    let grid = |half: f64| -> Vec<f64> {
        let step = |i: u32| radius * real::tan(f64::from(i) / f64::from(n) * (TURN / 8.0));
        let low = (0..=n).rev().map(|i| radius - half - step(i));
        low.chain((0..=n).map(|i| half - radius + step(i))).collect()
    };
    shell(&grid(half.x), &grid(half.y), &grid(half.z), |p| {
        let core = p.clamp(-inner, inner);
        core + (p - core).normalize_or_zero() * radius
    })
}

/// A profile of points (radius, height), turned about the y axis. It runs so that the outside lies on its right (up
/// along the outside); radius 0 at both ends closes it, and the same point at both ends makes a ring.
pub fn lathe(profile: &[(f64, f64)], sides: u32) -> Triangles {
    let ring: Vec<(f64, f64)> = (0..sides).map(|i| turned(f64::from(i) / f64::from(sides))).collect();
    let mut rows = Vec::with_capacity(profile.len());
    let mut vertices = Vec::new();
    for (j, &(r, y)) in profile.iter().enumerate() {
        if j > 0 && j + 1 == profile.len() && profile[0] == (r, y) {
            rows.push(rows[0]);
            continue;
        }
        rows.push((vertices.len(), r > 0.0));
        let points = if r > 0.0 { &ring[..] } else { &ring[..1] };
        vertices.extend(points.iter().map(|(c, s)| single(DVec3::new(r * c, y, -r * s))));
    }
    let mut indices = Vec::new();
    for pair in rows.windows(2) {
        for i in 0..sides as usize {
            let next = (i + 1) % sides as usize;
            let at = |(first, round): (usize, bool), i: usize| first + if round { i } else { 0 };
            square(&mut indices, [at(pair[0], i), at(pair[0], next), at(pair[1], next), at(pair[1], i)]);
        }
    }
    Triangles { vertices, indices }
}

/// A ring of radius `major`, as thick as `minor`, around the y axis.
pub fn torus(major: f64, minor: f64, around: u32, across: u32) -> Triangles {
    let profile: Vec<(f64, f64)> = (0..=across)
        .map(|j| turned(f64::from(j % across) / f64::from(across)))
        .map(|(c, s)| (major + minor * c, minor * s))
        .collect();
    lathe(&profile, around)
}

/// A tube along a path; `radius` at each of its points. The ends taper to points and close it.
pub fn tube(path: &[DVec3], radius: impl Fn(f64) -> f64, sides: u32) -> Triangles {
    let last = path.len() - 1;
    let mut across = (path[1] - path[0]).any_orthogonal_vector().normalize();
    let mut vertices = vec![single(path[0])];
    for (i, p) in path.iter().enumerate() {
        let along = (path[(i + 1).min(last)] - path[i.max(1) - 1]).normalize();
        // Carried along without twisting.
        across = (across - along * across.dot(along)).normalize();
        let up = along.cross(across);
        let r = radius(i as f64 / last as f64);
        for s in 0..sides {
            let (c, s) = turned(f64::from(s) / f64::from(sides));
            vertices.push(single(*p + (across * c + up * s) * r));
        }
    }
    vertices.push(single(path[last]));
    let n = sides as usize;
    let end = vertices.len() - 1;
    let mut indices = Vec::new();
    for i in 0..n {
        let next = (i + 1) % n;
        square(&mut indices, [0, 0, 1 + next, 1 + i]);
        square(&mut indices, [1 + last * n + i, 1 + last * n + next, end, end]);
        for j in 0..last {
            let row = 1 + j * n;
            square(&mut indices, [row + i, row + next, row + n + next, row + n + i]);
        }
    }
    Triangles { vertices, indices }
}

/// An open sheet of nu × nv squares: `map` gives the point of (u, v) in [0, 1]². Its front is the side of ∂u × ∂v.
pub fn sheet(nu: u32, nv: u32, mut map: impl FnMut(f64, f64) -> DVec3) -> Triangles {
    let mut vertices = Vec::with_capacity(((nu + 1) * (nv + 1)) as usize);
    for j in 0..=nv {
        for i in 0..=nu {
            vertices.push(single(map(f64::from(i) / f64::from(nu), f64::from(j) / f64::from(nv))));
        }
    }
    let row = nu as usize + 1;
    let mut indices = Vec::with_capacity((2 * nu * nv) as usize);
    for j in 0..nv as usize {
        for i in 0..nu as usize {
            let at = j * row + i;
            square(&mut indices, [at, at + 1, at + row + 1, at + row]);
        }
    }
    Triangles { vertices, indices }
}

/// Moved to another place.
pub fn moved(mut body: Triangles, to: &Transform) -> Triangles {
    for v in &mut body.vertices {
        *v = single(to.point(DVec3::from(v.map(f64::from))));
    }
    body
}

/// Several bodies as one mesh.
pub fn joined(bodies: impl IntoIterator<Item = Triangles>) -> Triangles {
    let mut all = Triangles::default();
    for body in bodies {
        let first = all.vertices.len() as u32;
        all.vertices.extend(body.vertices);
        all.indices.extend(body.indices.iter().map(|t| t.map(|v| v + first)));
    }
    all
}

/// A mesh shaded as the round body that it stands for: at each vertex the mean normal of its triangles, by their area.
pub fn smooth_mesh(name: &str, triangles: Triangles) -> Mesh {
    let mut normals = vec![DVec3::ZERO; triangles.vertices.len()];
    for (i, t) in triangles.indices.iter().enumerate() {
        let [a, b, c] = triangles.corners(i).map(|v| DVec3::from(v.map(f64::from)));
        let twice_area = (b - a).cross(c - a);
        t.iter().for_each(|v| normals[*v as usize] += twice_area);
    }
    let normals = normals.into_iter().map(|n| single(n.normalize_or(DVec3::Y))).collect();
    Mesh { name: name.into(), triangles, normals: Some(normals), ..Mesh::default() }
}

/// Adds a mesh with smooth shading and places it as it is.
pub fn smooth(scene: &mut SceneBuilder, name: &str, triangles: Triangles, material: MaterialId) {
    let mesh = scene.mesh(smooth_mesh(name, triangles));
    scene.place(name, mesh, material, Transform::IDENTITY);
}

/// A turn about the y axis by an angle [rad], then a move.
pub fn turn_y(angle: f64, to: DVec3) -> Transform {
    turn(DVec3::Y, angle, to)
}

/// A turn about an axis of unit length by an angle [rad], counter-clockwise against it, then a move.
pub fn turn(axis: DVec3, angle: f64, to: DVec3) -> Transform {
    Transform { translation: to, ..Transform::rotation(axis, angle) }
}

/// Cosine and sine of a part of a full turn.
pub fn turned(part: f64) -> (f64, f64) {
    (real::cos(part * TURN), real::sin(part * TURN))
}

/// Into the numbers of a mesh.
pub fn single(p: DVec3) -> [f32; 3] {
    [p.x as f32, p.y as f32, p.z as f32]
}

/// Two triangles of four corners (counter-clockwise); a corner that repeats leaves one triangle.
fn square(indices: &mut Vec<[u32; 3]>, corners: [usize; 4]) {
    let [a, b, c, d] = corners.map(|i| i as u32);
    if a != b && b != c {
        indices.push([a, b, c]);
    }
    if c != d && d != a {
        indices.push([a, c, d]);
    }
}
