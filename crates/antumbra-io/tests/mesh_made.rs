//! OBJ, PLY, STL and HDR: small files made here, each for one law.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::collections::HashMap;

use antumbra::scene::{Alpha, Level, SceneBuilder, Surface};
use antumbra::texture::Texels;
use antumbra_io::{Format, Limits, MemoryFiles, ReadError, environment_picture, read};

fn with(format: Format, bytes: &[u8], files: &[(&str, &str)]) -> Result<SceneBuilder, ReadError> {
    let files = files.iter().map(|(name, text)| (name.to_string(), text.as_bytes().to_vec()));
    read(format, bytes, &MemoryFiles(HashMap::from_iter(files)), &Limits::default())
}

fn obj(text: &str) -> SceneBuilder {
    with(Format::Obj, text.as_bytes(), &[]).unwrap()
}

/// Two triangles that meet at a right angle in the edge 1–2.
const FOLD: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

#[test]
fn smoothing_groups_make_normals_and_off_makes_none() {
    let flat = obj(&format!("{FOLD}f 1 2 3\nf 2 1 4\n"));
    assert!(flat.meshes[0].normals.is_none() && flat.meshes[0].triangles.vertices.len() == 4);
    let smooth = obj(&format!("{FOLD}s 1\nf 1 2 3\nf 2 1 4\n"));
    let mesh = &smooth.meshes[0];
    assert_eq!(mesh.triangles.vertices.len(), 4);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    // The faces look along +z and +y and have the same area: at the common edge stands the mean of both.
    let n = mesh.normals.as_ref().unwrap();
    let expected = [0.0, half, half];
    assert!(n[0].iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{n:?}");
    assert_eq!(n[2], [0.0, 0.0, 1.0]);
    let mixed = obj(&format!("{FOLD}s 1\nf 1 2 3\ns off\nf 2 1 4\n"));
    // The flat face has corners of its own.
    assert_eq!(mixed.meshes[0].triangles.vertices.len(), 6);
}

#[test]
fn lines_go_on_and_indices_may_point_forward() {
    let s = obj("f 1 2 \\\n 3\nv 0 0 0 # origin\r\nv 1 0 0\r\nv 0 1 0\r\n# end");
    assert_eq!(s.meshes[0].triangles.indices, [[0, 1, 2]]);
    let e = with(Format::Obj, b"v 0 0 0\nf 1 2 3\n", &[]).unwrap_err();
    assert_eq!(e.to_string(), "line 2: a face has the index 3 of 1 vertices");
    let e = with(Format::Obj, b"v 0 0 x\n", &[]).unwrap_err();
    assert_eq!(e.to_string(), "line 1: \"x\" is not a number");
}

#[test]
fn materials_of_a_library() {
    let mtl = "newmtl a lamp\nKd 0.1 0.2 0.3\nKe 5 4 3\nnewmtl glass\nKd 1 1 1\nd 0.25\nmap_bump b.png\nmap_Kd gone.png\n";
    let text = format!(
        "mtllib my lib.mtl\n{FOLD}g one\nusemtl a lamp\nf 1 2 3\ng two\nusemtl glass\nf 2 1 4\ng one\nusemtl a lamp\nf 1 3 4\nl 1 2\n"
    );
    let s = with(Format::Obj, text.as_bytes(), &[("my lib.mtl", mtl)]).unwrap();
    assert_eq!(s.meshes.iter().map(|m| m.triangles.indices.len()).collect::<Vec<_>>(), [2, 1]);
    assert_eq!(s.objects[0].name, "one");
    let Surface::Diffuse { albedo } = s.materials[0].surface else { panic!() };
    assert_eq!((albedo.0, s.materials[0].emission.unwrap().radiance.0), ([0.1, 0.2, 0.3], [5.0, 4.0, 3.0]));
    assert_eq!((s.materials[1].alpha, s.materials[1].opacity), (Alpha::Blend, 0.25));
    let warnings: Vec<_> = s.messages.iter().filter(|m| m.level == Level::Warning).map(|m| &m.text).collect();
    assert_eq!(warnings.len(), 3, "{warnings:?}");
}

#[test]
fn polygons_without_end_end() {
    // A comb of 100,000 corners, nearly all reflex or narrow: bounded work, one warning at most.
    let mut text = String::new();
    for i in 0..100_000 {
        text += &format!("v {i} {} 0\n", if i % 2 == 0 { 10 } else { 1 });
    }
    text += "v 99999 0 0\nv 0 0 0\nf";
    (1..=100_002).rev().for_each(|i| text += &format!(" {i}"));
    assert_eq!(obj(&text).meshes[0].triangles.indices.len(), 100_000);
}

#[test]
fn a_ply_with_everything_around_its_faces() {
    let text = "ply\nformat ascii 1.0\ncomment x\nelement tag 1\nproperty list uchar int ids\nelement vertex 4\n\
        property float nx\nproperty float ny\nproperty float nz\nproperty double x\nproperty float y\nproperty float z\n\
        property float u\nproperty float v\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
        element face 3\nproperty uchar flags\nproperty list uchar uint vertex_index\nproperty list uchar float more\n\
        end_header\n2 7 8\n\
        0 0 1 0 0 0 0 0 255 0 0\n0 0 1 1 0 0 1 0 0 255 0\n0 0 1 1 1 0 1 1 0 0 255\n0 0 1 0 1 0 0 1 255 255 255\n\
        1 4 0 1 2 3 2 0.5 0.5\n0 3 0 1 2 0\n0 2 0 1 0\n";
    for text in [text.to_string(), text.replace('\n', "\r\n")] {
        let s = with(Format::Ply, text.as_bytes(), &[]).unwrap();
        let mesh = &s.meshes[0];
        assert_eq!(mesh.triangles.indices, [[0, 1, 2], [0, 2, 3], [0, 1, 2]]);
        assert_eq!(mesh.triangles.vertices[2], [1.0, 1.0, 0.0]);
        assert_eq!(mesh.normals.as_ref().unwrap()[0], [0.0, 0.0, 1.0]);
        assert_eq!(mesh.uvs[0].as_ref().unwrap()[3], [0.0, 1.0]);
        assert_eq!(mesh.colors.as_ref().unwrap()[1], [0.0, 1.0, 0.0, 1.0]);
        assert_eq!(s.messages.len(), 1, "{:?}", s.messages);
    }
}

#[test]
fn an_stl_in_words_may_hold_several_solids() {
    let facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1e0 0\nendloop\nendfacet\n";
    let text = format!("solid a\n{facet}endsolid a\n  solid b\n{facet}{facet}endsolid b\n");
    let s = with(Format::Stl, text.as_bytes(), &[]).unwrap();
    assert_eq!(s.meshes[0].triangles.indices.len(), 3);
    let four = text.replacen("endloop", "vertex 1 1 1\nendloop", 1);
    assert!(with(Format::Stl, four.as_bytes(), &[]).unwrap_err().what.contains("three corners"));
}

fn pixels(bytes: &[u8]) -> Vec<[f32; 3]> {
    match &environment_picture(bytes, &Limits::default()).unwrap().image.texels {
        Texels::Float(p) => p.clone(),
        _ => panic!("not float"),
    }
}

#[test]
fn radiance_pictures_of_both_codings_and_all_orders() {
    let head =
        |size: &str| format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n{size}\n").into_bytes();
    // Mantissa 128 with exponent 129 means (128 + ½) · 2⁻⁷, here divided by the exposure 2.
    let (a, b) = ([128u8, 64, 0, 129], [1u8, 2, 3, 0]);
    let red = 128.5 / 256.0;
    let down = [head("-Y 2 +X 1"), a.to_vec(), b.to_vec()].concat();
    assert_eq!(pixels(&down)[0][0], red);
    assert_eq!(pixels(&down)[1], [0.0; 3]);
    let up = [head("+Y 2 +X 1"), b.to_vec(), a.to_vec()].concat();
    assert_eq!(pixels(&up), pixels(&down));
    // The older coding: a, then three more of it.
    let old = [head("-Y 1 +X 4"), a.to_vec(), vec![1, 1, 1, 3]].concat();
    assert_eq!(pixels(&old), [pixels(&down)[0]; 4]);
    // The newer one: for each channel a run of six and two single bytes.
    let mut new = [head("-Y 1 -X 8"), vec![2, 2, 0, 8]].concat();
    for (x, y) in a.iter().zip(b) {
        new.extend([128 + 6, *x, 2, y, y]);
    }
    let row = pixels(&new);
    assert_eq!((row[7], row[2], row[0]), (pixels(&down)[0], pixels(&down)[0], [0.0; 3]));
    assert!(environment_picture(&new[..new.len() - 1], &Limits::default()).is_err());
}
