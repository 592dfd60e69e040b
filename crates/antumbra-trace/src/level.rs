//! The SIMD levels that a world can be asked at.

use fearless_simd::Level;

/// Which instructions a world uses. Answers are the same bits at each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SimdLevel {
    /// The fastest that this machine has.
    #[default]
    Auto,
    /// 128 bits without fused multiply-add: SSE2 of every x86-64, or what else is the target's own minimum.
    Baseline,
    /// x86-64-v2.
    Sse42,
    /// x86-64-v3: 256 bits and fused multiply-add.
    Avx2,
    /// AVX-512 of the Ice Lake class.
    Avx512,
}

impl SimdLevel {
    /// All, from least to most; `Auto` is none of them.
    pub const ALL: [SimdLevel; 4] =
        [SimdLevel::Baseline, SimdLevel::Sse42, SimdLevel::Avx2, SimdLevel::Avx512];

    /// Those that this machine has, from least to most.
    pub fn available() -> Vec<SimdLevel> {
        SimdLevel::ALL.into_iter().filter(|level| level.token().is_some()).collect()
    }

    /// This machine has it.
    pub fn is_available(self) -> bool {
        self.token().is_some()
    }

    /// Its name, as options spell it.
    pub fn name(self) -> &'static str {
        match self {
            SimdLevel::Auto => "auto",
            SimdLevel::Baseline => "baseline",
            SimdLevel::Sse42 => "sse4.2",
            SimdLevel::Avx2 => "avx2",
            SimdLevel::Avx512 => "avx512",
        }
    }

    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    pub(crate) fn token(self) -> Option<Level> {
        let best = Level::new();
        match self {
            SimdLevel::Auto => Some(best),
            SimdLevel::Baseline => Some(Level::baseline()),
            SimdLevel::Sse42 => best.as_sse4_2().map(Level::Sse4_2),
            SimdLevel::Avx2 => best.as_avx2().map(Level::Avx2),
            SimdLevel::Avx512 => best.as_avx512().map(Level::Avx512),
        }
    }

    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    pub(crate) fn token(self) -> Option<Level> {
        match self {
            SimdLevel::Auto => Some(Level::new()),
            SimdLevel::Baseline => Some(Level::baseline()),
            _ => None,
        }
    }

    pub(crate) fn level(self) -> Level {
        self.token().unwrap_or_else(Level::new)
    }
}
