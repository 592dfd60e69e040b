//! What an estimator hands to visibility: segments with the light they carry, rays with their throughput.

use antumbra_math::{Rgb, World};
use antumbra_trace::{SegmentBuffer, TO_POINT};

use crate::density::Density;
use crate::film::Planes;
use crate::light::sampler::Scratch;
use crate::light::{End, LightSample};
use crate::receiver::Receiver;

/// What a segment brings to the film if it is free.
#[derive(Clone, Copy, Debug)]
pub struct Carried {
    /// Cell of the film.
    pub cell: u32,
    /// What arrives there.
    pub light: Rgb,
    /// Which of the planes (beside the picture itself, for light).
    pub plane: Planes,
}

/// What light that a ray finds counts for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// All of it: no other strategy draws it.
    All,
    /// Its share against light sampling.
    Weighed,
}

/// What a ray carries onward.
#[derive(Clone, Copy, Debug)]
pub struct Onward {
    /// Number of the receiver that it leaves.
    pub from: u32,
    /// What light arriving along it is worth at the film.
    pub throughput: Rgb,
    /// Which of the directions of its receiver it is: 0 goes on with the receiver's random numbers, others with their own.
    pub branch: u32,
    /// How densely its direction was drawn.
    pub density: Density,
    /// What light that it finds counts for.
    pub found: Found,
    /// The surface that it meets is a receiver again, its throughput times this (1/q of the roulette); `None`: it ends.
    pub goes_on: Option<f32>,
}

/// A batch of proposals, filled and cleared without giving memory back.
#[derive(Default)]
pub struct Proposals {
    /// Segments to lights.
    pub segments: SegmentBuffer,
    /// What each carries.
    pub carried: Vec<Carried>,
    /// Rays onward.
    pub rays: SegmentBuffer,
    /// What each carries.
    pub onward: Vec<Onward>,
    /// Room for the choice among many lights.
    pub light_weights: Scratch,
    /// Teaching switch: segments do not end at the light.
    pub beyond_lights: bool,
}

impl Proposals {
    /// Forgets the entries.
    pub fn clear(&mut self) {
        self.segments.clear();
        self.carried.clear();
        self.rays.clear();
        self.onward.clear();
    }

    /// A segment from a receiver to a point of a light; sample `j` of the receiver.
    #[inline]
    pub fn segment(&mut self, at: &Receiver, j: u32, to: &LightSample, plane: Planes, light: Rgb) {
        let number = number(at, j);
        let (end, reach) = match to.end {
            End::Infinity => (to.wi, f32::INFINITY),
            End::Point(q) if self.beyond_lights => (q - World::from(at.start), f32::INFINITY),
            End::Point(q) => (q, TO_POINT),
        };
        self.segments.push(at.start, end.to_array(), reach, at.prim, to.prim, number);
        self.carried.push(Carried { cell: at.cell, light, plane });
    }

    /// A segment from a receiver along `wi`, as long as `reach`, that carries only openness; sample `j` of the receiver.
    #[inline]
    pub fn probe(&mut self, at: &Receiver, j: u32, wi: World, reach: f32, open: Rgb) {
        let number = number(at, j);
        self.segments.push_ray(at.start, wi.to_array(), reach, at.prim, number);
        self.carried.push(Carried { cell: at.cell, light: open, plane: Planes::NONE });
    }

    /// A ray onward from a receiver.
    #[inline]
    pub fn ray(&mut self, at: &Receiver, wi: World, onward: Onward) {
        let number = !number(at, onward.branch);
        let start = if at.sees_side(wi) { at.start } else { at.beyond };
        self.rays.push_ray(start, wi.to_array(), f32::INFINITY, at.prim, number);
        self.onward.push(onward);
    }
}

/// Light that leaves `at` after `at.bounce` reflections: direct or indirect.
#[inline]
pub fn plane_of(at: &Receiver) -> Planes {
    if at.bounce == 0 { Planes::DIRECT } else { Planes::INDIRECT }
}

/// The number of a ray for stochastic alpha: a function of the receiver's stream and sample alone. Told apart, not mixed:
/// who draws by it hashes it with the primitive.
#[inline]
fn number(at: &Receiver, j: u32) -> u32 {
    let own = at.index.wrapping_mul(0x9e37_79b9) ^ j.wrapping_mul(0xc2b2_ae35);
    at.stream ^ own ^ (at.bounce + 1).wrapping_mul(0x85eb_ca6b)
}
