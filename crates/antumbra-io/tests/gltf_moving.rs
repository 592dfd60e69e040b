//! glTF that moves: animations, skins and morph targets at a time; variants of materials.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod common;
#[path = "common/made.rs"]
mod made;

use antumbra::scene::SceneBuilder;
use antumbra_io::{ReadOptions, read_path};
use antumbra_math::DVec3;
use made::{Made, ONE_NODE, PLAIN, TRIANGLE, close};

fn at(time: f64) -> ReadOptions {
    ReadOptions { at_time: Some(time), ..ReadOptions::default() }
}

/// A triangle whose node one channel moves: keys at `times` with `values`.
fn moved(path: &str, mode: &str, times: &[f32], lanes: usize, values: &[f32], time: f64) -> SceneBuilder {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    made.floats("SCALAR", 1, times);
    made.floats(["", "SCALAR", "", "VEC3", "VEC4"][lanes], lanes, values);
    let rest = format!(
        r#"{ONE_NODE}{PLAIN},"animations":[{{"channels":[{{"sampler":0,"target":{{"node":0,"path":"{path}"}}}}],
        "samplers":[{{"input":1,"output":2,"interpolation":"{mode}"}}]}}]"#
    );
    made.read_with(&rest, &at(time)).unwrap()
}

/// Where the node takes a point.
fn takes(s: &SceneBuilder, p: DVec3) -> [f32; 3] {
    s.objects[0].transform.point(p).as_vec3().to_array()
}

#[test]
fn keys_are_met_and_what_lies_between_follows_their_mode() {
    let values = [1.0, 0.0, 0.0, 3.0, 4.0, 0.0, 3.0, 4.0, 8.0];
    let x = |mode: &str, time: f64| {
        takes(&moved("translation", mode, &[0.5, 1.0, 3.0], 3, &values, time), DVec3::ZERO)
    };
    for mode in ["LINEAR", "STEP"] {
        for (time, want) in [(-1.0, 0), (0.0, 0), (0.5, 0), (1.0, 1), (3.0, 2), (9.0, 2)] {
            assert_eq!(x(mode, time), values[3 * want..3 * want + 3], "{mode} at {time}");
        }
    }
    assert_eq!(x("LINEAR", 0.75), [2.0, 2.0, 0.0]);
    assert_eq!(x("STEP", 0.75), [1.0, 0.0, 0.0]);
    assert_eq!(x("LINEAR", 2.5), [3.0, 4.0, 6.0]);
}

/// Hermite's cubic by hand: at half time p = (v₀ + v₁)/2 + Δt (b₀ − a₁)/8.
#[test]
fn cubic_splines_leave_and_come_along_their_tangents() {
    let values = [
        9.0, 9.0, 9.0, 1.0, 0.0, 0.0, 4.0, 0.0, 8.0, // in, value, out
        0.0, 8.0, 0.0, 3.0, 2.0, 0.0, 9.0, 9.0, 9.0,
    ];
    let x =
        |time: f64| takes(&moved("translation", "CUBICSPLINE", &[1.0, 3.0], 3, &values, time), DVec3::ZERO);
    assert_eq!((x(1.0), x(3.0)), ([1.0, 0.0, 0.0], [3.0, 2.0, 0.0]));
    assert!(close(x(2.0), [2.0 + 1.0, 1.0 - 2.0, 2.0]), "{:?}", x(2.0));
    // A quarter of the way: h₀₀ = 27/32, h₁₀ = 9/64, h₀₁ = 5/32, h₁₁ = −3/64; Δt = 2.
    let quarter =
        [27.0 / 32.0 + 15.0 / 32.0 + 8.0 * 9.0 / 64.0, 10.0 / 32.0 - 16.0 * 3.0 / 64.0, 16.0 * 9.0 / 64.0];
    assert!(close(x(1.5), quarter), "{:?}", x(1.5));
}

