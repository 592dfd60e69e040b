//! Alpha masks: asking the owner of a surface whether a ray goes through it.

use crate::PrimId;

/// Which rays go through which masked primitives. Asked only for instances with `masked: true`.
pub trait Passes: Sync {
    /// The ray or segment with this `number` goes through `prim` at `uv` (weights of its second and third corner).
    ///
    /// Pure: the same answer for the same arguments, so that every kernel gives the same result.
    fn passes(&self, number: u32, prim: PrimId, uv: [f32; 2]) -> bool;
}
