//! Untrusted input: damaged copies of every real file end in a scene that renders or in a message: no panic, at most 10
//! seconds and 2 GiB each. `ANTUMBRA_STRESS` asks for 200 damages of each file instead of 5.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

#[path = "../common/mod.rs"]
mod common;
mod damage;

use std::collections::HashMap;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

use antumbra::render::render;
use antumbra::scene::SceneBuilder;
use antumbra::schedule::Flow;
use antumbra::settings::Settings;
use antumbra_io::{FileError, Files, FolderFiles, Format, Limits, MemoryFiles, ReadError, format_of, read};
use antumbra_math::hash::fnv1a;
use damage::damage;

const SECONDS: f64 = 10.0;
const MEBIBYTES: u64 = 2048;
/// Below so many bytes every damaged file that still reads is built and rendered, above every fifth.
const SMALL: usize = 100_000;

/// The folders of the data whose files are damaged.
const FOLDERS: [&str; 5] = ["scenes/gltf", "scenes/mesh", "scenes/xml", "bake", "env"];

/// A picture on a triangle.
const PICTURE_ON_TRIANGLE: &[u8] =
    b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";

/// What scenes of many meshes get for each: those are damaged by themselves.
const TRIANGLE: &[u8] = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
    property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
    0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// The files beside a scene; one of them is replaced.
struct Beside<'a> {
    folder: FolderFiles,
    replaced: Option<(&'a str, &'a [u8])>,
}

impl Files for Beside<'_> {
    fn open(&self, relative: &str) -> Result<Vec<u8>, FileError> {
        match self.replaced {
            Some((name, bytes)) if relative.ends_with(name) => Ok(bytes.to_vec()),
            _ if relative.ends_with(".ply") => Ok(TRIANGLE.to_vec()),
            _ => self.folder.open(relative),
        }
    }
}

/// How a file is read once it is damaged.
enum Way {
    /// It is a scene.
    Scene(Format),
    /// It is a picture, put on a triangle.
    Picture,
    /// It belongs to this scene beside it.
    Part(PathBuf),
}

fn extension(path: &Path) -> &str {
    path.extension().and_then(|e| e.to_str()).unwrap_or("")
}

fn below(folder: &Path, out: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() { below(&path, out) } else { out.push(path) }
    }
}

fn way(path: &Path, bytes: &[u8]) -> Option<Way> {
    match extension(path) {
        "png" | "jpg" | "webp" => Some(Way::Picture),
        "bin" | "mtl" => {
            let scenes = fs::read_dir(path.parent()?).ok()?.flatten().map(|e| e.path());
            let name = path.file_name()?.as_encoded_bytes().to_vec();
            let names = |p: &PathBuf| {
                let text = fs::read(p).unwrap_or_default();
                matches!(extension(p), "gltf" | "obj") && text.windows(name.len()).any(|w| w == name)
            };
            scenes.filter(names).min().map(Way::Part)
        }
        _ => match format_of(path, bytes)? {
            Format::NotRead(_) => None,
            format => Some(Way::Scene(format)),
        },
    }
}

fn read_damaged(path: &Path, way: &Way, bytes: &[u8]) -> Result<SceneBuilder, ReadError> {
    let limits = Limits::default();
    let folder = path.parent().unwrap();
    let beside = |replaced| Beside { folder: FolderFiles::new(folder, folder, &limits).unwrap(), replaced };
    match way {
        Way::Scene(format) => read(*format, bytes, &beside(None), &limits),
        Way::Picture => {
            let mtl = format!("newmtl a\nmap_Kd t.{}\n", extension(path)).into_bytes();
            let picture = (format!("t.{}", extension(path)), bytes.to_vec());
            let files = MemoryFiles(HashMap::from([("m.mtl".into(), mtl), picture]));
            read(Format::Obj, PICTURE_ON_TRIANGLE, &files, &limits)
        }
        Way::Part(scene) => {
            let name = path.file_name().unwrap().to_str().unwrap();
            let text = fs::read(scene).unwrap();
            read(format_of(scene, &text).unwrap(), &text, &beside(Some((name, bytes))), &limits)
        }
    }
}

