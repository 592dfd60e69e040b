//! World = Brute, bit for bit: any hit, closest hit with t and identity, masks, instances, shapes, at every SIMD level.

use antumbra_math::{DMat3, DVec3, Transform};
use antumbra_trace::{
    Bits, Brute, BuildOptions, Geometry, Hits, Instance, Passes, Pool, Segments, Shape, SimdLevel, Triangles,
    Visibility, Ways, World,
};

use crate::meshes::{self, geometry};
use crate::questions::{bundles, questions};
use crate::rng::{Rng, amount, to_f32};

/// A third of all masked hits go through.
struct Third;

impl Passes for Third {
    fn passes(&self, number: u32, prim: u32, uv: [f32; 2]) -> bool {
        let bits = uv[0].to_bits() ^ uv[1].to_bits().rotate_left(13);
        (number.wrapping_mul(0x9e37_79b9) ^ prim.wrapping_mul(0x85eb_ca6b) ^ bits).is_multiple_of(3)
    }
}

/// An instance that is where its numbers say.
fn flat(geometry: u32, masked: bool) -> Instance {
    Instance { geometry, transform: None, masked }
}

/// Every level in every way that any-hit queries may go.
fn levels_and_ways() -> impl Iterator<Item = (SimdLevel, Ways)> {
    let ways = [Ways::Measured, Ways::Together, Ways::Packets, Ways::Walls, Ways::Alone];
    SimdLevel::available().into_iter().flat_map(move |level| ways.map(|ways| (level, ways)))
}

/// Asks both and compares every bit.
fn compare(name: &str, geometries: &[Geometry], instances: &[Instance], asked: Segments<'_>) {
    let built =
        World::build(geometries.to_vec(), instances.to_vec(), &BuildOptions::default(), Pool::serial());
    let mut world = built.unwrap();
    for masked in [false, true] {
        if masked && !world.has_masks() {
            continue;
        }
        let brute = Brute::new(geometries, instances, masked.then_some(&Third as &dyn Passes));
        let (mut bits, mut hits) = (Bits::default(), Hits::default());
        brute.occluded(asked, &mut bits);
        brute.nearest(asked, &mut hits);
        if !masked {
            let (mut b, mut h, mut work) = (Bits::default(), Hits::default(), Vec::new());
            world.occluded_counted(asked, &mut b, &mut work);
            world.nearest_counted(asked, &mut h, &mut work);
            assert!(b == bits && h == hits && work.len() == asked.len(), "{name}: counted queries differ");
        }
        for (level, ways) in levels_and_ways() {
            world.set_level(level);
            world.set_ways(ways);
            // Closest hits go one way only.
            let nearest = ways == Ways::Measured;
            let mut b = Bits::default();
            let mut h = if nearest { Hits::default() } else { hits.clone() };
            if masked {
                world.with_passes(&Third).occluded(asked, &mut b);
            } else {
                world.occluded(asked, &mut b);
            }
            if nearest && masked {
                world.with_passes(&Third).nearest(asked, &mut h);
            } else if nearest {
                world.nearest(asked, &mut h);
            }
            for i in 0..asked.len() {
                let what = || {
                    let (o, e, reach) = (asked.origin_at(i), asked.end_at(i), asked.reach[i]);
                    format!(
                        "{name} at {level:?}, {ways:?}, masks asked: {masked}: {i}: {o:?} {e:?} {reach:?}"
                    )
                };
                assert_eq!(b.get(i), bits.get(i), "any hit: {}", what());
                assert_eq!(h.prim[i], hits.prim[i], "closest: {}", what());
                assert_eq!(h.t[i].to_bits(), hits.t[i].to_bits(), "t: {}", what());
                assert_eq!(h.uv[i].map(f32::to_bits), hits.uv[i].map(f32::to_bits), "uv: {}", what());
            }
        }
    }
}

fn hard_meshes(r: &mut Rng) -> Vec<(&'static str, Triangles)> {
    vec![
        ("soup", meshes::soup(r, 200, 0.3)),
        ("large soup", meshes::soup(r, 60, 3.0)),
        ("slivers", meshes::slivers(r, 150, 1e-7)),
        ("needles", meshes::slivers(r, 150, 0.0)),
        ("lattice", meshes::lattice(r, 150)),
        ("coplanar", meshes::coplanar(r, 100)),
        ("field", meshes::field(r, 10)),
        ("sphere", meshes::sphere(8)),
    ]
}

