//! Which segments and rays to try, and what each would carry. Floor 5; never asks a kernel.
//!
//! To add one: a file here and a line in `kinds!`. Law of every kind: E[Σ carried · V] is the integral that it names.

mod ambient_occlusion;
mod area;
mod hemisphere;
mod lights;
mod mis;
mod path;
mod path_hemisphere;
mod proposals;
mod surfaces;
mod visible_fraction;

pub use ambient_occlusion::{AmbientOcclusion, Falloff};
pub use area::Area;
pub use hemisphere::{Directions, Hemisphere};
pub use lights::{Drawn, LightChoice, Lights};
pub use mis::Mis;
pub use path::Path;
pub use path_hemisphere::PathHemisphere;
pub use proposals::{Carried, Found, Onward, Proposals, plane_of};
pub use surfaces::Surfaces;
pub use visible_fraction::VisibleFraction;

use antumbra_math::{World, hash};

use crate::light::sampler::Scratch;
use crate::light::{LightId, LightPoints};
use crate::receiver::Receiver;
use crate::sampler::{AnySampler, PassPlan, Use};
use crate::scene::Scene;

/// Wrong on purpose, to show what a term is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mistake {
    /// Right.
    #[default]
    None,
    /// Leaves out cos θ′ at the light.
    NoCosLight,
    /// Leaves out 1/r².
    NoDistance,
    /// Takes the density over the light's area for one over solid angle (or the other way round).
    WrongMeasure,
    /// Counts light both by light sampling and when a direction finds it, with full weight.
    CountedTwice,
    /// Adds the samples up instead of averaging them.
    NoCount,
}

/// What all kinds are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// N: shadow rays (or directions) per receiver.
    pub shadow_rays: u32,
    /// Longest path.
    pub bounces: u32,
    /// Which lights are asked.
    pub lights: LightChoice,
    /// How a point of a light is drawn.
    pub light_points: LightPoints,
    /// How directions are drawn.
    pub directions: Directions,
    /// Russian roulette.
    pub roulette: bool,
    /// Ambient occlusion: R.
    pub radius: f32,
    /// Ambient occlusion: weight of an occluder.
    pub falloff: Falloff,
    /// Alpha masks count as opaque.
    pub opaque: bool,
    /// Wrong on purpose.
    pub mistake: Mistake,
}

/// Which of the samples that a receiver takes for one use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Nth {
    /// Its number, below `n`.
    pub j: u32,
    /// How many there are.
    pub n: u32,
}

impl Nth {
    /// The only sample.
    pub const ONLY: Nth = Nth { j: 0, n: 1 };

    /// All of `n` samples.
    #[inline]
    pub fn of(n: u32) -> impl Iterator<Item = Nth> {
        (0..n).map(move |j| Nth { j, n })
    }
}

/// The random numbers of receivers, by use.
pub struct Draws<'a> {
    sampler: &'a AnySampler,
    of: u32,
    shadow_rays: u32,
}

impl<'a> Draws<'a> {
    /// Numbers for a render of these passes with `shadow_rays` samples a receiver.
    pub fn new(sampler: &'a AnySampler, passes: PassPlan, shadow_rays: u32) -> Draws<'a> {
        Draws { sampler, of: passes.longest(), shadow_rays }
    }

    /// Samples that a receiver takes: N where the sensor looks, one on deeper bounces.
    #[inline]
    pub fn count(&self, at: &Receiver) -> u32 {
        if at.bounce == 0 { self.shadow_rays } else { 1 }
    }

    /// Two numbers for a sample of a receiver. The samples of all passes together are one set.
    #[inline]
    pub fn pair(&self, at: &Receiver, what: Use, nth: Nth) -> [f32; 2] {
        self.pair_of(at.stream, at, what, nth)
    }

    /// The same for light number `light` when every light is asked: the first shares the pixel's 4-D point.
    #[inline]
    pub fn pair_for(&self, light: u32, at: &Receiver, what: Use, nth: Nth) -> [f32; 2] {
        let stream = if light == 0 { at.stream } else { hash::hash2(at.stream, light) };
        self.pair_of(stream, at, what, nth)
    }

    /// One number.
    #[inline]
    pub fn one(&self, at: &Receiver, what: Use, nth: Nth) -> f32 {
        self.pair(at, what, nth)[0]
    }

    #[inline]
    fn pair_of(&self, stream: u32, at: &Receiver, what: Use, Nth { j, n }: Nth) -> [f32; 2] {
        // Beyond 2³² samples a set begins again.
        let index = at.index.wrapping_mul(n).wrapping_add(j);
        self.sampler.pair(stream, index, self.of.saturating_mul(n), what.at(at.bounce))
    }
}

/// Light that a ray found.
pub struct FoundLight<'a> {
    /// The receiver that it left.
    pub from: &'a Receiver,
    /// The ray.
    pub ray: &'a Onward,
    /// The light.
    pub light: LightId,
    /// ω_i of the ray.
    pub wi: World,
}

/// What each kind of estimator answers.
pub trait Estimator: Sync {
    /// Segments that carry light if they are free; rays that carry throughput onward.
    fn propose(&self, scene: &Scene, at: &[Receiver], u: &Draws<'_>, out: &mut Proposals);

    /// The most segments and rays together that `propose` makes for one receiver that takes `n` samples.
    fn most_proposed(&self, _scene: &Scene, n: usize) -> usize {
        n
    }

    /// The light points that `propose` draws for one receiver, in its order, with every factor (what `explain` shows);
    /// each with the receiver it leaves, on the one or the other side of the surface.
    fn each_point(
        &self,
        _scene: &Scene,
        _at: &Receiver,
        _u: &Draws<'_>,
        _scratch: &mut Scratch,
        _visit: &mut dyn FnMut(&Receiver, Drawn),
    ) {
    }

    /// Weight of light that a ray found (`Found::Weighed`): this strategy against light sampling.
    fn found_weight(&self, _scene: &Scene, _found: &FoundLight<'_>, _scratch: &mut Scratch) -> f32 {
        1.0
    }

    /// What of this scene it cannot see, in a sentence each.
    fn blind_to(&self, _scene: &Scene) -> Vec<String> {
        Vec::new()
    }
}

/// One enum of all kinds that a person can name.
macro_rules! kinds {
    ($($kind:ident),* $(,)?) => {
        /// The words for the kinds (`--estimator`).
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum EstimatorKind {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind),*
        }
        impl EstimatorKind {
            /// All kinds.
            pub const ALL: &'static [EstimatorKind] = &[$(EstimatorKind::$kind),*];

            /// An estimator of this kind for a scene. One call serves a batch of receivers.
            pub fn make(self, scene: &Scene, options: Options) -> Box<dyn Estimator> {
                match self { $(EstimatorKind::$kind => Box::new($kind::new(scene, options))),* }
            }
        }
    };
}

kinds!(Path, Area, Hemisphere, Surfaces, Mis, PathHemisphere, AmbientOcclusion);
