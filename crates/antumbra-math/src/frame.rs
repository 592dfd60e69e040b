//! Directions with their space in the type: [`World`] as the scene has them, [`Local`] with n = +z.

use glam::Vec3;

/// A direction or point in world space.
pub type World = Vec3;

/// A direction in the frame of a receiver, n = +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Local(pub Vec3);

impl Local {
    /// A local direction of its components.
    #[inline]
    pub const fn new(x: f32, y: f32, z: f32) -> Local {
        Local(Vec3::new(x, y, z))
    }

    /// cos θ: the cosine to the normal, signed.
    #[inline]
    pub fn cos(self) -> f32 {
        self.0.z
    }

    /// Mirrored about the normal.
    #[inline]
    pub fn mirrored(self) -> Local {
        Local::new(-self.0.x, -self.0.y, self.0.z)
    }

    /// Both directions lie on the same side of the surface (neither grazing).
    #[inline]
    pub fn same_side(self, other: Local) -> bool {
        (self.cos() > 0.0 && other.cos() > 0.0) || (self.cos() < 0.0 && other.cos() < 0.0)
    }
}

/// An orthonormal frame (s, t, n).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// First tangent.
    pub s: Vec3,
    /// Second tangent, n × s.
    pub t: Vec3,
    /// Normal.
    pub n: Vec3,
}

impl Frame {
    /// The frame about the unit vector `n` (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3).
    #[inline]
    pub fn about(n: Vec3) -> Frame {
        let sign = 1f32.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Frame {
            s: Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            t: Vec3::new(b, sign + n.y * n.y * a, -n.y),
            n,
        }
    }

    /// The same normal with its first tangent towards `t`, as far as that lies across the normal.
    #[inline]
    pub fn turned_to(self, t: Vec3) -> Frame {
        let across = (t - self.n * t.dot(self.n)).normalize_or_zero();
        if across == Vec3::ZERO { self } else { Frame { s: across, t: self.n.cross(across), n: self.n } }
    }

    /// World → local.
    #[inline]
    pub fn to_local(&self, w: World) -> Local {
        Local::new(w.dot(self.s), w.dot(self.t), w.dot(self.n))
    }

    /// Local → world.
    #[inline]
    pub fn to_world(&self, l: Local) -> World {
        self.s * l.0.x + self.t * l.0.y + self.n * l.0.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_orthonormal_and_invert() {
        for i in 0..1000u32 {
            let u = [
                crate::hash::unit_f32(crate::hash::mix32(i)),
                crate::hash::unit_f32(crate::hash::mix32(i + 77_777)),
            ];
            let z = 1.0 - 2.0 * u[0];
            let phi = 2.0 * crate::real::PI * u[1];
            let r = crate::real::safe_sqrt(1.0 - z * z);
            let n = Vec3::new(r * crate::real::cosf(phi), r * crate::real::sinf(phi), z);
            let f = Frame::about(n);
            // A few roundings of unit components.
            let tol = 1e-6;
            assert!(f.s.dot(f.t).abs() < tol && f.s.dot(f.n).abs() < tol && f.t.dot(f.n).abs() < tol);
            assert!((f.to_world(f.to_local(Vec3::X)) - Vec3::X).length() < tol);
        }
    }
}
