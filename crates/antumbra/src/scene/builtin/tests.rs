//! Laws of the built-in scenes and of the meshes that they are made of.

use std::collections::HashMap;

use antumbra_math::{DVec3, World};
use antumbra_trace::{Shape, Triangles};

use super::noise::TURN;
use super::solids::{ball, cuboid, joined, lathe, rounded_box, sheet, smooth_mesh, torus, tube};
use super::{Builtin, SCENES, Values, build, default_sky, eclipse, find};
use crate::bsdf::{Bsdf, Diffuse};
use crate::light::Light;
use crate::scene::{Body, SceneBuilder};

/// Number of the scene's triangles, each object counted.
fn triangles(scene: &SceneBuilder) -> usize {
    let count = |body: &Body| match body {
        Body::Mesh(m) => scene.meshes[*m as usize].triangles.indices.len(),
        Body::Shape(_) => 0,
    };
    scene.objects.iter().map(|o| count(&o.body)).sum()
}

fn default(name: &str) -> SceneBuilder {
    build(name, &[]).unwrap()
}

/// Parameters whose largest value makes a scene too big for a quick test, and the value that stands for it.
const SMALLER: [(&str, f64); 2] = [("boxes", 2_000.0), ("triangles", 50_000.0)];

/// The scene with every parameter at its default, and with each at either end.
fn variants(scene: &Builtin) -> Vec<SceneBuilder> {
    let mut all = vec![build(scene.name, &[]).unwrap()];
    for p in scene.parameters {
        let high = SMALLER.iter().find(|(n, _)| *n == p.name).map_or(p.high, |(_, v)| *v);
        for value in [p.low, high] {
            all.push(build(scene.name, &[(p.name.into(), value)]).unwrap());
        }
    }
    all
}

/// Each edge is used once in each direction: no hole, no flap, all fronts on the same side.
fn is_closed(body: &Triangles) -> bool {
    let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
    for [a, b, c] in &body.indices {
        for (from, to) in [(*a, *b), (*b, *c), (*c, *a)] {
            *edges.entry((from, to)).or_default() += 1;
            *edges.entry((to, from)).or_default() += 0;
        }
    }
    !edges.is_empty() && edges.values().all(|n| *n == 1)
}

