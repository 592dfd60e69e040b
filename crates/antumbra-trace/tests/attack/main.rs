//! Attacks on visibility: adversarial cases with fixed seeds, each against a truth that shares no code with the crate
//! (LAW §7). One failure fails. ANTUMBRA_STRESS=1 runs millions.

mod brute;
mod cases;
mod law;
mod leaks;
mod meshes;
mod rng;
mod shapes;
mod start;
mod truth;
