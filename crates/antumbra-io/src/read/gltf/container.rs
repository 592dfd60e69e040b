//! The outside of a file: a GLB with its chunks, or bare JSON (glTF 2.0, section 4).

use crate::error::ReadError;

/// The JSON text and the binary chunk.
pub(super) struct Container<'a> {
    pub json: &'a [u8],
    pub bin: Option<&'a [u8]>,
    /// Bytes after the announced length.
    pub trailing: usize,
}

const CUT: &str = "The file is cut short, or its exporter is wrong.";
const JSON: u32 = u32::from_le_bytes(*b"JSON");
const BIN: u32 = u32::from_le_bytes(*b"BIN\0");

/// Takes a file apart. A file that does not begin like a GLB is taken as JSON.
pub(super) fn open(bytes: &[u8], named_glb: bool) -> Result<Container<'_>, ReadError> {
    if bytes.is_empty() {
        return Err(ReadError::new("", "the file is empty (0 bytes)").hint(CUT));
    }
    if bytes.starts_with(b"glTF") {
        return glb(bytes);
    }
    let json = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if json.iter().find(|b| !b.is_ascii_whitespace()).is_none_or(|b| *b != b'{') {
        let what = if named_glb {
            "this is no GLB: it does not begin with \"glTF\""
        } else {
            "this is no glTF: it begins neither with \"{\" nor with \"glTF\""
        };
        return Err(ReadError::new("", what).hint("Check that it was downloaded or exported completely."));
    }
    Ok(Container { json, bin: None, trailing: 0 })
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

fn glb(bytes: &[u8]) -> Result<Container<'_>, ReadError> {
    let cut = |place: &str, what: String| ReadError::new(place, what).hint(CUT);
    let (Some(version), Some(length)) = (word(bytes, 4), word(bytes, 8)) else {
        let what = format!("ends after {} of 12 bytes", bytes.len());
        return Err(cut("GLB header", what));
    };
    if version != 2 {
        let what = format!("this is version {version} of the GLB container; version 2 is read");
        return Err(ReadError::new("GLB header", what).hint("Export the scene as glTF 2.0."));
    }
    if length as usize > bytes.len() {
        let what = format!("announces {length} bytes, the file has {}", bytes.len());
        return Err(cut("GLB header", what));
    }
    let (mut json, mut bin, mut at) = (None, None, 12);
    let body = &bytes[..length as usize];
    while let (Some(size), Some(kind)) = (word(body, at), word(body, at + 4)) {
        let begin = at + 8;
        let Some(chunk) = body.get(begin..begin.saturating_add(size as usize)) else {
            let name = if kind == JSON { "JSON chunk" } else { "binary chunk" };
            let what = format!("announces {size} bytes, the file has {} left", body.len() - begin);
            return Err(cut(name, what));
        };
        match kind {
            JSON if json.is_none() => json = Some(chunk),
            BIN if bin.is_none() => bin = Some(chunk),
            _ => {}
        }
        at = begin + size as usize;
    }
    let json = json.ok_or_else(|| cut("GLB", "has no JSON chunk".into()))?;
    Ok(Container { json, bin, trailing: bytes.len() - body.len() })
}
