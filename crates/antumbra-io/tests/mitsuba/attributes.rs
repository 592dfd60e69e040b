//! Colours of meshes: `mesh_attribute`.

use antumbra::scene::{Mesh, SceneBuilder, Surface};

use crate::serialized::{CORNERS, packed};
use crate::{warnings, with};

const POSITIONS: &str = "property float x\nproperty float y\nproperty float z\n";

/// A square and a triangle; `vertex` and `face` are properties with one number more a row each.
fn ply(vertex: (&str, &str), face: (&str, [&str; 2])) -> String {
    let corners = ["0 0 0", "1 0 0", "1 1 0", "0 1 0", "0.5 2 0"];
    let rows: String = corners.iter().map(|c| format!("{c} {}\n", vertex.1)).collect();
    format!(
        "ply\nformat ascii 1.0\nelement vertex 5\n{POSITIONS}{}element face 2\n\
         property list uchar int vertex_indices\n{}end_header\n{rows}4 0 1 2 3 {}\n3 3 2 4 {}\n",
        vertex.0, face.0, face.1[0], face.1[1]
    )
}

fn floats(names: [&str; 3]) -> String {
    names.map(|n| format!("property float {n}\n")).concat()
}

fn shown(file: Vec<u8>, plugin: &str, attribute: &str) -> SceneBuilder {
    let texture = format!(
        "<texture name='reflectance' type='mesh_attribute'><string name='name' value='{attribute}'/></texture>"
    );
    let shape = format!(
        "<bsdf type='twosided' id='painted'><bsdf type='diffuse'>{texture}</bsdf></bsdf>\
         <shape type='{plugin}'><string name='filename' value='a'/><ref id='painted'/></shape>\
         <shape type='{plugin}'><string name='filename' value='a'/></shape>"
    );
    with(&shape, &[("a", file)]).unwrap()
}

/// The mesh with its colours; the same file under another look has none.
fn painted(file: Vec<u8>, plugin: &str, attribute: &str) -> Mesh {
    let s = shown(file, plugin, attribute);
    assert!(
        warnings(&s).iter().all(|w| w.contains("no emitter") || w.contains("no sensor")),
        "{:?}",
        warnings(&s)
    );
    assert!(s.meshes[0].colors.is_some() && s.meshes[1].colors.is_none());
    let look = &s.materials[s.objects[0].material as usize];
    assert!(matches!(look.surface, Surface::Diffuse { albedo } if albedo.0 == [1.0; 3]), "{look:?}");
    s.meshes[0].clone()
}

#[test]
fn vertices_have_colors_in_every_way_of_writing_them() {
    let ways = [
        ["r", "g", "b"],
        ["red", "green", "blue"],
        ["color_0", "color_1", "color_2"],
        ["color_x", "color_y", "color_z"],
    ];
    for names in ways {
        let file = ply((&floats(names), "0.25 0.5 1"), ("", ["", ""]));
        let mesh = painted(file.into_bytes(), "ply", "vertex_color");
        assert_eq!(mesh.colors, Some(vec![[0.25, 0.5, 1.0, 1.0]; 5]), "{names:?}");
        assert_eq!(mesh.triangles.vertices.len(), 5);
    }
    let named = ply((&floats(["heat_r", "heat_g", "heat_b"]), "0 1 0"), ("", ["", ""]));
    assert_eq!(painted(named.into_bytes(), "ply", "vertex_heat").colors, Some(vec![[0.0, 1.0, 0.0, 1.0]; 5]));
    // Bytes are screen colours: 128 is 0.2159 (IEC 61966-2-1).
    let bytes = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    let mesh = painted(ply((bytes, "128 0 255"), ("", ["", ""])).into_bytes(), "ply", "vertex_color");
    let color = mesh.colors.unwrap()[3];
    assert!((color[0] - 0.2159).abs() < 1e-4 && color[1..] == [0.0, 1.0, 1.0], "{color:?}");
}

/// Each triangle of a face has its colour, at corners of its own, where and as smooth as they were.
#[test]
fn faces_have_colors() {
    let file = ply(("", ""), (&floats(["red", "green", "blue"]), ["1 0 0", "0 0 1"])).into_bytes();
    let mesh = painted(file.clone(), "ply", "face_color");
    let colors = mesh.colors.as_ref().unwrap();
    let color = |t: usize| mesh.triangles.indices[t].map(|i| colors[i as usize]);
    let (red, blue) = ([1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]);
    assert_eq!([color(0), color(1), color(2)], [[red; 3], [red; 3], [blue; 3]]);
    let s = shown(file, "ply", "face_color");
    let corners = |m: &Mesh| -> Vec<[f32; 3]> {
        m.triangles.indices.iter().flatten().map(|i| m.triangles.vertices[*i as usize]).collect()
    };
    assert_eq!(corners(&s.meshes[0]), corners(&s.meshes[1]));
    assert_eq!(s.meshes[0].normals.as_ref().unwrap().len(), 9);
}

#[test]
fn serialized_meshes_have_colors() {
    let mesh = painted(packed(4, false, 1.0), "serialized", "vertex_color");
    assert_eq!(mesh.colors, Some(CORNERS.map(|[x, y, z]| [x, y, z, 1.0]).to_vec()));
}

#[test]
fn what_has_no_colors_is_named() {
    let s = shown(ply(("", ""), ("", ["", ""])).into_bytes(), "ply", "vertex_color");
    assert!(
        warnings(&s).iter().any(|w| w.contains("no colours called \"vertex_color\"")),
        "{:?}",
        warnings(&s)
    );
    let texture =
        "<texture name='alpha' type='mesh_attribute'><string name='name' value='vertex_a'/></texture>";
    let s = with::<&str>(
        &format!("<shape type='cube'><bsdf type='roughconductor'>{texture}</bsdf></shape>"),
        &[],
    );
    let said = warnings(&s.unwrap());
    assert!(said.iter().any(|w| w.contains("the colour of a bsdf alone")), "{said:?}");
}
