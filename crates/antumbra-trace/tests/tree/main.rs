//! The tree against the definition: whatever it is asked, it answers as `Brute` does, bit for bit, at every SIMD level.

#![allow(clippy::unwrap_used, reason = "a world that is not built is a failed test")]

mod boxes;
mod degenerate;
mod equals;
mod leaks;
mod meshes;
mod questions;
#[allow(dead_code, reason = "shared with the attacks on the law, which use more of it")]
#[path = "../attack/rng.rs"]
mod rng;
