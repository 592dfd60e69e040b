//! What `Brute` does beside the law: identities, skipped primitives, masks, the closest of many.

use std::sync::Arc;

use antumbra_math::{DMat3, DVec3, Transform};
use antumbra_trace::{
    Bits, Brute, Geometry, Hits, Instance, NO_PRIM, Passes, PrimId, SegmentBuffer, Shape, Triangles,
    Visibility,
};

/// Two triangles over z = 1 and z = 2, above the origin.
fn two_layers() -> Geometry {
    let layer = |z: f32| [[-1.0, -1.0, z], [3.0, -1.0, z], [-1.0, 3.0, z]];
    let vertices = [layer(1.0), layer(2.0)].concat();
    Geometry::Triangles(Arc::new(Triangles { vertices, indices: vec![[0, 1, 2], [3, 4, 5]] }))
}

fn instance(geometry: u32, transform: Option<Transform>, masked: bool) -> Instance {
    Instance { geometry, transform, masked }
}

fn lifted(z: f64) -> Option<Transform> {
    Some(Transform::translation(DVec3::new(0.0, 0.0, z)))
}

fn closest(brute: &Brute<'_>, batch: &SegmentBuffer) -> Vec<(PrimId, f64)> {
    let (mut hits, mut bits) = (Hits::default(), Bits::default());
    brute.nearest(batch.as_segments(), &mut hits);
    brute.occluded(batch.as_segments(), &mut bits);
    let found: Vec<_> = hits.prim.into_iter().zip(hits.t).collect();
    for (i, (prim, t)) in found.iter().enumerate() {
        assert_eq!(*prim != NO_PRIM, bits.get(i), "entry {i}");
        assert_eq!(*prim == NO_PRIM, *t == f64::INFINITY, "entry {i}");
    }
    found
}

#[test]
fn the_closest_wins_and_ties_go_to_the_smaller_identity() {
    let geometries = [two_layers(), Geometry::Shapes(vec![Shape::Sphere { center: [0.0; 3], radius: 0.5 }])];
    let singular = Transform { linear: DMat3::ZERO, translation: DVec3::ZERO };
    let instances = [
        instance(0, lifted(1.0), false),               // 0, 1: z = 2 and 3
        instance(0, None, false),                      // 2, 3: z = 1 and 2
        instance(0, Some(singular), false),            // 4, 5: nowhere
        instance(1, lifted(10.0), false),              // 6
        instance(0, Some(Transform::IDENTITY), false), // 7, 8: z = 1 and 2
    ];
    let brute = Brute::new(&geometries, &instances, None);
    let up = [0.0, 0.0, 1.0];
    let mut batch = SegmentBuffer::default();
    batch.push_ray([0.0; 3], up, f32::INFINITY, NO_PRIM, 0);
    batch.push_ray([0.0, 0.0, 1.5], up, f32::INFINITY, NO_PRIM, 0);
    batch.push_ray([0.0, 0.0, 5.0], up, f32::INFINITY, NO_PRIM, 0);
    batch.push_ray([0.0, 0.0, 5.0], up, 4.5, NO_PRIM, 0);
    batch.push_segment([0.0, 0.0, 1.0], [0.0, 0.0, 2.0], NO_PRIM, NO_PRIM, 0);
    let want = [(2, 1.0), (0, 0.5), (6, 4.5), (NO_PRIM, f64::INFINITY), (NO_PRIM, f64::INFINITY)];
    assert_eq!(closest(&brute, &batch), want);
}

#[test]
fn the_last_and_a_flat_first_are_skipped_a_curved_first_is_not() {
    let sphere = Shape::Sphere { center: [0.0, 0.0, 1.0], radius: 0.25 };
    let disk = Shape::Disk { center: [0.0, 0.0, 2.0], normal: [0.0, 0.0, 1.0], radius: 1.0 };
    let geometries = [Geometry::Shapes(vec![sphere, disk]), two_layers()];
    let instances = [instance(0, None, false), instance(1, lifted(2.0), false)];
    let brute = Brute::new(&geometries, &instances, None);
    let prim_of = |first: PrimId, last: PrimId| {
        let mut batch = SegmentBuffer::default();
        batch.push_segment([0.0; 3], [0.0, 0.0, 3.5], first, last, 0);
        closest(&brute, &batch)[0].0
    };
    assert_eq!(prim_of(NO_PRIM, NO_PRIM), 0);
    assert_eq!(prim_of(0, NO_PRIM), 0);
    assert_eq!(prim_of(NO_PRIM, 0), 1);
    assert_eq!(prim_of(1, 0), 2);
    assert_eq!(prim_of(2, 0), 1);
}

/// Even numbers go through what lies below the diagonal.
struct Half;

impl Passes for Half {
    fn passes(&self, number: u32, _: PrimId, uv: [f32; 2]) -> bool {
        number.is_multiple_of(2) && uv[0] + uv[1] < 0.5
    }
}

#[test]
fn masks_are_asked_where_they_are_set() {
    let geometries = [two_layers()];
    let mut batch = SegmentBuffer::default();
    for number in 0..2 {
        batch.push_ray([-0.5, -0.5, 0.0], [0.0, 0.0, 1.0], f32::INFINITY, NO_PRIM, number);
        batch.push_ray([0.75, 0.75, 0.0], [0.0, 0.0, 1.0], f32::INFINITY, NO_PRIM, number);
    }
    let prims = |masked: bool, passes: Option<&dyn Passes>| {
        let instances = [instance(0, None, masked), instance(0, lifted(4.0), false)];
        let brute = Brute::new(&geometries, &instances, passes);
        closest(&brute, &batch).into_iter().map(|(prim, _)| prim).collect::<Vec<_>>()
    };
    assert_eq!(prims(true, Some(&Half)), [2, 0, 0, 0]);
    assert_eq!(prims(false, Some(&Half)), [0; 4]);
    assert_eq!(prims(true, None), [0; 4]);
}

#[test]
fn impossible_questions_are_not_blocked() {
    let geometries = [two_layers()];
    let brute_instances = [instance(0, None, false), instance(7, None, false)];
    let brute = Brute::new(&geometries, &brute_instances, None);
    let mut batch = SegmentBuffer::default();
    batch.push_segment([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], NO_PRIM, NO_PRIM, 0);
    batch.push_segment([f32::NAN, 0.0, 0.0], [0.0, 0.0, 3.0], NO_PRIM, NO_PRIM, 0);
    batch.push_ray([0.0; 3], [0.0, 0.0, f32::INFINITY], 1.0, NO_PRIM, 0);
    batch.push_ray([0.0; 3], [0.0, 0.0, 1.0], f32::NAN, NO_PRIM, 0);
    assert!(closest(&brute, &batch).iter().all(|(prim, _)| *prim == NO_PRIM));
}
