//! Which light: one is chosen per shadow ray. To add a way: a file here and a line in `kinds!`.
//!
//! Laws of every kind: the probabilities sum to 1 (or there is nothing to choose), the frequency of a choice is its
//! probability, and every light that can contribute has one above 0.

mod contribution;
mod power;
mod uniform;

pub use contribution::Contribution;
pub use power::Power;
pub use uniform::Uniform;

use super::{Light, LightId, steps};
use crate::receiver::Receiver;

/// A chosen light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// Which.
    pub light: LightId,
    /// Its probability among the lights.
    pub prob: f32,
}

/// Room that a thread keeps for what is computed once per receiver.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    weights: Vec<f32>,
    ends: Vec<u32>,
}

/// The probabilities of all lights at one receiver.
#[derive(Clone, Copy, Debug)]
pub struct Chooser<'a> {
    ends: &'a [u32],
}

impl Chooser<'_> {
    /// The light that `u` in [0, 1) falls on; `None` if no light can contribute.
    #[inline]
    pub fn pick(&self, u: f32) -> Option<Pick> {
        steps::pick(self.ends, u).map(|choice| Pick { light: choice.index as LightId, prob: choice.prob })
    }

    /// The probability of a light.
    #[inline]
    pub fn prob(&self, light: LightId) -> f32 {
        steps::prob(self.ends, light as usize)
    }
}

/// What each way of choosing answers.
pub trait LightSamplerKind: Sized {
    /// What can be computed once for a scene (`scene_radius`: what lights at infinity shine through); `None` if this way
    /// cannot serve so many lights.
    fn new(lights: &[Light], scene_radius: f32) -> Option<Self>;
    /// The probabilities at a receiver, shared by all its shadow rays.
    fn prepare<'a>(&'a self, lights: &[Light], at: &Receiver, scratch: &'a mut Scratch) -> Chooser<'a>;
}

/// One enum of all kinds, the words for them, and their delegation.
macro_rules! kinds {
    ($($kind:ident: $word:literal),* $(,)?) => {
        /// The ways of choosing a light (`--lights`).
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Choose {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind),*
        }
        impl Choose {
            /// All of them.
            pub const ALL: &'static [Choose] = &[$(Choose::$kind),*];
            /// Its word in the settings.
            pub fn word(self) -> &'static str {
                match self { $(Choose::$kind => $word),* }
            }
        }
        /// A way of choosing a light, made for a scene.
        #[derive(Clone, Debug)]
        pub enum LightSampler {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind($kind)),*
        }
        impl LightSampler {
            /// The way `kind`; by power where that way cannot serve so many lights (see [`LightSampler::kind`]).
            pub fn new(kind: Choose, lights: &[Light], scene_radius: f32) -> LightSampler {
                let made = match kind {
                    $(Choose::$kind => $kind::new(lights, scene_radius).map(LightSampler::$kind)),*
                };
                made.unwrap_or_else(|| LightSampler::Power(Power::of(lights, scene_radius)))
            }
            /// The way it is.
            pub fn kind(&self) -> Choose {
                match self { $(LightSampler::$kind(_) => Choose::$kind),* }
            }
            /// See [`LightSamplerKind::prepare`].
            #[inline]
            pub fn prepare<'a>(
                &'a self,
                lights: &[Light],
                at: &Receiver,
                scratch: &'a mut Scratch,
            ) -> Chooser<'a> {
                match self { $(LightSampler::$kind(s) => s.prepare(lights, at, scratch)),* }
            }
        }
    };
}

kinds!(Uniform: "uniform", Power: "power", Contribution: "contribution");
