//! From a batch to the kernels of a SIMD level: one decision a batch.

use fearless_simd::{Level, Simd, dispatch};

use crate::traverse::{Asking, Lines, Masks, Opaque};
use crate::walk;
use crate::world::World;
use crate::{Bits, Hits, Passes, Segments, Visibility};

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

    fn level(self) -> Level {
        self.token().unwrap_or_else(Level::new)
    }
}

impl World {
    /// The same world asked at another SIMD level; the best one if this machine lacks it.
    pub fn with_level(mut self, level: SimdLevel) -> World {
        self.set_level(level);
        self
    }

    /// Asks at another SIMD level from now on; at the best one if this machine lacks it.
    pub fn set_level(&mut self, level: SimdLevel) {
        self.level = level;
    }

    /// The same world, in which hits on masked instances are asked back. Without masks it costs nothing.
    pub fn with_passes<'a, P: Passes>(&'a self, passes: &'a P) -> impl Visibility + 'a {
        Masked { world: self, passes: Asking(passes), ask: self.has_masks() }
    }
}

/// A world whose masks are asked.
struct Masked<'a, P: Passes> {
    world: &'a World,
    passes: Asking<'a, P>,
    ask: bool,
}

/// Masks count as opaque.
impl Visibility for World {
    fn occluded(&self, segments: Segments<'_>, out: &mut Bits) {
        dispatch!(self.level.level(), simd => occluded(simd, self, &segments, &Opaque, out));
    }

    fn nearest(&self, rays: Segments<'_>, out: &mut Hits) {
        dispatch!(self.level.level(), simd => nearest(simd, self, &rays, &Opaque, out));
    }
}

impl<P: Passes> Visibility for Masked<'_, P> {
    fn occluded(&self, segments: Segments<'_>, out: &mut Bits) {
        if !self.ask {
            return self.world.occluded(segments, out);
        }
        let level = self.world.level.level();
        dispatch!(level, simd => occluded(simd, self.world, &segments, &self.passes, out));
    }

    fn nearest(&self, rays: Segments<'_>, out: &mut Hits) {
        if !self.ask {
            return self.world.nearest(rays, out);
        }
        let level = self.world.level.level();
        dispatch!(level, simd => nearest(simd, self.world, &rays, &self.passes, out));
    }
}

#[inline(always)]
fn occluded<S: Simd>(simd: S, world: &World, segments: &Segments<'_>, masks: &impl Masks, out: &mut Bits) {
    out.reset(segments.len());
    let lines = Lines::of(segments);
    for word in 0..segments.len().div_ceil(64) {
        let mut bits = 0;
        for i in 64 * word..segments.len().min(64 * word + 64) {
            if walk::occluded(simd, world, segments, lines.line(i), i, masks) {
                bits |= 1 << (i % 64);
            }
        }
        out.set_word(word, bits);
    }
}

#[inline(always)]
fn nearest<S: Simd>(simd: S, world: &World, rays: &Segments<'_>, masks: &impl Masks, out: &mut Hits) {
    out.reset(rays.len());
    let lines = Lines::of(rays);
    for i in 0..rays.len() {
        walk::nearest(simd, world, rays, lines.line(i), i, masks, out);
    }
}
