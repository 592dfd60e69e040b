//! Numbers in [0, 1): each a pure function of (seed, stream, sample, dimension). Floor 2.
//!
//! To add one: a file here and a line in `kinds!`. Laws of every kind: values in [0, 1), the same question gets the
//! same answer, each value alone is uniform, strata are met once if the kind claims so.

mod owen;
mod passes;
mod random;
mod regular;
mod stratified;

use antumbra_math::hash;

pub use owen::Owen;
pub use passes::PassPlan;
pub use random::Random;
pub use regular::Regular;
pub use stratified::Stratified;

/// Which pair of numbers is asked for. Every use has its own dimension, so that no two share a number by accident.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// Position in the pixel.
    Pixel,
    /// Position on the lens.
    Lens,
    /// Point on a light.
    LightPoint,
    /// Which light; which surface.
    LightChoice,
    /// Direction of the BSDF or of the hemisphere.
    Direction,
    /// Lobe of the BSDF; length of an occlusion ray.
    Lobe,
    /// Russian roulette.
    Roulette,
}

/// A use at a bounce of the path, as one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension(u32);

impl Use {
    /// This use at bounce `bounce`.
    #[inline]
    pub fn at(self, bounce: u32) -> Dimension {
        Dimension(bounce * 8 + self as u32)
    }
}

impl Dimension {
    /// The first pairs of a path: pixel and first light point may share one 4-D point.
    #[inline]
    fn four_d_half(self) -> Option<u32> {
        match self.0 {
            d if d == Use::Pixel as u32 => Some(0),
            d if d == Use::LightPoint as u32 => Some(1),
            _ => None,
        }
    }
}

/// How pixel and light point are paired (`--pairing`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pairing {
    /// One 4-D point gives both (with one shadow ray a viewing ray; else the shadow rays of a pixel are one 2-D set).
    #[default]
    FourD,
    /// Two 2-D points in independent order.
    TwoD,
}

/// What each kind of sampler answers.
pub trait Sampler: Sync {
    /// The two numbers of sample `index` of `of` samples in `dimension` of `stream`.
    fn pair(&self, stream: u32, index: u32, of: u32, dimension: Dimension) -> [f32; 2];
}

/// Options that all kinds are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SamplerOptions {
    /// Another seed, another noise.
    pub seed: u32,
    /// How pixel and light point are paired.
    pub pairing: Pairing,
    /// `regular`: shift the grid by a random offset per stream.
    pub rotate: bool,
}

/// One enum of all kinds, its delegation, and the list that the contract tests walk through.
macro_rules! kinds {
    ($($kind:ident),* $(,)?) => {
        /// The words for the kinds (`--sampler`).
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum SamplerKind {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind),*
        }
        /// A sampler, one of the closed list of kinds.
        #[derive(Clone, Copy, Debug)]
        pub enum AnySampler {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind($kind)),*
        }
        impl AnySampler {
            /// A sampler of this kind.
            pub fn new(kind: SamplerKind, options: SamplerOptions) -> AnySampler {
                match kind { $(SamplerKind::$kind => AnySampler::$kind($kind::new(options))),* }
            }
            /// See [`Sampler::pair`].
            #[inline]
            pub fn pair(&self, stream: u32, index: u32, of: u32, dimension: Dimension) -> [f32; 2] {
                match self { $(AnySampler::$kind(s) => s.pair(stream, index, of, dimension)),* }
            }
            /// One number: the first of the pair.
            #[inline]
            pub fn one(&self, stream: u32, index: u32, of: u32, dimension: Dimension) -> f32 {
                self.pair(stream, index, of, dimension)[0]
            }
        }
        impl SamplerKind {
            /// All kinds.
            pub const ALL: &'static [SamplerKind] = &[$(SamplerKind::$kind),*];
        }
    };
}

kinds!(Owen, Random, Stratified, Regular);

/// The stream of random numbers of one receiver in one replicate.
#[inline]
pub fn stream(seed: u32, receiver: u32, replicate: u32) -> u32 {
    hash::hash3(seed, receiver, replicate)
}

/// Number `i` of a random permutation of 0..n that `key` names (A. Kensler 2013, "Correlated Multi-Jittered
/// Sampling", listing 5: hash within the next power of two, again while it falls outside).
#[inline]
pub(crate) fn permute(mut i: u32, n: u32, key: u32) -> u32 {
    if n <= 1 {
        return 0;
    }
    let mask = (n - 1) | (n - 1) >> 1;
    let mask = mask | mask >> 2;
    let mask = mask | mask >> 4;
    let mask = mask | mask >> 8;
    let w = mask | mask >> 16;
    loop {
        i ^= key;
        i = i.wrapping_mul(0xe170_893d);
        i ^= key >> 16;
        i ^= (i & w) >> 4;
        i ^= key >> 8;
        i = i.wrapping_mul(0x0929_eb3f);
        i ^= key >> 23;
        i ^= (i & w) >> 1;
        i = i.wrapping_mul(1 | key >> 27);
        i = i.wrapping_mul(0x6935_fa69);
        i ^= (i & w) >> 11;
        i = i.wrapping_mul(0x74dc_b303);
        i ^= (i & w) >> 2;
        i = i.wrapping_mul(0x9e50_1cc3);
        i ^= (i & w) >> 2;
        i = i.wrapping_mul(0xc860_a3df);
        i &= w;
        i ^= i >> 5;
        if i < n {
            break;
        }
    }
    ((u64::from(i) + u64::from(key)) % u64::from(n)) as u32
}

#[cfg(test)]
mod tests;
