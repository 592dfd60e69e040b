//! From where a scene is looked at.

use antumbra_math::{DVec3, Transform};

/// How a camera maps the scene onto the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// A pinhole.
    Perspective {
        /// Vertical angle of view [rad], in (0, π).
        vertical_fov: f64,
    },
    /// Parallel rays.
    Orthographic {
        /// Height of the picture in scene units.
        height: f64,
    },
}

/// A camera: looks from `eye` toward `look_at`, `up` upwards in the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Its name in the file; may be empty.
    pub name: String,
    /// Where it stands.
    pub eye: DVec3,
    /// A point in the middle of the picture.
    pub look_at: DVec3,
    /// Upwards.
    pub up: DVec3,
    /// Projection.
    pub projection: Projection,
    /// Size of the picture that goes with it [pixels], if the scene names one.
    pub size: Option<[u32; 2]>,
    /// Width over height, if the file names one (used when no size is given).
    pub aspect: Option<f64>,
}

impl Camera {
    /// A perspective camera; `vertical_fov` in degrees.
    pub fn perspective(eye: DVec3, look_at: DVec3, vertical_fov: f64) -> Camera {
        Camera {
            name: String::new(),
            eye,
            look_at,
            up: DVec3::Y,
            projection: Projection::Perspective { vertical_fov: vertical_fov.to_radians() },
            size: None,
            aspect: None,
        }
    }

    /// The camera of a node that looks along its −z with +y up (glTF).
    pub fn of_node(world_from_node: &Transform, projection: Projection) -> Camera {
        let eye = world_from_node.translation;
        Camera {
            name: String::new(),
            eye,
            look_at: eye - world_from_node.vector(DVec3::Z).normalize_or_zero(),
            up: world_from_node.vector(DVec3::Y),
            projection,
            size: None,
            aspect: None,
        }
    }

    /// The same with a size of its picture.
    pub fn sized(self, width: u32, height: u32) -> Camera {
        Camera { size: Some([width, height]), ..self }
    }
}
