//! glTF: small files made here, each for one law.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

#[path = "common/made.rs"]
mod made;

use antumbra::light::Light;
use antumbra::scene::{Alpha, Body, Level, Surface};
use antumbra_math::{DVec3, Rgb, World};
use made::{Made, ONE_NODE, PIXEL, PLAIN, TRIANGLE, close};

#[test]
fn a_skin_follows_its_joints_and_not_its_node() {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    made.floats("VEC3", 3, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0]);
    made.add(5121, "VEC4", 3, "", &[0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0]);
    made.floats("VEC4", 4, &[1.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    let mut bind = [0.0; 32];
    for m in [0, 16] {
        (0..4).for_each(|i| bind[m + 5 * i] = 1.0);
    }
    // The second joint was bound at (0, 1, 0).
    bind[16 + 13] = -1.0;
    made.floats("MAT4", 16, &bind);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let s = made
        .read(&format!(
            r#""scenes":[{{"nodes":[0,1]}}],
            "nodes":[{{"mesh":0,"skin":0,"translation":[9,9,9]}},{{"children":[2],"translation":[0,0,5]}},
                     {{"translation":[0,1,0],"rotation":[0,0,{half},{half}]}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"JOINTS_0":2,"WEIGHTS_0":3}}}}]}}],
            "skins":[{{"joints":[1,2],"inverseBindMatrices":4}}]"#
        ))
        .unwrap();
    let mesh = &s.meshes[0];
    let v = &mesh.triangles.vertices;
    // The first joint moves by 5 along z; the second turns by 90° about (0, 1, z): (x, y) → (1 − y, 1 + x).
    assert!(close(v[0], [0.0, 0.0, 5.0]), "{v:?}");
    assert!(close(v[1], [1.0, 1.0, 5.0]), "{v:?}");
    assert!(close(v[2], [0.0, 1.0, 5.0]), "{v:?}");
    let n = mesh.normals.as_ref().unwrap();
    assert!(close(n[1], [0.0, 0.0, 1.0]) && close(n[2], [0.0, 1.0, 0.0]), "{n:?}");
    assert_eq!(s.objects[0].transform.point(DVec3::ONE), DVec3::ONE);
}

#[test]
fn a_small_part_of_a_large_list_is_copied_alone() {
    let mut made = Made::default();
    let many: Vec<f32> = (0..3000).map(|i| i as f32).collect();
    made.floats("VEC3", 3, &many);
    let indices: Vec<u8> = [7u16, 900, 31].iter().flat_map(|i| i.to_le_bytes()).collect();
    made.add(5123, "SCALAR", 3, "", &indices);
    let uv: Vec<f32> = (0..2000).map(|i| i as f32).collect();
    made.floats("VEC2", 2, &uv);
    let s = made
        .read(&format!(
            r#"{ONE_NODE}"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":2}},"indices":1}}]}}]"#
        ))
        .unwrap();
    let mesh = &s.meshes[0];
    assert_eq!(mesh.triangles.vertices.len(), 3);
    assert_eq!(mesh.triangles.corners(0), [[21.0, 22.0, 23.0], [2700.0, 2701.0, 2702.0], [93.0, 94.0, 95.0]]);
    let corner = mesh.triangles.indices[0][1] as usize;
    assert_eq!(mesh.uvs[0].as_ref().unwrap()[corner], [1800.0, 1801.0]);
}

