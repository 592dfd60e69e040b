//! It is right: laws across the rooms of the core, each judged against its own standard error with fixed seeds.
//!
//! Every test states one α for all its comparisons (Šidák); `ANTUMBRA_STRESS=1` takes more rays.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail as tests do")]

mod agree;
mod batches;
mod bits;
mod blends;
mod closed;
mod closed_ao;
mod coverage;
mod explain;
mod furnace;
mod glass;
mod instances;
mod judge;
mod lengths;
mod lens;
mod masks;
mod mixture;
mod normal_maps;
mod pictures;
mod planes;
mod regions;
mod rooms;
mod scenes;
mod sky;
mod switches;
mod table;
mod teaching;
mod textured;
mod variance;
mod visibility;
mod visits;
