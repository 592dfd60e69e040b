//! Embree's packets of 8 and 16 rays: the rays side by side, as its header lays them out, and the ways to ask it.

use std::ffi::c_void;

use antumbra_trace::{Segments, TO_POINT};

/// One way to ask Embree whether rays are blocked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mode {
    /// Rays a call: 1, 8 or 16.
    pub width: usize,
    /// Its flag that says that the rays of a packet lie close together.
    pub coherent: bool,
    /// Its scene is built with the robust flag.
    pub robust: bool,
    /// A packet holds the same stratum of 16 receivers, not 16 strata of one.
    pub transposed: bool,
}

impl Mode {
    /// All of them.
    pub fn all(strata: bool) -> Vec<Mode> {
        let mut out = Vec::new();
        for robust in [false, true] {
            for transposed in [false, true].into_iter().filter(|t| strata || !t) {
                out.extend(
                    [(1, false), (8, false), (8, true), (16, false), (16, true)]
                        .map(|(width, coherent)| Mode { width, coherent, robust, transposed }),
                );
            }
        }
        out
    }

    /// As results name it.
    pub fn name(&self) -> String {
        let word = |really, word| if really { word } else { "" };
        format!(
            "{}{}{}{}",
            self.width,
            word(self.coherent, " coherent"),
            word(self.transposed, " transposed"),
            word(self.robust, " robust")
        )
    }
}

/// RTCRay8 or RTCRay16: one row a field.
#[repr(C, align(64))]
pub struct Packet<const N: usize> {
    origin: [[f32; N]; 3],
    tnear: [f32; N],
    direction: [[f32; N]; 3],
    time: [f32; N],
    tfar: [f32; N],
    mask: [u32; N],
    id: [u32; N],
    flags: [u32; N],
}

/// Which rays of a packet are asked. Embree reads it with aligned loads.
#[repr(C, align(64))]
struct Valid<const N: usize>([i32; N]);

/// RTCOccludedArguments of Embree 4.
#[repr(C)]
pub struct Arguments {
    flags: u32,
    features: u32,
    context: *mut c_void,
    filter: *mut c_void,
    function: *mut c_void,
}

impl Arguments {
    /// The defaults, and whether packets are coherent.
    pub fn new(coherent: bool) -> Arguments {
        let none = std::ptr::null_mut();
        let flags = if coherent { 1 << 16 } else { 0 };
        Arguments { flags, features: u32::MAX, context: none, filter: none, function: none }
    }
}

/// rtcOccluded8 or rtcOccluded16.
pub type Call<const N: usize> = unsafe extern "C" fn(*const i32, *mut c_void, *mut Packet<N>, *mut Arguments);

/// Fills `out` with whether each entry is blocked.
///
/// # Safety
/// `call` is Embree's function for packets of N, `scene` is committed.
pub unsafe fn occluded<const N: usize>(
    (call, scene): (Call<N>, *mut c_void),
    asked: &Segments<'_>,
    coherent: bool,
    out: &mut [bool],
) {
    let mut arguments = Arguments::new(coherent);
    let mut packet = Packet::<N> {
        origin: [[0.0; N]; 3],
        tnear: [0.0; N],
        direction: [[0.0; N]; 3],
        time: [0.0; N],
        tfar: [0.0; N],
        mask: [u32::MAX; N],
        id: [0; N],
        flags: [0; N],
    };
    let mut valid = Valid([0; N]);
    for (from, blocked) in (0..).step_by(N).zip(out.chunks_mut(N)) {
        for (lane, valid) in valid.0.iter_mut().enumerate() {
            *valid = if lane < blocked.len() { -1 } else { 0 };
        }
        fill(&mut packet, asked, from, blocked.len());
        // SAFETY: packet and mask are 64-byte aligned and hold N rays; the caller vouches for the rest.
        unsafe { call(valid.0.as_ptr(), scene, &mut packet, &mut arguments) };
        for (blocked, tfar) in blocked.iter_mut().zip(packet.tfar) {
            *blocked = tfar < 0.0;
        }
    }
}

/// The entries from `from` on, column by column.
#[inline(always)]
fn fill<const N: usize>(packet: &mut Packet<N>, asked: &Segments<'_>, from: usize, count: usize) {
    let reach = &asked.reach[from..from + count];
    for axis in 0..3 {
        let (o, e) = (&asked.origin[axis][from..from + count], &asked.end[axis][from..from + count]);
        packet.origin[axis][..count].copy_from_slice(o);
        let ends = o.iter().zip(e).zip(reach);
        for (d, ((o, e), reach)) in packet.direction[axis].iter_mut().zip(ends) {
            *d = if *reach == TO_POINT { e - o } else { *e };
        }
    }
    for (tfar, reach) in packet.tfar.iter_mut().zip(reach) {
        *tfar = if *reach == TO_POINT { 1.0 } else { *reach };
    }
}
