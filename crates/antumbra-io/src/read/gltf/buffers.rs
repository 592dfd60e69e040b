//! The bytes of the buffers: binary chunk, data URI, or a file beside.

use std::borrow::Cow;
use std::collections::HashMap;

use super::document::Document;
use crate::error::ReadError;
use crate::read::Context;
use crate::read::uri;

/// Bytes of each buffer; `None` for those that only meshopt compression names as its fallback and that are not there.
pub(super) type Buffers<'a> = Vec<Option<Cow<'a, [u8]>>>;

/// Loads what the document names.
pub(super) fn load<'a>(
    doc: &Document,
    bin: Option<&'a [u8]>,
    context: &Context,
) -> Result<Buffers<'a>, ReadError> {
    let mut buffers: Buffers<'a> = Vec::new();
    // A file that several buffers name is read once.
    let mut first_with: HashMap<&str, usize> = HashMap::new();
    for (i, buffer) in doc.buffers.iter().enumerate() {
        let place = || match &buffer.uri {
            Some(u) if !u.starts_with("data:") => format!("buffer {i} \"{u}\""),
            _ => format!("buffer {i}"),
        };
        let bytes: Cow<[u8]> = match &buffer.uri {
            Some(u) if first_with.contains_key(u.as_str()) => {
                let same = buffers[first_with[u.as_str()]].as_deref().unwrap_or_default();
                context.take(same.len() as u64, 1).map_err(|what| ReadError::new(place(), what))?;
                Cow::Owned(same.to_vec())
            }
            Some(u) => Cow::Owned(uri::fetch(u, context).map_err(|what| ReadError::new(place(), what))?),
            None if i == 0 && bin.is_some() => Cow::Borrowed(bin.unwrap_or_default()),
            None if is_fallback(&buffer.extensions) => {
                buffers.push(None);
                continue;
            }
            None => return Err(ReadError::new(place(), "has no uri, and there is no binary chunk for it")),
        };
        if (bytes.len() as u64) < buffer.byte_length {
            let what = format!("announces {} bytes, it has {}", buffer.byte_length, bytes.len());
            return Err(
                ReadError::new(place(), what).hint("The file is cut short, or its exporter is wrong.")
            );
        }
        if let Some(u) = &buffer.uri {
            first_with.entry(u).or_insert(buffers.len());
        }
        buffers.push(Some(bytes));
    }
    Ok(buffers)
}

/// A placeholder of EXT_meshopt_compression (or its KHR twin).
fn is_fallback(extensions: &super::document::Extensions) -> bool {
    super::extensions::MESHOPT
        .iter()
        .filter_map(|name| extensions.get(*name))
        .any(|e| e.get("fallback").and_then(|f| f.as_bool()) == Some(true))
}
