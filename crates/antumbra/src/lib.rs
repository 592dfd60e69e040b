//! The core: which part of each light does a point see, and how much light arrives from it?
//!
//! One loop ([`illuminate`](illuminate::illuminate)) joins four ideas that look at one [`scene`]: a [`sensor`] says where
//! light is asked for, an [`estimator`] proposes segments, visibility (`antumbra-trace`) says which are free, a
//! [`film`] sums what arrived. Modules stand in the order of their floors; each imports only from floors below.
//! The core opens no file, reads no clock and starts no thread outside [`schedule`].

// Floor 2
pub mod bsdf;
pub mod density;
pub mod film;
pub mod receiver;
pub mod sampler;
pub mod texture;
// Floor 3
pub mod light;
// Floor 4
pub mod scene;
// Floor 5
pub mod estimator;
pub mod sensor;
// Floor 6
pub mod illuminate;
pub mod settings;
// Floor 7
pub mod schedule;
// Floor 8
pub mod query;
// Floor 9
pub mod render;

pub use antumbra_math as math;
pub use antumbra_trace as trace;
