//! The rules of glTF 2.0 that its validator holds files to, as far as they can be checked here.

use std::collections::BTreeSet;
use std::fs;

use antumbra::scene::builtin;
use serde_json::Value;

use super::{Folder, built_in, looks, write};

fn index(v: &Value) -> usize {
    usize::try_from(v.as_u64().unwrap()).unwrap()
}

fn list<'a>(document: &'a Value, name: &str) -> &'a [Value] {
    document.get(name).map_or(&[], |l| l.as_array().unwrap())
}

/// The document and the numbers of a `.glb`: header, lengths and padding are right.
fn open(bytes: &[u8]) -> (Value, Vec<u8>) {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()));
    let json = word(12);
    assert_eq!((&bytes[16..20], json % 4), (&b"JSON"[..], 0));
    let document = serde_json::from_slice(&bytes[20..20 + json]).unwrap();
    let bin = 20 + json;
    assert_eq!((word(bin) % 4, &bytes[bin + 4..bin + 8]), (0, &b"BIN\0"[..]));
    assert_eq!(bin + 8 + word(bin), bytes.len());
    (document, bytes[bin + 8..].to_vec())
}

/// Names of all extensions in a part of the document.
fn extensions(v: &Value, found: &mut BTreeSet<String>) {
    match v {
        Value::Array(all) => all.iter().for_each(|v| extensions(v, found)),
        Value::Object(all) => {
            for (name, v) in all {
                if name == "extensions" {
                    found.extend(v.as_object().unwrap().keys().cloned());
                }
                assert!(v.as_array().is_none_or(|a| !a.is_empty()), "an empty list: {name}");
                extensions(v, found);
            }
        }
        _ => {}
    }
}

/// Numbers of an accessor: views lie in the buffer, at multiples of four, and hold it to the byte.
fn numbers(document: &Value, bin: &[u8], accessor: &Value) -> Vec<f64> {
    let view = &list(document, "bufferViews")[index(&accessor["bufferView"])];
    let (offset, length) = (index(&view["byteOffset"]), index(&view["byteLength"]));
    assert!(offset % 4 == 0 && offset + length <= bin.len());
    let lanes = ["SCALAR", "VEC2", "VEC3", "VEC4"].iter().position(|k| accessor["type"] == *k).unwrap() + 1;
    let size = if accessor["componentType"] == 5123 { 2 } else { 4 };
    assert_eq!(length, index(&accessor["count"]) * lanes * size);
    let bytes = bin[offset..offset + length].chunks_exact(size);
    let number = |b: &[u8]| match index(&accessor["componentType"]) {
        5123 => f64::from(u16::from_le_bytes(b.try_into().unwrap())),
        5125 => f64::from(u32::from_le_bytes(b.try_into().unwrap())),
        _ => f64::from(f32::from_le_bytes(b.try_into().unwrap())),
    };
    bytes.map(number).collect()
}

