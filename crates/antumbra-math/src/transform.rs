//! Affine maps in f64: where an object stands in the world.

use glam::{DMat3, DVec3};

use crate::real;

/// x ↦ M x + t, in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// The linear part M.
    pub linear: DMat3,
    /// The translation t.
    pub translation: DVec3,
}

impl Transform {
    /// x ↦ x.
    pub const IDENTITY: Transform = Transform { linear: DMat3::IDENTITY, translation: DVec3::ZERO };

    /// A translation.
    pub fn translation(t: DVec3) -> Transform {
        Transform { linear: DMat3::IDENTITY, translation: t }
    }

    /// A linear map.
    pub fn linear(linear: DMat3) -> Transform {
        Transform { linear, translation: DVec3::ZERO }
    }

    /// A rotation by `angle` [rad] about a unit `axis`, counterclockwise as seen from its tip (Rodrigues).
    pub fn rotation(axis: DVec3, angle: f64) -> Transform {
        let (s, c) = (real::sin(angle), real::cos(angle));
        let turn = |v: DVec3| v * c + axis.cross(v) * s + axis * (axis.dot(v) * (1.0 - c));
        Transform::linear(DMat3::from_cols(turn(DVec3::X), turn(DVec3::Y), turn(DVec3::Z)))
    }

    /// Takes what looks along +z from the origin, +y upwards, to `eye`: +z goes to the unit vector `forward`, +x to
    /// up × forward. `None` if `up` lies along `forward`.
    pub fn looking(eye: DVec3, forward: DVec3, up: DVec3) -> Option<Transform> {
        let side = up.cross(forward).try_normalize()?;
        Some(Transform { linear: DMat3::from_cols(side, forward.cross(side), forward), translation: eye })
    }

    /// From the columns of a 4×4 matrix (glTF order); the last row is taken as (0, 0, 0, 1).
    pub fn from_columns(m: &[f64; 16]) -> Transform {
        let col = |i: usize| DVec3::new(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
        Transform { linear: DMat3::from_cols(col(0), col(1), col(2)), translation: col(3) }
    }

    /// From translation, rotation (unit quaternion x, y, z, w) and scale, applied in the order scale, rotate, translate.
    pub fn from_trs(t: DVec3, q: [f64; 4], s: DVec3) -> Transform {
        let r = DMat3::from_quat(glam::DQuat::from_xyzw(q[0], q[1], q[2], q[3]));
        Transform { linear: r * DMat3::from_diagonal(s), translation: t }
    }

    /// The map `self ∘ inner`: first `inner`, then `self`.
    pub fn after(&self, inner: &Transform) -> Transform {
        Transform {
            linear: self.linear * inner.linear,
            translation: self.linear * inner.translation + self.translation,
        }
    }

    /// The image of a point.
    #[inline]
    pub fn point(&self, p: DVec3) -> DVec3 {
        self.linear * p + self.translation
    }

    /// The image of a direction (not normalised).
    #[inline]
    pub fn vector(&self, v: DVec3) -> DVec3 {
        self.linear * v
    }

    /// The image of an outward normal (not normalised): cofactors of M times the sign of det M, so that a mirrored
    /// object keeps its outside outside.
    #[inline]
    pub fn normal(&self, n: DVec3) -> DVec3 {
        let m = self.linear;
        let (cx, cy, cz) = (m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
        let sign = 1f64.copysign(m.x_axis.dot(cx));
        (cx * n.x + cy * n.y + cz * n.z) * sign
    }

    /// The inverse map, if M is not singular.
    pub fn inverse(&self) -> Option<Transform> {
        let det = self.linear.determinant();
        if det == 0.0 || !det.is_finite() {
            return None;
        }
        let linear = self.linear.inverse();
        Some(Transform { linear, translation: -(linear * self.translation) })
    }

    /// M mirrors (its determinant is negative): triangles turn round.
    pub fn mirrors(&self) -> bool {
        self.linear.determinant() < 0.0
    }

    /// All twelve numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.linear.is_finite() && self.translation.is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lengths and angles stay, the axis stays, and two turns are one by their sum: to a few roundings of numbers near 1.
    #[test]
    fn a_rotation_is_one() {
        let axis = DVec3::new(1.0, -2.0, 0.5).normalize();
        let (a, b) = (Transform::rotation(axis, 0.7), Transform::rotation(axis, -2.1));
        let sum = Transform::rotation(axis, -1.4);
        assert!(a.after(&b).linear.abs_diff_eq(sum.linear, 1e-15));
        assert!((a.linear.transpose() * a.linear).abs_diff_eq(DMat3::IDENTITY, 1e-15) && !a.mirrors());
        assert!(a.vector(axis).abs_diff_eq(axis, 1e-15));
        let quarter = Transform::rotation(DVec3::Z, std::f64::consts::FRAC_PI_2);
        assert!(quarter.vector(DVec3::X).abs_diff_eq(DVec3::Y, 1e-15));
    }

    #[test]
    fn who_looks_sees_up_upwards() {
        let (eye, forward, up) = (DVec3::new(1.0, 2.0, 3.0), DVec3::NEG_Z, DVec3::new(0.0, 2.0, 5.0));
        let look = Transform::looking(eye, forward, up).map(|t| (t.linear, t.translation));
        let linear = DMat3::from_cols(DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z);
        assert_eq!(look, Some((linear, eye)));
        assert_eq!(Transform::looking(eye, forward, DVec3::Z), None);
    }
}
