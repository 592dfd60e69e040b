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

/// A thin lens about the eye, across the direction of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Radius of its opening, in scene units; 0 = a pinhole.
    pub radius: f64,
    /// From the eye to the plane that is sharp, along the direction of view, in scene units.
    pub focus: f64,
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
    /// What blurs all that is not in focus; only with a perspective.
    pub lens: Option<Lens>,
    /// How far the middle of the picture lies right of and below the direction of view, in widths and heights.
    pub shift: [f64; 2],
    /// Left and right are exchanged, as where a left-handed world is seen.
    pub mirrored: bool,
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
            lens: None,
            shift: [0.0; 2],
            mirrored: false,
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
            lens: None,
            shift: [0.0; 2],
            mirrored: false,
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
        if !(self.eye.is_finite() && self.look_at.is_finite() && self.up.is_finite()) {
            return Some("eye, look-at or up is not finite".into());
        }
        if self.forward() == DVec3::ZERO {
            return Some("eye and look-at are the same point".into());
        }
        if self.up == DVec3::ZERO {
            return Some("up is 0, 0, 0: it points nowhere".into());
        }
        if self.is_along_up() {
            return Some("it looks straight along its up direction".into());
        }
        if let Some(Lens { radius, focus }) = self.lens {
            if !(radius >= 0.0 && radius.is_finite() && focus > 0.0 && focus.is_finite()) {
                return Some(format!("a lens of radius {radius}, in focus at {focus}"));
            }
            if matches!(self.projection, Projection::Orthographic { .. }) {
                return Some("a lens for parallel rays".into());
            }
        }
        if !self.shift.iter().all(|s| s.is_finite()) {
            return Some(format!("a picture shifted by {:?}", self.shift));
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

    fn forward(&self) -> DVec3 {
        (self.look_at - self.eye).normalize_or_zero()
    }

    fn is_along_up(&self) -> bool {
        self.forward().cross(self.up).length() < 1e-9 * self.up.length()
    }

    /// Where it looks straight along its up direction: another one, as if it had bent down (or up) from looking along
    /// −z. `None` where up is good as it is.
    pub fn other_up(&self) -> Option<DVec3> {
        let y = self.forward().y;
        let bent = if y.abs() > 0.5 { DVec3::new(0.0, 0.0, y.signum()) } else { DVec3::Y };
        (self.up != DVec3::ZERO && self.is_along_up()).then_some(bent)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_along_up_gets_another_up() {
        for (look_at, up, other) in [
            (DVec3::NEG_Y, DVec3::Y, Some(DVec3::NEG_Z)),
            (DVec3::Y, DVec3::Y * 3.0, Some(DVec3::Z)),
            (DVec3::NEG_Z, DVec3::Z, Some(DVec3::Y)),
            (DVec3::X, DVec3::NEG_X, Some(DVec3::Y)),
            (DVec3::new(1e-3, -1.0, 0.0), DVec3::Y, None),
        ] {
            let camera = Camera { up, ..Camera::perspective(DVec3::ZERO, look_at, 40.0) };
            assert_eq!(camera.other_up(), other, "{look_at} {up}");
            let mended = Camera { up: other.unwrap_or(up), ..camera };
            assert_eq!((mended.fault(), mended.other_up()), (None, None));
        }
    }

    #[test]
    fn what_keeps_a_camera_from_looking_is_named() {
        let camera = Camera::perspective(DVec3::X, DVec3::X, 40.0);
        assert_eq!(camera.fault().unwrap(), "eye and look-at are the same point");
        let camera = Camera { up: DVec3::ZERO, look_at: DVec3::ZERO, ..camera };
        assert_eq!(camera.fault().unwrap(), "up is 0, 0, 0: it points nowhere");
        assert_eq!(camera.other_up(), None);
        let camera = Camera::perspective(DVec3::X, DVec3::ZERO, 40.0);
        for (radius, focus) in [(-1.0, 1.0), (f64::NAN, 1.0), (1.0, 0.0), (1.0, f64::INFINITY)] {
            let camera = Camera { lens: Some(Lens { radius, focus }), ..camera.clone() };
            assert!(camera.fault().unwrap().starts_with("a lens of radius"));
        }
    }
}
