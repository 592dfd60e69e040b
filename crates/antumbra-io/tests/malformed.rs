//! Every case of the manifest of broken files gets the answer that it names, in time, without a panic.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod common;

use std::time::Instant;

use antumbra::scene::Level;
use antumbra_io::{ReadError, ReadOptions, read_path};

#[derive(serde::Deserialize)]
struct Manifest {
    cases: Vec<Case>,
}

#[derive(serde::Deserialize)]
struct Case {
    file: String,
    expect: String,
    why: String,
}

#[test]
fn the_manifest_of_broken_files() {
    let Some(data) = common::data("the_manifest_of_broken_files") else { return };
    let folder = data.join("malformed");
    let text = std::fs::read(folder.join("manifest.json")).unwrap();
    let manifest: Manifest = serde_json::from_slice(&text).unwrap();
    let mut wrong = Vec::new();
    for case in &manifest.cases {
        let path = folder.join(&case.file);
        let begin = Instant::now();
        let (got, said) = answer(&path);
        println!("{}: {said}", case.file);
        if got != case.expect || begin.elapsed().as_secs_f64() > 5.0 {
            wrong.push(format!("{} ({}): {} expected, {got}: {said}", case.file, case.why, case.expect));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn answer(path: &std::path::Path) -> (&'static str, String) {
    let built = read_path(path, &ReadOptions::default())
        .and_then(|builder| builder.build().map_err(|e| ReadError::from(e).of(path.to_str().unwrap())));
    match built {
        Err(e) => {
            let text = e.to_string();
            assert!(text.starts_with(path.to_str().unwrap()), "{text}");
            ("error", text)
        }
        Ok(scene) => {
            let warnings: Vec<_> = scene.messages.iter().filter(|m| m.level == Level::Warning).collect();
            let said: Vec<_> = warnings.iter().map(|m| format!("{}: {}", m.place, m.text)).collect();
            (if warnings.is_empty() { "ok" } else { "warning" }, said.join("; "))
        }
    }
}
