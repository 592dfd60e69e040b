//! Each thing that looks wrong is said, and nothing of a scene that is well.

use antumbra_math::{DVec3, Rgb, Transform};
use antumbra_trace::Triangles;

use super::super::{Camera, Material, Mesh, Object, SceneBuilder, SceneMesh, Surface};
use super::*;

const CORNERS: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const OUTWARD: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

fn inward() -> Vec<[u32; 3]> {
    OUTWARD.map(|[a, b, c]| [a, c, b]).to_vec()
}

fn said(builder: SceneBuilder) -> Vec<String> {
    let scene = builder.build().unwrap();
    scene.looks_wrong(&scene.surfaces())
}

/// A tetrahedron of these triangles and this look, under a light that fits its size.
fn body(indices: Vec<[u32; 3]>, material: Material) -> SceneBuilder {
    let mut builder = SceneBuilder::new("body");
    let look = builder.material(material);
    builder.object("Body", Triangles { vertices: CORNERS.to_vec(), indices }, look);
    if builder.materials[0].emission.is_none() {
        builder.light("sky", crate::light::Environment::constant(Rgb::WHITE));
    }
    builder
}

fn grey(indices: Vec<[u32; 3]>) -> SceneBuilder {
    body(indices, Material::diffuse(Rgb::grey(0.5)))
}

#[test]
fn a_lamp_turned_inside_out_is_named() {
    let lamp = |indices| said(body(indices, Material::light(Rgb::WHITE)));
    assert_eq!(lamp(OUTWARD.to_vec()), Vec::<String>::new());
    assert_eq!(lamp(inward()), ["\"Body\" emits to the inside (normals flipped?)"]);
    // An open lamp has no inside.
    assert_eq!(lamp(vec![[0, 1, 2]]), Vec::<String>::new());
}

#[test]
fn a_body_turned_inside_out_is_named_and_a_room_is_not() {
    assert_eq!(said(grey(OUTWARD.to_vec())), Vec::<String>::new());
    assert_eq!(said(grey(inward())), ["\"Body\" is inside out (normals flipped?)"]);
    let mut room = grey(inward());
    room.cameras.push(Camera::perspective(DVec3::splat(0.2), DVec3::ZERO, 40.0));
    assert_eq!(said(room), Vec::<String>::new());
    let mut around = grey(inward());
    let small = CORNERS.map(|v| v.map(|c| 0.1 + c / 10.0)).to_vec();
    around.object("Inside", Triangles { vertices: small, indices: OUTWARD.to_vec() }, 0);
    assert_eq!(said(around), Vec::<String>::new());
}

#[test]
fn a_mirrored_body_keeps_its_front_outside() {
    let mut builder = grey(OUTWARD.to_vec());
    let mirror = |x: f64| Transform {
        linear: antumbra_math::DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)),
        translation: DVec3::new(x, 0.0, 0.0),
    };
    builder.objects[0].transform = mirror(0.0);
    assert_eq!(said(builder.clone()), Vec::<String>::new());
    // The same as instances, whose mesh stays as it is: enough of them that copies would be too many.
    let mesh = Mesh { triangles: sphere(128), ..Mesh::default() };
    builder.meshes[0] = mesh;
    for i in 1..10 {
        let object = Object { transform: mirror(4.0 * f64::from(i)), ..builder.objects[0].clone() };
        builder.objects.push(object);
    }
    assert_eq!(said(builder), Vec::<String>::new());
}

#[test]
fn triangles_twice_at_one_place_are_counted() {
    let found = said(grey(vec![[0, 1, 2], [1, 2, 0], [2, 1, 0], [0, 1, 3]]));
    assert_eq!(found, ["\"Body\" (1 edge) is flipped in part", "2 duplicate triangles"]);
    let mut twice = grey(OUTWARD.to_vec());
    twice.object("Twin", Triangles { vertices: CORNERS.to_vec(), indices: OUTWARD.to_vec() }, 0);
    assert_eq!(said(twice), ["\"Twin\" lies exactly where \"Body\" lies"]);
}

/// A sphere of 2·n·(n − 1) triangles about the origin, n ≥ 3 columns; every triangle with corners of its own.
fn sphere(n: u32) -> Triangles {
    let at = |i: u32, j: u32| {
        let [phi, theta] = [2.0 * f64::from(j % n) / f64::from(n), f64::from(i) / f64::from(n)]
            .map(|turns| turns * std::f64::consts::PI);
        use antumbra_math::real::{cos, sin};
        // The poles are one point each.
        let ring = if i == 0 || i == n { 0.0 } else { sin(theta) };
        [cos(phi) * ring, sin(phi) * ring, cos(theta)].map(|x| x as f32)
    };
    let mut out = Triangles::default();
    let mut add = |corners: [[f32; 3]; 3]| {
        let first = out.vertices.len() as u32;
        out.vertices.extend(corners);
        out.indices.push([first, first + 1, first + 2]);
    };
    for i in 0..n {
        for j in 0..n {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if i + 1 < n {
                add([a, b, c]);
            }
            if i > 0 {
                add([a, c, d]);
            }
        }
    }
    out
}

