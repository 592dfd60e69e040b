//! L_e and how a point of a light is drawn. Floor 3. To add one: a file here and a line in `kinds!`.
//!
//! Laws of every kind: `sample` agrees with `pdf` (χ²), E[1/pdf] = solid angle of the support, `hit` agrees with
//! `sample`, `bounds` contain the light. Densities are in solid angle at the receiver, always.

mod along;
mod directional;
mod disk;
mod environment;
mod far;
mod flat;
mod lat_long;
mod point;
mod rectangle;
pub mod sampler;
pub mod sky;
mod sphere;
mod spot;
mod square;
mod steps;
mod sun;
mod triangle;

pub use along::Along;
pub use directional::Directional;
pub use disk::Disk;
pub use environment::Environment;
pub use far::{Far, FarLights};
pub use point::Point;
pub use rectangle::Rectangle;
pub use sphere::Sphere;
pub use spot::{Spot, SpotEdge};
pub use sun::Sun;
pub use triangle::Triangle;

use antumbra_math::{Rgb, World};
use antumbra_trace::{PrimId, Shape};

use crate::density::Density;
use crate::receiver::Receiver;

/// Which light of the scene.
pub type LightId = u32;

/// How a point on a light is drawn (`--light-points`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightPoints {
    /// Uniform in the solid angle that the light fills at the receiver, where the kind knows how.
    #[default]
    SolidAngle,
    /// Uniform on the light's area: the lecture's pdf = 1/A.
    Area,
    /// On the area of flat lights, one side nine times as dense as the other; others: as `SolidAngle`.
    Skewed,
    /// On the area of flat lights, dense about the point nearest to the receiver; others: as `SolidAngle`.
    Nearest,
    /// On the area of flat lights but for a strip of a quarter of it, which is never drawn; others: as `SolidAngle`.
    /// Biased, on purpose, where nothing else finds the light of the strip.
    Hole,
}

/// Where a segment to a light ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// At a point p′ of the light.
    Point(World),
    /// At infinity, along ω_i.
    Infinity,
}

/// One point of a light, as a receiver sees it.
#[derive(Clone, Copy, Debug)]
pub struct LightSample {
    /// ω_i: unit vector toward the light.
    pub wi: World,
    /// Where the segment ends. Points of flat lights lie a start offset (LAW §5) in front of the surface, on the
    /// receiver's side, so that the light never shadows itself.
    pub end: End,
    /// Distance to p′; +∞ at infinity.
    pub distance: f32,
    /// What arrives along ω_i if the segment is free: L_e [W·m⁻²·sr⁻¹]; for delta lights the irradiance at normal
    /// incidence (I/r² or E₀).
    pub radiance: Rgb,
    /// p(ω_i).
    pub density: Density,
    /// The primitive that p′ lies on, or `NO_PRIM`.
    pub prim: PrimId,
    /// |cos θ′| at p′; 1 for lights without a surface.
    pub cos: f32,
}

/// The light met along a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightHit {
    /// Distance to it; +∞ for lights at infinity.
    pub distance: f32,
    /// L_e toward the receiver.
    pub radiance: Rgb,
}

/// A point of the silhouette of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutlinePoint {
    /// ω: unit vector toward it.
    pub wi: World,
    /// Where a segment to it ends.
    pub end: End,
}

/// Where a light may be and where it may shine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightBounds {
    /// Lower corner of the box of its points; −∞ for lights at infinity.
    pub low: World,
    /// Upper corner.
    pub high: World,
    /// It shines only into directions within an angle of this axis …
    pub axis: World,
    /// … whose cosine is this (−1: everywhere).
    pub cos_spread: f32,
}

impl LightBounds {
    /// Those of a light at infinity that shines along `axis`, within a cone about it.
    pub fn at_infinity(axis: World, cos_spread: f32) -> LightBounds {
        LightBounds { low: World::NEG_INFINITY, high: World::INFINITY, axis, cos_spread }
    }
}

/// The surface of an area light.
#[derive(Clone, Debug, PartialEq)]
pub enum LightSurface {
    /// Triangles whose counter-clockwise side is the light's front.
    Triangles(Vec<[[f32; 3]; 3]>),
    /// A shape; a disk's front is its normal's side, a sphere's its outside.
    Shape(Shape),
}

