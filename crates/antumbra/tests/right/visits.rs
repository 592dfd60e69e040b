//! What segments visit: the answers of any hit, its counts never above those of closest hit where nothing is gained.

use antumbra::math::hash::{hash3, unit_f32};
use antumbra::query::{Visited, occluded, visits};
use antumbra::scene::builtin;
use antumbra::schedule::Flow;
use antumbra::trace::{NO_PRIM, SegmentBuffer};

/// Between random points of a box about the scene.
fn fill(range: std::ops::Range<usize>, out: &mut SegmentBuffer) {
    for i in range {
        let at = |k: u32| {
            let x = |axis: u32| unit_f32(hash3(i as u32, 3 * k + axis, 5));
            [4.0 * x(0) - 2.0, 2.2 * x(1), 4.0 * x(2) - 2.0]
        };
        out.push_segment(at(0), at(1), NO_PRIM, NO_PRIM, i as u32);
    }
}

/// The bits are those of `occluded`; a free segment visits what it must, whichever question is asked; a blocked one is
/// spared something by any hit, over all of them.
#[test]
fn any_hit_gains_on_blocked_segments_only() {
    for name in ["pillars", "corner", "antumbra"] {
        let scene = builtin::build(name, &[]).unwrap().build().unwrap();
        let n = 4000;
        let mut blocked = vec![false; n];
        occluded(&scene, &fill, 1, &mut blocked, &mut |_| Flow::Continue);
        let mut found = vec![Visited::default(); n];
        visits(&scene, &fill, 2, &mut found, &mut |_| Flow::Continue);
        let bits: Vec<bool> = found.iter().map(|v| v.blocked).collect();
        assert_eq!(bits, blocked, "{name}");
        let sum = |of: bool, count: &dyn Fn(&Visited) -> u32| {
            let some = found.iter().filter(|v| v.blocked == of);
            some.map(|v| u64::from(count(v))).sum::<u64>() as f64
        };
        let counts: [&dyn Fn(&Visited) -> u32; 4] =
            [&|v| v.any.boxes, &|v| v.closest.boxes, &|v| v.any.primitives, &|v| v.closest.primitives];
        let [free, shut] = [false, true].map(|of| counts.map(|count| sum(of, count)));
        println!("{name}: free {free:?}, blocked {shut:?} (boxes any, closest, primitives any, closest)");
        assert!(free[0] > 0.0 && free[0] == free[1] && free[2] == free[3], "{name}: {free:?}");
        assert!(shut[0] <= shut[1] && shut[2] < shut[3], "{name}: {shut:?}");
    }
}
