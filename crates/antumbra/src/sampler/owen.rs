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
        let half = if self.pairing == Pairing::FourD { dimension.four_d_half() } else { None };
        // The halves of a 4-D point share the shuffled index; every other pair has its own.
        let shuffle = if half.is_some() { hash::hash2(stream, 0x4d) } else { key };
        let index = scramble(index.reverse_bits(), shuffle).reverse_bits();
        let index = if half == Some(1) { second_half(index) } else { index };
        // Reversed, the first coordinate (van der Corput) is the index itself.
        let x = scramble(index, hash::mix32(key)).reverse_bits();
        let y = scramble(sobol_reversed(index), hash::mix32(key ^ 0x9e37_79b9)).reverse_bits();
        [hash::unit_f32(x), hash::unit_f32(y)]
    }
}

/// The index of the second pair of a 4-D point: each byte through an invertible upper triangular matrix over GF(2), so
/// that it stays a (0, 2)-sequence by itself. The matrix was searched so that of each 16 points one lies in each of the
/// 2⁴ cells of the 4-D cube, and of each 256 one in each of the 4⁴ (docs/decisions/0003).
#[inline]
fn second_half(index: u32) -> u32 {
    const COLUMNS: [u32; 8] = columns([0x5b, 0x72, 0xec, 0x18, 0x90, 0x60, 0xc0, 0x80]);
    COLUMNS.iter().enumerate().fold(0, |x, (bit, column)| x ^ (((index >> bit) & 0x0101_0101) * column))
}

/// Columns of a matrix given by its rows.
const fn columns(rows: [u32; 8]) -> [u32; 8] {
    let mut columns = [0; 8];
    let mut i = 0;
    while i < 64 {
        columns[i % 8] |= ((rows[i / 8] >> (i % 8)) & 1) << (i / 8);
        i += 1;
    }
    columns
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

/// The second coordinate of Sobol point `index`, bit-reversed.
///
/// Its direction numbers (primitive polynomial x + 1) are v_i = v_{i−1} ⊕ v_{i−1}/2: reversed, the powers (1 + X)^i over
/// GF(2). So the sum over the bits of the index is its polynomial at 1 + X, by halves: (1 + X)^16 = 1 + X^16, and so on.
#[inline]
fn sobol_reversed(index: u32) -> u32 {
    let mut x = index;
    x ^= (x >> 16) & 0x0000_ffff;
    x ^= (x >> 8) & 0x00ff_00ff;
    x ^= (x >> 4) & 0x0f0f_0f0f;
    x ^= (x >> 2) & 0x3333_3333;
    x ^ ((x >> 1) & 0x5555_5555)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halving_gives_the_sum_of_the_direction_numbers() {
        let mut v = [1u32; 32];
        for i in 1..32 {
            v[i] = v[i - 1] ^ (v[i - 1] << 1);
        }
        for index in (0..1000).map(hash::mix32).chain([0, 1, u32::MAX]) {
            let sum = (0..32).filter(|i| index >> i & 1 == 1).fold(0, |x, i| x ^ v[i]);
            assert_eq!(sobol_reversed(index), sum, "{index:#x}");
        }
    }
}
