//! Untrusted input: cut and changed files end in an answer, paths stay in their folder.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod common;

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use antumbra_io::{
    FileError, Files, FolderFiles, Format, Limits, MemoryFiles, ReadOptions, environment_picture, format_of,
    read, read_path,
};
use antumbra_math::hash::{hash2, hash3};

/// Every file below a folder.
fn below(folder: &Path, out: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() { below(&path, out) } else { out.push(path) }
    }
}

/// Cuts and changes of every small real file. `ANTUMBRA_STRESS` asks for many more of them.
#[test]
fn cut_and_changed_files_never_panic() {
    let Some(data) = common::data("cut_and_changed_files_never_panic") else { return };
    let rounds = if std::env::var_os("ANTUMBRA_STRESS").is_some() { 400 } else { 12 };
    let mut all = Vec::new();
    ["scenes/gltf", "scenes/mesh", "bake", "env"].iter().for_each(|f| below(&data.join(f), &mut all));
    let (mut good, mut bad) = (0u32, 0u32);
    for (number, path) in all.iter().enumerate() {
        let bytes = fs::read(path).unwrap();
        let Some(format) = format_of(path, &bytes) else { continue };
        if bytes.len() > 300_000 || matches!(format, Format::NotRead(_)) {
            continue;
        }
        let folder = path.parent().unwrap();
        let files = FolderFiles::new(folder, folder, &Limits::default()).unwrap();
        for round in 0..rounds {
            let broken = damage(&bytes, number as u32, round);
            match read(format, &broken, &files, &Limits::default()) {
                // What comes through is built, too: readers must not hand over what the scene chokes on.
                Ok(scene) => {
                    good += 1;
                    if round % 4 == 1 {
                        drop(scene.build());
                    }
                }
                Err(e) => {
                    assert!(!e.what.is_empty());
                    bad += 1;
                }
            }
        }
    }
    println!("{good} read, {bad} refused");
    assert!(good > 50 && bad > 100);
}

/// A third of the damages cut the file, the others change up to four bytes, anywhere or near the beginning.
fn damage(bytes: &[u8], file: u32, round: u32) -> Vec<u8> {
    let mut out = bytes.to_vec();
    let draw = |i: u32, n: usize| hash3(file, round, i) as usize % n.max(1);
    if round.is_multiple_of(3) {
        out.truncate(draw(0, bytes.len()));
        return out;
    }
    for i in 0..1 + draw(1, 4) as u32 {
        let reach = if hash2(round, file).is_multiple_of(2) { out.len() } else { out.len().min(2000) };
        let at = draw(10 + i, reach);
        out[at] = match hash3(i, file, round) % 4 {
            0 => 0xff,
            1 => 0,
            2 => b'9',
            _ => hash3(round, i, file) as u8,
        };
    }
    out
}

#[test]
fn damaged_pictures_of_the_light_never_panic() {
    let Some(data) = common::data("damaged_pictures_of_the_light_never_panic") else { return };
    let mut all = Vec::new();
    below(&data.join("env"), &mut all);
    below(&data.join("references"), &mut all);
    let mut picked = all.iter().filter(|p| p.extension().is_some_and(|e| e == "exr" || e == "hdr"));
    let picked: Vec<_> = picked
        .by_ref()
        .enumerate()
        .filter(|(i, p)| i % 12 == 0 || p.parent().unwrap().ends_with("env"))
        .collect();
    for (i, path) in picked {
        let bytes = fs::read(path).unwrap();
        (0..12).for_each(|round| {
            drop(environment_picture(&damage(&bytes, i as u32, round), &Limits::default()))
        });
    }
}

/// Gives the files of a folder, with the pictures damaged.
struct Damaged(FolderFiles, u32);

impl Files for Damaged {
    fn open(&self, relative: &str) -> Result<Vec<u8>, FileError> {
        let bytes = self.0.open(relative)?;
        let picture = [".png", ".jpg", ".webp"].iter().any(|e| relative.ends_with(e));
        Ok(if picture { damage(&bytes, relative.len() as u32, self.1) } else { bytes })
    }
}