#[test]
fn flat_meshes_at_all_scales() {
    let mut r = Rng::new(1);
    let placements = [
        (1.0, [0.0; 3]),
        (1e-6, [0.0; 3]),
        (1e6, [0.0; 3]),
        (1.0, [1000.0, -500.0, 3000.0]),
        (1e-3, [1.0, 1.0, 1.0]),
        (1e20, [0.0; 3]),
        (1e-30, [0.0; 3]),
    ];
    for (scale, by) in placements {
        for (name, mesh) in hard_meshes(&mut r) {
            let mesh = meshes::moved(&mesh, scale, by);
            let asked = questions(&mut r, &mesh, amount(700, 20_000), scale, by, 0);
            let together = bundles(&mut r, &mesh, amount(3, 300), scale, by, 0);
            let name = format!("{name} × {scale:e} + {by:?}");
            let (geometries, instances) = ([geometry(mesh)], [flat(0, false)]);
            compare(&name, &geometries, &instances, asked.as_segments());
            compare(&format!("{name}, bundles"), &geometries, &instances, together.as_segments());
        }
    }
}

#[test]
fn several_flat_instances_with_masks() {
    let mut r = Rng::new(2);
    for _ in 0..amount(4, 40) {
        let all = [meshes::soup(&mut r, 90, 0.4), Triangles::default(), meshes::field(&mut r, 7)];
        let geometries = all.clone().map(geometry);
        let instances =
            [flat(1, true), flat(0, true), flat(1, false), flat(2, false), flat(0, false), flat(1, false)];
        let asked = questions(&mut r, &all[0], 1500, 1.0, [0.0; 3], 0);
        compare("flat instances", &geometries, &instances, asked.as_segments());
        let asked = bundles(&mut r, &all[0], 4, 1.0, [0.0; 3], 0);
        compare("flat instances, bundles", &geometries, &instances, asked.as_segments());
    }
}

fn shapes(r: &mut Rng, n: usize) -> Vec<Shape> {
    let shape = |r: &mut Rng| {
        let (p, q) = (to_f32(r.cube(1.0)), to_f32(r.cube(1.0)));
        let radius = r.range(0.01, 0.3) as f32;
        match r.below(3) {
            0 => Shape::Sphere { center: p, radius },
            1 => Shape::Disk { center: p, normal: q, radius },
            _ => Shape::Cylinder { p, q, radius },
        }
    };
    (0..n).map(|_| shape(r)).collect()
}

fn random_map(r: &mut Rng) -> Transform {
    let column = |r: &mut Rng| DVec3::from_array(r.cube(1.5));
    let linear = match r.below(6) {
        // Nearly singular, singular, tiny: what files hold.
        0 => DMat3::from_cols(column(r), column(r), DVec3::new(1e-13, 0.0, 0.0)),
        1 => DMat3::from_cols(column(r), DVec3::ZERO, column(r)),
        2 => DMat3::from_diagonal(DVec3::from_array(r.cube(1e-7))),
        _ => DMat3::from_cols(column(r), column(r), column(r)),
    };
    Transform { linear, translation: DVec3::from_array(r.cube(3.0)) }
}

#[test]
fn shapes_and_instances() {
    let mut r = Rng::new(3);
    for round in 0..amount(12, 80) {
        let (soup, field) = (meshes::soup(&mut r, 40, 0.5), meshes::field(&mut r, 4));
        let list = shapes(&mut r, 30);
        let geometries = [geometry(soup.clone()), Geometry::Shapes(list), geometry(field)];
        let mut instances = vec![flat(1, round % 2 == 0), flat(2, false)];
        for _ in 0..15 {
            let transform = (r.below(5) > 0).then(|| random_map(&mut r));
            let (geometry, masked) = (r.below(3) as u32, r.below(4) == 0);
            instances.push(Instance { geometry, transform, masked });
        }
        let asked = questions(&mut r, &soup, 800, 2.0, [0.0; 3], 0);
        compare("shapes and instances", &geometries, &instances, asked.as_segments());
        // Aimed at where an instance is, with primitives of it to skip.
        let Some(k) = instances.iter().position(|i| i.geometry == 0 && i.transform.is_some()) else {
            continue;
        };
        let base: usize = instances[..k].iter().map(|i| geometries[i.geometry as usize].len()).sum();
        let Some(map) = instances[k].transform else { continue };
        let image = |v: &[f32; 3]| to_f32(map.point(DVec3::from_array(v.map(f64::from))).to_array());
        let world = Triangles { vertices: soup.vertices.iter().map(image).collect(), ..soup };
        let centre = map.translation.to_array();
        let asked = questions(&mut r, &world, 800, 1.0, centre, base as u32);
        compare("aimed at an instance", &geometries, &instances, asked.as_segments());
    }
}
