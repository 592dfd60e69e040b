//! Numbers for the attacks: splitmix64 with a seed, and the shapes of randomness that break geometry code.

/// A stream of numbers; equal seeds give equal streams on every machine.
pub struct Rng(u64);

impl Rng {
    pub fn new(seed: u64) -> Rng {
        Rng(seed)
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In 0..n.
    pub fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// In [a, b).
    pub fn range(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }

    /// ±10^x, x uniform in [a, b).
    pub fn signed_power(&mut self, a: f64, b: f64) -> f64 {
        let size = antumbra_math::real::pow(10.0, self.range(a, b));
        if self.below(2) == 0 { size } else { -size }
    }

    /// In the cube [−r, r)³.
    pub fn cube(&mut self, r: f64) -> [f64; 3] {
        [0; 3].map(|_| self.range(-r, r))
    }

    /// A unit vector (by rejection from the ball).
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            let v = self.cube(1.0);
            let length2 = dot(v, v);
            if length2 > 1e-4 && length2 < 1.0 {
                return v.map(|x| x / length2.sqrt());
            }
        }
    }

    /// Weights of three corners: inside, on an edge, or at a corner.
    pub fn weights(&mut self) -> [f64; 3] {
        let (u, v) = (self.unit(), self.unit());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        let mut w = match self.below(4) {
            0 => [1.0, 0.0, 0.0],
            1 => [1.0 - u, u, 0.0],
            _ => [1.0 - u - v, u, v],
        };
        w.rotate_left(self.below(3) as usize);
        w
    }

    /// `x` moved by up to two steps of f32, half the time.
    pub fn nudge(&mut self, x: f32) -> f32 {
        match self.below(8) {
            0 => x.next_up(),
            1 => x.next_down(),
            2 => x.next_up().next_up(),
            3 => x.next_down().next_down(),
            _ => x,
        }
    }
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Σ weights · points.
pub fn mix<const N: usize>(weights: [f64; N], points: [[f64; 3]; N]) -> [f64; 3] {
    let mut out = [0.0; 3];
    for (w, p) in weights.iter().zip(points) {
        for k in 0..3 {
            out[k] += w * p[k];
        }
    }
    out
}

pub fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = dot(v, v).sqrt();
    v.map(|x| x / length)
}

pub fn to_f32(v: [f64; 3]) -> [f32; 3] {
    v.map(|x| x as f32)
}

pub fn to_f64(v: [f32; 3]) -> [f64; 3] {
    v.map(f64::from)
}

/// `small` in the normal suite, `large` under ANTUMBRA_STRESS=1.
pub fn amount(small: usize, large: usize) -> usize {
    if std::env::var_os("ANTUMBRA_STRESS").is_some_and(|v| v == "1") { large } else { small }
}
