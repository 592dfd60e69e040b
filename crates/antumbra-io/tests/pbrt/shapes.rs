//! Shapes: which side is the front, how large they are, where their points lie.

use antumbra::math::{DVec3, Vec3, real};
use antumbra::scene::{Body, Object, SceneBuilder};

use crate::{ball, world};

const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]\n";

/// Normal of the first triangle of an object in the world, of length twice its area.
fn front(scene: &SceneBuilder, object: usize) -> Vec3 {
    let Object { body: Body::Mesh(mesh), transform, .. } = &scene.objects[object] else { panic!() };
    let triangles = &scene.meshes[*mesh as usize].triangles;
    let [a, b, c] = triangles.indices[0].map(|i| triangles.vertices[i as usize].map(f64::from));
    let [a, b, c] = [a, b, c].map(DVec3::from);
    transform.normal((b - a).cross(c - a)).as_vec3()
}

#[test]
fn the_front_is_where_the_corners_go_round_or_the_normals_point() {
    for (before, inside, up) in [
        ("", "", true),
        ("ReverseOrientation", "", false),
        // A mirrored surface keeps its outside.
        ("Scale 1 1 -1", "", false),
        ("Scale -1 1 1", "", true),
        ("", "\"normal N\" [ 0 0 -1  0 0 -1  0 0 -1 ]", false),
        ("ReverseOrientation", "\"normal N\" [ 0 0 -1  0 0 -1  0 0 -1 ]", true),
    ] {
        let s = world(&format!("{before} {} {inside}", TRIANGLE.trim_end()));
        assert_eq!(front(&s, 0).z > 0.0, up, "{before} {inside}");
    }
}

#[test]
fn objects_are_placed_where_each_instance_stands() {
    let s = world(
        "Translate 1 0 0 ObjectBegin \"thing\" Translate 0 1 0 Shape \"sphere\" ObjectEnd Shape \"sphere\"\n\
         ObjectInstance \"thing\" Translate 0 0 7 ObjectInstance \"thing\"",
    );
    assert_eq!(ball(&s.objects[0]).0, DVec3::X);
    let places: Vec<_> = s.objects[1..].iter().map(|o| o.transform.translation).collect();
    // The instance's transform comes after that of the object's definition.
    assert_eq!(places, [DVec3::new(2.0, 1.0, 0.0), DVec3::new(2.0, 1.0, 7.0)]);
    assert!(matches!((&s.objects[1].body, &s.objects[2].body), (Body::Mesh(a), Body::Mesh(b)) if a == b));
}

/// Φ = π A L, from both sides twice as much.
#[test]
fn the_power_of_a_surface_is_spread_over_it() {
    for (shape, area) in
        [(TRIANGLE.trim_end(), 0.5), ("Shape \"disk\" \"float radius\" 2", 4.0 * std::f64::consts::PI)]
    {
        for (twosided, sides) in [("false", 1.0), ("true", 2.0)] {
            let s = world(&format!(
                "Scale 3 3 3 AreaLightSource \"diffuse\" \"float power\" 100 \"bool twosided\" {twosided} {shape}"
            ));
            let emission = s.materials[s.objects[0].material as usize].emission.unwrap();
            let power = f64::from(emission.radiance.0[1]) * std::f64::consts::PI * 9.0 * area * sides;
            assert!((power - 100.0).abs() < 1e-3, "{shape} {power}");
            assert_eq!(emission.both_sides, twosided == "true");
        }
    }
}

/// A sphere's points lie on it, whatever part of it is swept, and its coordinates run from the lower pole to the upper.
#[test]
fn parts_of_round_shapes() {
    let s = world("Shape \"sphere\" \"float radius\" 2 \"float zmin\" -1 \"float phimax\" 90");
    let Body::Mesh(mesh) = s.objects[0].body else { panic!() };
    let mesh = &s.meshes[mesh as usize];
    for (v, uv) in mesh.triangles.vertices.iter().zip(mesh.uvs[0].as_ref().unwrap()) {
        let p = Vec3::from(*v);
        assert!((p.length() - 2.0).abs() < 1e-5 && p.x >= -1e-6 && p.y >= -1e-6 && p.z >= -1.0 - 1e-5, "{p}");
        let theta = real::acosf((p.z / 2.0).clamp(-1.0, 1.0));
        let (from, to) = (real::acosf(-0.5), 0.0);
        assert!((uv[1] - (theta - from) / (to - from)).abs() < 1e-3, "{p} {uv:?}");
    }
    for (shape, area) in [
        ("disk\" \"float radius\" 2 \"float innerradius\" 1", 3.0),
        ("disk\" \"float radius\" 2 \"float phimax\" 90", 1.0),
        ("cylinder\" \"float zmax\" 2 \"float phimax\" 180", 3.0),
    ] {
        let s = world(&format!("AreaLightSource \"diffuse\" \"float power\" 1 Shape \"{shape}"));
        let radiance = s.materials[s.objects[0].material as usize].emission.unwrap().radiance.0[0];
        let measured = 1.0 / (f64::from(radiance) * std::f64::consts::PI);
        assert!((measured / (area * std::f64::consts::PI) - 1.0).abs() < 1e-3, "{shape}: {measured}");
    }
}

#[test]
fn patches_are_flat_or_bent() {
    let s = world(
        "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ]\n\
         Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 1 ]",
    );
    assert_eq!((s.meshes[0].triangles.indices.len(), front(&s, 0).z > 0.0), (2, true));
    assert_eq!(s.meshes[1].triangles.indices.len(), 2 * 16 * 16);
    // z = u v.
    let on = |v: &[f32; 3]| (v[2] - v[0] * v[1]).abs() < 1e-6;
    assert!(s.meshes[1].triangles.vertices.iter().all(on));
}

/// An octahedron turns into something round; a flat patch stays flat, its corners move in.
#[test]
fn subdivision() {
    let octahedron = "\"point3 P\" [ 1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1 ]\n\
        \"integer indices\" [ 0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5 ]";
    let s = world(&format!("Shape \"loopsubdiv\" \"integer levels\" 3 {octahedron}"));
    let radii: Vec<f32> = s.meshes[0].triangles.vertices.iter().map(|v| Vec3::from(*v).length()).collect();
    assert_eq!(s.meshes[0].triangles.indices.len(), 8 * 64);
    let (least, most) =
        (radii.iter().copied().fold(9.0, f32::min), radii.iter().copied().fold(0.0, f32::max));
    // Corners and middles of faces of the octahedron itself differ by √3.
    assert!(most / least < 1.25 && most < 1.0, "{least} {most}");
    // A vertex of valence 4 goes to p (1 − 4w) + 4w · mean of its neighbours, whose mean is 0 here: w = 1/(4 + 3/(8β)),
    // β = 3/32, so to half of where it was, and subdividing does not move the limit.
    let first = |levels: u32| {
        let s = world(&format!("Shape \"loopsubdiv\" \"integer levels\" {levels} {octahedron}"));
        s.meshes[0].triangles.vertices[0][0]
    };
    assert!((first(0) - 0.5).abs() < 1e-6);
    assert!((first(1) - first(4)).abs() < 1e-5, "{} {}", first(1), first(4));
    assert!(front(&s, 0).dot(Vec3::from(s.meshes[0].triangles.vertices[0])) > 0.0);
}
