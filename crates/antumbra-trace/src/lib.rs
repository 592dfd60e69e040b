//! Floor 1: V(p, p′), which segments are free. Batches of segments and rays against triangles, spheres, disks and
//! open cylinders; the answer is the mathematically exact one for the numbers given, at every SIMD level.
//!
//! The law is [`law`]; [`Brute`] asks it of every primitive; [`World`] answers the same, bit for bit, through a tree.

mod batch;
mod brute;
mod build;
mod counted;
mod dispatch;
mod draft;
mod geometry;
pub mod law;
mod layout;
mod level;
mod object;
pub mod occlusion;
mod passes;
mod place;
pub mod start;
mod traverse;
mod walk;
mod world;

pub use batch::{Bits, Grown, Hits, SegmentBuffer, Segments, TO_POINT};
pub use brute::Brute;
pub use build::{BuildOptions, Pool};
pub use counted::Work;
pub use draft::WorldError;
pub use geometry::{Geometry, Instance, NO_PRIM, PrimId, Shape, Triangles};
pub use level::SimdLevel;
pub use passes::Passes;
#[doc(hidden)]
pub use traverse::Ways;
pub use world::{TreeStats, World};

/// Which segments are blocked, what a ray meets first.
///
/// Law: equals `Brute` on every input, bit for bit.
pub trait Visibility: Sync {
    /// Sets bit i of `out` if anything lies strictly between the ends of segment i (any hit, no order).
    fn occluded(&self, segments: Segments<'_>, out: &mut Bits);

    /// The closest hit of each ray; ties by (instance, mesh, primitive) in builder order. `first` and `last` are
    /// skipped as in [`occluded`](Visibility::occluded).
    fn nearest(&self, rays: Segments<'_>, out: &mut Hits);
}
