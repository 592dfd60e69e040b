//! Walking a tree: the f32 way of LAW §3 and §4 at every SIMD level, and the f64 way for lines outside its conditions.
//!
//! Nothing here decides a hit near its border: boxes and filters discard or confirm outside proven error bounds, and
//! ask the law for the rest. So all ways give the same bits.

mod ask;
mod boxes;
mod chunk;
mod closest;
mod eight;
mod exact;
mod filter;
mod flight;
mod gate;
mod measure;
mod packet;
mod ray;
mod ready;
mod rules;
mod shaft;
mod shapes;
mod sixteen;
mod triangles;
mod vector;
mod walls;

pub(crate) use ask::{Ask, Asking, Best, Masks, Opaque};
pub(crate) use boxes::{VisitAny, VisitNearest, any_hit, nearest_hit};
pub(crate) use chunk::{Chunk, Room};
pub(crate) use closest::Desk;
pub(crate) use exact::{Count, ExactVisit, NotCounted, any_hit_exact, nearest_hit_exact};
pub(crate) use filter::{TINY, U};
pub(crate) use flight::Answers;
pub(crate) use ray::{FastLine, Limits, Lines};
pub(crate) use ready::CHUNK;
pub use rules::Ways;
pub(crate) use shapes::{Numbered, ShapeTree, ShapeVisit};
pub(crate) use sixteen::{Met, PACKET, Seen, Sixteen};
pub(crate) use triangles::{AnyTriangle, ExactTriangles, NearestTriangle, TriangleTree};
pub(crate) use vector::V3;
pub(crate) use walls::walls;
