//! The clock of the races.

use std::ffi::c_int;
use std::sync::atomic::{AtomicI32, Ordering};

unsafe extern "C" {
    fn clock_gettime(clock: c_int, time: *mut Time) -> c_int;
}

/// Seconds and nanoseconds, as the system writes them.
#[repr(C)]
struct Time {
    seconds: i64,
    nanoseconds: i64,
}

const WALL: c_int = 1;
const CPU_OF_THREAD: c_int = 3;

/// Which clock [`now`] reads.
static CLOCK: AtomicI32 = AtomicI32::new(CPU_OF_THREAD);

/// From now on by the clock on the wall: for work of several threads.
pub fn use_wall_clock() {
    CLOCK.store(WALL, Ordering::Relaxed);
}

/// Processor time of this thread [s] (what the other work on a shared machine disturbs least), or wall time.
pub fn now() -> f64 {
    let mut time = Time { seconds: 0, nanoseconds: 0 };
    // SAFETY: `time` has the layout of timespec on 64-bit Linux and lives through the call.
    unsafe { clock_gettime(CLOCK.load(Ordering::Relaxed), &mut time) };
    time.seconds as f64 + time.nanoseconds as f64 * 1e-9
}
