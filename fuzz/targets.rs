//! What random bytes are thrown at: one target a reader, and one from a scene to a picture. A panic, a picture that is not
//! finite or an error without words is a finding. `fuzz/src/main.rs` makes the bytes, `crates/antumbra-io/tests/corpus.rs`
//! replays those that were worth keeping.

use std::collections::HashMap;

use antumbra::render::render;
use antumbra::schedule::Flow;
use antumbra::settings::Settings;
use antumbra_io::{Format, Limits, MemoryFiles, ReadError, read};

/// Answers bytes.
pub type Target = fn(&[u8]);

/// Every target by its name, which its folder of the corpus has too. To add one: a line here and a folder.
pub const TARGETS: [(&str, Target); 10] = [
    ("gltf", |bytes| scene(Format::Gltf, bytes)),
    ("obj", |bytes| scene(Format::Obj, bytes)),
    ("ply", |bytes| scene(Format::Ply, bytes)),
    ("stl", |bytes| scene(Format::Stl, bytes)),
    ("mitsuba", |bytes| scene(Format::Mitsuba, bytes)),
    ("pbrt", |bytes| scene(Format::Pbrt, bytes)),
    ("environment", |bytes| scene(Format::Environment, bytes)),
    ("texture", texture),
    ("serialized", serialized),
    ("picture", picture),
];

/// Memory enough for any honest scene of this size, so that a finding is one of ours.
fn limits() -> Limits {
    Limits { pixels: 1 << 20, texture_bytes: 64 << 20, ..Limits::default() }
}

fn refused(error: &ReadError) {
    assert!(!error.what.is_empty(), "an error says what is wrong");
}

/// Bytes to a scene that is built.
fn scene(format: Format, bytes: &[u8]) {
    with(format, bytes, &MemoryFiles(HashMap::new()), false);
}

/// A picture on a triangle.
fn texture(bytes: &[u8]) {
    let files = [("m.mtl", b"newmtl a\nmap_Kd t.png\n".to_vec()), ("t.png", bytes.to_vec())];
    let triangle =
        b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";
    with(Format::Obj, triangle, &beside(files), false);
}

/// Mitsuba's packed meshes.
fn serialized(bytes: &[u8]) {
    let scene = b"<scene version='3.0.0'><shape type='serialized'>\
        <string name='filename' value='t.serialized'/></shape></scene>";
    with(Format::Mitsuba, scene, &beside([("t.serialized", bytes.to_vec())]), false);
}

/// A scene of the format that the first byte chooses, drawn in 4 × 4 pixels.
fn picture(bytes: &[u8]) {
    let formats = [Format::Gltf, Format::Obj, Format::Ply, Format::Stl, Format::Mitsuba, Format::Pbrt];
    let Some((first, bytes)) = bytes.split_first() else { return };
    let format = formats[usize::from(*first) % formats.len()];
    with(format, bytes, &MemoryFiles(HashMap::new()), true);
}

fn beside<const N: usize>(files: [(&str, Vec<u8>); N]) -> MemoryFiles {
    MemoryFiles(files.into_iter().map(|(name, bytes)| (name.to_string(), bytes)).collect())
}

fn with(format: Format, bytes: &[u8], files: &MemoryFiles, draw: bool) {
    let read = read(format, bytes, files, &limits());
    let scene = match read.and_then(|scene| scene.build().map_err(ReadError::from)) {
        Ok(scene) => scene,
        Err(e) => return refused(&e),
    };
    drop(scene.looks_wrong(&scene.surfaces()));
    if !draw {
        return;
    }
    let settings = Settings { size: Some([4, 4]), viewing_rays: 1, threads: 1, ..Settings::default() };
    match render(&scene, &settings, None, &mut |_| Flow::Continue) {
        Ok(picture) => {
            let finite = picture.pixels.as_flattened().iter().all(|p| p.is_finite());
            assert!(finite, "a pixel is not finite");
        }
        Err(e) => assert!(!e.what.is_empty(), "an error says what is wrong"),
    }
}
