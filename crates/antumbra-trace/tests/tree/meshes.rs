//! Meshes that are hard for a tree: soups, slivers, lattices, coplanar layers, closed surfaces.

use std::sync::Arc;

use antumbra_trace::{Geometry, Triangles};

use crate::rng::{Rng, to_f32};

/// A mesh from loose triangles.
pub fn loose(corners: &[[[f32; 3]; 3]]) -> Triangles {
    let vertices = corners.iter().flatten().copied().collect();
    let indices = (0..corners.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Triangles { vertices, indices }
}

/// As a geometry.
pub fn geometry(mesh: Triangles) -> Geometry {
    Geometry::Triangles(Arc::new(mesh))
}

/// `n` random triangles of edge about `size` in the cube ±1.
pub fn soup(r: &mut Rng, n: usize, size: f64) -> Triangles {
    let triangle = |r: &mut Rng| {
        let c = r.cube(1.0);
        [0, 1, 2].map(|_| {
            let e = r.cube(size);
            to_f32([0, 1, 2].map(|k| c[k] + e[k]))
        })
    };
    loose(&(0..n).map(|_| triangle(r)).collect::<Vec<_>>())
}

/// `n` triangles with one corner within `thin` of the opposite edge.
pub fn slivers(r: &mut Rng, n: usize, thin: f64) -> Triangles {
    let triangle = |r: &mut Rng| {
        let (a, b, w) = (r.cube(1.0), r.cube(1.0), r.unit());
        let off = r.cube(thin);
        let c = [0, 1, 2].map(|k| a[k] + w * (b[k] - a[k]) + off[k]);
        [to_f32(a), to_f32(b), to_f32(c)]
    };
    loose(&(0..n).map(|_| triangle(r)).collect::<Vec<_>>())
}

/// `n` triangles with integer corners in ±4, doubled and degenerate ones among them.
pub fn lattice(r: &mut Rng, n: usize) -> Triangles {
    let point = |r: &mut Rng| [0, 1, 2].map(|_| r.below(9) as f32 - 4.0);
    loose(&(0..n).map(|_| [point(r), point(r), point(r)]).collect::<Vec<_>>())
}

/// `n` triangles in one plane z = 0.25 and its copy 1 ulp above.
pub fn coplanar(r: &mut Rng, n: usize) -> Triangles {
    let triangle = |r: &mut Rng| {
        let z = if r.below(2) == 0 { 0.25f32 } else { 0.25f32.next_up() };
        [0, 1, 2].map(|_| [r.range(-1.0, 1.0) as f32, r.range(-1.0, 1.0) as f32, z])
    };
    loose(&(0..n).map(|_| triangle(r)).collect::<Vec<_>>())
}

/// A bumpy height field of n × n quads over [−1, 1]².
pub fn field(r: &mut Rng, n: usize) -> Triangles {
    let mut mesh = Triangles::default();
    let row = n as u32 + 1;
    for j in 0..=n {
        for i in 0..=n {
            let at = |k: usize| (2.0 * k as f64 / n as f64 - 1.0) as f32;
            mesh.vertices.push([at(i), (r.unit() * 0.2) as f32, at(j)]);
        }
    }
    for q in 0..(n * n) as u32 {
        let v = q / n as u32 * row + q % n as u32;
        mesh.indices.push([v, v + row, v + 1]);
        mesh.indices.push([v + 1, v + row, v + row + 1]);
    }
    mesh
}

/// A closed sphere of radius 1 about 0, `n` rings of 2n quads; corners outward counter-clockwise.
pub fn sphere(n: usize) -> Triangles {
    use std::f64::consts::PI;
    let mut mesh = Triangles { vertices: vec![[0.0, 1.0, 0.0]], indices: Vec::new() };
    let around = 2 * n as u32;
    for j in 1..n {
        for i in 0..around {
            let (theta, phi) = (PI * j as f64 / n as f64, 2.0 * PI * f64::from(i) / f64::from(around));
            let s = libm::sin(theta);
            mesh.vertices.push(to_f32([s * libm::cos(phi), libm::cos(theta), s * libm::sin(phi)]));
        }
    }
    mesh.vertices.push([0.0, -1.0, 0.0]);
    let south = mesh.vertices.len() as u32 - 1;
    let at = |j: u32, i: u32| 1 + j * around + i % around;
    for i in 0..around {
        mesh.indices.push([0, at(0, i + 1), at(0, i)]);
        for j in 0..n as u32 - 2 {
            mesh.indices.push([at(j, i), at(j, i + 1), at(j + 1, i)]);
            mesh.indices.push([at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)]);
        }
        mesh.indices.push([south, at(n as u32 - 2, i), at(n as u32 - 2, i + 1)]);
    }
    mesh
}

/// The same mesh, scaled, then moved.
pub fn moved(mesh: &Triangles, scale: f64, by: [f64; 3]) -> Triangles {
    let vertices = mesh.vertices.iter();
    let map = |v: &[f32; 3]| to_f32([0, 1, 2].map(|k| f64::from(v[k]) * scale + by[k]));
    Triangles { vertices: vertices.map(map).collect(), indices: mesh.indices.clone() }
}
