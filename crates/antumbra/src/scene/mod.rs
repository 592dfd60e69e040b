//! What there is to see: builder → checked, immutable scene. Floor 4.

mod areas;
mod build;
mod builder;
pub mod builtin;
mod camera;
mod emissive;
mod fingerprint;
mod looks;
mod material;
mod message;
mod parts;
mod place;
mod reflects;
mod roughness;
#[allow(clippy::module_inception)]
mod scene;
mod shading;
mod surface;
mod suspect;
mod tangents;

pub use areas::{SurfaceAreas, SurfacePoint};
pub use builder::{Body, Mesh, MeshId, Object, SceneBuilder};
pub use camera::{Camera, Lens, Projection};
pub use material::{Alpha, BumpMap, Emission, Material, MaterialId, NormalMap, TextureId, blended};
pub use message::{Level, Message, SceneError, nearest};
pub use place::Start;
pub use reflects::Surface;
pub use roughness::{Channel, Roughness};
pub use scene::{Emits, LightNames, Placed, Scene, SceneMesh, SceneVisibility};
pub use surface::{Errand, Look, Met, Ray};
pub use suspect::Surfaces;
pub use tangents::Tangents;
