//! Embree 4 through its C interface, loaded at run time: the peer of the race, never a dependency.

use std::ffi::{CString, c_char, c_int, c_void};
use std::sync::atomic::{AtomicIsize, Ordering};

use antumbra_trace::{Segments, TO_POINT, Triangles};

use crate::clock::now;
use crate::packets::{self, Arguments, Mode, Packet};

unsafe extern "C" {
    fn dlopen(file: *const c_char, flags: c_int) -> *mut c_void;
    fn dlsym(library: *mut c_void, name: *const c_char) -> *mut c_void;
}

const RTLD_NOW: c_int = 2;
const QUALITY_HIGH: c_int = 2;
const FLAG_ROBUST: c_int = 4;
const FORMAT_UINT3: c_int = 0x5003;
const FORMAT_FLOAT3: c_int = 0x9003;

/// Bytes that Embree holds now, by its own monitor.
static HELD: AtomicIsize = AtomicIsize::new(0);

extern "C" fn monitor(_: *mut c_void, bytes: isize, _: bool) -> bool {
    HELD.fetch_add(bytes, Ordering::Relaxed);
    true
}

/// One ray as Embree takes it, with room behind it for the hit.
#[repr(C, align(64))]
#[derive(Clone, Copy)]
struct RayHit {
    origin: [f32; 3],
    tnear: f32,
    direction: [f32; 3],
    time: f32,
    tfar: f32,
    mask: u32,
    id: u32,
    flags: u32,
    normal: [f32; 3],
    uv: [f32; 2],
    prim: u32,
    geometry: u32,
    room: [u32; 9],
}

macro_rules! functions {
    ($($name:ident: fn($($arg:ty),*) $(-> $out:ty)?;)*) => {
        /// The functions that the race calls.
        #[allow(non_snake_case)]
        struct Functions { $($name: unsafe extern "C" fn($($arg),*) $(-> $out)?,)* }

        impl Functions {
            /// # Safety
            /// `library` is a loaded Embree 4: its functions have the types of its public header.
            unsafe fn of(library: *mut c_void) -> Option<Functions> {
                Some(Functions { $($name: {
                    let name = CString::new(stringify!($name)).ok()?;
                    let found = unsafe { dlsym(library, name.as_ptr()) };
                    if found.is_null() { return None; }
                    unsafe { std::mem::transmute::<*mut c_void, unsafe extern "C" fn($($arg),*) $(-> $out)?>(found) }
                },)* })
            }
        }
    };
}

type Ptr = *mut c_void;

functions! {
    rtcNewDevice: fn(*const c_char) -> Ptr;
    rtcReleaseDevice: fn(Ptr);
    rtcSetDeviceMemoryMonitorFunction: fn(Ptr, extern "C" fn(Ptr, isize, bool) -> bool, Ptr);
    rtcNewScene: fn(Ptr) -> Ptr;
    rtcSetSceneFlags: fn(Ptr, c_int);
    rtcSetSceneBuildQuality: fn(Ptr, c_int);
    rtcNewGeometry: fn(Ptr, c_int) -> Ptr;
    rtcSetNewGeometryBuffer: fn(Ptr, c_int, u32, c_int, usize, usize) -> Ptr;
    rtcCommitGeometry: fn(Ptr);
    rtcAttachGeometry: fn(Ptr, Ptr) -> u32;
    rtcReleaseGeometry: fn(Ptr);
    rtcCommitScene: fn(Ptr);
    rtcReleaseScene: fn(Ptr);
    rtcOccluded1: fn(Ptr, *mut RayHit, *mut Arguments);
    rtcOccluded8: fn(*const i32, Ptr, *mut Packet<8>, *mut Arguments);
    rtcOccluded16: fn(*const i32, Ptr, *mut Packet<16>, *mut Arguments);
    rtcIntersect1: fn(Ptr, *mut RayHit, Ptr);
}

/// A loaded library with one device.
pub struct Embree {
    call: Functions,
    device: Ptr,
}

/// A built scene.
pub struct Scene<'a> {
    embree: &'a Embree,
    scene: Ptr,
    /// Bytes taken while building, kept.
    pub bytes: usize,
    /// Time of the build [s].
    pub seconds: f64,
}

impl Embree {
    /// Loads the library at `path` and makes a device of `threads` threads.
    pub fn load(path: &str, threads: usize) -> Option<Embree> {
        let (path, config) = (CString::new(path).ok()?, CString::new(format!("threads={threads}")).ok()?);
        // SAFETY: both strings end in 0 and live through the calls; a null result is checked. Whoever names the file
        // vouches for its being Embree 4.
        unsafe {
            let library = dlopen(path.as_ptr(), RTLD_NOW);
            if library.is_null() {
                return None;
            }
            let call = Functions::of(library)?;
            let device = (call.rtcNewDevice)(config.as_ptr());
            (call.rtcSetDeviceMemoryMonitorFunction)(device, monitor, std::ptr::null_mut());
            Some(Embree { call, device })
        }
    }

