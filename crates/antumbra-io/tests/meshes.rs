//! OBJ, PLY, STL and environments: every real file reads, and the same model by several formats is the same.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod common;

use std::path::Path;

use antumbra::scene::{Body, SceneBuilder, Surface};
use antumbra::texture::Texels;
use antumbra_io::{ReadOptions, UpAxis, environment_picture, read_path};
use antumbra_math::DVec3;

fn scene(data: &Path, name: &str) -> SceneBuilder {
    let scene = read_path(&data.join("scenes/mesh").join(name), &ReadOptions::default()).unwrap();
    println!("{name}: {}, {} triangles", scene.source, triangles(&scene).len());
    scene.messages.iter().for_each(|m| println!("    {}: {}", m.place, m.text));
    scene
}

/// The corners of all triangles.
fn triangles(scene: &SceneBuilder) -> Vec<[[f32; 3]; 3]> {
    let mut all = Vec::new();
    for object in &scene.objects {
        let Body::Mesh(m) = object.body else { continue };
        let t = &scene.meshes[m as usize].triangles;
        all.extend((0..t.indices.len()).map(|i| t.corners(i)));
    }
    all
}

fn area([a, b, c]: &[[f32; 3]; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| DVec3::from_array(p.map(f64::from)));
    (b - a).cross(c - a).length() / 2.0
}

#[test]
fn every_real_mesh_reads_and_builds() {
    let Some(data) = common::data("every_real_mesh_reads_and_builds") else { return };
    let mut count = 0;
    for entry in std::fs::read_dir(data.join("scenes/mesh")).unwrap() {
        let path = entry.unwrap().path();
        let kind = path.extension().and_then(|e| e.to_str()).unwrap_or("");
        if ["obj", "ply", "stl"].contains(&kind) {
            let scene = scene(&data, path.file_name().unwrap().to_str().unwrap());
            assert!(!triangles(&scene).is_empty() && scene.sky_if_unlit);
            scene.build().unwrap();
            count += 1;
        }
    }
    assert!(count >= 12);
}

#[test]
fn one_model_by_six_files_is_the_same() {
    let Some(data) = common::data("one_model_by_six_files_is_the_same") else { return };
    let truth = triangles(&scene(&data, "spot.obj"));
    assert_eq!(truth.len(), 5856);
    let exact = ["spot_le.ply", "spot_be_double_colour.ply", "spot_binary_named_solid.stl"];
    for (name, tolerance) in exact.map(|n| (n, 0.0)).into_iter().chain([("spot_ascii.ply", 1e-6)]) {
        let other = triangles(&scene(&data, name));
        assert_eq!(other.len(), truth.len(), "{name}");
        // Texts of six decimals are off by half of the last one.
        let far = |a: &[[f32; 3]; 3], b: &[[f32; 3]; 3]| {
            a.as_flattened().iter().zip(b.as_flattened()).any(|(a, b)| (a - b).abs() > tolerance)
        };
        assert_eq!(truth.iter().zip(&other).filter(|(a, b)| far(a, b)).count(), 0, "{name}");
    }
    let part = triangles(&scene(&data, "spot_part_ascii.stl"));
    let near = |a: &[[f32; 3]; 3], b: &[[f32; 3]; 3]| {
        a.as_flattened().iter().zip(b.as_flattened()).all(|(a, b)| (a - b).abs() <= 1e-6)
    };
    assert!(part.iter().zip(&truth).all(|(a, b)| near(a, b)));
}

#[test]
fn colours_of_bytes_are_screen_colours() {
    let Some(data) = common::data("colours_of_bytes_are_screen_colours") else { return };
    let s = scene(&data, "spot_be_double_colour.ply");
    let colors = s.meshes[0].colors.as_ref().unwrap();
    assert_eq!(colors.len(), s.meshes[0].triangles.vertices.len());
    assert!(colors.iter().flatten().all(|c| (0.0..=1.0).contains(c)));
    let s = scene(&data, "cube_with_vertexcolors.obj");
    let colors = s.meshes[0].colors.as_ref().unwrap();
    // "0.48627" is code 124, whose linear value is 0.2016 (IEC 61966-2-1).
    assert!(colors.iter().any(|c| (c[0] - 0.2016).abs() < 1e-4), "{colors:?}");
}

