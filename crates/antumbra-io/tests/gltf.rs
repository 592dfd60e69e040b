//! glTF: every real file of the data reads, and its scenes hold what their makers say.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod common;

use std::path::{Path, PathBuf};

use antumbra::scene::{Projection, SceneBuilder, Surface};
use antumbra::texture::Texels;
use antumbra_io::{FolderFiles, Format, Limits, ReadOptions, read, read_path};
use antumbra_math::DVec3;

/// All glTF files below a folder.
fn files(folder: &Path, out: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files(&path, out);
        } else if path.extension().is_some_and(|e| e == "gltf" || e == "glb") {
            out.push(path);
        }
    }
}

fn scene(data: &Path, name: &str) -> SceneBuilder {
    read_path(&data.join(name), &ReadOptions::default()).unwrap()
}

/// Triangles in place: instances counted.
fn drawn(s: &SceneBuilder) -> usize {
    s.objects
        .iter()
        .map(|o| match o.body {
            antumbra::scene::Body::Mesh(m) => s.meshes[m as usize].triangles.indices.len(),
            _ => 0,
        })
        .sum()
}

#[test]
fn every_real_file_reads_or_is_refused_by_name() {
    let Some(data) = common::data("every_real_file_reads_or_is_refused_by_name") else { return };
    let mut all = Vec::new();
    files(&data.join("scenes/gltf"), &mut all);
    files(&data.join("bake"), &mut all);
    assert!(all.len() > 30);
    for path in all {
        let name = path.file_name().unwrap().to_str().unwrap();
        let got = read_path(&path, &ReadOptions::default());
        let refused =
            [("gltf1_SimpleSkin.gltf", "glTF 1.1"), ("DracoSparseMesh.gltf", "KHR_draco_mesh_compression")];
        match (refused.iter().find(|r| r.0 == name), got) {
            (Some((_, word)), Err(e)) => {
                println!("{e} ({})", e.hint);
                assert!(e.to_string().contains(word) && !e.hint.is_empty(), "{e}");
            }
            (None, Ok(s)) => {
                println!("{name}: {} triangles, {} objects, {}", drawn(&s), s.objects.len(), s.source);
                s.messages.iter().for_each(|m| println!("    {}: {}", m.place, m.text));
                assert!(drawn(&s) > 0, "{name}");
                assert!(s.source.starts_with("glTF 2.0"), "{name}: {}", s.source);
            }
            (_, got) => panic!("{name}: {:?}", got.map(|s| s.messages)),
        }
    }
}

#[test]
fn lights_and_cameras_stand_where_their_nodes_are() {
    let Some(data) = common::data("lights_and_cameras_stand_where_their_nodes_are") else { return };
    let s = scene(&data, "scenes/gltf/gen_lights_cameras.glb");
    let kinds: Vec<_> = s.lights.iter().map(|(_, l)| l.kind()).collect();
    for kind in ["Point", "Spot", "Directional"] {
        assert!(kinds.contains(&kind), "{kinds:?}");
    }
    assert_eq!(s.cameras.len(), 2);
    assert!(s.cameras.iter().any(|c| matches!(c.projection, Projection::Orthographic { .. })));
    assert!(s.cameras.iter().all(|c| c.eye.is_finite() && (c.look_at - c.eye).length() > 0.99));
}

#[test]
fn instances_share_their_mesh() {
    let Some(data) = common::data("instances_share_their_mesh") else { return };
    let s = scene(&data, "bake/instances_mirrored.glb");
    assert!(s.objects.len() > s.meshes.len(), "{} objects, {} meshes", s.objects.len(), s.meshes.len());
    assert!(s.objects.iter().any(|o| o.transform.mirrors()));
    let s = scene(&data, "scenes/gltf/gen_gpu_instancing_400.glb");
    assert_eq!(
        s.objects.iter().filter(|o| o.transform != s.objects[0].transform).count() + 1,
        s.objects.len()
    );
    assert!(s.objects.len() >= 400);
}

#[test]
fn all_triangle_modes_give_the_same_shape() {
    let Some(data) = common::data("all_triangle_modes_give_the_same_shape") else { return };
    let s = scene(&data, "scenes/gltf/gen_primitive_modes.glb");
    s.meshes.iter().for_each(|m| println!("{:?}", m.triangles));
    let areas: Vec<DVec3> = s.meshes.iter().map(area).collect();
    // All primitives are drawn counter-clockwise: their vector areas point the same way.
    assert!(areas.len() >= 3 && areas.iter().all(|a| a.dot(areas[0]) > 0.0), "{areas:?}");
}