#[test]
fn a_soup_of_triangles_is_closed_where_corners_meet() {
    let whole = SceneMesh::from(Mesh { triangles: sphere(40), ..Mesh::default() }).surfaces();
    assert_eq!((whole.open_edges, whole.turned_edges, whole.duplicates), (0, 0, 0));
    assert_eq!(whole.edges, 3 * 2 * 40 * 39 / 2, "every edge has two triangles");
    let volume = whole.volume.unwrap();
    // Its 40 columns leave out (2π/40)²/6 of the sphere's volume, its 40 rings less.
    let share = volume / (4.0 * std::f64::consts::PI / 3.0);
    assert!((0.99..1.0).contains(&share), "{share}");
}

#[test]
fn holes_and_turned_triangles_are_told_with_their_edges() {
    let with = |change: fn(&mut Triangles)| {
        let mut builder = grey(Vec::new());
        let mut triangles = sphere(40);
        change(&mut triangles);
        builder.meshes[0].triangles = triangles;
        said(builder)
    };
    assert_eq!(with(|_| {}), Vec::<String>::new());
    let torn = with(|t| t.indices.truncate(t.indices.len() - 1));
    assert_eq!(torn, ["\"Body\" (3 edges) is closed but for a hole"]);
    let turned = with(|t| t.indices[50].swap(0, 1));
    assert_eq!(turned, ["\"Body\" (3 edges) is flipped in part"]);
    let flat = with(|t| t.indices.push([0, 0, 1]));
    assert_eq!(flat, ["1 triangle without area"]);
    let half = with(|t| t.indices.truncate(1500));
    assert_eq!(half, Vec::<String>::new(), "an open half is a bowl");
}

#[test]
fn open_glass_and_normals_on_the_back_are_told() {
    let surface = Surface::Dielectric(crate::bsdf::Dielectric::clear(1.5));
    let glass = Material { surface, ..Material::diffuse(Rgb::WHITE) };
    assert_eq!(said(body(vec![[0, 1, 2]], glass)), ["\"Body\" is glass and open: its rim has no other side"]);
    let mut builder = grey(OUTWARD.to_vec());
    let inward = CORNERS.map(|v| v.map(|c| 0.25 - c)).to_vec();
    builder.meshes[0].normals = Some(inward);
    assert_eq!(said(builder), ["4 triangles with shading normals on the back"]);
}

#[test]
fn sizes_that_cannot_be_meant_are_told() {
    let scaled = |by: f32, source: &str, more: &[([f32; 3], f32)]| {
        let mut builder = grey(OUTWARD.to_vec());
        builder.source = source.into();
        builder.meshes[0].triangles.vertices.iter_mut().for_each(|v| *v = v.map(|c| c * by));
        for (at, size) in more {
            let vertices = CORNERS.map(|v| [0, 1, 2].map(|k| at[k] + v[k] * size)).to_vec();
            builder.object("More", Triangles { vertices, indices: OUTWARD.to_vec() }, 0);
        }
        said(builder)
    };
    assert_eq!(scaled(2e5, "glTF 2.0", &[]), ["200,000 m large (glTF is in metres): another unit?"]);
    assert_eq!(scaled(2e5, "OBJ", &[]), Vec::<String>::new());
    let far = scaled(1.0, "OBJ", &[([2.0, 0.0, 0.0], 1.0), ([900.0, 0.0, 0.0], 1.0)]);
    assert_eq!(far, ["\"More\" lies far outside: the rest is 300 times smaller"]);
    let ground = scaled(1.0, "OBJ", &[([2.0, 0.0, 0.0], 1.0), ([-500.0, -1.0, -500.0], 1000.0)]);
    assert_eq!(ground, Vec::<String>::new());
    let mut away = grey(OUTWARD.to_vec());
    away.meshes[0].triangles.vertices.iter_mut().for_each(|v| v[0] += 131_072.0);
    assert_eq!(
        said(away)[0],
        "lies 131,000 times its size away from the origin: its numbers are coarse there"
    );
    let mut bright = grey(OUTWARD.to_vec());
    bright.lights[0].1 = crate::light::Environment::constant(Rgb::grey(1e4)).into();
    assert_eq!(said(bright), ["its lights give about 31,400 W/m²: white pictures without `exposure` -15"]);
}

#[test]
fn numbers_read_as_people_write_them() {
    let all = [0.00012345, 0.5, 12.345, 999.9, 1234.0, 98_765.0, 3.2e9];
    let texts = all.map(three_digits);
    assert_eq!(texts, ["0.000123", "0.5", "12.3", "1,000", "1,230", "98,800", "3.2e9"]);
}
