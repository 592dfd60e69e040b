//! Arrays of questions: what is blocked, what is hit, how much light arrives. Floor 8.

mod light;
mod order;
mod rays;

pub use light::{Estimated, LightDraws, ambient_occlusion, irradiance, sample_light, visible_fraction};
pub use rays::{Fill, RayHit, closest_hit, occluded};
