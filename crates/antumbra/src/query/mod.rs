//! Arrays of questions: what is blocked, what is hit, how much light arrives. Floor 8.

mod light;
mod order;
mod rays;
mod regions;
mod visits;

pub use light::{Estimated, LightDraws, ambient_occlusion, irradiance, sample_light, visible_fraction};
pub use rays::{Fill, RayHit, closest_hit, occluded};
pub use regions::{Region, RegionFinder, RegionScratch, regions};
pub use visits::{Visited, visits};
