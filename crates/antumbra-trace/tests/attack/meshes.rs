//! Closed meshes of the shapes that leak: pole fans, lattices whose edges are hit exactly, slivers one ulp wide.

use std::sync::Arc;

use antumbra_math::real;
use antumbra_trace::{Geometry, Instance, SegmentBuffer, Triangles};

use crate::rng::{Rng, to_f64};

/// A sphere of rings and sectors; the poles are fans.
pub fn sphere(rings: u32, sectors: u32, radius: f64, center: [f64; 3]) -> Triangles {
    let mut mesh = Triangles::default();
    let mut add = |z: f64, rho: f64, phi: f64| {
        let unit = [rho * real::cos(phi), rho * real::sin(phi), z];
        mesh.vertices.push([0, 1, 2].map(|k| (center[k] + radius * unit[k]) as f32));
    };
    let pi = std::f64::consts::PI;
    add(1.0, 0.0, 0.0);
    add(-1.0, 0.0, 0.0);
    for i in 1..rings {
        let theta = pi * f64::from(i) / f64::from(rings);
        for j in 0..sectors {
            add(real::cos(theta), real::sin(theta), 2.0 * pi * f64::from(j) / f64::from(sectors));
        }
    }
    let at = |i: u32, j: u32| 2 + (i - 1) * sectors + j % sectors;
    for j in 0..sectors {
        mesh.indices.push([0, at(1, j), at(1, j + 1)]);
        mesh.indices.push([1, at(rings - 1, j + 1), at(rings - 1, j)]);
        for i in 1..rings - 1 {
            mesh.indices.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            mesh.indices.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh
}

/// The cube [0, n]³, its faces cut into unit squares and those into two triangles.
pub fn lattice_cube(n: u32) -> Triangles {
    let mut mesh = Triangles::default();
    for axis in 0..3 {
        for level in [0, n] {
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                let corner = |di: u32, dj: u32| {
                    let mut v = [0.0; 3];
                    v[axis] = level as f32;
                    v[(axis + 1) % 3] = (i + di) as f32;
                    v[(axis + 2) % 3] = (j + dj) as f32;
                    v
                };
                let first = mesh.vertices.len() as u32;
                mesh.vertices.extend([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]);
                mesh.indices.push([first, first + 1, first + 2]);
                mesh.indices.push([first, first + 2, first + 3]);
            }
        }
    }
    mesh
}

/// Splits one edge of `count` triangles near its middle and closes the crack, which is up to an ulp wide, with a sliver.
pub fn add_slivers(mesh: &mut Triangles, count: usize, r: &mut Rng) {
    for _ in 0..count {
        let i = r.below(mesh.indices.len() as u64) as usize;
        let [a, b, c] = mesh.indices[i];
        let (p, q) = (mesh.vertices[a as usize], mesh.vertices[b as usize]);
        let s = r.range(0.1, 0.9) as f32;
        let m = mesh.vertices.len() as u32;
        mesh.vertices.push([0, 1, 2].map(|k| r.nudge(p[k] + (q[k] - p[k]) * s)));
        mesh.indices[i] = [a, m, c];
        mesh.indices.push([m, b, c]);
        mesh.indices.push([a, b, m]);
    }
}

/// A corner, an edge point or a face point of some triangle.
pub fn point_of(mesh: &Triangles, r: &mut Rng) -> [f64; 3] {
    let corners = mesh.corners(r.below(mesh.indices.len() as u64) as usize);
    crate::rng::mix(r.weights(), corners.map(to_f64))
}

/// One mesh, placed by `transform`.
pub fn world(mesh: Triangles, transform: Option<antumbra_math::Transform>) -> (Vec<Geometry>, Vec<Instance>) {
    let geometry = Geometry::Triangles(Arc::new(mesh));
    (vec![geometry], vec![Instance { geometry: 0, transform, masked: false }])
}

/// Adds p → q and q → p.
pub fn push_both_ways(batch: &mut SegmentBuffer, p: [f32; 3], q: [f32; 3]) {
    batch.push_segment(p, q, antumbra_trace::NO_PRIM, antumbra_trace::NO_PRIM, 0);
    batch.push_segment(q, p, antumbra_trace::NO_PRIM, antumbra_trace::NO_PRIM, 0);
}