/// From the identity to 90° about z, given with the other sign: a third of the way is 30°, not the long way round.
#[test]
fn rotations_go_the_short_way_at_an_even_pace() {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let values = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -half, -half];
    let s = moved("rotation", "LINEAR", &[0.0, 3.0], 4, &values, 1.0);
    let (c, s30) = (f32::sqrt(3.0) / 2.0, 0.5);
    assert!(close(takes(&s, DVec3::X), [c, s30, 0.0]), "{:?}", takes(&s, DVec3::X));
    let s = moved("scale", "LINEAR", &[0.0, 1.0], 3, &[1.0, 1.0, 1.0, 3.0, 1.0, 1.0], 0.5);
    assert_eq!(takes(&s, DVec3::ONE), [2.0, 1.0, 1.0]);
}

/// simple_skin.gltf (the skinning tutorial of Khronos): two joints, the upper one turned about z; at 1 s by 90°.
#[test]
fn a_skinned_vertex_stands_where_the_hand_computes_it() {
    let Some(data) = common::data("a_skinned_vertex_stands_where_the_hand_computes_it") else { return };
    let path = data.join("scenes/gltf/simple_skin.gltf");
    let rest = read_path(&path, &ReadOptions::default()).unwrap();
    let bent = read_path(&path, &at(1.0)).unwrap();
    let (a, b) = (&rest.meshes[0].triangles.vertices, &bent.meshes[0].triangles.vertices);
    assert!(rest.messages.iter().any(|m| m.text.contains("--at-time")), "{:?}", rest.messages);
    assert!(!bent.messages.iter().any(|m| m.text.contains("--at-time")), "{:?}", bent.messages);
    // The upper joint stands at (0, 1, 0) and takes the share y/2: its part (x, y) → (1 − y, 1 + x).
    assert_eq!(a.len(), 10);
    for (&[x, y, z], &to) in a.iter().zip(b) {
        let (w, turned) = (y / 2.0, [1.0 - y, 1.0 + x]);
        let want = [(1.0 - w) * x + w * turned[0], (1.0 - w) * y + w * turned[1], z];
        assert!(close(to, want), "({x}, {y}, {z}) → {to:?}, not {want:?}");
    }
}

#[test]
fn morph_targets_follow_their_weights() {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    made.floats("VEC3", 3, &[0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 3.0]);
    made.floats("VEC3", 3, &[4.0, 0.0, 0.0, 4.0, 0.0, 0.0, 4.0, 0.0, 0.0]);
    made.floats("SCALAR", 1, &[0.0, 2.0]);
    made.floats("SCALAR", 1, &[1.0, 0.0, 0.0, 0.5]);
    let rest = r#""scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"weights":[0.25,0]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":1},{"POSITION":2}]}]}],
        "animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}],
        "samplers":[{"input":3,"output":4}]}]"#;
    let third = |s: SceneBuilder| s.meshes[0].triangles.vertices[2];
    assert!(close(third(made.read(rest).unwrap()), [0.0, 1.0, 0.75]));
    assert!(close(third(made.read_with(rest, &at(0.0)).unwrap()), [0.0, 1.0, 3.0]));
    assert!(close(third(made.read_with(rest, &at(1.0)).unwrap()), [1.0, 1.0, 1.5]));
    assert!(close(third(made.read_with(rest, &at(2.0)).unwrap()), [2.0, 1.0, 0.0]));
}

