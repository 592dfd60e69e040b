//! What the tests of this crate share: where the data lies.

use std::path::PathBuf;

/// The data folder: `ANTUMBRA_DATA`, else beside the repository. Without it the test is skipped by name, and fails
/// where `CI` is `true`.
pub fn data(test: &str) -> Option<PathBuf> {
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("ANTUMBRA_DATA").map_or(beside, PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    assert!(std::env::var("CI").as_deref() != Ok("true"), "{test}: no data folder at {}", folder.display());
    eprintln!("skipped: {test} needs the data folder ({})", folder.display());
    None
}