#[test]
fn lights_shine_along_minus_z_of_their_nodes() {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let s = made
        .read(&format!(
            r#""scenes":[{{"nodes":[0,1,2]}}],
            "nodes":[{{"mesh":0}},
                {{"name":"down","rotation":[-{half},0,0,{half}],"scale":[3,3,3],"extensions":{{"KHR_lights_punctual":{{"light":0}}}}}},
                {{"translation":[1,2,3],"rotation":[-{half},0,0,{half}],"extensions":{{"KHR_lights_punctual":{{"light":1}}}}}}],
            "extensions":{{"KHR_lights_punctual":{{"lights":[
                {{"type":"directional","intensity":2,"color":[1,0.5,0.25]}},
                {{"type":"spot","intensity":10,"range":7,"spot":{{"outerConeAngle":0.5}}}}]}}}},{PLAIN}"#
        ))
        .unwrap();
    let [(name, Light::Directional(sun)), (_, Light::Spot(spot))] = &s.lights[..] else {
        panic!("{:?}", s.lights)
    };
    assert!(name == "down" && (sun.to_light - World::Y).length() < 1e-6, "{:?}", sun.to_light);
    assert_eq!(sun.irradiance.0, [2.0, 1.0, 0.5]);
    assert!((spot.direction + World::Y).length() < 1e-6);
    assert_eq!(
        (spot.position, spot.inner, spot.outer, spot.range),
        (World::new(1.0, 2.0, 3.0), 0.0, 0.5, Some(7.0))
    );
}

