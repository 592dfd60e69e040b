//! LAW §7.4: from the inside of a closed mesh no segment gets out (T2), by whichever corner, edge or sliver it leaves.

use antumbra_math::{DMat3, DVec3, Transform};
use antumbra_trace::{Bits, Brute, Geometry, Instance, SegmentBuffer, Visibility};

use crate::meshes::{add_slivers, lattice_cube, point_of, push_both_ways, sphere, world};
use crate::rng::{Rng, amount, cross, dot, mix, to_f32, to_f64, unit};

fn assert_no_leak(
    name: &str,
    (geometries, instances): &(Vec<Geometry>, Vec<Instance>),
    batch: &SegmentBuffer,
) {
    let segments = batch.as_segments();
    let mut blocked = Bits::default();
    Brute::new(geometries, instances, None).occluded(segments, &mut blocked);
    for i in 0..segments.len() {
        assert!(blocked.get(i), "{name}: {:?} → {:?} leaks", segments.origin_at(i), segments.end_at(i));
    }
}

/// A rotation, then a scale along each axis, then a shift.
fn random_placement(r: &mut Rng) -> Transform {
    let x = r.direction();
    let y = unit(cross(x, r.direction()));
    let rotation = DMat3::from_cols_array_2d(&[x, y, cross(x, y)]);
    let scale = DVec3::from_array([0; 3].map(|_| r.signed_power(-1.0, 1.0)));
    Transform {
        linear: DMat3::from_diagonal(scale) * rotation,
        translation: DVec3::from_array(r.cube(100.0)),
    }
}

#[test]
fn a_sphere_is_tight() {
    let mut r = Rng::new(1001);
    for trial in 0..8 {
        let (radius, center) = (r.signed_power(-3.0, 3.0).abs(), r.cube([0.0, 50.0][trial % 2]));
        let mut mesh = sphere(8, 11, radius, center);
        add_slivers(&mut mesh, 60 * (trial / 4), &mut r);
        let placement = (trial % 4 > 1).then(|| random_placement(&mut r));
        let to_world = placement.unwrap_or(Transform::IDENTITY);
        let mut batch = SegmentBuffer::default();
        for _ in 0..amount(1500, 60_000) {
            let inner = r.cube(0.4);
            let p = [0, 1, 2].map(|k| center[k] + radius * inner[k]);
            let (target, s) = (point_of(&mesh, &mut r), r.range(1.5, 30.0));
            let outer = mix([1.0 - s, s], [p, target]);
            let [p, q] = [p, outer].map(|x| to_f32(to_world.point(DVec3::from_array(x)).to_array()));
            if is_between(&to_world, p, q, center, radius) {
                push_both_ways(&mut batch, p, q);
            }
        }
        assert!(batch.len() > 1000);
        assert_no_leak("sphere", &world(mesh, placement), &batch);
    }
}

/// After all rounding p is inside the mesh (radius ≥ 0.8 of the sphere's) and q outside the sphere.
fn is_between(to_world: &Transform, p: [f32; 3], q: [f32; 3], center: [f64; 3], radius: f64) -> bool {
    let Some(back) = to_world.inverse() else { return false };
    let distance = |x: [f32; 3]| {
        let v = back.point(DVec3::from_array(to_f64(x))) - DVec3::from_array(center);
        dot(v.to_array(), v.to_array()).sqrt()
    };
    distance(p) < 0.75 * radius && distance(q) > 1.01 * radius
}

#[test]
fn a_lattice_cube_is_tight_along_its_edges() {
    let n = 4;
    let mut r = Rng::new(1002);
    let mut batch = SegmentBuffer::default();
    for _ in 0..amount(15_000, 500_000) {
        // Half integers and integers strictly inside; directions of small integers.
        let p = [0; 3].map(|_| (1 + r.below(u64::from(2 * n) - 1)) as f32 / 2.0);
        let d = [0; 3].map(|_| r.below(7) as f32 - 3.0);
        if d != [0.0; 3] {
            push_both_ways(&mut batch, p, [0, 1, 2].map(|k| p[k] + 9.0 * d[k]));
        }
    }
    assert_no_leak("lattice cube", &world(lattice_cube(n), None), &batch);
}

#[test]
fn grazing_exits_are_blocked() {
    let mut r = Rng::new(1003);
    for placement in [None, Some(Transform { linear: DMat3::IDENTITY * 0.37, translation: DVec3::ZERO })] {
        let to_world = placement.unwrap_or(Transform::IDENTITY);
        let mut mesh = lattice_cube(4);
        add_slivers(&mut mesh, 30, &mut r);
        // The bottom of the cube stays flat: its slivers lie in z = 0.
        let mut batch = SegmentBuffer::default();
        for _ in 0..amount(10_000, 300_000) {
            let mut point = |z: f64| {
                let mut coordinate =
                    || if r.below(2) == 0 { 1.0 + r.below(3) as f64 } else { r.range(0.1, 3.9) };
                let p = DVec3::new(coordinate(), coordinate(), z);
                to_f32(to_world.point(p).to_array())
            };
            let (p, q) = (point(1.0), point(-1.0));
            let (inside, outside) = (r.signed_power(-13.0, -7.0).abs(), r.signed_power(-13.0, -7.0).abs());
            push_both_ways(&mut batch, [p[0], p[1], inside as f32], [q[0], q[1], -outside as f32]);
        }
        // `nudge` may lift a sliver of the bottom off z = 0 by steps of the smallest f32: below every depth here.
        assert_no_leak("grazing exit", &world(mesh, placement), &batch);
    }
}