#[test]
fn broken_animations_say_where_and_clips_are_not_mixed() {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    made.floats("SCALAR", 1, &[0.0, 1.0]);
    made.floats("VEC3", 3, &[1.0, 0.0, 0.0, 2.0, 0.0, 0.0]);
    made.floats("SCALAR", 1, &[1.0, 1.0]);
    made.floats("VEC3", 3, &[7.0, 0.0, 0.0, 8.0, 0.0, 0.0]);
    let channel = r#"{"sampler":0,"target":{"node":0,"path":"translation"}}"#;
    let read = |channels: &str, sampler: &str| {
        let one = format!(r#"{{"name":"walk","channels":[{channels}],"samplers":[{sampler}]}}"#);
        made.read_with(&format!(r#"{ONE_NODE}{PLAIN},"animations":[{one},{one}]"#), &at(1.0))
    };
    let good = r#"{"input":1,"output":2}"#;
    let s = read(channel, good).unwrap();
    assert_eq!(s.objects[0].transform.translation, DVec3::new(2.0, 0.0, 0.0));
    assert!(s.messages.iter().any(|m| m.text.contains("an earlier animation")), "{:?}", s.messages);
    // Named, one clip plays alone, at 0 where no time is said.
    let clips = |second: &str, name: &str| {
        let clip = |name: &str, output: u32| {
            format!(
                r#"{{"name":"{name}","channels":[{channel}],"samplers":[{{"input":1,"output":{output}}}]}}"#
            )
        };
        let rest = format!(r#"{ONE_NODE}{PLAIN},"animations":[{},{}]"#, clip("walk", 2), clip(second, 4));
        made.read_with(&rest, &ReadOptions { animation: Some(name.into()), ..ReadOptions::default() })
    };
    for (second, name, x) in [("run", "walk", 1.0), ("run", "run", 7.0), ("", "1", 7.0)] {
        let s = clips(second, name).unwrap();
        assert!(s.messages.is_empty() && s.objects[0].transform.translation.x == x, "{:?}", s.messages);
    }
    let e = clips("run", "jump").unwrap_err();
    assert!(e.what.contains("jump") && e.hint.contains("walk, run"), "{e}");
    for (channel, sampler, word) in [
        (channel, r#"{"input":3,"output":2}"#, "do not increase"),
        (channel, r#"{"input":1,"output":2,"interpolation":"CUBICSPLINE"}"#, "need 18"),
        (channel, r#"{"input":1,"output":2,"interpolation":"WAVE"}"#, "WAVE"),
        (channel, r#"{"input":1,"output":9}"#, "accessor 9"),
        (r#"{"sampler":7,"target":{"node":0,"path":"scale"}}"#, good, "sampler 7"),
        (r#"{"sampler":0,"target":{"node":8,"path":"scale"}}"#, good, "node 8"),
        (r#"{"sampler":0,"target":{"node":0,"path":"rotation"}}"#, good, "numbers an element"),
        (r#"{"sampler":0,"target":{"node":0,"path":"weights"}}"#, good, "numbers an element"),
    ] {
        let e = read(channel, sampler).unwrap_err();
        assert!(e.place.starts_with("animation \"walk\", channel 0"), "{e}");
        assert!(e.to_string().contains(word), "{e}");
    }
    // What is no property of a node is named and stands still.
    let s = read(r#"{"sampler":0,"target":{"path":"pointer"}}"#, good).unwrap();
    assert!(s.messages[0].text.contains("pointer"), "{:?}", s.messages);
}

#[test]
fn a_variant_is_chosen_by_its_name() {
    let mut made = Made::default();
    made.floats("VEC3", 3, &TRIANGLE);
    let mappings = r#""KHR_materials_variants":{"mappings":[{"material":1,"variants":[0]},{"material":2,"variants":[1,2]}]}"#;
    let rest = format!(
        r#"{ONE_NODE}"extensionsUsed":["KHR_materials_variants"],
        "extensions":{{"KHR_materials_variants":{{"variants":[{{"name":"red"}},{{"name":"blue"}},{{"name":"navy"}}]}}}},
        "materials":[{{"name":"plain"}},{{"name":"R"}},{{"name":"B"}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0,"extensions":{{{mappings}}}}}]}}]"#
    );
    let look = |variant: Option<&str>| {
        let options = ReadOptions { variant: variant.map(Into::into), ..ReadOptions::default() };
        made.read_with(&rest, &options).map(|s| {
            let told = s.messages.iter().map(|m| m.text.clone()).collect::<String>();
            (s.materials[s.objects[0].material as usize].name.clone(), told)
        })
    };
    assert_eq!(look(Some("red")).unwrap(), ("R".into(), String::new()));
    assert_eq!(look(Some("navy")).unwrap().0, "B");
    let (name, told) = look(None).unwrap();
    assert!(name == "plain" && told.contains("red, blue, navy"), "{told}");
    let e = look(Some("green")).unwrap_err();
    assert!(e.what.contains("green") && e.hint.contains("red, blue, navy"), "{e}");
    let options = ReadOptions { variant: Some("red".into()), ..ReadOptions::default() };
    let e = made.read_with(&format!("{ONE_NODE}{PLAIN}"), &options).unwrap_err();
    assert!(e.what.contains("no variants"), "{e}");
}