#[test]
fn integers_become_numbers_from_minus_one_to_one() {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    let bytes: Vec<u8> = [-128i8, 0, 127, 0, 64, 0, 0, -127, 0].iter().map(|b| *b as u8).collect();
    made.add(5120, "VEC3", 3, r#","normalized":true"#, &bytes);
    made.add(5121, "VEC4", 3, r#","normalized":true"#, &[255, 0, 51, 102, 0, 0, 0, 0, 255, 255, 255, 255]);
    let s = made
        .read(&format!(
            r#"{ONE_NODE}"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"COLOR_0":2}}}}]}}]"#
        ))
        .unwrap();
    assert_eq!(s.meshes[0].normals.as_ref().unwrap()[0], [-1.0, 0.0, 1.0]);
    assert_eq!(s.meshes[0].colors.as_ref().unwrap()[0], [1.0, 0.0, 0.2, 0.4]);
}

#[test]
fn materials_say_what_they_cannot_show_once() {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    let primitives: Vec<_> =
        (0..3).map(|m| format!(r#"{{"attributes":{{"POSITION":0}},"material":{m}}}"#)).collect();
    let s = made
        .read(&format!(
            r#"{ONE_NODE}"extensionsUsed":["KHR_materials_unlit","KHR_materials_emissive_strength","EXT_odd"],
            "meshes":[{{"primitives":[{}]}}],
            "materials":[
                {{"name":"a","extensions":{{"KHR_materials_unlit":{{}},"KHR_materials_sheen":{{}}}},"alphaMode":"MASK",
                  "alphaCutoff":0.25}},
                {{"name":"b","extensions":{{"KHR_materials_ior":{{"ior":1.33}},"KHR_materials_sheen":{{}}}},"alphaMode":"BLEND",
                  "pbrMetallicRoughness":{{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0,"roughnessFactor":0.5}}}},
                {{"emissiveFactor":[1,0.5,0],"doubleSided":true,
                  "extensions":{{"KHR_materials_emissive_strength":{{"emissiveStrength":10}}}}}}]"#,
            primitives.join(",")
        ))
        .unwrap();
    assert_eq!(s.materials[0].alpha, Alpha::Mask { cutoff: 0.25 });
    assert_eq!((s.materials[1].alpha, s.materials[1].opacity), (Alpha::Blend, 0.4));
    let Surface::MetallicRoughness { base, metallic, roughness, f0 } = s.materials[1].surface else {
        panic!()
    };
    assert_eq!((base.0, metallic, roughness), ([0.1, 0.2, 0.3], 0.0, 0.5));
    // ((1.33 − 1)/(1.33 + 1))².
    assert!((f0 - 0.02006).abs() < 1e-5);
    let Surface::Unlit { color } = s.materials[0].surface else { panic!() };
    assert_eq!(color, Rgb::WHITE);
    let e = s.materials[2].emission.unwrap();
    assert_eq!((e.radiance.0, e.both_sides), ([10.0, 5.0, 0.0], true));
    let said: Vec<_> = s.messages.iter().map(|m| format!("{}: {}", m.place, m.text)).collect();
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(
        said.iter().any(|t| t.starts_with("material \"a\"") && t.ends_with("(and 1 more like it)")),
        "{said:?}"
    );
    assert!(s.messages.iter().all(|m| m.level == Level::Warning));
    // One geometry, three looks.
    assert_eq!((s.meshes.len(), s.objects.len()), (1, 3));
    assert!(s.objects.iter().all(|o| o.body == Body::Mesh(0)));
}

#[test]
fn hidden_nodes_and_unknown_extensions() {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    let hidden = r#""scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},
        {"children":[2],"extensions":{"KHR_node_visibility":{"visible":false}}},{"mesh":0}],"#;
    assert_eq!(made.read(&format!("{hidden}{PLAIN}")).unwrap().objects.len(), 1);
    let e = made.read(&format!(r#"{ONE_NODE}"extensionsRequired":["EXT_secret"],{PLAIN}"#)).unwrap_err();
    assert!(e.what.contains("EXT_secret") && !e.hint.is_empty(), "{e}");
    let looks =
        format!(r#"{ONE_NODE}"extensionsRequired":["KHR_materials_sheen","EXT_texture_avif"],{PLAIN}"#);
    assert_eq!(made.read(&looks).unwrap().messages.len(), 1);
}

#[test]
fn glass_and_normal_maps() {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    made.floats("VEC3", 3, &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    made.floats("VEC2", 2, &[0.0, 1.0, 1.0, 1.0, 0.0, 0.0]);
    made.floats("VEC4", 4, &[1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0]);
    let attributes = r#"{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"TANGENT":3}"#;
    let primitives: Vec<_> =
        (0..6).map(|m| format!(r#"{{"attributes":{attributes},"material":{m}}}"#)).collect();
    let glass = r#""KHR_materials_transmission":{"transmissionFactor":1}"#;
    let smooth = r#""pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0}"#;
    let s = made
        .read(&format!(
            r#"{ONE_NODE}"meshes":[{{"primitives":[{}]}}],
            "images":[{{"uri":"data:image/png;base64,{PIXEL}"}}],"textures":[{{"source":0}}],
            "materials":[
                {{"normalTexture":{{"index":0,"scale":0.5}}}},
                {{{smooth},"extensions":{{{glass}}}}},
                {{{smooth},"extensions":{{{glass},"KHR_materials_volume":{{"thicknessFactor":1}}}}}},
                {{"pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":0.5,"baseColorFactor":[1,0.5,0,1]}},
                  "extensions":{{{glass},"KHR_materials_volume":{{"thicknessFactor":1}},
                  "KHR_materials_ior":{{"ior":2}}}}}},
                {{{smooth},"extensions":{{"KHR_materials_transmission":
                  {{"transmissionFactor":0.25,"transmissionTexture":{{"index":0}}}}}}}},
                {{"pbrMetallicRoughness":{{"metallicFactor":0,"roughnessFactor":0.5,
                  "metallicRoughnessTexture":{{"index":0}}}},"extensions":{{{glass}}}}}]"#,
            primitives.join(",")
        ))
        .unwrap();
    assert!(s.messages.is_empty(), "{:?}", s.messages);
    assert_eq!(s.materials[0].normal.map(|map| map.scale), Some(0.5));
    assert!(s.meshes[0].tangents.is_some());
    assert!(matches!(s.materials[1].surface, Surface::ThinDielectric(_)));
    assert!(matches!(s.materials[2].surface, Surface::Dielectric(_)));
    let Surface::RoughDielectric(ground) = s.materials[3].surface else { panic!() };
    assert_eq!(ground.transmittance.0, [1.0, 0.5, 0.0]);
    let Surface::Blend { first, second, weight } = s.materials[6].surface else { panic!() };
    assert!((first, second, weight) == (4, 5, 0.25) && s.materials[6].blend.is_some());
    assert!(matches!(s.materials[4].surface, Surface::MetallicRoughness { .. }));
    assert!(matches!(s.materials[5].surface, Surface::ThinDielectric(_)));
    // A pane of ground glass: α = roughness² times the square of green.
    let Surface::RoughThinDielectric(pane) = s.materials[7].surface else { panic!() };
    assert_eq!(pane.facets().alpha(), [0.25; 2]);
    let roughness = s.materials[7].roughness.clone().unwrap();
    assert!(roughness.squared && roughness.channel.component == 1);
}
