//! Owen-scrambled Sobol points: every power-of-two run is stratified in all elementary intervals of a pair.
//!
//! B. Burley 2020, "Practical Hash-based Owen Scrambling" (JCGT 9:4): scrambling and index shuffling by nested uniform
//! hashes. Any number of samples; the first two pairs may come from one 4-D point.

use antumbra_math::hash;

use super::{Dimension, Pairing, Sampler, SamplerOptions};

/// Owen-scrambled Sobol points.
#[derive(Clone, Copy, Debug)]
pub struct Owen {
    pairing: Pairing,
}

impl Owen {
    /// The stream carries the seed.
    pub fn new(options: SamplerOptions) -> Owen {
        Owen { pairing: options.pairing }
    }
}

impl Sampler for Owen {
    #[inline]
    fn pair(&self, stream: u32, index: u32, _of: u32, dimension: Dimension) -> [f32; 2] {
        let key = hash::hash2(stream, dimension.0);
        let four_d = if self.pairing == Pairing::FourD { dimension.four_d_half() } else { None };
        // Dimensions 0 and 1 of the sequence, or 2 and 3 for the second half of the 4-D point; the halves share the
        // shuffled index.
        let (first, shuffle) = match four_d {
            Some(half) => (2 * half, hash::hash2(stream, 0x4d)),
            None => (0, key),
        };
        let index = scramble(index.reverse_bits(), shuffle);
        let coordinate = |d: u32, key: u32| {
            let point = sobol_reversed(index.reverse_bits(), first + d);
            unit(scramble(point, hash::mix32(key ^ d.wrapping_mul(0x9e37_79b9))).reverse_bits())
        };
        [coordinate(0, key), coordinate(1, key)]
    }
}

/// The number in [0, 1) that 32 bits spell, rounded down to the 24 that f32 has.
#[inline]
fn unit(bits: u32) -> f32 {
    hash::unit_f32(bits)
}

/// Nested uniform (Owen) scramble of a bit-reversed number (Burley 2020, §2, with the constants of N. Vegdahl's
/// improved Laine–Karras hash): each bit changes by a hash of the bits below it.
#[inline]
fn scramble(mut x: u32, key: u32) -> u32 {
    x = x.wrapping_add(key);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^= x.wrapping_mul(0x8d22_f6e6);
    x
}

/// Coordinate `d` (0…3) of Sobol point `index`, bit-reversed: bit k of the result is bit 31−k of the coordinate.
#[inline]
fn sobol_reversed(index: u32, d: u32) -> u32 {
    if d == 0 {
        return index; // Van der Corput: the reversed index, reversed again.
    }
    let matrix = &DIRECTIONS[d as usize - 1];
    let mut x = 0;
    let mut rest = index;
    while rest != 0 {
        x ^= matrix[rest.trailing_zeros() as usize];
        rest &= rest - 1;
    }
    x
}

/// Bit-reversed direction numbers of dimensions 1, 2, 3 (S. Joe & F. Kuo 2008: primitive polynomials x+1, x²+x+1,
/// x³+x+1 with initial numbers {1}, {1, 3}, {1, 3, 1}).
static DIRECTIONS: [[u32; 32]; 3] =
    [directions(1, 0, &[1]), directions(2, 1, &[1, 3]), directions(3, 1, &[1, 3, 1])];

/// The recurrence of Joe & Kuo for degree `s`, coefficients `a`, initial numbers `m`.
const fn directions(s: usize, a: u32, m: &[u32]) -> [u32; 32] {
    let mut v = [0u32; 32];
    let mut i = 0;
    while i < 32 {
        if i < s {
            v[i] = m[i] << (31 - i);
        } else {
            v[i] = v[i - s] ^ (v[i - s] >> s);
            let mut k = 1;
            while k < s {
                if (a >> (s - 1 - k)) & 1 == 1 {
                    v[i] ^= v[i - k];
                }
                k += 1;
            }
        }
        i += 1;
    }
    let mut r = [0u32; 32];
    let mut i = 0;
    while i < 32 {
        r[i] = v[i].reverse_bits();
        i += 1;
    }
    r
}
