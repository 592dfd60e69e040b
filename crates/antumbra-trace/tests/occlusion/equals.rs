//! Fuzzed triangles, slivers, needles; receivers on their surfaces with the exact start, in their edges, anywhere and
//! nowhere; every number of directions, at all scales and SIMD levels.

use antumbra_math::{DMat3, DVec3, Transform};
use antumbra_trace::occlusion::{COUNTS, Directions, Method, OcclusionWork, Receiver};
use antumbra_trace::start::{start_free, start_on_triangle};
use antumbra_trace::{
    Bits, Brute, BuildOptions, Geometry, Instance, NO_PRIM, Passes, Pool, SegmentBuffer, Shape, SimdLevel,
    Triangles, Visibility, Ways, World,
};

use crate::meshes::{self, geometry};
use crate::rng::{Rng, amount, mix, to_f32, to_f64};

/// A third of all masked hits go through.
struct Third;

impl Passes for Third {
    fn passes(&self, number: u32, prim: u32, uv: [f32; 2]) -> bool {
        let bits = uv[0].to_bits() ^ uv[1].to_bits().rotate_left(13);
        (number.wrapping_mul(0x9e37_79b9) ^ prim.wrapping_mul(0x85eb_ca6b) ^ bits).is_multiple_of(3)
    }
}

fn flat(geometry: u32, masked: bool) -> Instance {
    Instance { geometry, transform: None, masked }
}

/// What `Brute` says of the rays of all receivers, as words.
fn truth(brute: &Brute<'_>, receivers: &[Receiver], directions: &Directions) -> Vec<u64> {
    let (mut rays, mut bits) = (SegmentBuffer::default(), Bits::default());
    receivers.iter().for_each(|at| at.rays(directions, &mut rays));
    brute.occluded(rays.as_segments(), &mut bits);
    let word = |w: usize| (0..64).fold(0, |m, k| m | u64::from(bits.get(64 * w + k)) << k);
    (0..rays.len() / 64).map(word).collect()
}

/// Asks every method at every level; what the last one of each took.
fn compare(
    name: &str,
    (geometries, instances): (&[Geometry], &[Instance]),
    receivers: &[Receiver],
    directions: &Directions,
) -> [OcclusionWork; 3] {
    let options = BuildOptions::default();
    let mut world = World::build(geometries.to_vec(), instances.to_vec(), &options, Pool::serial()).unwrap();
    let mut work = [OcclusionWork::default(); 3];
    for masked in [false, true] {
        if masked && !world.has_masks() {
            continue;
        }
        let brute = Brute::new(geometries, instances, masked.then_some(&Third as &dyn Passes));
        let expected = truth(&brute, receivers, directions);
        for level in SimdLevel::available() {
            world.set_level(level);
            for (k, method) in [Method::Occluders, Method::Receivers, Method::Rays].into_iter().enumerate() {
                let mut found = vec![7; 3];
                work[k] = if masked {
                    world.occlusion_masks_with(receivers, directions, method, &Third, &mut found)
                } else {
                    world.occlusion_masks(receivers, directions, method, &mut found)
                };
                assert_eq!(found.len(), expected.len());
                for (w, (a, b)) in found.iter().zip(&expected).enumerate() {
                    let at = &receivers[w / directions.words()];
                    let first = w % directions.words() * 64 + (a ^ b).trailing_zeros() as usize;
                    assert_eq!(a, b, "{name}, {method:?} at {level:?}, masks {masked}: {first} of {at:?}");
                }
            }
        }
    }
    work
}

/// Receivers on the triangles, at their corners and edges, and anywhere.
fn receivers(r: &mut Rng, mesh: &Triangles, n: usize, scale: f64, centre: [f64; 3]) -> Vec<Receiver> {
    (0..n as u32).map(|i| receiver(r, mesh, 1024 * i, scale, centre)).collect()
}

