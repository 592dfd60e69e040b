//! Integer hashes: the source of every random number (pure functions, no state).

/// A bijection of u32 with good avalanche (the `lowbias32` constants found by C. Wellons' hash prospector).
#[inline]
pub fn mix32(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// Hash of two words.
#[inline]
pub fn hash2(a: u32, b: u32) -> u32 {
    mix32(a ^ mix32(b.wrapping_add(0x9e37_79b9)))
}

/// Hash of three words.
#[inline]
pub fn hash3(a: u32, b: u32, c: u32) -> u32 {
    hash2(hash2(a, b), c)
}

/// The number in [0, 1) that the upper 24 bits of `x` spell.
#[inline]
pub fn unit_f32(x: u32) -> f32 {
    (x >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// FNV-1a over words, 64 bits.
pub fn fnv1a_words(words: impl Iterator<Item = u32>) -> u64 {
    words.fold(0xcbf2_9ce4_8422_2325, |h, w| (h ^ u64::from(w)).wrapping_mul(0x0100_0000_01b3))
}

/// FNV-1a over bytes, 64 bits: for names of pictures and scenes, not for random numbers.
pub fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |h, &b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
}