#[test]
fn damaged_textures_never_panic() {
    let Some(data) = common::data("damaged_textures_never_panic") else { return };
    let rounds = if std::env::var_os("ANTUMBRA_STRESS").is_some() { 400 } else { 24 };
    let mut all = Vec::new();
    ["scenes/gltf", "scenes/mesh", "bake"].iter().for_each(|f| below(&data.join(f), &mut all));
    let mut warned = 0;
    for path in all.iter().filter(|p| p.extension().is_some_and(|e| e == "gltf" || e == "obj")) {
        let (bytes, folder) = (fs::read(path).unwrap(), path.parent().unwrap());
        let format = format_of(path, &bytes).unwrap();
        // Only scenes with pictures beside them are worth the rounds.
        if !fs::read_dir(folder).unwrap().any(|e| {
            let name = e.unwrap().file_name().into_string().unwrap();
            [".png", ".jpg", ".webp"].iter().any(|e| name.ends_with(e))
        }) {
            continue;
        }
        for round in 0..rounds {
            let files = Damaged(FolderFiles::new(folder, folder, &Limits::default()).unwrap(), round);
            let scene = read(format, &bytes, &files, &Limits::default()).unwrap();
            warned += usize::from(scene.messages.iter().any(|m| m.text.contains("drawn without it")));
        }
    }
    assert!(warned > 20, "{warned}");
}

#[test]
fn paths_stay_in_their_folder() {
    let root = std::env::temp_dir().join(format!("antumbra-io-paths-{}", std::process::id()));
    let scene = root.join("scenes/a");
    fs::create_dir_all(&scene).unwrap();
    fs::write(root.join("secret"), b"s").unwrap();
    fs::write(root.join("scenes/shared.bin"), b"shared").unwrap();
    fs::write(scene.join("own.bin"), b"own").unwrap();
    let limits = Limits::default();
    let narrow = FolderFiles::new(&scene, &scene, &limits).unwrap();
    assert_eq!(narrow.open("own.bin").unwrap(), b"own");
    assert_eq!(narrow.open("./x/../own.bin").unwrap(), b"own");
    assert_eq!(narrow.open("gone.bin"), Err(FileError::Missing));
    for bad in [
        "../shared.bin",
        "../../secret",
        "/etc/hostname",
        "http://a/b",
        "C:\\a",
        "\\\\host\\a",
        "..\\shared.bin",
        "",
        "a\0b",
    ] {
        assert!(matches!(narrow.open(bad), Err(FileError::Refused(_))), "{bad:?}");
    }
    // A wider root lets a path climb up to it.
    let wide = FolderFiles::new(&root.join("scenes"), &scene, &limits).unwrap();
    assert_eq!(wide.open("../shared.bin").unwrap(), b"shared");
    assert!(matches!(wide.open("../../secret"), Err(FileError::Refused(_))));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(root.join("secret"), scene.join("link")).unwrap();
        std::os::unix::fs::symlink(&root, scene.join("up")).unwrap();
        assert!(matches!(narrow.open("link"), Err(FileError::Refused(_))));
        assert!(matches!(narrow.open("up/secret"), Err(FileError::Refused(_))));
        assert!(matches!(narrow.open("own.bin/x"), Err(FileError::Missing)));
    }
    fs::remove_dir_all(&root).unwrap();
}

#[test]
fn files_in_memory_have_no_way_out() {
    let files = MemoryFiles(HashMap::from([("tex/a.png".to_string(), vec![1])]));
    assert_eq!(files.open("./tex\\a.png").unwrap(), [1]);
    assert!(matches!(files.open("tex/../../a.png"), Err(FileError::Refused(_))));
}

#[test]
fn odd_paths_give_one_plain_message() {
    let options = ReadOptions::default();
    let says = |path: &str| read_path(Path::new(path), &options).unwrap_err().to_string();
    assert_eq!(says("nowhere.glb"), "nowhere.glb: cannot be read (no such file)");
    assert_eq!(says("/"), "/: cannot be read (it is a folder)");
    #[cfg(unix)]
    assert_eq!(says("/dev/zero"), "/dev/zero: cannot be read (it is not a regular file)");
}

/// A small file may not ask for much memory, by whatever way.
#[test]
fn small_files_stay_small() {
    let files = MemoryFiles::default();
    let refused = |json: String| {
        let e = read(Format::Gltf, json.as_bytes(), &files, &Limits::default()).unwrap_err();
        assert!(e.what.contains("out of proportion"), "{e}");
    };
    let head = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"#;
    // Zeros without a buffer.
    refused(format!(
        r#"{head}"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"componentType":5126,"count":900000000,"type":"VEC3"}}]}}"#
    ));
    // The same megabyte again and again, in another order of names each time.
    let text = "A".repeat(1 << 20);
    let primitives: Vec<_> =
        (0..400).map(|i| format!(r#"{{"attributes":{{"POSITION":0,"_{i}":0}}}}"#)).collect();
    refused(format!(
        r#"{head}"meshes":[{{"primitives":[{}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":65536,"type":"VEC3"}}],
        "bufferViews":[{{"buffer":0,"byteLength":786432}}],
        "buffers":[{{"byteLength":786432,"uri":"data:application/octet-stream;base64,{text}"}}]}}"#,
        primitives.join(",")
    ));
}