fn receiver(r: &mut Rng, mesh: &Triangles, number: u32, scale: f64, centre: [f64; 3]) -> Receiver {
    let prim = r.below(mesh.indices.len() as u64) as u32;
    let c = mesh.corners(prim as usize).map(to_f64);
    let p = mix(r.weights(), c);
    let turn = r.unit();
    match r.below(10) {
        // Corners, edges and faces without a start above them: half of the surface is in the plane of every ray's end.
        0 => Receiver::new(to_f32(p), NO_PRIM, number, r.direction(), turn),
        1 => {
            let q = r.cube(1.5 * scale);
            let axis = [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 1.0, 0.0]][r.below(3) as usize];
            Receiver::new(to_f32([0, 1, 2].map(|k| centre[k] + q[k])), NO_PRIM, number, axis, 0.0)
        }
        2 => {
            let q = r.cube(1e5 * scale);
            Receiver::new(to_f32([0, 1, 2].map(|k| centre[k] + q[k])), NO_PRIM, number, q.map(|x| -x), turn)
        }
        3 => {
            let bad = [f32::NAN, f32::INFINITY, 1e-44, 3e38, 0.0][r.below(5) as usize];
            let mut start = to_f32(p);
            start[r.below(3) as usize] = bad;
            let normal = [r.direction(), [0.0; 3], [f64::NAN; 3], [1e-300, 0.0, 0.0]][r.below(4) as usize];
            Receiver::new(start, prim, number, normal, turn)
        }
        4 => Receiver::new(start_free(p, [0.0, 1.0, 0.0]), NO_PRIM, number, [0.0, 1.0, 0.0], turn),
        _ => {
            let n = normal(c);
            let n = if r.below(2) == 0 { n } else { n.map(|x| -x) };
            Receiver::new(start_on_triangle(p, n, c), prim, number, n, turn)
        }
    }
}

/// Unit normal, (0, 0, 1) where there is none.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let (p, q) = (mix([1.0, -1.0], [b, a]), mix([1.0, -1.0], [c, a]));
    let n = DVec3::from(p).cross(DVec3::from(q));
    let largest = n.abs().max_element();
    if largest > 0.0 { (n / largest).normalize().to_array() } else { [0.0, 0.0, 1.0] }
}

/// Directions with rays of one length, without an end, or with a fall-off.
fn directions(r: &mut Rng, scale: f64) -> Directions {
    let count = COUNTS[r.below(COUNTS.len() as u64) as usize];
    let radius = ([0.02, 0.2, 0.7, 3.0][r.below(4) as usize] * scale) as f32;
    match r.below(4) {
        0 => Directions::new(count, |_| f32::INFINITY),
        1 => Directions::new(count, |u| radius * (1.0 - u).max(1e-3)),
        _ => Directions::new(count, |_| radius),
    }
    .unwrap()
}

fn hard_meshes(r: &mut Rng) -> Vec<(&'static str, Triangles)> {
    vec![
        ("soup", meshes::soup(r, 150, 0.3)),
        ("large soup", meshes::soup(r, 30, 3.0)),
        ("slivers", meshes::slivers(r, 100, 1e-7)),
        ("needles", meshes::slivers(r, 60, 0.0)),
        ("lattice", meshes::lattice(r, 100)),
        ("coplanar", meshes::coplanar(r, 60)),
        ("field", meshes::field(r, 8)),
        ("sphere", meshes::sphere(6)),
    ]
}

#[test]
fn every_method_equals_brute_at_all_scales() {
    let mut r = Rng::new(41);
    let placements = [
        (1.0, [0.0; 3]),
        (1e-6, [0.0; 3]),
        (1e6, [0.0; 3]),
        (1.0, [1000.0, -500.0, 3000.0]),
        (1e-3, [1.0, 1.0, 1.0]),
        (2f64.powi(66), [0.0; 3]),
        (2f64.powi(-100), [0.0; 3]),
        (2f64.powi(-38), [0.0; 3]),
    ];
    for round in 0..amount(1, 40) {
        for (scale, by) in placements {
            for (name, mesh) in hard_meshes(&mut r) {
                let mesh = meshes::moved(&mesh, scale, by);
                let asked = receivers(&mut r, &mesh, 6, scale, by);
                let directions = directions(&mut r, scale);
                let name = format!("{name} × {scale:e} + {by:?}, round {round}");
                compare(&name, (&[geometry(mesh)], &[flat(0, false)]), &asked, &directions);
            }
        }
    }
}

