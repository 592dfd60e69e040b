//! A picture of any kind that is read, told apart by its first bytes.

use std::path::Path;

use super::{Picture, read_exr_bytes, read_png_bytes};
use crate::error::ReadError;
use crate::files::read_limited;
use crate::limits::Limits;
use crate::read::hdr;

/// Reads an EXR, a PNG or a Radiance HDR picture as linear colours.
pub fn read_picture(path: &Path) -> Result<Picture, ReadError> {
    let limits = Limits::default();
    let name = path.display().to_string();
    let bytes = read_limited(path, limits.file_bytes)
        .map_err(|why| ReadError::new("", format!("cannot be read ({why})")).of(name.clone()))?;
    let picture = match bytes[..] {
        [0x76, 0x2f, 0x31, 0x01, ..] => read_exr_bytes(&bytes, &limits),
        [0x89, b'P', b'N', b'G', ..] => read_png_bytes(&bytes, &limits),
        [b'#', b'?', ..] => read_hdr_bytes(&bytes, &limits),
        [] => Err(ReadError::new("", "the file is empty (0 bytes)")),
        _ => Err(ReadError::new("", "this is no picture that antumbra reads: its first bytes are others")
            .hint("It reads OpenEXR, PNG and Radiance HDR.")),
    };
    picture.map_err(|e| e.of(name))
}

fn read_hdr_bytes(bytes: &[u8], limits: &Limits) -> Result<Picture, ReadError> {
    let hdr::Radiance { width, height, pixels } = hdr::decode(bytes, limits)?;
    Ok(Picture { width, height, pixels, ..Picture::default() })
}
