//! Seeded randomness of the built-in scenes: dice, and noise in space. The same bits on every machine.

use antumbra_math::hash::{hash2, mix32, unit_f32};
use antumbra_math::{DMat3, DVec3, real};

/// A row of random numbers: each scene rolls its own, in a fixed order.
pub struct Dice {
    seed: u32,
    rolled: u32,
}

impl Dice {
    /// Dice that fall the same way for the same seed.
    pub fn new(seed: u32) -> Dice {
        Dice { seed, rolled: 0 }
    }

    /// A number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.rolled += 1;
        f64::from(unit_f32(hash2(self.seed, self.rolled)))
    }

    /// A number in [low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// One of the items, each with the same chance.
    pub fn pick<T: Copy>(&mut self, items: &[T]) -> T {
        items[(self.unit() * items.len() as f64) as usize]
    }

    /// A rotation, uniform over all rotations (Shoemake's quaternion of three numbers).
    pub fn rotation(&mut self) -> DMat3 {
        let (u, a, b) = (self.unit(), self.between(0.0, TURN), self.between(0.0, TURN));
        let (s, c) = ((1.0 - u).sqrt(), u.sqrt());
        let [x, y, z, w] = [s * real::sin(a), s * real::cos(a), c * real::sin(b), c * real::cos(b)];
        DMat3::from_cols(
            DVec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)),
            DVec3::new(2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)),
            DVec3::new(2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)),
        )
    }
}

/// One full turn [rad].
pub const TURN: f64 = std::f64::consts::TAU;

/// Gradient noise: smooth, 0 at the points of the integer lattice, between about −1 and 1 (after K. Perlin, 2002).
/// |x|, |y|, |z| < 2³¹.
pub fn noise(p: DVec3, seed: u32) -> f64 {
    let ((x, fx), (y, fy), (z, fz)) = (cell(p.x), cell(p.y), cell(p.z));
    let row = |j: u32, plane: u32, fy: f64, fz: f64| {
        let key = mix32(y.wrapping_add(j) ^ plane);
        // One multiplication is enough here: only four upper bits are used.
        let corner = |i: u32| (x.wrapping_add(i) ^ key).wrapping_mul(0x7feb_352d) >> 28;
        mixed(slope(corner(0), fx, fy, fz), slope(corner(1), fx - 1.0, fy, fz), fade(fx))
    };
    let plane = |k: u32, fz: f64| {
        let key = mix32(z.wrapping_add(k) ^ seed.wrapping_mul(0x9e37_79b9));
        mixed(row(0, key, fy, fz), row(1, key, fy - 1.0, fz), fade(fy))
    };
    mixed(plane(0, fz), plane(1, fz - 1.0), fade(fz))
}

/// Octaves of noise, each twice as fine and half as high as the one before.
pub fn fractal(p: DVec3, octaves: u32, seed: u32) -> f64 {
    (0..octaves).map(|o| noise(p * f64::from(1u32 << o), seed ^ o) / f64::from(1u32 << o)).sum()
}

/// Ridged octaves: sharp crests over wide valleys, between about 0 and 2.
pub fn ridges(p: DVec3, octaves: u32, seed: u32) -> f64 {
    let mut weight = 1.0;
    let mut sum = 0.0;
    for o in 0..octaves {
        let crest = 1.0 - noise(p * f64::from(1u32 << o), seed ^ o).abs();
        let crest = crest * crest * weight;
        sum += crest / f64::from(1u32 << o);
        // Fine detail grows on the crests; the valleys stay smooth.
        weight = crest.clamp(0.0, 1.0);
    }
    sum
}

/// The lattice cell that x lies in, and how far.
fn cell(x: f64) -> (u32, f64) {
    let cut = x as i32;
    let below = cut - i32::from(x < f64::from(cut));
    (below as u32, x - f64::from(below))
}

fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Scalar product of (x, y, z) with one of the twelve edge directions of a cube (four of them twice).
fn slope(corner: u32, x: f64, y: f64, z: f64) -> f64 {
    let [gx, gy, gz] = SLOPES[corner as usize];
    gx * x + gy * y + gz * z
}

const SLOPES: [[f64; 3]; 16] = [
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [-1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [-1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, -1.0, 1.0],
    [0.0, 1.0, -1.0],
    [0.0, -1.0, -1.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [0.0, -1.0, 1.0],
    [0.0, -1.0, -1.0],
];

fn mixed(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}
