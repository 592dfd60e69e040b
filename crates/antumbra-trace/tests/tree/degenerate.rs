//! Worlds that break naive trees, and builds that must not depend on who builds.

use antumbra_trace::{
    Bits, Brute, BuildOptions, Geometry, Hits, Instance, NO_PRIM, Pool, SegmentBuffer, Shape, Triangles,
    Visibility, World, WorldError,
};

use crate::meshes::{self, geometry};
use crate::questions::questions;
use crate::rng::{Rng, amount};

fn world(mesh: Triangles) -> World {
    let instance = Instance { geometry: 0, transform: None, masked: false };
    World::build(vec![geometry(mesh)], vec![instance], &BuildOptions::default(), Pool::serial()).unwrap()
}

/// Answers as brute force does, on questions about the mesh.
fn check(name: &str, mesh: &Triangles, n: usize) {
    let mut r = Rng::new(4);
    let asked = questions(&mut r, mesh, n, 1.0, [0.0; 3], 0);
    let (mut bits, mut hits) = (Bits::default(), Hits::default());
    let world = world(mesh.clone());
    world.occluded(asked.as_segments(), &mut bits);
    world.nearest(asked.as_segments(), &mut hits);
    let geometries = [geometry(mesh.clone())];
    let instances = [Instance { geometry: 0, transform: None, masked: false }];
    let brute = Brute::new(&geometries, &instances, None);
    let (mut b, mut h) = (Bits::default(), Hits::default());
    brute.occluded(asked.as_segments(), &mut b);
    brute.nearest(asked.as_segments(), &mut h);
    assert_eq!((bits, hits), (b, h), "{name}");
}

#[test]
fn an_empty_world_blocks_nothing() {
    for instances in [vec![], vec![Instance { geometry: 0, transform: None, masked: false }]] {
        let geometries = vec![geometry(Triangles::default())];
        let world = World::build(geometries, instances, &BuildOptions::default(), Pool::serial()).unwrap();
        let mut asked = SegmentBuffer::default();
        asked.push_segment([0.0; 3], [1.0; 3], NO_PRIM, NO_PRIM, 0);
        let (mut bits, mut hits) = (Bits::default(), Hits::default());
        world.occluded(asked.as_segments(), &mut bits);
        world.nearest(asked.as_segments(), &mut hits);
        assert_eq!((bits.count(), hits.prim[0], hits.t[0]), (0, NO_PRIM, f64::INFINITY));
        assert_eq!(world.prim_count(), 0);
        assert_eq!(world.locate(0), None);
        assert!(world.bounds().0[0] > world.bounds().1[0]);
    }
}

#[test]
fn one_to_twenty_triangles() {
    let mut r = Rng::new(5);
    for n in 1..20 {
        check("few", &meshes::soup(&mut r, n, 0.8), 300);
    }
}

