//! The bytes of the buffers: binary chunk, data URI, or a file beside.

use std::borrow::Cow;
use std::collections::HashMap;

use super::document::Document;
use super::draco;
use super::meshopt;
use crate::error::ReadError;
use crate::read::Context;
use crate::read::uri;

/// The bytes of a document.
pub(super) struct Buffers<'a> {
    /// Of each buffer; `None` for those that hold nothing, because all their views are packed.
    pub files: Vec<Option<Cow<'a, [u8]>>>,
    /// Of the buffer views that were packed.
    pub unpacked: HashMap<usize, Vec<u8>>,
    /// Of the accessors of primitives that were packed.
    pub accessors: HashMap<usize, Vec<u8>>,
}

impl Buffers<'_> {
    /// The bytes of a buffer view.
    pub(super) fn view(&self, doc: &Document, view: usize) -> Result<&[u8], String> {
        let n = doc.buffer_views.len();
        let v = doc.buffer_views.get(view).ok_or(format!("names buffer view {view}; there are {n}"))?;
        if let Some(bytes) = self.unpacked.get(&view) {
            return Ok(bytes);
        }
        let n = self.files.len();
        let buffer = self
            .files
            .get(v.buffer)
            .ok_or_else(|| format!("buffer view {view} names buffer {}; there are {n}", v.buffer))?;
        let Some(buffer) = buffer else {
            return Err(format!(
                "buffer view {view} is not packed, and its buffer {} holds nothing",
                v.buffer
            ));
        };
        let end = v.byte_offset.checked_add(v.byte_length).filter(|end| *end <= buffer.len() as u64);
        end.map(|end| &buffer[v.byte_offset as usize..end as usize]).ok_or_else(|| {
            let (offset, length) = (v.byte_offset, v.byte_length);
            let has = buffer.len();
            format!("buffer view {view} has {length} bytes at offset {offset} of a buffer that has {has}")
        })
    }
}

/// Loads what the document names, and unpacks what is packed.
pub(super) fn load<'a>(
    doc: &Document,
    bin: Option<&'a [u8]>,
    context: &Context,
) -> Result<Buffers<'a>, ReadError> {
    let files = files(doc, bin, context)?;
    let mut unpacked = HashMap::new();
    for view in 0..doc.buffer_views.len() {
        let buffer = |i: usize| files.get(i)?.as_deref();
        if let Some(bytes) = meshopt::unpack(doc, view, buffer, context)? {
            unpacked.insert(view, bytes);
        }
    }
    let mut buffers = Buffers { files, unpacked, accessors: HashMap::new() };
    buffers.accessors = draco::unpack(doc, |view| buffers.view(doc, view), context)?;
    Ok(buffers)
}

fn files<'a>(
    doc: &Document,
    bin: Option<&'a [u8]>,
    context: &Context,
) -> Result<Vec<Option<Cow<'a, [u8]>>>, ReadError> {
    let mut buffers: Vec<Option<Cow<'a, [u8]>>> = Vec::new();
    // A file that several buffers name is read once.
    let mut first_with: HashMap<&str, usize> = HashMap::new();
    for (i, buffer) in doc.buffers.iter().enumerate() {
        let place = || match &buffer.uri {
            Some(u) if !u.starts_with("data:") => format!("buffer {i} \"{u}\""),
            _ => format!("buffer {i}"),
        };
        if meshopt::is_placeholder(&buffer.extensions) {
            buffers.push(None);
            continue;
        }
        let bytes: Cow<[u8]> = match &buffer.uri {
            Some(u) if first_with.contains_key(u.as_str()) => {
                let same = buffers[first_with[u.as_str()]].as_deref().unwrap_or_default();
                context.take(same.len() as u64, 1).map_err(|what| ReadError::new(place(), what))?;
                Cow::Owned(same.to_vec())
            }
            Some(u) => Cow::Owned(uri::fetch(u, context).map_err(|what| ReadError::new(place(), what))?),
            None if i == 0 && bin.is_some() => Cow::Borrowed(bin.unwrap_or_default()),
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
