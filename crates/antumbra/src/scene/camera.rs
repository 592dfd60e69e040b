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

    /// Why it cannot look, if it cannot.
    pub fn fault(&self) -> Option<String> {
        let finite = self.eye.is_finite() && self.look_at.is_finite() && self.up.is_finite();
        let forward = (self.look_at - self.eye).normalize_or_zero();
        if !finite || forward == DVec3::ZERO || forward.cross(self.up).length() < 1e-9 * self.up.length() {
            return Some("eye, look-at and up do not span a view".into());
        }
        match self.projection {
            Projection::Perspective { vertical_fov }
                if !(vertical_fov > 0.0 && vertical_fov < std::f64::consts::PI) =>
            {
                Some(format!("vertical angle of view {}°", vertical_fov.to_degrees()))
            }
            Projection::Orthographic { height } if !(height > 0.0 && height.is_finite()) => {
                Some(format!("height of view {height}"))
            }
            _ => None,
        }
    }

    /// A camera from the front right above that sees everything between two corners.
    pub fn seeing(low: DVec3, high: DVec3) -> Camera {
        let center = (low + high) * 0.5;
        let radius = ((high - low) * 0.5).length().max(1e-30);
        let fov: f64 = 40.0;
        let away = DVec3::new(0.6, 0.45, 1.0).normalize();
        let distance = radius / antumbra_math::real::sin((fov / 2.0).to_radians());
        Camera::perspective(center + away * distance, center, fov)
    }
}
