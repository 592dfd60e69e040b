//! A closed mesh lets no segment out (LAW §2, T2), asked through the tree.

use antumbra_trace::{
    Bits, BuildOptions, Instance, NO_PRIM, Pool, SegmentBuffer, SimdLevel, Triangles, Visibility, World,
};

use crate::meshes::{self, geometry};
use crate::rng::{Rng, amount, mix, to_f32, to_f64};

/// Segments from inside, through corners, edges and faces of the mesh, to outside: all are blocked.
fn no_leak(name: &str, mesh: &Triangles, inside: [f64; 3], n: usize) {
    let instance = Instance { geometry: 0, transform: None, masked: false };
    let geometries = vec![geometry(mesh.clone())];
    let built = World::build(geometries, vec![instance], &BuildOptions::default(), Pool::serial());
    let mut world = built.unwrap();
    let mut r = Rng::new(8);
    let mut asked = SegmentBuffer::default();
    for i in 0..n {
        let c = mesh.corners(r.below(mesh.indices.len() as u64) as usize).map(to_f64);
        let through = match r.below(3) {
            0 => c[0],
            1 => mix([0.5, 0.5], [c[1], c[2]]),
            _ => mix(r.weights(), c),
        };
        let beyond = [0, 1, 2].map(|k| inside[k] + 2.0 * (through[k] - inside[k]));
        let d = [0, 1, 2].map(|k| through[k] - inside[k]);
        if r.below(2) == 0 {
            asked.push_segment(to_f32(inside), to_f32(beyond), NO_PRIM, NO_PRIM, i as u32);
        } else {
            asked.push_ray(to_f32(inside), to_f32(d), f32::INFINITY, NO_PRIM, i as u32);
        }
    }
    for level in SimdLevel::available() {
        world.set_level(level);
        let mut bits = Bits::default();
        world.occluded(asked.as_segments(), &mut bits);
        assert_eq!(bits.count(), n, "{name} leaks at {level:?}");
    }
}

#[test]
fn spheres_are_tight() {
    for scale in [1.0, 1e-6, 1e6] {
        let ball = meshes::moved(&meshes::sphere(40), scale, [0.0; 3]);
        no_leak("sphere", &ball, [0.1 * scale, 0.05 * scale, -0.2 * scale], amount(10_000, 400_000));
    }
    let far = meshes::moved(&meshes::sphere(40), 1.0, [1000.0, 0.0, -1000.0]);
    no_leak("far sphere", &far, [1000.0, 0.0, -1000.0], amount(10_000, 400_000));
}

#[test]
fn a_lattice_cube_is_tight() {
    let mut mesh = Triangles::default();
    for corner in 0..8u32 {
        mesh.vertices.push([0, 1, 2].map(|k| if corner >> k & 1 == 1 { 2.0 } else { -2.0 }));
    }
    for [a, b, c, d] in [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]] {
        mesh.indices.push([a, b, c]);
        mesh.indices.push([a, c, d]);
    }
    no_leak("cube", &mesh, [0.0; 3], amount(20_000, 200_000));
    no_leak("cube, off centre", &mesh, [1.0, 1.0, 1.0], amount(20_000, 200_000));
}
