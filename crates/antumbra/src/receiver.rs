//! The point to be lit: p with its normal, its surface and the start of every segment that leaves it.

use antumbra_math::{Frame, Local, Rgb, World, hash};
use antumbra_trace::PrimId;

use crate::bsdf::Bsdf;

/// Tells the random numbers of the other side apart.
const BEHIND: u32 = 0x5bd1_e995;

/// A point p that asks for light, seen from ω_o.
#[derive(Clone, Copy, Debug)]
pub struct Receiver {
    /// Position p.
    pub p: World,
    /// Where segments start (LAW §5: on the viewer's side of the surface, by the one function of `trace::start`).
    pub start: [f32; 3],
    /// Where segments start that leave on the other side of a surface that lets light through; else `start`.
    pub beyond: [f32; 3],
    /// The primitive that p lies on; `NO_PRIM` for a bare point.
    pub prim: PrimId,
    /// Geometric unit normal, on the viewer's side: decides sides.
    pub ng: World,
    /// Shading frame, its normal on the viewer's side: bends the BSDF only.
    pub frame: Frame,
    /// ω_o: toward the viewer, in the shading frame.
    pub wo: Local,
    /// How the surface reflects here (textures already looked up).
    pub bsdf: Bsdf,
    /// Where the film sums what arrives.
    pub cell: u32,
    /// Stream of the random numbers.
    pub stream: u32,
    /// Number of the sample in its stream.
    pub index: u32,
    /// What light leaving p toward ω_o is worth at the film.
    pub throughput: Rgb,
    /// Segments of the path before p: 0 where the sensor looks.
    pub bounce: u32,
}

impl Receiver {
    /// ω into the shading frame.
    #[inline]
    pub fn to_local(&self, w: World) -> Local {
        self.frame.to_local(w)
    }

    /// ω from the shading frame.
    #[inline]
    pub fn to_world(&self, l: Local) -> World {
        self.frame.to_world(l)
    }

    /// ω leaves on the side on which segments start.
    #[inline]
    pub fn sees_side(&self, wi: World) -> bool {
        wi.dot(self.ng) > 0.0
    }

    /// ω in the shading frame, if it leaves on the side on which segments start, by both normals.
    #[inline]
    pub fn local_in_sight(&self, wi: World) -> Option<Local> {
        let local = self.to_local(wi);
        let both = local.cos() * self.frame.n.dot(self.ng) > 0.0;
        (both && self.sees_side(wi)).then_some(local)
    }

    /// Light reaches p from the other side too, over a range of directions.
    #[inline]
    pub fn spreads_through(&self) -> bool {
        self.bsdf.index_below().is_some() && !self.bsdf.is_delta()
    }

    /// The same point asking for light from the other side of its surface; numbers of its own.
    pub fn from_behind(&self) -> Receiver {
        let (start, beyond) = (self.beyond, self.start);
        Receiver { start, beyond, ng: -self.ng, stream: hash::hash2(self.stream, BEHIND), ..*self }
    }
}
