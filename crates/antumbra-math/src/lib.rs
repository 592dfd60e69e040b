//! Floor 0: vectors and frames, solid angles, warps of the square, colours, moments.
//!
//! Everything here is pure arithmetic with the same bits on every machine: transcendental functions go through
//! [`real`], never through the platform's library.

pub mod closed;
mod frame;
pub mod hash;
pub mod real;
mod rgb;
pub mod solid_angle;
pub mod spherical;
pub mod stats;
mod transform;
pub mod warp;

pub use frame::{Frame, Local, World};
pub use glam::{DMat3, DVec2, DVec3, Vec2, Vec3};
pub use rgb::Rgb;
pub use transform::Transform;
