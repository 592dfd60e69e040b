//! LAW §7, attack 3, through the whole tree: exact rays along box faces and through box corners, tiny direction
//! components, thin boxes, far origins. What the law says is hit, the boxes must let through.

use antumbra_trace::law::{self, Line};
use antumbra_trace::{
    Bits, BuildOptions, Hits, Instance, NO_PRIM, Pool, SegmentBuffer, SimdLevel, Triangles, Visibility, World,
};

use crate::meshes::{self, geometry};
use crate::rng::{Rng, amount};

/// One triangle among distant others, so that its own box is a node's.
fn surrounded(corners: [[f32; 3]; 3], scale: f32) -> Triangles {
    let mut all = vec![corners];
    for k in 0..24 {
        let x = (40.0 + 8.0 * k as f32) * scale;
        all.push([[x, x, x], [x + scale, x, x], [x, x + scale, x]]);
    }
    meshes::loose(&all)
}

fn asks_like_the_law(mesh: &Triangles, asked: &SegmentBuffer) {
    let instance = Instance { geometry: 0, transform: None, masked: false };
    let geometries = vec![geometry(mesh.clone())];
    let built = World::build(geometries, vec![instance], &BuildOptions::default(), Pool::serial());
    let mut world = built.unwrap();
    let segments = asked.as_segments();
    for level in SimdLevel::available() {
        world.set_level(level);
        let (mut bits, mut hits) = (Bits::default(), Hits::default());
        world.occluded(segments, &mut bits);
        world.nearest(segments, &mut hits);
        for i in 0..segments.len() {
            let line = Line::of(&segments, i);
            if law::triangle(&line, mesh.corners(0)).is_some() {
                assert!(bits.get(i) && hits.prim[i] != NO_PRIM, "{level:?}: {line:?} {:?}", mesh.corners(0));
            }
        }
    }
}

#[test]
fn whole_number_rays_through_box_corners() {
    let mut r = Rng::new(9);
    let whole = |r: &mut Rng, n: u64| [0, 1, 2].map(|_| r.below(2 * n + 1) as f32 - n as f32);
    for _ in 0..amount(300, 20_000) {
        let scale = libm::exp2(r.range(-60.0, 20.0).round()) as f32;
        let mut c = [whole(&mut r, 3), whole(&mut r, 3), whole(&mut r, 3)];
        if r.below(2) == 0 {
            // A thin box: flat along one axis.
            let axis = r.below(3) as usize;
            c.iter_mut().for_each(|p| p[axis] = 1.0);
        }
        let mesh = surrounded(c.map(|p| p.map(|x| x * scale)), scale);
        let mut asked = SegmentBuffer::default();
        for i in 0..60 {
            let to = c[r.below(3) as usize];
            let far = [1.0, 16.0, 262_144.0][r.below(3) as usize];
            let steps = whole(&mut r, 2);
            let o = [0, 1, 2].map(|k| (to[k] - far * steps[k]) * scale);
            let mut d = steps;
            let k = r.below(3) as usize;
            d[k] += [0.0, 0.0, libm::exp2f(-60.0), -libm::exp2f(-70.0), 1e-40][r.below(5) as usize];
            asked.push_ray(o, d, f32::INFINITY, NO_PRIM, i);
            asked.push_segment(
                o,
                [0, 1, 2].map(|k| o[k] + 2.0 * far * steps[k] * scale),
                NO_PRIM,
                NO_PRIM,
                i,
            );
        }
        asks_like_the_law(&mesh, &asked);
    }
}

#[test]
fn the_counterexample_of_the_older_law_misses() {
    let u = f32::EPSILON;
    let corners = [[0.0; 3], [1.0; 3], [0.5 + u, 0.5, 0.5]];
    let mut asked = SegmentBuffer::default();
    asked.push_ray([1.0 + 4.0 * u, 1.0 + 4.0 * u, -15.0], [0.0, 0.0, 1.0], f32::INFINITY, NO_PRIM, 0);
    let instance = Instance { geometry: 0, transform: None, masked: false };
    let geometries = vec![geometry(meshes::loose(&[corners]))];
    let world = World::build(geometries, vec![instance], &BuildOptions::default(), Pool::serial()).unwrap();
    let mut bits = Bits::default();
    world.occluded(asked.as_segments(), &mut bits);
    assert_eq!(bits.count(), 0);
}
