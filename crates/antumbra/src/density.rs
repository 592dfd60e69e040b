//! The measure of a probability density: always solid angle at the receiver [1/sr], or a single direction.

/// How densely a direction was drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Density {
    /// p(ω) in solid angle at the receiver [1/sr].
    SolidAngle(f32),
    /// The only direction there is (point light, mirror): the estimate divides by one.
    Delta,
}

impl Density {
    /// What an estimate divides by.
    #[inline]
    pub fn weight(self) -> f32 {
        match self {
            Density::SolidAngle(p) => p,
            Density::Delta => 1.0,
        }
    }

    /// p(ω) for weighing against another strategy; 0 for a single direction, which no other strategy draws.
    #[inline]
    pub fn pdf(self) -> f32 {
        match self {
            Density::SolidAngle(p) => p,
            Density::Delta => 0.0,
        }
    }

    /// A single direction.
    #[inline]
    pub fn is_delta(self) -> bool {
        self == Density::Delta
    }
}