/// Volume inside a closed mesh: above 0 if its fronts look outwards.
fn volume(body: &Triangles) -> f64 {
    let corners = (0..body.indices.len()).map(|i| body.corners(i).map(|c| DVec3::from(c.map(f64::from))));
    corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

#[test]
fn closed_solids_are_closed_and_look_outwards() {
    let ring: Vec<DVec3> = (0..9).map(|i| DVec3::new(f64::from(i), 0.1 * f64::from(i * i), 0.0)).collect();
    let solids = [
        ("cuboid", cuboid(DVec3::NEG_ONE, DVec3::ONE), 8.0, 1e-6),
        ("ball", ball(32, |d| d), 4.18879, 0.01),
        ("rounded box", rounded_box(DVec3::new(1.0, 2.0, 0.5), 0.1, 3), 7.9413, 0.005),
        ("cylinder", lathe(&[(0.0, 0.0), (1.0, 0.0), (1.0, 2.0), (0.0, 2.0)], 64), TURN, 0.02),
        ("torus", torus(2.0, 0.5, 64, 32), 9.8696, 0.1),
        ("tube", tube(&ring, |_| 0.2, 12), 1.27, 0.15),
    ];
    for (name, body, expected, tolerance) in solids {
        assert!(is_closed(&body), "{name} has a hole");
        // The tolerances hold the difference between a round body and its facets.
        let volume = volume(&body);
        assert!((volume - expected).abs() <= tolerance, "{name}: volume {volume}, expected {expected}");
    }
}

#[test]
fn solids_have_the_number_of_triangles_that_they_say() {
    assert_eq!(ball(5, |d| d).indices.len(), 12 * 25);
    assert_eq!(rounded_box(DVec3::ONE, 0.1, 3).indices.len(), 12 * 49);
    assert_eq!(sheet(7, 3, |u, v| DVec3::new(u, v, 0.0)).indices.len(), 42);
    let two = joined([cuboid(DVec3::ZERO, DVec3::ONE), cuboid(DVec3::ONE, DVec3::splat(2.0))]);
    assert_eq!((two.indices.len(), two.vertices.len()), (24, 16));
}

#[test]
fn smooth_normals_of_a_ball_are_its_directions() {
    let mesh = smooth_mesh("ball", ball(24, |d| d));
    for (p, n) in mesh.triangles.vertices.iter().zip(mesh.normals.unwrap()) {
        // Facets of 3.75° may tilt the mean of their normals by a part of that.
        assert!(World::from(*p).dot(World::from(n)) > 0.999, "{p:?} {n:?}");
    }
}

#[test]
fn every_scene_is_sound_at_default_and_at_the_ends_of_its_parameters() {
    for scene in SCENES {
        for made in variants(scene) {
            assert_eq!(made.name, scene.name);
            assert!(!scene.shows.is_empty() && !scene.shows.contains('!'), "{}", scene.name);
            assert!(!made.objects.is_empty() && !made.lights.is_empty(), "{}", scene.name);
            for mesh in &made.meshes {
                let vertices = &mesh.triangles.vertices;
                assert!(vertices.iter().flatten().all(|x| x.is_finite()), "{} {}", scene.name, mesh.name);
                let n = vertices.len() as u32;
                assert!(
                    mesh.triangles.indices.iter().flatten().all(|i| *i < n),
                    "{} {}",
                    scene.name,
                    mesh.name
                );
                assert!(mesh.normals.as_ref().is_none_or(|v| v.len() == vertices.len()));
                assert!(mesh.colors.as_ref().is_none_or(|v| v.len() == vertices.len()));
            }
            for object in &made.objects {
                assert!((object.material as usize) < made.materials.len());
            }
            for (name, light) in &made.lights {
                assert_eq!(light.fault(), None, "{} {name}", scene.name);
            }
        }
    }
}

#[test]
fn cameras_look_at_something_from_outside_of_it() {
    for scene in SCENES {
        let made = default(scene.name);
        let camera = &made.cameras[0];
        assert!(camera.size.is_some(), "{}", scene.name);
        let ahead = camera.look_at - camera.eye;
        assert!(ahead.length() > 0.0 && ahead.cross(camera.up).length() > 1e-3, "{}", scene.name);
        let (low, high) = bounds(&made);
        let inside = |p: DVec3| p.cmpge(low).all() && p.cmple(high).all();
        assert!(inside(camera.look_at), "{}: {} is not in {low} … {high}", scene.name, camera.look_at);
    }
}

/// The box around all objects.
fn bounds(scene: &SceneBuilder) -> (DVec3, DVec3) {
    let mut corners = Vec::new();
    let mut around = |center: [f32; 3], r: f32| {
        let center = DVec3::from(center.map(f64::from));
        corners.extend([center - f64::from(r), center + f64::from(r)]);
    };
    for object in &scene.objects {
        match &object.body {
            Body::Mesh(m) => {
                scene.meshes[*m as usize].triangles.vertices.iter().for_each(|v| around(*v, 0.0))
            }
            Body::Shape(Shape::Sphere { center, radius } | Shape::Disk { center, radius, .. }) => {
                around(*center, *radius);
            }
            Body::Shape(Shape::Cylinder { p, q, radius }) => [p, q].iter().for_each(|c| around(**c, *radius)),
        }
    }
    let all = |pick: fn(DVec3, DVec3) -> DVec3| corners.iter().copied().reduce(pick).unwrap_or_default();
    (all(DVec3::min), all(DVec3::max))
}

#[test]
fn some_light_shines_on_what_the_camera_looks_at() {
    for scene in SCENES {
        let made = default(scene.name);
        let camera = &made.cameras[0];
        // What lies there may face anywhere.
        let shines = |n: World| {
            let at = crate::receiver::Receiver {
                p: camera.look_at.as_vec3(),
                ng: n,
                frame: antumbra_math::Frame::about(n),
                ..bare(Bsdf::Diffuse(Diffuse { albedo: antumbra_math::Rgb::WHITE }))
            };
            made.lights.iter().any(|(_, l)| l.irradiance(&at) > 0.0)
        };
        let facings = [World::X, World::Y, World::Z].into_iter().flat_map(|n| [n, -n]);
        assert!(facings.into_iter().any(shines), "{}", scene.name);
    }
}

#[test]
fn large_scenes_have_the_triangles_that_they_promise() {
    assert_eq!(triangles(&default("pillars")), 98);
    assert_eq!(triangles(&default("terrain")), 31_250);
    assert_eq!(triangles(&default("hall")), 1_200_012);
    let interior = triangles(&default("interior"));
    assert!((300_000..600_000).contains(&interior), "{interior}");
    let scan = triangles(&default("scan"));
    assert!((2_050_000..2_150_000).contains(&scan), "{scan}");
    assert_eq!(default("many-lights").lights.len(), 400);
}

#[test]
fn boxes_of_the_hall_and_the_stone_are_closed() {
    let hall = build("hall", &[("boxes".into(), 600.0)]).unwrap();
    assert_eq!(triangles(&hall), 12 + 600 * 12);
    for mesh in &hall.meshes {
        assert!(is_closed(&mesh.triangles), "{}", mesh.name);
    }
    let scan = build("scan", &[("triangles".into(), 12_000.0)]).unwrap();
    let stone = scan.meshes.iter().find(|m| m.name == "stone").unwrap();
    assert!(is_closed(&stone.triangles) && volume(&stone.triangles) > 0.0);
}

#[test]
fn eclipse_has_true_distances() {
    use antumbra_math::real;
    let total = |distance: f64| {
        let scene = build("eclipse", &[("distance".into(), distance)]).unwrap();
        let moon = scene.objects.iter().find(|o| o.name == "moon").unwrap();
        let Body::Shape(Shape::Sphere { center, radius }) = moon.body else { panic!("the moon is a sphere") };
        let Some((_, Light::Sphere(sun))) = scene.lights.first() else { panic!("the sun is a sphere") };
        // f32 holds the moon's distance to 1/64 km and the sun's to 8 km.
        assert!((f64::from(center[0]) - distance).abs() < 0.04);
        assert!((f64::from(sun.center.x) - eclipse::UNIT).abs() <= 8.0);
        // Seen from where the sun stands overhead.
        let half_angle = |r: f32, d: f32| real::asin(f64::from(r) / (f64::from(d) - eclipse::EARTH));
        half_angle(radius, center[0]) > half_angle(sun.radius, sun.center.x)
    };
    assert!(total(356_500.0) && !total(406_700.0));
    // The umbra ends where both have the same angle: D r / (R − r) behind the moon (similar triangles).
    let length = (eclipse::UNIT - 380_000.0) * eclipse::MOON / (eclipse::SUN - eclipse::MOON);
    assert!(total(length + eclipse::EARTH - 600.0) && !total(length + eclipse::EARTH + 600.0));
}

#[test]
fn the_umbra_of_the_lowest_ball_reaches_the_floor_and_that_of_the_highest_does_not() {
    use antumbra_math::real;
    let scene = default("antumbra");
    let Some((_, Light::Disk(light))) = scene.lights.first() else { panic!("the light is a disk") };
    let lamp = light.center.as_dvec3();
    // On the floor, in the middle of a ball's shadow: the disk of the light against the ball that covers it.
    let covers = |center: [f32; 3], radius: f32| {
        let ball = DVec3::from(center.map(f64::from));
        let along = (ball - lamp) / (ball.y - lamp.y);
        let floor = ball - along * ball.y;
        let half_angle = real::asin(f64::from(radius) / (ball - floor).length());
        half_angle - real::atan(f64::from(light.radius) / (lamp - floor).length())
    };
    let margins: Vec<f64> = scene
        .objects
        .iter()
        .filter_map(|o| match o.body {
            Body::Shape(Shape::Sphere { center, radius }) => Some(covers(center, radius)),
            _ => None,
        })
        .collect();
    assert_eq!(margins.len(), 5);
    assert!(margins.windows(2).all(|pair| pair[0] > pair[1]), "{margins:?}");
    assert!(margins[1] > 0.0 && margins[3] < 0.0, "{margins:?}");
}

#[test]
fn wrong_names_and_values_are_told_with_a_way_out() {
    let error = |name: &str, set: &[(&str, f64)]| {
        let set: Vec<_> = set.iter().map(|(n, v)| ((*n).to_string(), *v)).collect();
        build(name, &set).err().map(|e| format!("{e} {}", e.hint)).unwrap_or_default()
    };
    assert!(error("pilars", &[]).contains("did you mean \"pillars\"?"));
    assert!(!error("xyzzy", &[]).contains("did you mean"));
    assert!(error("xyzzy", &[]).contains("cornell-box"));
    assert!(error("pillars", &[("lightsize", 1.0)]).contains("did you mean \"light-size\"?"));
    assert!(error("terrain", &[("size", 1.0)]).contains("It has none."));
    assert!(error("pillars", &[("light-size", -1.0)]).contains("outside 0.001 … 4"));
    assert!(error("pillars", &[("light-size", f64::NAN)]).contains("outside"));
    assert!(error("many-lights", &[("lights", 2.5)]).contains("not a whole number"));
    assert!(build("pillars", &[("light_size".into(), 0.5)]).is_ok());
}

#[test]
fn names_and_defaults_fit_each_other() {
    for scene in SCENES {
        assert_eq!(find(scene.name).unwrap().name, scene.name);
        for p in scene.parameters {
            assert!(p.low <= p.default && p.default <= p.high, "{} {}", scene.name, p.name);
        }
        let values = Values(scene.parameters.iter().map(|p| (p.name, p.default)).collect());
        assert!(scene.parameters.iter().all(|p| values.get(p.name) == p.default));
    }
}

#[test]
fn the_default_sky_is_soft_and_bright_enough() {
    let sky = default_sky();
    assert!(sky.is_environment() && sky.fault().is_none());
    let up =
        crate::receiver::Receiver { ..bare(Bsdf::Diffuse(Diffuse { albedo: antumbra_math::Rgb::WHITE })) };
    let irradiance = sky.irradiance(&up);
    assert!((1.5..2.6).contains(&irradiance), "{irradiance}");
}

/// A point at the origin that faces up.
fn bare(bsdf: Bsdf) -> crate::receiver::Receiver {
    let n = World::Y;
    let frame = antumbra_math::Frame::about(n);
    crate::receiver::Receiver {
        p: World::ZERO,
        start: [0.0; 3],
        beyond: [0.0; 3],
        prim: antumbra_trace::NO_PRIM,
        ng: n,
        frame,
        wo: antumbra_math::Local::new(0.0, 0.0, 1.0),
        bsdf,
        cell: 0,
        stream: 0,
        index: 0,
        throughput: antumbra_math::Rgb::WHITE,
        bounce: 0,
    }
}