#[test]
fn the_same_triangle_many_times() {
    let one = meshes::loose(&[[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]);
    let copies = |n: usize| Triangles { indices: vec![[0, 1, 2]; n], ..one.clone() };
    check("the same", &copies(500), 300);
    let many = world(copies(amount(100_000, 1_000_000)));
    let mut asked = SegmentBuffer::default();
    asked.push_ray([0.2, 0.2, 1.0], [0.0, 0.0, -1.0], f32::INFINITY, NO_PRIM, 0);
    let (mut bits, mut hits) = (Bits::default(), Hits::default());
    many.occluded(asked.as_segments(), &mut bits);
    many.nearest(asked.as_segments(), &mut hits);
    assert_eq!((bits.count(), hits.prim[0], hits.t[0]), (1, 0, 1.0));
    assert!(many.stats().depth < 20, "depth {}", many.stats().depth);
}

#[test]
fn points_lines_and_extremes() {
    let mut r = Rng::new(6);
    let point = meshes::loose(&[[[0.5; 3]; 3]]);
    check("a point", &point, 100);
    check("points", &Triangles { indices: vec![[0, 0, 0]; 30], ..point }, 100);
    check("zero", &meshes::loose(&[[[0.0; 3]; 3]; 20]), 100);
    let soup = meshes::soup(&mut r, 60, 0.5);
    for scale in [3e37, 1.7e38, 1e15, 1e-38, 1e-44] {
        check(&format!("soup × {scale:e}"), &meshes::moved(&soup, scale, [0.0; 3]), 200);
    }
    // Coordinates of all sizes at once: splits that peel off one triangle after the other.
    let powers: Vec<_> = (-140..127)
        .map(|k| {
            let s = libm::exp2(f64::from(k)) as f32;
            [[s, 0.0, s], [s, s, 0.0], [2.0 * s, s, s]]
        })
        .collect();
    check("powers", &meshes::loose(&powers), 300);
    let mut with_giant = soup;
    with_giant.vertices[0] = [3e37, -3e37, 3e37];
    check("one giant", &with_giant, 300);
}

#[test]
fn the_tree_is_bounded_in_depth() {
    let peel = |i: u32| {
        let x = libm::pow(1.3, f64::from(i)) as f32;
        [[x, 0.0, 0.0], [x, x * 0.01, 0.0], [x, 0.0, x * 0.01]]
    };
    let mesh = meshes::loose(&(0..300).map(peel).collect::<Vec<_>>());
    assert!(world(mesh.clone()).stats().depth <= 80);
    check("peel", &mesh, 300);
}

#[test]
fn any_number_of_threads_builds_the_same() {
    let mut r = Rng::new(7);
    let soup = meshes::soup(&mut r, 50_000, 0.02);
    let mut asked = SegmentBuffer::default();
    for i in 0..200 {
        asked.push_ray(
            r.cube(1.0).map(|x| x as f32),
            r.direction().map(|x| x as f32),
            f32::INFINITY,
            NO_PRIM,
            i,
        );
    }
    let build = |pool: Pool<'_>| {
        let instance = Instance { geometry: 0, transform: None, masked: false };
        let geometries = vec![geometry(soup.clone())];
        World::build(geometries, vec![instance], &BuildOptions::default(), pool).unwrap()
    };
    let one = build(Pool::serial());
    for threads in [1, 2, 3, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let other = build(Pool::from(&pool));
        assert!(one.same_trees(&other), "{threads} threads built another tree");
    }
    assert_eq!(one.stats().primitives, 50_000);
}

#[test]
fn numbers_lead_back_to_instances() {
    let meshes = [1, 0, 3].map(|n| Triangles { vertices: vec![[0.0; 3]], indices: vec![[0, 0, 0]; n] });
    let geometries = meshes.map(geometry).to_vec();
    let of = |geometry| Instance { geometry, transform: None, masked: false };
    let instances = vec![of(1), of(0), of(1), of(2), of(1)];
    let world = World::build(geometries, instances, &BuildOptions::default(), Pool::serial()).unwrap();
    let found: Vec<_> = (0..5).map(|prim| world.locate(prim)).collect();
    assert_eq!(found, [Some((1, 0)), Some((3, 0)), Some((3, 1)), Some((3, 2)), None]);
    assert_eq!(world.locate(NO_PRIM), None);
}

#[test]
fn unsound_geometry_is_refused() {
    let build = |g: Geometry, geometry: u32| {
        let instance = Instance { geometry, transform: None, masked: false };
        World::build(vec![g], vec![instance], &BuildOptions::default(), Pool::serial()).err()
    };
    let mesh = |v: [f32; 3], index| {
        geometry(Triangles { vertices: vec![v], indices: vec![[0, 0, 0], [0, 0, index]] })
    };
    assert_eq!(build(mesh([0.0; 3], 0), 0), None);
    assert_eq!(
        build(mesh([0.0; 3], 0), 3),
        Some(WorldError::NoSuchGeometry { instance: 0, geometry: 3, count: 1 })
    );
    assert_eq!(build(mesh([0.0; 3], 7), 0), Some(WorldError::NoSuchVertex { geometry: 0, triangle: 1 }));
    let nan = [0.0, f32::NAN, 0.0];
    assert_eq!(build(mesh(nan, 0), 0), Some(WorldError::NotFinite { geometry: 0, primitive: 0 }));
    let ball = Shape::Sphere { center: [0.0; 3], radius: 0.0 };
    assert_eq!(
        build(Geometry::Shapes(vec![ball]), 0),
        Some(WorldError::NotFinite { geometry: 0, primitive: 0 })
    );
}
