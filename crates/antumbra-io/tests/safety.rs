//! Untrusted input: paths stay in their folder, small files stay small. Damaged files: `broken/`.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use antumbra_io::{FileError, Files, FolderFiles, Format, Limits, MemoryFiles, ReadOptions, read, read_path};

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
