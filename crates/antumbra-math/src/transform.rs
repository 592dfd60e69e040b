//! Affine maps in f64: where an object stands in the world.

use glam::{DMat3, DVec3};

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
