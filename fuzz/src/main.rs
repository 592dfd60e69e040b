//! libFuzzer over the target that `ANTUMBRA_FUZZ` names; `tools/fuzz.sh` builds and runs it.

#![no_main]

#[path = "../targets.rs"]
mod targets;

use std::sync::LazyLock;

use targets::{TARGETS, Target};

static CHOSEN: LazyLock<Target> = LazyLock::new(|| {
    let name = std::env::var("ANTUMBRA_FUZZ").unwrap_or_default();
    let Some((_, target)) = TARGETS.iter().find(|(n, _)| *n == name) else {
        let names: Vec<_> = TARGETS.iter().map(|(n, _)| *n).collect();
        eprintln!("ANTUMBRA_FUZZ names one of {}", names.join(", "));
        std::process::exit(2)
    };
    *target
});

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| CHOSEN(bytes));
