//! Arrays of questions: what is blocked, what is hit, how much light arrives. Floor 8.

mod light;
mod light_points;
mod occlusion;
mod order;
mod rays;
mod reflect;
mod regions;
mod visits;

pub use light::{Estimated, ambient_occlusion, irradiance, visible_fraction};
pub use light_points::{LightDraw, LightFound, find_light, sample_light};
pub use occlusion::{Occlusion, directions, occlusion_masks};
pub use rays::{Fill, RayHit, closest_hit, occluded};
pub use reflect::{Directions, brdf};
pub use regions::{Region, RegionFinder, RegionScratch, regions};
pub use visits::{Visited, visits};
