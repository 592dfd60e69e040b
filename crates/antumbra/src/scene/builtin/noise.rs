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
pub fn noise(p: DVec3, seed: u32) -> f64 {
    let cell = DVec3::new(real::floor(p.x), real::floor(p.y), real::floor(p.z));
    let f = p - cell;
    let fade = f * f * f * (f * (f * 6.0 - DVec3::splat(15.0)) + DVec3::splat(10.0));
    let base = [cell.x as i32 as u32, cell.y as i32 as u32, cell.z as i32 as u32];
    let row = |j: u32, k: u32| {
        let key = mix32(base[1].wrapping_add(j) ^ mix32(base[2].wrapping_add(k) ^ seed));
        let corner = |i: u32| {
            let h = mix32(base[0].wrapping_add(i) ^ key);
            slope(h, f.x - f64::from(i), f.y - f64::from(j), f.z - f64::from(k))
        };
        mixed(corner(0), corner(1), fade.x)
    };
    mixed(mixed(row(0, 0), row(1, 0), fade.y), mixed(row(0, 1), row(1, 1), fade.y), fade.z)
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

/// Scalar product of (x, y, z) with one of the twelve edge directions of a cube.
fn slope(hash: u32, x: f64, y: f64, z: f64) -> f64 {
    let (u, v) = match (hash >> 8) % 3 {
        0 => (x, y),
        1 => (y, z),
        _ => (z, x),
    };
    (if hash & 1 == 0 { u } else { -u }) + (if hash & 2 == 0 { v } else { -v })
}

fn mixed(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}