/// What each kind of light answers. `at.p` is the point of the geometry terms.
pub trait LightKind {
    /// Draws a point of the light that may shine on `at.p` (no look at normals of the receiver or at visibility).
    fn sample(&self, at: &Receiver, u: [f32; 2], how: LightPoints) -> Option<LightSample>;
    /// How points are drawn that lie evenly over what a receiver sees of the light: in area where it is flat, in solid
    /// angle where it is round or at infinity.
    fn even(&self) -> LightPoints {
        LightPoints::Area
    }
    /// The density with which `sample` draws ω_i [1/sr]; 0 for delta lights and directions that miss.
    fn pdf(&self, at: &Receiver, wi: World, how: LightPoints) -> f32;
    /// L_e met from the point `from` along the unit vector `wi`; `None` for a miss and for delta lights.
    fn hit(&self, from: World, wi: World) -> Option<LightHit>;
    /// Where a segment from `from` along the unit vector `wi` ends on the light, as in [`LightSample`], and on which
    /// primitive; `None` where `hit` is.
    fn end_along(&self, from: World, wi: World) -> Option<(End, PrimId)>;
    /// L_e leaving a surface of this light that was hit along `wi`, on its front or its back; black for delta lights.
    fn emitted(&self, wi: World, front: bool) -> Rgb;
    /// Unoccluded irradiance at `at` on the side of its geometric normal, luminance [W/m²], exact or estimated; above 0
    /// wherever the light can contribute.
    fn irradiance(&self, at: &Receiver) -> f32;
    /// How it looks from far away, if it is flat.
    fn far(&self) -> Option<Far> {
        None
    }
    /// Emitted power, luminance [W]; for lights at infinity through a disk of `scene_radius`.
    fn power(&self, scene_radius: f32) -> f32;
    /// Where it is.
    fn bounds(&self) -> LightBounds;
    /// A point of its silhouette as seen from `at`, u in [0, 1) once around; `None` for delta lights and the sky.
    fn outline(&self, at: &Receiver, u: f32) -> Option<OutlinePoint>;
    /// Fills no solid angle.
    fn is_delta(&self) -> bool {
        false
    }
    /// Lies at infinity (rays that miss everything see it).
    fn is_infinite(&self) -> bool {
        false
    }
    /// Lies at infinity around everything: the environment, which a person may replace.
    fn is_environment(&self) -> bool {
        false
    }
    /// What it is made of, for the scene to place in the world; `None` for lights without a surface.
    fn surface(&self) -> Option<LightSurface> {
        None
    }
    /// A number that is not finite, a length that is not positive: said as `what is wrong`; `None` if all is well.
    fn fault(&self) -> Option<String>;
    /// Tells a light that is a surface which primitives of the world it is (called once, by the scene).
    fn set_first_prim(&mut self, _first: PrimId) {}
    /// Examples for the contract tests.
    fn examples() -> Vec<Self>
    where
        Self: Sized;
}

/// One enum of all kinds, its delegation, and the list that the contract tests walk through.
macro_rules! kinds {
    ($($kind:ident),* $(,)?) => {
        /// A light, one of the closed list of kinds.
        #[derive(Clone, Debug)]
        pub enum Light {
            $(#[doc = concat!("See [`", stringify!($kind), "`].")] $kind($kind)),*
        }
        impl Light {
            kinds!(@delegate [$($kind)*]
                sample(at: &Receiver, u: [f32; 2], how: LightPoints) (at, u, how) -> Option<LightSample>;
                even() () -> LightPoints;
                pdf(at: &Receiver, wi: World, how: LightPoints) (at, wi, how) -> f32;
                hit(from: World, wi: World) (from, wi) -> Option<LightHit>;
                end_along(from: World, wi: World) (from, wi) -> Option<(End, PrimId)>;
                emitted(wi: World, front: bool) (wi, front) -> Rgb;
                irradiance(at: &Receiver) (at) -> f32;
                far() () -> Option<Far>;
                power(scene_radius: f32) (scene_radius) -> f32;
                bounds() () -> LightBounds;
                outline(at: &Receiver, u: f32) (at, u) -> Option<OutlinePoint>;
                is_delta() () -> bool;
                is_infinite() () -> bool;
                is_environment() () -> bool;
                surface() () -> Option<LightSurface>;
                fault() () -> Option<String>;
            );
            /// See [`LightKind::set_first_prim`].
            pub fn set_first_prim(&mut self, first: PrimId) {
                match self { $(Light::$kind(l) => l.set_first_prim(first)),* }
            }
            /// The word for its kind.
            pub fn kind(&self) -> &'static str {
                match self { $(Light::$kind(_) => stringify!($kind)),* }
            }
            /// Every kind's examples, with the kind's name.
            pub fn examples() -> Vec<(&'static str, Light)> {
                let mut all = Vec::new();
                $(all.extend($kind::examples().into_iter().map(|l| (stringify!($kind), Light::$kind(l))));)*
                all
            }
        }
        $(impl From<$kind> for Light { fn from(l: $kind) -> Light { Light::$kind(l) } })*
    };
    (@delegate $kinds:tt $($name:ident($($arg:ident: $ty:ty),*) $args:tt -> $out:ty;)*) => {
        $(kinds!(@method $kinds $name ($($arg: $ty),*) $args $out);)*
    };
    (@method [$($kind:ident)*] $name:ident ($($arg:ident: $ty:ty),*) $args:tt $out:ty) => {
        #[doc = concat!("See [`LightKind::", stringify!($name), "`].")]
        #[inline]
        pub fn $name(&self, $($arg: $ty),*) -> $out {
            match self { $(Light::$kind(l) => l.$name $args),* }
        }
    };
}

kinds!(Point, Spot, Directional, Sun, Triangle, Rectangle, Disk, Sphere, Environment);
