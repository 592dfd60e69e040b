//! The order in which many rays are asked does not change an answer.

use std::ops::Range;

use antumbra::query;
use antumbra::scene::builtin;
use antumbra::schedule::{self, Flow};
use antumbra::trace::{Bits, NO_PRIM, SegmentBuffer, Visibility};

/// Enough that the chunks are large enough to be put into an order.
const RAYS: usize = 1 << 20;

/// Numbers in [0, 1) without pattern: splitmix64.
fn unit(i: u64) -> f32 {
    let z = i.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
}

#[test]
fn the_order_of_rays_changes_no_answer() -> Result<(), String> {
    let builder = builtin::build("terrain", &[]).map_err(|e| e.to_string())?;
    let scene = schedule::build(builder, 2).map_err(|e| e.to_string())?;
    let fill = |run: Range<usize>, buffer: &mut SegmentBuffer| {
        for i in run {
            let [x, y, z, u, v, w] = [0, 1, 2, 3, 4, 5].map(|k| unit(6 * i as u64 + k));
            let from = [100.0 * (x - 0.5), 12.0 * y, 100.0 * (z - 0.5)];
            if i % 3 == 0 {
                buffer.push_segment(
                    from,
                    [100.0 * u - 50.0, 20.0 * v, 100.0 * w - 50.0],
                    NO_PRIM,
                    NO_PRIM,
                    0,
                );
            } else {
                buffer.push_ray(from, [u - 0.5, v - 0.5, w - 0.5], f32::INFINITY, NO_PRIM, 0);
            }
        }
    };
    let mut out = vec![false; RAYS];
    query::occluded(&scene, &fill, 2, &mut out, &mut |_| Flow::Continue);

    let (mut buffer, mut bits) = (SegmentBuffer::default(), Bits::default());
    fill(0..RAYS, &mut buffer);
    scene.visibility(false).occluded(buffer.as_segments(), &mut bits);
    let other = (0..RAYS).filter(|i| bits.get(*i) != out[*i]).count();
    assert_eq!(other, 0);
    assert!((0.1..0.9).contains(&(bits.count() as f64 / RAYS as f64)), "both answers occur");
    Ok(())
}
