//! Closed forms of the irradiance [W/m²] that lights of radiance 1 send to a surface with nothing in the way, in f64.
//!
//! Centres and corners are relative to the lit point, n is its unit normal. Flat lights have a front, the side from which
//! their corners run counter-clockwise; their irradiance is positive when it faces the point, negative from behind.

use crate::{DVec3, real};

const PI: f64 = std::f64::consts::PI;

/// The irradiance of a cone of radiance 1 and half-angle α, its axis at the cosine `cos_axis` to the normal.
///
/// Above the horizon π sin²α cos θ. Cut by it (x = cot α, y = −x cot θ):
/// sin²α (cos θ acos y − x sin θ √(1−y²)) + atan(sin θ √(1−y²) / x)   (Snyder 1996).
/// That form cancels like α², so cones below 10⁻⁴ rad take the flat disk cut by a straight horizon, exact to α².
pub fn cone(versin: f64, cos_axis: f64) -> f64 {
    let sin2 = versin * (2.0 - versin);
    let (sin, cos) = (sin2.sqrt(), 1.0 - versin);
    if cos_axis >= sin {
        return PI * sin2 * cos_axis;
    }
    if cos_axis <= -sin {
        return 0.0;
    }
    if sin < 1e-4 {
        // ∫ (h + t) 2√(1−t²) dt over t in [−h, 1], h = cos θ / α.
        let h = cos_axis / sin;
        let w = (1.0 - h * h).max(0.0).sqrt();
        let area = 0.5 * PI + real::asin(h) + h * w;
        return sin2 * sin * (h * area + 2.0 / 3.0 * w * w * w).max(0.0);
    }
    let x = cos / sin;
    let sin_axis = (1.0 - cos_axis * cos_axis).max(0.0).sqrt();
    let y = (-x * cos_axis / sin_axis).clamp(-1.0, 1.0);
    let rim = sin_axis * (1.0 - y * y).sqrt();
    (sin2 * (cos_axis * real::acos(y) - x * rim) + real::atan2(rim, x)).max(0.0)
}

/// The irradiance of a polygon of radiance 1 on a surface with unit normal `n`, the polygon clipped by the horizon:
/// E = ½ Σ θᵢ n·(pᵢ₊₁ × pᵢ)/|pᵢ₊₁ × pᵢ| (Lambert 1760), signed like the solid angle.
///
/// Written without the clipped polygon: each edge contributes its part above the horizon, and the edges that clipping
/// adds lie in the horizon, where n·(pᵢ₊₁ × pᵢ) is the whole angle between leaving and coming back.
pub fn polygon(corners: &[DVec3], n: DVec3) -> f64 {
    let mut sum = 0.0;
    let (mut leaves, mut enters) = (None, None);
    for (i, &p) in corners.iter().enumerate() {
        let q = corners[(i + 1) % corners.len()];
        let (hp, hq) = (n.dot(p), n.dot(q));
        match (hp >= 0.0, hq >= 0.0) {
            (true, true) => sum += edge(p, q, n),
            (true, false) => {
                let x = p + (q - p) * (hp / (hp - hq));
                sum += edge(p, x, n);
                leaves = Some(x);
            }
            (false, true) => {
                let x = p + (q - p) * (hp / (hp - hq));
                sum += edge(x, q, n);
                enters = Some(x);
            }
            (false, false) => {}
        }
    }
    if let (Some(x), Some(y)) = (leaves, enters) {
        sum += edge(x, y, n);
    }
    0.5 * sum
}

/// θ n·(q × p)/|q × p| for the angle θ between p and q.
#[inline]
fn edge(p: DVec3, q: DVec3, n: DVec3) -> f64 {
    let cross = q.cross(p);
    let (s2, c) = (cross.length_squared(), p.dot(q));
    // θ/|q × p| by the series of atan where the edge looks short: no cancellation, no root.
    let x2 = s2 / (c * c);
    let weight = if c > 0.0 && x2 < 1e-3 {
        (1.0 - x2 * (1.0 / 3.0 - x2 * (1.0 / 5.0 - x2 * (1.0 / 7.0 - x2 * (1.0 / 9.0))))) / c
    } else if s2 > 0.0 {
        let s = s2.sqrt();
        real::atan2(s, c) / s
    } else {
        0.0
    };
    weight * n.dot(cross)
}

/// The irradiance of a disk of radiance 1 that lies wholly above the horizon of `n`: centre c, unit front normal m,
/// signed like the solid angle.
///
/// With h the height over the disk's plane, a the distance from its axis, s = h² + a² + R², w = √(s² − 4a²R²), the
/// parts toward the plane and toward the axis are (π/2)(1 − (s − 2R²)/w) and (πh/2a)(s/w − 1) (Howell's catalogue of
/// configuration factors). Here with s − w = 4a²R²/(s + w) and k = s − 2a², w² − k² = 4a²h², which cancel nothing.
pub fn disk(center: DVec3, m: DVec3, radius: f64, n: DVec3) -> f64 {
    let front = 1f64.copysign(-center.dot(m));
    let (up, h) = (m * -front, center.dot(m).abs());
    let side = center - up * h;
    let (a2, r2, h2) = (side.length_squared(), radius * radius, h * h);
    let a = a2.sqrt();
    let s = h2 + a2 + r2;
    let w = ((h2 + (a - radius) * (a - radius)) * (h2 + (a + radius) * (a + radius))).sqrt();
    let k = h2 + r2 - a2;
    let w_plus_k = if k >= 0.0 { w + k } else { 4.0 * a2 * h2 / (w - k) };
    let scale = PI * r2 / (w * (s + w));
    front * scale * (w_plus_k * n.dot(up) + 2.0 * h * n.dot(side)).max(0.0)
}

/// A sky of radiance max(0, ω·m), m at the angle γ to the normal: (2/3)(sin γ + (π−γ) cos γ).
pub fn cosine_lobe(angle: f64) -> f64 {
    2.0 / 3.0 * (real::sin(angle) + (PI - angle) * real::cos(angle))
}

/// A sky of radiance 1 over black ground, the surface tilted by β: π (1 + cos β)/2.
pub fn sky_over_ground(tilt: f64) -> f64 {
    0.5 * PI * (1.0 + real::cos(tilt))
}

/// The CIE overcast sky (1 + 2 sin elevation)/3 over black ground: a third of the even sky and two of the lobe, cut by
/// the ground, (π/6)(1 + cos β) + (4/9)(sin β + (π−β) cos β).
pub fn overcast(tilt: f64) -> f64 {
    sky_over_ground(tilt) / 3.0 + 2.0 / 3.0 * cosine_lobe(tilt)
}

/// A zone of the sky between two elevations [rad] and over an azimuth [rad], on the horizontal:
/// Δφ (sin²γ₂ − sin²γ₁)/2.
pub fn zone(elevation: [f64; 2], azimuth: f64) -> f64 {
    let [low, high] = elevation.map(real::sin);
    0.5 * azimuth * (high - low) * (high + low)
}

/// An infinite strip between two angles from the normal, across the strip [rad]: (π/2)(sin φ₂ − sin φ₁).
pub fn strip(angles: [f64; 2]) -> f64 {
    0.5 * PI * (real::sin(angles[1]) - real::sin(angles[0]))
}

/// An infinite tube of radius r whose axis passes at distance d, wholly above the horizon: π (r/d) cos θ.
pub fn tube(radius: f64, distance: f64, cos: f64) -> f64 {
    PI * (radius / distance) * cos
}