/// Σ ½ (b − a) × (c − a).
fn area(m: &antumbra::scene::Mesh) -> DVec3 {
    let corner = |t: usize| m.triangles.corners(t).map(|p| DVec3::from_array(p.map(f64::from)));
    (0..m.triangles.indices.len())
        .map(corner)
        .map(|[a, b, c]| (b - a).cross(c - a) / 2.0)
        .fold(DVec3::ZERO, |s, a| s + a)
}

#[test]
fn materials_carry_their_factors_textures_and_emission() {
    let Some(data) = common::data("materials_carry_their_factors_textures_and_emission") else { return };
    let s = scene(&data, "bake/room_overlapping_uv.glb");
    assert!(s.materials.iter().any(|m| m.emission.is_some_and(|e| e.radiance.max() > 1.0)));
    let s = scene(&data, "bake/suzanne_orm/02_suzanne.gltf");
    let m = &s.materials[0];
    assert!(m.color.is_some() && m.metallic.is_some() && m.roughness.is_some());
    assert!(matches!(m.surface, Surface::MetallicRoughness { .. }));
    let s = scene(&data, "scenes/gltf/texture_transform/09_texture_transform.gltf");
    assert!(s.textures[0].map != [1.0, 0.0, 0.0, 0.0, 1.0, 0.0]);
}

/// The same logo as WebP alone and with a PNG to fall back on, which then comes first.
#[test]
fn webp_is_read_where_the_file_offers_it() {
    let Some(data) = common::data("webp_is_read_where_the_file_offers_it") else { return };
    // Means of both pictures as another program decodes them.
    for (file, told) in [
        ("box-textured-separate", [154.714, 186.265, 176.429]),
        ("box-textured-with-fallback", [154.594, 186.172, 176.362]),
    ] {
        let s = scene(&data, &format!("scenes/gltf/texture_webp/{file}.gltf"));
        let image = &s.textures[s.materials[0].color.unwrap() as usize].image;
        let Texels::Srgb8(texels) = &image.texels else { panic!() };
        let mean = [0, 1, 2].map(|c| {
            texels.iter().map(|t| f64::from(t[c])).sum::<f64>() / f64::from(image.width * image.height)
        });
        assert_eq!((image.width, image.height), (128, 128));
        assert!((0..3).all(|c| (mean[c] - told[c]).abs() < 0.02), "{file}: {mean:?}");
    }
}

/// The same box, packed and as its exporter wrote the plain bytes for other readers.
#[test]
fn what_is_packed_is_what_was_there_before() {
    let Some(data) = common::data("what_is_packed_is_what_was_there_before") else { return };
    let folder = data.join("scenes/gltf/meshopt_fallback");
    let text = std::fs::read_to_string(folder.join("meshopt-fallback.gltf")).unwrap();
    let packed = scene(&data, "scenes/gltf/meshopt_fallback/meshopt-fallback.gltf");
    let plain = text.replace("EXT_meshopt_compression", "EXT_of_nobody").replace("extensionsRequired", "x");
    let files = FolderFiles::new(&folder, &folder, &Limits::default()).unwrap();
    let plain = read(Format::Gltf, plain.as_bytes(), &files, &Limits::default()).unwrap();
    assert!(packed.messages.is_empty(), "{:?}", packed.messages);
    let (a, b) = (&packed.meshes[0], &plain.meshes[0]);
    assert!(!a.triangles.vertices.is_empty());
    assert_eq!(a.triangles.vertices, b.triangles.vertices);
    assert_eq!(a.triangles.indices, b.triangles.indices);
    // The plain normals of this file are still filtered; unpacked they stand on the faces of the box.
    let normals = a.normals.as_ref().unwrap();
    for (i, corners) in a.triangles.indices.iter().enumerate() {
        let [p, q, r] = a.triangles.corners(i).map(|p| DVec3::from_array(p.map(f64::from)));
        let face = (q - p).cross(r - p).normalize().as_vec3().to_array();
        assert!(corners.iter().all(|c| normals[*c as usize] == face), "{i}: {face:?}");
    }
    let s = scene(&data, "scenes/gltf/BoxMeshopt.glb");
    assert_eq!((drawn(&s), s.messages.len()), (12, 0), "{:?}", s.messages);
}
