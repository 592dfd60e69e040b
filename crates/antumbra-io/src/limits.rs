//! All limits on untrusted input, in one place.

use std::cell::Cell;

/// How much a file may ask for before it is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Forecast peak of memory for a scene [bytes]; none without.
    pub memory: Option<u64>,
    /// Size of one file [bytes].
    pub file_bytes: u64,
    /// Pixels of one picture.
    pub pixels: u64,
    /// Decoded pictures of one scene together [bytes].
    pub texture_bytes: u64,
    /// A scene may take this many times the bytes of its files …
    pub expansion: u64,
    /// … and this many bytes on top, so that tiny files are not refused.
    pub expansion_base: u64,
    /// Bytes of a text line (headers of PLY, STL, HDR).
    pub header_bytes: usize,
    /// Corners of one polygon.
    pub corners: usize,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits {
            memory: None,
            file_bytes: 8 << 30,
            pixels: 1 << 26,
            texture_bytes: 8 << 30,
            expansion: 48,
            expansion_base: 64 << 20,
            header_bytes: 1 << 16,
            corners: 1 << 20,
        }
    }
}

/// What is left of a number of bytes. Asked before anything large is allocated.
#[derive(Debug)]
pub(crate) struct Allowance(Cell<u64>);

impl Allowance {
    /// So many bytes may be taken.
    pub(crate) fn new(bytes: u64) -> Allowance {
        Allowance(Cell::new(bytes))
    }

    /// Takes `count` items of `size` bytes, or says that the limit is reached.
    pub(crate) fn take(&self, count: u64, size: u64) -> Result<(), String> {
        let left = count.checked_mul(size).and_then(|bytes| self.0.get().checked_sub(bytes));
        match left {
            Some(left) => {
                self.0.set(left);
                Ok(())
            }
            None => {
                Err(format!("{count} items of {size} bytes are out of proportion to the size of the file"))
            }
        }
    }

    /// So many more bytes may be taken.
    pub(crate) fn grant(&self, bytes: u64) {
        self.0.set(self.0.get().saturating_add(bytes));
    }
}
