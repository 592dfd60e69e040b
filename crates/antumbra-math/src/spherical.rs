//! Directions drawn uniformly from the solid angle of a triangle or a rectangle, density 1/Ω, in f64.
//!
//! Corners are relative to the point that looks, their counter-clockwise side faces it.

use crate::{DVec3, real, solid_angle};

const PI: f64 = std::f64::consts::PI;

/// A spherical triangle ready for sampling.
///
/// The map is Arvo's (1995): a part of the area, cut off by an arc through b, then a height on that arc. The half-angle
/// form that follows from tan(Ω/2) = V/(1 + a·b + b·c + c·a) needs one sine and cosine, and differences of corners
/// instead of cosines near 1 keep it exact for the smallest triangles.
#[derive(Clone, Copy, Debug)]
pub struct SphericalTriangle {
    /// Unit vectors to the corners.
    corners: [DVec3; 3],
    /// V of the unit vectors.
    volume: f64,
    /// Ω [sr], above 0.
    pub solid_angle: f64,
}

impl SphericalTriangle {
    /// The triangle a, b, c; `None` from behind, from its plane, or where nothing is left above rounding.
    #[inline]
    pub fn new(a: DVec3, b: DVec3, c: DVec3) -> Option<SphericalTriangle> {
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let volume = solid_angle::triangle_volume(a, b, c) / (la * lb * lc);
        let corners = [a / la, b / lb, c / lc];
        let [a, b, c] = corners;
        let solid_angle = 2.0 * real::atan2(volume, 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
        (volume > 0.0 && solid_angle.is_normal()).then_some(SphericalTriangle {
            corners,
            volume,
            solid_angle,
        })
    }

    /// A unit direction, uniform in the solid angle.
    #[inline]
    pub fn sample(&self, u: [f64; 2]) -> DVec3 {
        let [a, b, c] = self.corners;
        // The corner c′ on the arc from a to c with Ω(a, b, c′) = u₀Ω: its bisector with a is h.
        let half = 0.5 * u[0] * self.solid_angle;
        let (sin, cos) = real::sincos(half);
        let h = a * (self.volume * cos - sin * (b.dot(c) + a.dot(c))) + c * (sin * (1.0 + a.dot(b)));
        let c1 = h * (2.0 * a.dot(h) / h.length_squared()) - a;
        // On the arc from b to c′, 1 − cos uniform: with q = |c′ − b|² = 2(1 − b·c′) and t the share of the sine,
        // ω = b + t(c′ − b) − b (q/2)(u₁ − t).
        let chord = c1 - b;
        let q = chord.length_squared();
        let t = (u[1] * (4.0 - u[1] * q) / (4.0 - q)).max(0.0).sqrt();
        (b + chord * t - b * (0.5 * q * (u[1] - t))).normalize()
    }
}

/// A spherical rectangle ready for sampling (Ureña, Fajardo and King 2013).
///
/// Their four angles γ are needed only in sums: as complex numbers with those angles they are multiplied, so that one
/// arctangent gives Ω and none the phase at which the columns begin.
#[derive(Clone, Copy, Debug)]
pub struct SphericalRectangle {
    /// The rectangle in its own frame: x from `x[0]` to `x[1]`, y from `y[0]` to `y[1]`, at height −`z`.
    x: [f64; 2],
    y: [f64; 2],
    z: f64,
    /// z of the normals of the planes through the lower and the upper edge.
    b: [f64; 2],
    /// cos and sin of k = 2π − γ₂ − γ₃.
    k: [f64; 2],
    /// Ω [sr].
    pub solid_angle: f64,
}

impl SphericalRectangle {
    /// Below this (and this near to 2π) the sum of the four angles has lost more than six digits.
    const SMALLEST: f64 = 1e-6;
    /// Below this height, as a part of the reach, the columns lose their digits.
    const GRAZING: f64 = 1e-4;

    /// The rectangle (corner, u, v), u ⊥ v; `None` if it looks too small or too flat for the sum of its angles (take
    /// its two triangles then).
    #[inline]
    pub fn new(corner: DVec3, u: DVec3, v: DVec3) -> Option<SphericalRectangle> {
        let [lu, lv] = [u.length(), v.length()];
        SphericalRectangle::of_sides(corner, [u / lu, v / lv], [lu, lv])
    }

    /// The same of unit edges and their lengths.
    #[inline]
    pub fn of_sides(corner: DVec3, [ex, ey]: [DVec3; 2], [lu, lv]: [f64; 2]) -> Option<SphericalRectangle> {
        let (x0, y0, z) = (corner.dot(ex), corner.dot(ey), corner.dot(ex.cross(ey)).abs());
        let (x1, y1) = (x0 + lu, y0 + lv);
        if z <= Self::GRAZING * (x0.abs().max(x1.abs()) + y0.abs().max(y1.abs())) {
            return None;
        }
        // γ between the planes of two edges that meet in a corner at distance r: cos ∝ ∓xy, sin ∝ zr.
        let angle = |x: f64, y: f64, sign: f64| [sign * x * y, z * (x * x + y * y + z * z).sqrt()];
        let lower = times(angle(x1, y0, 1.0), angle(x1, y1, -1.0));
        let upper = times(angle(x0, y1, 1.0), angle(x0, y0, -1.0));
        let [cos, sin] = times(lower, upper);
        // γ₀ + γ₁ + γ₂ + γ₃ − 2π, in (0, 2π).
        let angle = real::atan2(sin, cos);
        let solid_angle = if angle < 0.0 { angle + 2.0 * PI } else { angle };
        let size = (upper[0] * upper[0] + upper[1] * upper[1]).sqrt();
        (angle.abs() > Self::SMALLEST).then(|| SphericalRectangle {
            x: [x0, x1],
            y: [y0, y1],
            z,
            b: [-y0 / (y0 * y0 + z * z).sqrt(), y1 / (y1 * y1 + z * z).sqrt()],
            k: [upper[0] / size, -upper[1] / size],
            solid_angle,
        })
    }

    /// The point (α, β) of the rectangle, corner + α u + β v, whose direction is uniform in the solid angle.
    #[inline]
    pub fn sample(&self, u: [f64; 2]) -> [f64; 2] {
        let ([x0, x1], [y0, y1], z2) = (self.x, self.y, self.z * self.z);
        // The column x up to which the part u₀ of the solid angle lies: f = (b₀ cos a − b₁)/sin a at a = u₀Ω + k,
        // x = z/√(f² + b₀² − 1) on the side of f.
        let (sin, cos) = real::sincos(u[0] * self.solid_angle);
        let [cos, sin] = times([cos, sin], self.k);
        let f = cos * self.b[0] - self.b[1];
        let root = (f * f - z2 / (y0 * y0 + z2) * (sin * sin)).max(f64::MIN_POSITIVE).sqrt();
        let x = ((self.z * sin).copysign(f * sin) / root).clamp(x0, x1);
        // On it, sines of the latitude are uniform.
        let d2 = x * x + z2;
        let sine = |y: f64| y / (d2 + y * y).sqrt();
        let s = sine(y0) + u[1] * (sine(y1) - sine(y0));
        let y = (s * (d2 / (1.0 - s * s)).sqrt()).clamp(y0, y1);
        [(x - x0) / (x1 - x0), (y - y0) / (y1 - y0)]
    }
}

/// The product of two complex numbers: their angles add.
#[inline]
fn times([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}
