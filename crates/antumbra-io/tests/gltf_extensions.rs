//! glTF: instances, materials and packed pictures and meshes of extensions, in small files made here.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

#[path = "common/made.rs"]
mod made;

use antumbra::scene::{Material, SceneBuilder, Surface};
use antumbra_io::{DracoAttribute, DracoError, DracoMesh, ReadOptions};
use made::{Made, ONE_NODE, PIXEL, PLAIN, TRIANGLE};

/// What was said, in one text.
fn told(s: &SceneBuilder) -> String {
    s.messages.iter().map(|m| format!("{}: {}\n", m.place, m.text)).collect()
}

/// The same objects in the same places, so every picture is the same to the bit.
#[test]
fn instances_are_nodes_written_shorter() {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    made.floats("VEC3", 3, &[1.0, 2.0, 3.0, -4.0, 0.5, 0.0]);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    made.floats("VEC4", 4, &[0.0, 0.0, half, half, 0.0, 0.0, 0.0, 1.0]);
    made.floats("VEC3", 3, &[1.0, 1.0, 1.0, 2.0, 3.0, -1.0]);
    let node = r#""translation":[0,0,7],"scale":[2,2,2]"#;
    let instanced = made
        .read(&format!(
            r#""scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,{node},"extensions":{{"EXT_mesh_gpu_instancing":
            {{"attributes":{{"TRANSLATION":1,"ROTATION":2,"SCALE":3}}}}}}}}],{PLAIN}"#
        ))
        .unwrap();
    let half = f64::from(half);
    let nodes = made
        .read(&format!(
            r#""scenes":[{{"nodes":[0]}}],"nodes":[{{"children":[1,2],{node}}},
            {{"mesh":0,"translation":[1,2,3],"rotation":[0,0,{half},{half}]}},
            {{"mesh":0,"translation":[-4,0.5,0],"scale":[2,3,-1]}}],{PLAIN}"#
        ))
        .unwrap();
    let placed =
        |s: &SceneBuilder| s.objects.iter().map(|o| (o.body.clone(), o.transform)).collect::<Vec<_>>();
    assert_eq!(placed(&instanced).len(), 2);
    assert_eq!(placed(&instanced), placed(&nodes));
    assert!(instanced.messages.is_empty() && instanced.meshes.len() == 1);
    // Lists of different lengths are refused.
    made.floats("VEC3", 3, &[1.0; 9]);
    let e = made
        .read(&format!(
            r#""scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,"extensions":{{"EXT_mesh_gpu_instancing":
            {{"attributes":{{"TRANSLATION":1,"SCALE":4}}}}}}}}],{PLAIN}"#
        ))
        .unwrap_err();
    assert!(e.what.contains("different counts"), "{e}");
}

/// One material on a triangle: the last one of the scene, and what was said.
fn look(material: &str) -> (SceneBuilder, Material) {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    let s = made
        .read(&format!(
            r#"{ONE_NODE}"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],
            "images":[{{"uri":"data:image/png;base64,{PIXEL}"}}],"textures":[{{"source":0}}],"materials":[{material}]"#
        ))
        .unwrap();
    let m = s.materials[s.objects[0].material as usize].clone();
    (s, m)
}