/// Builds and renders what came through; whether there is a picture.
fn answered(read: Result<SceneBuilder, ReadError>, draw: bool) -> bool {
    let scene = match read {
        Ok(scene) if draw => scene.build().map_err(ReadError::from),
        Ok(_) => return true,
        Err(e) => Err(e),
    };
    let scene = match scene {
        Ok(scene) => scene,
        Err(e) => {
            assert!(!e.what.is_empty(), "an error says what is wrong");
            return false;
        }
    };
    drop(scene.looks_wrong(&scene.surfaces()));
    let settings = Settings { size: Some([8, 6]), viewing_rays: 1, threads: 1, ..Settings::default() };
    match render(&scene, &settings, None, &mut |_| Flow::Continue) {
        Ok(picture) => {
            assert!(picture.pixels.as_flattened().iter().all(|p| p.is_finite()), "a pixel is not finite");
            true
        }
        Err(e) => {
            assert!(!e.what.is_empty(), "an error says what is wrong");
            false
        }
    }
}

/// The most memory since the last call [MiB]; 0 where the system does not tell.
fn peak_memory() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse().ok());
    // "5": from here on, the peak counts anew (proc_pid_clear_refs(5)).
    let _ = fs::write("/proc/self/clear_refs", "5");
    peak.unwrap_or(0u64) / 1024
}

/// What all damages together did.
#[derive(Default)]
struct Tally {
    files: u32,
    answered: u32,
    refused: u32,
    seconds: (f64, String),
    mebibytes: (u64, String),
    wrong: Vec<String>,
}

impl Tally {
    fn take(&mut self, name: &str, path: &Path, way: &Way, broken: &[u8], draw: bool) {
        let began = Instant::now();
        let outcome = catch_unwind(AssertUnwindSafe(|| answered(read_damaged(path, way, broken), draw)));
        let (seconds, mebibytes) = (began.elapsed().as_secs_f64(), peak_memory());
        match outcome {
            Ok(true) => self.answered += 1,
            Ok(false) => self.refused += 1,
            Err(cause) => {
                let text = cause.downcast_ref::<String>().map(String::as_str);
                let text = text.or_else(|| cause.downcast_ref::<&str>().copied()).unwrap_or("?");
                self.wrong.push(format!("{name}: {text}"));
            }
        }
        if seconds > SECONDS || mebibytes > MEBIBYTES {
            self.wrong.push(format!("{name}: {seconds:.1} s, {mebibytes} MiB"));
        }
        if seconds > self.seconds.0 {
            self.seconds = (seconds, name.into());
        }
        if mebibytes > self.mebibytes.0 {
            self.mebibytes = (mebibytes, name.into());
        }
    }
}

#[test]
fn damaged_files_end_in_an_answer() {
    let Some(data) = common::data("damaged_files_end_in_an_answer") else { return };
    let rounds = if std::env::var_os("ANTUMBRA_STRESS").is_some() { 200 } else { 5 };
    let mut all = Vec::new();
    FOLDERS.iter().for_each(|f| below(&data.join(f), &mut all));
    let mut tally = Tally::default();
    peak_memory();
    for path in &all {
        let bytes = fs::read(path).unwrap();
        let Some(way) = way(path, &bytes) else { continue };
        tally.files += 1;
        let name = path.strip_prefix(&data).unwrap().display().to_string();
        let number = fnv1a(name.as_bytes()) as u32;
        for round in 0..rounds {
            let draw = bytes.len() < SMALL || round % 25 == number % 5;
            let broken = damage(&bytes, number, round);
            tally.take(&format!("{name}, damage {round}"), path, &way, &broken, draw);
        }
    }
    println!("{} files: {} answered, {} refused", tally.files, tally.answered, tally.refused);
    println!(
        "longest {:.2} s ({}), most {} MiB ({})",
        tally.seconds.0, tally.seconds.1, tally.mebibytes.0, tally.mebibytes.1
    );
    assert!(tally.wrong.is_empty(), "{} of them:\n{}", tally.wrong.len(), tally.wrong.join("\n"));
    assert!(tally.files > 100 && tally.answered > 100 && tally.refused > 100);
}