    /// Builds `mesh` at quality HIGH.
    pub fn scene(&self, mesh: &Triangles, robust: bool) -> Scene<'_> {
        let c = &self.call;
        // SAFETY: handles come from this device and are used before release; the buffers returned hold the counts asked
        // for (Embree pads vertex buffers to 16 bytes itself), and are filled before the commit that reads them.
        unsafe {
            let scene = (c.rtcNewScene)(self.device);
            (c.rtcSetSceneFlags)(scene, if robust { FLAG_ROBUST } else { 0 });
            (c.rtcSetSceneBuildQuality)(scene, QUALITY_HIGH);
            let geometry = (c.rtcNewGeometry)(self.device, 0);
            let (v, i) = (mesh.vertices.len(), mesh.indices.len());
            let vertices = (c.rtcSetNewGeometryBuffer)(geometry, 1, 0, FORMAT_FLOAT3, 12, v);
            std::ptr::copy_nonoverlapping(mesh.vertices.as_ptr(), vertices.cast::<[f32; 3]>(), v);
            let indices = (c.rtcSetNewGeometryBuffer)(geometry, 0, 0, FORMAT_UINT3, 12, i);
            std::ptr::copy_nonoverlapping(mesh.indices.as_ptr(), indices.cast::<[u32; 3]>(), i);
            (c.rtcCommitGeometry)(geometry);
            (c.rtcAttachGeometry)(scene, geometry);
            (c.rtcReleaseGeometry)(geometry);
            let before = HELD.load(Ordering::Relaxed);
            let start = now();
            (c.rtcCommitScene)(scene);
            let seconds = now() - start;
            let bytes = (HELD.load(Ordering::Relaxed) - before).max(0) as usize;
            Scene { embree: self, scene, bytes, seconds }
        }
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        // SAFETY: scenes borrow self, so none is left.
        unsafe { (self.call.rtcReleaseDevice)(self.device) }
    }
}

impl Drop for Scene<'_> {
    fn drop(&mut self) {
        // SAFETY: made by `scene`, released once.
        unsafe { (self.embree.call.rtcReleaseScene)(self.scene) }
    }
}

impl Scene<'_> {
    /// Fills `out` with whether each entry is blocked.
    pub fn occluded(&self, asked: &Segments<'_>, mode: Mode, out: &mut [bool]) {
        let call = &self.embree.call;
        // SAFETY: the functions are Embree's, found by these names; the scene is committed.
        unsafe {
            match mode.width {
                16 => packets::occluded((call.rtcOccluded16, self.scene), asked, mode.coherent, out),
                8 => packets::occluded((call.rtcOccluded8, self.scene), asked, mode.coherent, out),
                _ => self.one_by_one(asked, out),
            }
        }
    }

    fn one_by_one(&self, asked: &Segments<'_>, out: &mut [bool]) {
        let f = self.embree.call.rtcOccluded1;
        let mut ray = blank();
        for (i, blocked) in out.iter_mut().enumerate() {
            aim(&mut ray, asked, i);
            // SAFETY: the scene is committed; the ray is 64-byte aligned and larger than RTCRay; null = defaults.
            unsafe { f(self.scene, &mut ray, std::ptr::null_mut()) };
            *blocked = ray.tfar < 0.0;
        }
    }

    /// Fills `out` with the closest primitive of each entry and its t; `u32::MAX` for none.
    pub fn nearest(&self, asked: &Segments<'_>, out: &mut [(u32, f32)]) {
        let f = self.embree.call.rtcIntersect1;
        let mut ray = blank();
        for (i, hit) in out.iter_mut().enumerate() {
            aim(&mut ray, asked, i);
            ray.geometry = u32::MAX;
            ray.prim = u32::MAX;
            // SAFETY: as above; RayHit holds RTCRayHit and room to spare.
            unsafe { f(self.scene, &mut ray, std::ptr::null_mut()) };
            *hit = (ray.prim, ray.tfar);
        }
    }
}

fn blank() -> RayHit {
    RayHit {
        origin: [0.0; 3],
        tnear: 0.0,
        direction: [0.0; 3],
        time: 0.0,
        tfar: 0.0,
        mask: u32::MAX,
        id: 0,
        flags: 0,
        normal: [0.0; 3],
        uv: [0.0; 2],
        prim: u32::MAX,
        geometry: u32::MAX,
        room: [u32::MAX; 9],
    }
}

#[inline]
fn aim(ray: &mut RayHit, asked: &Segments<'_>, i: usize) {
    let (o, e, reach) = (asked.origin_at(i), asked.end_at(i), asked.reach[i]);
    ray.origin = o;
    if reach == TO_POINT {
        ray.direction = [e[0] - o[0], e[1] - o[1], e[2] - o[2]];
        ray.tfar = 1.0;
    } else {
        ray.direction = e;
        ray.tfar = reach;
    }
    ray.tnear = 0.0;
}