fn primitive(document: &Value, bin: &[u8], p: &Value) {
    let accessors = list(document, "accessors");
    let attributes = p["attributes"].as_object().unwrap();
    let count = index(&accessors[index(&attributes["POSITION"])]["count"]);
    for (name, at) in attributes {
        let accessor = &accessors[index(at)];
        assert_eq!(index(&accessor["count"]), count, "{name}");
        let values = numbers(document, bin, accessor);
        assert!(values.iter().all(|x| x.is_finite()), "{name}");
        let unit = |v: &[f64]| (v.iter().map(|x| x * x).sum::<f64>().sqrt() - 1.0).abs() < 5e-4;
        match name.as_str() {
            "POSITION" => {
                for c in 0..3 {
                    let of = || values.iter().skip(c).step_by(3).copied();
                    let bounds = [of().fold(f64::INFINITY, f64::min), of().fold(f64::NEG_INFINITY, f64::max)];
                    let told = ["min", "max"].map(|m| accessor[m][c].as_f64().unwrap() as f32);
                    assert_eq!(told, bounds.map(|b| b as f32));
                }
            }
            "NORMAL" => assert!(values.chunks_exact(3).all(unit)),
            "TANGENT" => assert!(values.chunks_exact(4).all(|t| unit(&t[..3]) && t[3].abs() == 1.0)),
            "COLOR_0" => assert!(values.iter().all(|c| (0.0..=1.0).contains(c))),
            _ => assert!(["TEXCOORD_0", "TEXCOORD_1"].contains(&name.as_str()), "{name}"),
        }
    }
    match p.get("indices") {
        Some(at) => {
            let indices = numbers(document, bin, &accessors[index(at)]);
            assert!(indices.len().is_multiple_of(3) && indices.iter().all(|i| (*i as usize) < count));
        }
        None => assert_eq!(count % 3, 0),
    }
    let material = list(document, "materials")[index(&p["material"])].to_string();
    for set in 0..2 {
        let asked = material.contains(&format!("\"texCoord\":{set}"));
        assert!(!asked || attributes.contains_key(&format!("TEXCOORD_{set}")), "{material}");
    }
    // A viewer would make tangents of its own kind.
    assert!(!material.contains("normalTexture") || attributes.contains_key("TANGENT"), "{material}");
}

/// Holds one file to the rules.
fn check(bytes: &[u8]) {
    let (document, bin) = open(bytes);
    assert_eq!(document["asset"]["version"], "2.0");
    assert_eq!(index(&document["buffers"][0]["byteLength"]), bin.len());
    let mut found = BTreeSet::new();
    extensions(&document, &mut found);
    let used: BTreeSet<_> =
        list(&document, "extensionsUsed").iter().map(|n| n.as_str().unwrap().to_string()).collect();
    assert_eq!(used, found);
    let nodes = list(&document, "nodes");
    let shown: Vec<_> = list(&document["scenes"][0], "nodes").iter().map(index).collect();
    assert_eq!(shown, (0..nodes.len()).collect::<Vec<_>>());
    let mut used = [("mesh", "meshes"), ("camera", "cameras")].map(|(one, all)| {
        let of: BTreeSet<_> = nodes.iter().filter_map(|n| n.get(one)).map(index).collect();
        (of, list(&document, all).len())
    });
    for (of, there) in &mut used {
        assert_eq!(of.len(), *there, "each is used");
    }
    for node in nodes {
        if let Some(m) = node.get("matrix") {
            let m: Vec<f64> = m.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
            let dot = |a: usize, b: usize| (0..3).map(|k| m[4 * a + k] * m[4 * b + k]).sum::<f64>();
            let square = |a, b| dot(a, b).abs() <= 1e-6 * (dot(a, a) * dot(b, b)).sqrt();
            assert!(square(0, 1) && square(1, 2) && square(2, 0), "a node's axes are at right angles");
        }
    }
    for mesh in list(&document, "meshes") {
        list(mesh, "primitives").iter().for_each(|p| primitive(&document, &bin, p));
    }
    for material in list(&document, "materials") {
        let factor = material["emissiveFactor"].as_array().cloned().unwrap_or_default();
        assert!(factor.iter().all(|c| c.as_f64().unwrap() <= 1.0));
    }
    for image in list(&document, "images") {
        let view = &list(&document, "bufferViews")[index(&image["bufferView"])];
        assert_eq!(&bin[index(&view["byteOffset"])..][..4], b"\x89PNG");
    }
}

#[test]
fn files_keep_the_rules() {
    let folder = Folder::new("rules");
    let large = ["interior", "terrain", "scan", "hall"];
    for scene in builtin::SCENES.iter().filter(|s| !large.contains(&s.name)) {
        write(&folder, "a.glb", &built_in(scene.name));
        check(&fs::read(folder.0.join("a.glb")).unwrap());
    }
    write(&folder, "a.glb", &looks::everything());
    check(&fs::read(folder.0.join("a.glb")).unwrap());
}
