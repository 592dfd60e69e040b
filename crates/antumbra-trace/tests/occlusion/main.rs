//! Masks of occlusion against the definition: every method gives what `Brute` says of the same rays, bit for bit.

#![allow(clippy::unwrap_used, reason = "a world that is not built is a failed test")]

mod equals;
#[allow(dead_code, reason = "shared with the tests of the tree, which use more of it")]
#[path = "../tree/meshes.rs"]
mod meshes;
#[allow(dead_code, reason = "shared with the attacks on the law, which use more of it")]
#[path = "../attack/rng.rs"]
mod rng;