#[test]
fn indices_back_and_forth_polygons_and_wide_text() {
    let Some(data) = common::data("indices_back_and_forth_polygons_and_wide_text") else { return };
    let whole = |name: &str| triangles(&scene(&data, name)).iter().map(area).sum::<f64>();
    // A cube from −1 to 1 has the surface 24, one of unit edges 6.
    assert_eq!((whole("negative_indices.obj"), whole("cube_uv_quads.ply")), (24.0, 6.0));
    assert_eq!(triangles(&scene(&data, "box_UTF16BE.obj")).len(), 12);
}

#[test]
fn a_concave_polygon_with_a_hole_is_covered_once() {
    let Some(data) = common::data("a_concave_polygon_with_a_hole_is_covered_once") else { return };
    let s = scene(&data, "concave_polygon.obj");
    let t = triangles(&s);
    let corner = |p: &[f32; 3]| DVec3::from_array(p.map(f64::from));
    let sum: DVec3 = t
        .iter()
        .map(|[a, b, c]| (corner(b) - corner(a)).cross(corner(c) - corner(a)) / 2.0)
        .fold(DVec3::ZERO, |s, a| s + a);
    // Triangles that turn one way have areas that add up to the length of the sum of their vector areas.
    let sizes: f64 = t.iter().map(area).sum();
    assert!((sum.length() - sizes).abs() < 1e-9 * sizes, "{} {sizes}", sum.length());
}

#[test]
fn materials_textures_and_smoothing_of_obj() {
    let Some(data) = common::data("materials_textures_and_smoothing_of_obj") else { return };
    let s = scene(&data, "spider.obj");
    // Four of the five materials are used.
    assert_eq!(s.textures.len(), 4);
    assert!(s.materials.iter().all(|m| m.color.is_some() && matches!(m.surface, Surface::Diffuse { .. })));
    assert!(s.meshes.iter().any(|m| m.normals.is_some()));
    let s = scene(&data, "fuze.obj");
    assert_eq!((s.textures.len(), s.materials[0].opacity), (1, 1.0));
    // v runs upwards in OBJ.
    assert_eq!(s.textures[0].map, [1.0, 0.0, 0.0, 0.0, -1.0, 1.0]);
}

#[test]
fn z_up_becomes_y_up() {
    let Some(data) = common::data("z_up_becomes_y_up") else { return };
    let options = ReadOptions { up_axis: UpAxis::Z, ..ReadOptions::default() };
    for name in ["scenes/mesh/spot.obj", "scenes/mesh/spot_le.ply", "bake/spot_good_uv.glb"] {
        let s = read_path(&data.join(name), &options).unwrap();
        let up = s.objects[0].transform.point(DVec3::new(1.0, 2.0, 3.0));
        let plain = read_path(&data.join(name), &ReadOptions::default()).unwrap();
        let p = plain.objects[0].transform.point(DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(up, DVec3::new(p.x, p.z, -p.y), "{name}");
    }
}

#[test]
fn environments_read_as_finite_radiance() {
    let Some(data) = common::data("environments_read_as_finite_radiance") else { return };
    let mut count = 0;
    for entry in std::fs::read_dir(data.join("env")).unwrap() {
        let path = entry.unwrap().path();
        let picture = environment_picture(&std::fs::read(&path).unwrap(), &Default::default()).unwrap();
        println!("{}: {}, mean {:?}", path.display(), picture.source, picture.image.mean());
        assert_eq!(picture.image.width, 2 * picture.image.height);
        let Texels::Float(pixels) = &picture.image.texels else { panic!("not float") };
        assert!(pixels.iter().flatten().all(|c| c.is_finite() && *c >= 0.0) && picture.messages.is_empty());
        assert!(picture.image.mean().luminance() > 1e-3);
        let scene = read_path(&path, &ReadOptions::default()).unwrap();
        assert!(scene.lights.len() == 1 && scene.objects.is_empty() && scene.lights[0].1.is_environment());
        count += 1;
    }
    assert_eq!(count, 5);
}