#[test]
fn specular_weighs_the_gloss_of_what_is_no_metal() {
    let with = |pbr: &str, specular: &str| {
        look(&format!(
            r#"{{"pbrMetallicRoughness":{{{pbr}}},"extensions":{{"KHR_materials_specular":{{{specular}}}}}}}"#
        ))
    };
    let f0 = |m: &Material| match m.surface {
        Surface::MetallicRoughness { f0, .. } => f0,
        _ => f32::NAN,
    };
    let (s, m) = with(r#""metallicFactor":0"#, r#""specularColorFactor":[2,2,2]"#);
    assert!((f0(&m) - 0.08).abs() < 1e-6 && s.messages.is_empty(), "{}", told(&s));
    let (_, m) = with(r#""metallicFactor":0"#, r#""specularFactor":0"#);
    assert!(matches!(m.surface, Surface::Diffuse { .. }));
    let (s, m) = with(r#""metallicFactor":0"#, r#""specularFactor":0.25"#);
    let Surface::Blend { first, second, weight } = m.surface else { panic!("{m:?}") };
    assert!(matches!(s.materials[first as usize].surface, Surface::Diffuse { .. }));
    assert!((f0(&s.materials[second as usize]) - 0.04).abs() < 1e-6 && weight == 0.25);
    // Metal does not heed it.
    let (s, m) = with(r#""metallicFactor":1"#, r#""specularFactor":0,"specularColorFactor":[0,0,0]"#);
    assert!(s.messages.is_empty() && (f0(&m) - 0.04).abs() < 1e-6);
    let (s, m) =
        with(r#""metallicFactor":0"#, r#""specularColorFactor":[0,1,2],"specularTexture":{"index":0}"#);
    assert!((f0(&m) - 0.04).abs() < 1e-6);
    assert!(told(&s).contains("as grey") && told(&s).contains("not read"), "{}", told(&s));
}

#[test]
fn a_clear_coat_lies_on_metallic_roughness() {
    let with = |pbr: &str, more: &str, coat: &str| {
        look(&format!(
            r#"{{"pbrMetallicRoughness":{{{pbr}}},"extensions":{{{more}"KHR_materials_clearcoat":{{{coat}}}}}}}"#
        ))
    };
    let varnish = r#""clearcoatFactor":0.5,"clearcoatRoughnessFactor":0.25,"clearcoatTexture":{"index":0}"#;
    let (s, m) = with(r#""metallicFactor":0.5"#, "", varnish);
    let Surface::ClearCoat { metallic, strength, coat_roughness, .. } = m.surface else { panic!("{m:?}") };
    assert!(s.messages.is_empty() && m.blend.is_some(), "{}", told(&s));
    assert_eq!((metallic, strength, coat_roughness), (0.5, 0.5, 0.25));
    // A coat of nothing is none.
    let (s, m) = with("", "", r#""clearcoatRoughnessFactor":0.25"#);
    assert!(s.messages.is_empty() && matches!(m.surface, Surface::MetallicRoughness { .. }));
    let index = r#""KHR_materials_ior":{"ior":2},"#;
    let (_, m) = with("", index, varnish);
    assert!(matches!(m.surface, Surface::ClearCoat { f0, .. } if (f0 - 1.0 / 9.0).abs() < 1e-6), "{m:?}");
    // What it has beyond that is named.
    let textures = r#","clearcoatRoughnessTexture":{"index":0},"clearcoatNormalTexture":{"index":0}"#;
    let (s, _) = with("", "", &format!("{varnish}{textures}"));
    assert!(told(&s).contains("its factor holds everywhere") && told(&s).contains("bent"), "{}", told(&s));
    let matt = r#""KHR_materials_specular":{"specularFactor":0},"#;
    let (s, m) = with(r#""metallicFactor":0"#, matt, varnish);
    assert!(told(&s).contains("without the coat") && matches!(m.surface, Surface::Diffuse { .. }));
    let glass = r#""KHR_materials_transmission":{"transmissionFactor":1},"#;
    let (s, _) = with(r#""metallicFactor":0"#, glass, varnish);
    assert!(told(&s).contains("on glass"), "{}", told(&s));
    let (s, _) = with("", "", r#""clearcoatFactor":"much""#);
    assert!(told(&s).contains("is broken"), "{}", told(&s));
}

#[test]
fn specular_and_glossiness_become_metallic_and_roughness() {
    let with = |more: &str| {
        look(&format!(r#"{{"extensions":{{"KHR_materials_pbrSpecularGlossiness":{{{more}}}}}}}"#))
    };
    // A grey specular is an F₀ of its own, and the base loses what it takes.
    let (s, m) =
        with(r#""diffuseFactor":[0.5,0.25,1,0.5],"specularFactor":[0.2,0.2,0.2],"glossinessFactor":0.75"#);
    let Surface::MetallicRoughness { base, metallic, roughness, f0 } = m.surface else { panic!("{m:?}") };
    assert!(s.messages.is_empty() && (metallic, roughness, m.opacity) == (0.0, 0.25, 0.5));
    assert!((f0 - 0.2).abs() < 1e-6 && (base.0[0] - 0.4).abs() < 1e-6 && (base.0[2] - 0.8).abs() < 1e-6);
    // Gold: no diffuse part, a coloured specular.
    let (_, m) = with(r#""diffuseFactor":[0,0,0,1],"specularFactor":[1,0.77,0.34]"#);
    let Surface::MetallicRoughness { base, metallic, .. } = m.surface else { panic!("{m:?}") };
    assert!(metallic > 0.95 && (base.0[0] - 1.0).abs() < 0.05 && (base.0[2] - 0.34).abs() < 0.05, "{m:?}");
    let (s, m) = with(r#""specularGlossinessTexture":{"index":0}"#);
    assert!(matches!(m.surface, Surface::Diffuse { .. }) && told(&s).contains("drawn matt"), "{}", told(&s));
}

#[test]
fn a_packed_picture_gives_way_to_its_fallback_and_says_so() {
    let with = |texture: &str| {
        let mut made = Made::default();
        made.floats("VEC3", 3, &TRIANGLE);
        let s = made.read(&format!(
            r#"{ONE_NODE}"extensionsUsed":["KHR_texture_basisu"],"extensionsRequired":["KHR_texture_basisu"],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],
            "images":[{{"uri":"data:image/png;base64,{PIXEL}"}},{{"uri":"a.ktx2"}}],"textures":[{texture}],
            "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}]"#
        ));
        let s = s.unwrap();
        (s.materials[0].color.is_some(), told(&s))
    };
    let (drawn, said) = with(r#"{"source":0,"extensions":{"KHR_texture_basisu":{"source":1}}}"#);
    assert!(drawn && said.contains("its fallback is shown") && said.lines().count() == 1, "{said}");
    let (drawn, said) = with(r#"{"extensions":{"KHR_texture_basisu":{"source":1}}}"#);
    assert!(!drawn && said.contains("ktxdecompress") && said.lines().count() == 1, "{said}");
}

/// A packed triangle: three bytes that only the decoders below understand.
fn packed(decode: antumbra_io::DracoDecoder, indices: usize) -> Result<SceneBuilder, antumbra_io::ReadError> {
    let mut made = Made::default();
    made.add(5126, "VEC3", 3, "", b"abc");
    made.accessors = vec![
        r#"{"componentType":5126,"type":"VEC3","count":3}"#.into(),
        format!(r#"{{"componentType":5123,"type":"SCALAR","count":{indices}}}"#),
    ];
    let rest = format!(
        r#"{ONE_NODE}"extensionsRequired":["KHR_draco_mesh_compression"],
        "meshes":[{{"name":"thing","primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"extensions":
        {{"KHR_draco_mesh_compression":{{"bufferView":0,"attributes":{{"POSITION":7}}}}}}}}]}}]"#
    );
    made.read_with(&rest, &ReadOptions { draco: Some(decode), ..ReadOptions::default() })
}

#[test]
fn packed_meshes_go_through_the_decoder_that_is_given() {
    let good = |bytes: &[u8], wanted: &[DracoAttribute]| {
        assert_eq!((bytes, wanted), (&b"abc"[..], &[DracoAttribute { id: 7, component: 5126 }][..]));
        let attributes = vec![TRIANGLE.iter().flat_map(|n| n.to_le_bytes()).collect()];
        Ok(DracoMesh { indices: vec![2, 0, 1], attributes })
    };
    let s = packed(good, 3).unwrap();
    assert_eq!(s.meshes[0].triangles.indices, [[2, 0, 1]]);
    assert_eq!(s.meshes[0].triangles.vertices[1], [1.0, 0.0, 0.0]);
    let e = packed(good, 6).unwrap_err();
    assert!(e.to_string().contains("6 indices; 3 were packed"), "{e}");
    let e = packed(|_, _| Err(DracoError::Missing), 3).unwrap_err();
    assert!(e.place.contains("thing") && e.hint.contains("antumbra[draco]"), "{e}");
    let e = packed(|_, _| Err(DracoError::Broken("no head".into())), 3).unwrap_err();
    assert!(e.what.contains("no head"), "{e}");
    let short = |_: &[u8], _: &[DracoAttribute]| {
        Ok(DracoMesh { indices: vec![0, 1, 2], attributes: vec![vec![0; 4]] })
    };
    assert!(packed(short, 3).unwrap_err().what.contains("needs 36 bytes"));
    let far = |_: &[u8], _: &[DracoAttribute]| {
        Ok(DracoMesh { indices: vec![0, 1, 9], attributes: vec![vec![0; 36]] })
    };
    assert!(packed(far, 3).unwrap_err().what.contains("index 9 of 3"));
}
