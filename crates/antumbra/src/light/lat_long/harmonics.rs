//! A picture's light in the nine real spherical harmonics up to l = 2, and its irradiance by them.

use antumbra_math::{World, real};

/// Y₀₀.
const Y00: f64 = 0.282_094_791_773_878_14;

/// ∫ L Y dω, luminance.
#[derive(Clone, Copy, Debug, Default)]
pub struct Harmonics([f64; 9]);

impl Harmonics {
    /// Of a picture of `width` × `height` texels, `light` their luminance: every texel at its middle with its solid angle.
    pub fn of(width: u32, height: u32, light: impl Fn(u32, u32) -> f32) -> Harmonics {
        let step = std::f64::consts::TAU / f64::from(width);
        let around: Vec<[f64; 2]> = (0..width)
            .map(|i| {
                let phi = step * (f64::from(i) + 0.5);
                [real::sin(phi), -real::cos(phi)]
            })
            .collect();
        let border = |j: u32| real::cos(std::f64::consts::PI * f64::from(j) / f64::from(height));
        let mut sums = [0.0; 9];
        for j in 0..height {
            // In a row only x and z change, and of their products only five sums matter.
            let mut row = [0.0; 6];
            for (i, [x, z]) in around.iter().enumerate() {
                let l = f64::from(light(i as u32, j));
                let terms = [1.0, *x, *z, x * x, z * z, x * z];
                (0..6).for_each(|k| row[k] += l * terms[k]);
            }
            let (upper, lower) = (border(j), border(j + 1));
            let y = 0.5 * (upper + lower);
            let sin2 = (1.0 - y * y).max(0.0);
            let sin = sin2.sqrt();
            let solid_angle = step * (upper - lower);
            let [l, x, z, xx, zz, xz] = row.map(|r| r * solid_angle);
            let parts = products(
                l,
                [x * sin, y * l, z * sin],
                [xx * sin2, zz * sin2],
                [x * sin * y, y * z * sin, xz * sin2],
            );
            (0..9).for_each(|k| sums[k] += parts[k]);
        }
        Harmonics(sums)
    }

    /// Mean luminance over the sphere.
    pub fn mean(&self) -> f64 {
        self.0[0] * Y00
    }

    /// ∫ L cos⁺ about the unit normal n: the harmonics, each weakened by the cosine to π, 2π/3, π/4 (Ramamoorthi and
    /// Hanrahan 2001). Exact up to l = 2 and a few percent off for smooth skies; never less than a twentieth of what an
    /// even sky of the same light would give.
    pub fn irradiance(&self, n: World) -> f32 {
        let pi = std::f64::consts::PI;
        let weaken = |k: usize| [pi, 2.0 * pi / 3.0, pi / 4.0][usize::from(k > 0) + usize::from(k > 3)];
        let [x, y, z] = n.as_dvec3().to_array();
        let basis = products(1.0, [x, y, z], [x * x, z * z], [x * y, y * z, x * z]);
        let sum: f64 = (0..9).map(|k| weaken(k) * self.0[k] * basis[k]).sum();
        sum.max(0.05 * pi * self.mean()) as f32
    }
}

/// The harmonics of 1, (x, y, z), (x², z²) and (xy, yz, xz), or of sums of these.
fn products(one: f64, [x, y, z]: [f64; 3], [xx, zz]: [f64; 2], [xy, yz, xz]: [f64; 3]) -> [f64; 9] {
    const Y1: f64 = 0.488_602_511_902_919_9;
    const Y2: f64 = 1.092_548_430_592_079_2;
    const Y20: f64 = 0.315_391_565_252_520_05;
    const Y22: f64 = 0.546_274_215_296_039_6;
    // x² − y² = 2x² + z² − 1 on the unit sphere.
    let difference = 2.0 * xx + zz - one;
    [Y00 * one, Y1 * y, Y1 * z, Y1 * x, Y2 * xy, Y2 * yz, Y20 * (3.0 * zz - one), Y2 * xz, Y22 * difference]
}