#[test]
fn masks_shapes_and_instances_are_asked() {
    let mut r = Rng::new(42);
    for _ in 0..amount(3, 60) {
        let (soup, field) = (meshes::soup(&mut r, 60, 0.4), meshes::field(&mut r, 5));
        let sphere = Shape::Sphere { center: to_f32(r.cube(1.0)), radius: 0.3 };
        let disk = Shape::Disk { center: to_f32(r.cube(1.0)), normal: [0.0, 1.0, 0.2], radius: 0.4 };
        let all = [geometry(soup.clone()), geometry(field), Geometry::Shapes(vec![sphere, disk])];
        let columns = [r.cube(1.0), r.cube(1.0), r.cube(1.0)].map(DVec3::from_array);
        let map = Transform {
            linear: DMat3::from_cols(columns[0], columns[1], columns[2]),
            translation: DVec3::from_array(r.cube(1.0)),
        };
        let placed = Instance { geometry: 0, transform: Some(map), masked: r.below(2) == 0 };
        let asked = receivers(&mut r, &soup, 10, 1.0, [0.0; 3]);
        let directions = directions(&mut r, 1.0);
        compare("masked", (&all, &[flat(0, true), flat(1, false)]), &asked, &directions);
        compare("mixed", (&all, &[flat(0, false), flat(2, false), placed]), &asked, &directions);
        compare("shapes alone", (&all, &[flat(2, false), placed]), &asked, &directions);
        compare("nothing", (&all, &[]), &asked, &directions);
    }
}

#[test]
fn the_table_leaves_few_directions_open() {
    let mut r = Rng::new(43);
    let mesh = meshes::soup(&mut r, 400, 0.1);
    let asked: Vec<Receiver> =
        (0..100).map(|i| Receiver::new(to_f32(r.cube(0.8)), NO_PRIM, i, r.direction(), r.unit())).collect();
    let directions = Directions::new(256, |_| 0.6).unwrap();
    let work = compare("soup", (&[geometry(mesh)], &[flat(0, false)]), &asked, &directions);
    for work in &work[..2] {
        // 256 for each pair without the table; without the bins no triangle lies between.
        assert!(work.in_range > 1000 && work.tested < 20 * work.in_range, "{work:?}");
        assert!(work.between > work.in_range / 20, "{work:?}");
        assert!(work.rays == 0 && work.law < work.tested / 100, "{work:?}");
    }
    assert_eq!(work[2].rays, 25_600);
}

#[test]
fn no_receiver_and_every_way_of_rays() {
    let mut r = Rng::new(44);
    let (mesh, directions) = (meshes::field(&mut r, 6), Directions::new(64, |_| 1.0).unwrap());
    let all = [geometry(mesh.clone())];
    let mut world =
        World::build(all.to_vec(), vec![flat(0, false)], &BuildOptions::default(), Pool::serial()).unwrap();
    let (asked, mut out) = (receivers(&mut r, &mesh, 150, 1.0, [0.0; 3]), vec![1]);
    world.occlusion_masks(&[], &directions, Method::Occluders, &mut out);
    assert!(out.is_empty());
    let expected = truth(&Brute::new(&all, &[flat(0, false)], None), &asked, &directions);
    for ways in [Ways::Measured, Ways::Together, Ways::Packets, Ways::Walls, Ways::Alone] {
        world.set_ways(ways);
        world.occlusion_masks(&asked, &directions, Method::Rays, &mut out);
        assert_eq!(out, expected);
    }
}
