//! Large arrays: pages of 2 MiB where the system offers them, so that a walk through 100 MB misses the address cache
//! less often; filled by all threads.

use std::mem::MaybeUninit;

use crate::build::Workers;

/// An empty vector for `capacity` elements.
pub(crate) fn roomy<T>(capacity: usize) -> Vec<T> {
    let mut room = Vec::with_capacity(capacity);
    advise(room.spare_capacity_mut());
    room
}

/// `make(0)`, `make(1)` … `make(n − 1)`, made in parts of `part` by all threads.
pub(crate) fn filled<T: Send>(
    n: usize,
    part: usize,
    workers: Workers,
    make: &(impl Fn(usize) -> T + Sync),
) -> Vec<T> {
    let mut out = roomy(n);
    workers.parts(&mut out.spare_capacity_mut()[..n], part, &|first, slots| {
        for (i, slot) in slots.iter_mut().enumerate() {
            slot.write(make(first + i));
        }
    });
    // SAFETY: `parts` hands out each of the first n slots once, and every slot handed out was written.
    unsafe { out.set_len(n) };
    out
}

/// Tells the system that this memory, not touched so far, is better in large pages.
#[cfg(target_os = "linux")]
fn advise<T>(memory: &mut [MaybeUninit<T>]) {
    use std::ffi::{c_int, c_void};
    unsafe extern "C" {
        fn madvise(start: *mut c_void, length: usize, advice: c_int) -> c_int;
    }
    const HUGE_PAGES: c_int = 14;
    const PAGE: usize = 4096;
    let bytes = size_of_val(memory);
    let start = memory.as_mut_ptr().cast::<u8>();
    let skip = start.align_offset(PAGE);
    if bytes < 1 << 22 || skip > bytes {
        return;
    }
    let length = (bytes - skip) / PAGE * PAGE;
    // SAFETY: start + skip is page-aligned and [start + skip, start + skip + length) lies inside `memory`, which is
    // borrowed mutably; this advice changes how pages are backed, never what they hold. Its failure changes nothing.
    unsafe { madvise(start.add(skip).cast::<c_void>(), length, HUGE_PAGES) };
}

#[cfg(not(target_os = "linux"))]
fn advise<T>(_: &mut [MaybeUninit<T>]) {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::Pool;

    #[test]
    fn filled_in_order() {
        let out = Pool::serial().run(|workers| filled(1_000_003, 1 << 12, workers, &|i| 3 * i));
        assert!(out.len() == 1_000_003 && out.iter().enumerate().all(|(i, &x)| x == 3 * i));
        assert!(Pool::serial().run(|workers| filled(0, 8, workers, &|i| i)).is_empty());
    }
}
