//! What there is to see: builder → checked, immutable scene. Floor 4.

mod builder;
pub mod builtin;
mod camera;
mod material;
mod message;

pub use builder::{Body, Mesh, MeshId, Object, SceneBuilder};
pub use camera::{Camera, Projection};
pub use material::{Alpha, Emission, Material, MaterialId, Surface, TextureId};
pub use message::{Level, Message, SceneError};
