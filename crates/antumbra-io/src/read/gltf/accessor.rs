//! Accessors: typed views of buffers, plain, interleaved, sparse, normalised (glTF 2.0, section 5.1).
//!
//! Everything is checked once for a whole accessor; the conversions then run over slices without a test per element.

use std::any::TypeId;
use std::borrow::Cow;

use bytemuck::Pod;

use super::buffers::Buffers;
use super::document::{Accessor, Document, Sparse};
use crate::error::ReadError;
use crate::read::Context;

// Buffers are little endian and are copied as they are.
#[cfg(target_endian = "big")]
compile_error!("the readers copy little-endian numbers; a big-endian machine needs conversions here");

/// The accessors of a document over its buffers.
pub(super) struct Accessors<'a> {
    pub doc: &'a Document,
    pub buffers: &'a Buffers<'a>,
    pub context: &'a Context<'a>,
}

/// Which elements are wanted: all, or those of these indices, each below the number of elements.
pub(super) type Pick<'a> = Option<&'a [u32]>;

/// The elements of one accessor, all within `bytes`.
struct Elements<'a> {
    bytes: Cow<'a, [u8]>,
    stride: usize,
    count: usize,
    /// Bytes of one element.
    size: usize,
    component: u32,
    normalized: bool,
}

const I8: u32 = 5120;
const U8: u32 = 5121;
const I16: u32 = 5122;
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;

/// Bytes of a component type.
fn component_size(component: u32) -> Option<usize> {
    match component {
        I8 | U8 => Some(1),
        I16 | U16 => Some(2),
        U32 | F32 => Some(4),
        _ => None,
    }
}

/// Components of an element type.
fn lanes(kind: &str) -> Option<usize> {
    match kind {
        "SCALAR" => Some(1),
        "VEC2" => Some(2),
        "VEC3" => Some(3),
        "VEC4" | "MAT2" => Some(4),
        "MAT3" => Some(9),
        "MAT4" => Some(16),
        _ => None,
    }
}

/// Bytes of one element.
pub(super) fn element_size(a: &Accessor) -> Option<usize> {
    Some(component_size(a.component_type)? * lanes(&a.kind)?)
}

impl<'a> Accessors<'a> {
    fn accessor(&self, index: usize) -> Result<&'a Accessor, ReadError> {
        let n = self.doc.accessors.len();
        let missing = || ReadError::new("", format!("accessor {index} is named; there are {n}"));
        self.doc.accessors.get(index).ok_or_else(missing)
    }

    /// Number of elements.
    pub(super) fn count(&self, index: usize) -> Result<u64, ReadError> {
        Ok(self.accessor(index)?.count)
    }

    /// Components of its elements.
    pub(super) fn lanes(&self, index: usize) -> Result<usize, ReadError> {
        let accessor = self.accessor(index)?;
        lanes(&accessor.kind).ok_or_else(|| {
            ReadError::new(place(index), format!("has the unknown type \"{}\"", accessor.kind))
        })
    }

    /// Elements of N floats; integers are converted, to [−1, 1] or [0, 1] where they are normalised.
    pub(super) fn floats<const N: usize>(&self, index: usize, pick: Pick) -> Result<Vec<[f32; N]>, ReadError>
    where
        [f32; N]: Pod,
        [u32; N]: Pod,
        [i16; N]: Pod,
        [u16; N]: Pod,
        [i8; N]: Pod,
        [u8; N]: Pod,
    {
        let e = self.elements(index, N, pick)?;
        Ok(match (e.component, e.normalized) {
            (F32, _) => e.collect(pick, |v: [f32; N]| v),
            // Section 3.6.2.2: c / 255, c / 127 not below −1, and so on.
            (U8, true) => e.collect(pick, |v: [u8; N]| v.map(|c| f32::from(c) / 255.0)),
            (U16, true) => e.collect(pick, |v: [u16; N]| v.map(|c| f32::from(c) / 65535.0)),
            (I8, true) => e.collect(pick, |v: [i8; N]| v.map(|c| (f32::from(c) / 127.0).max(-1.0))),
            (I16, true) => e.collect(pick, |v: [i16; N]| v.map(|c| (f32::from(c) / 32767.0).max(-1.0))),
            (U8, false) => e.collect(pick, |v: [u8; N]| v.map(f32::from)),
            (U16, false) => e.collect(pick, |v: [u16; N]| v.map(f32::from)),
            (I8, false) => e.collect(pick, |v: [i8; N]| v.map(f32::from)),
            (I16, false) => e.collect(pick, |v: [i16; N]| v.map(f32::from)),
            _ => e.collect(pick, |v: [u32; N]| v.map(|c| c as f32)),
        })
    }

    /// Elements of N unsigned integers.
    pub(super) fn integers<const N: usize>(
        &self,
        index: usize,
        pick: Pick,
    ) -> Result<Vec<[u32; N]>, ReadError>
    where
        [u32; N]: Pod,
        [u16; N]: Pod,
        [u8; N]: Pod,
    {
        let e = self.elements(index, N, pick)?;
        match e.component {
            U32 => Ok(e.collect(pick, |v: [u32; N]| v)),
            U16 => Ok(e.collect(pick, |v: [u16; N]| v.map(u32::from))),
            U8 => Ok(e.collect(pick, |v: [u8; N]| v.map(u32::from))),
            other => {
                let what = format!("has component type {other}; indices are 5121, 5123 or 5125");
                Err(ReadError::new(place(index), what))
            }
        }
    }

    /// The checked elements, sparse values applied.
    fn elements(&self, index: usize, wanted: usize, pick: Pick) -> Result<Elements<'a>, ReadError> {
        let a = self.accessor(index)?;
        let fail = |what: String| ReadError::new(place(index), what);
        let component = component_size(a.component_type)
            .ok_or_else(|| fail(format!("has the unknown component type {}", a.component_type)))?;
        let lanes = self.lanes(index)?;
        if lanes != wanted {
            return Err(fail(format!("has type {}; {wanted} numbers an element are needed", a.kind)));
        }
        let size = component * lanes;
        let too_much = |what: String| fail(what).hint("The file is cut short, or its exporter is wrong.");
        let given = self.buffers.accessors.get(&index);
        let (bytes, stride) = match (given, a.buffer_view) {
            // Its length was held against the count when it was unpacked.
            (Some(bytes), _) => (bytes.as_slice(), size),
            (None, Some(view)) => self.slice(view, a.byte_offset, a.count, size).map_err(too_much)?,
            (None, None) => (&[] as &[u8], size),
        };
        // What is converted is charged, for many accessors may name the same bytes; so is what has to be made first.
        let is_there = given.is_some() || a.buffer_view.is_some();
        let made = !is_there || a.sparse.is_some();
        let converted = pick.map_or(a.count, |p| p.len() as u64);
        self.context.take(if made { a.count } else { 0 }, size as u64).map_err(too_much)?;
        self.context.take(converted, 4 * lanes as u64).map_err(too_much)?;
        let count = a.count as usize;
        let bytes = if is_there { Cow::Borrowed(bytes) } else { Cow::Owned(vec![0; count * size]) };
        let (component, normalized) = (a.component_type, a.normalized);
        let elements = Elements { bytes, stride, count, size, component, normalized };
        match &a.sparse {
            None => Ok(elements),
            Some(sparse) => self.replace(elements, sparse).map_err(too_much),
        }
    }

    /// The bytes of `count` elements of `size` bytes in a view, with their stride.
    fn slice(&self, view: usize, offset: u64, count: u64, size: usize) -> Result<(&'a [u8], usize), String> {
        let n = self.doc.buffer_views.len();
        let v = self.doc.buffer_views.get(view).ok_or(format!("names buffer view {view}; there are {n}"))?;
        let bytes = self.view(view)?;
        let stride = v.byte_stride.unwrap_or(size as u64);
        if stride < size as u64 {
            return Err(format!("has elements of {size} bytes, but its view has a stride of {stride}"));
        }
        let end = match count {
            0 => Some(offset),
            n => (n - 1).checked_mul(stride).and_then(|s| s.checked_add(size as u64)?.checked_add(offset)),
        };
        match end {
            Some(end) if end <= bytes.len() as u64 => {
                Ok((&bytes[offset as usize..end as usize], stride as usize))
            }
            Some(end) => {
                let length = bytes.len();
                Err(format!(
                    "reads bytes {offset}…{} of a buffer view that has {length}",
                    end.saturating_sub(1)
                ))
            }
            None => Err(format!("has {count} elements at offset {offset}: beyond any file")),
        }
    }

    /// The bytes of a buffer view.
    pub(super) fn view(&self, view: usize) -> Result<&'a [u8], String> {
        self.buffers.view(self.doc, view)
    }

    /// The elements with the sparse ones put in their places.
    fn replace(&self, e: Elements<'a>, sparse: &Sparse) -> Result<Elements<'a>, String> {
        let index_size = component_size(sparse.indices.component_type)
            .ok_or_else(|| format!("has sparse indices of type {}", sparse.indices.component_type))?;
        let (at, from) = (&sparse.indices, &sparse.values);
        let (indices, _) = self.slice(at.buffer_view, at.byte_offset, sparse.count, index_size)?;
        let (values, _) = self.slice(from.buffer_view, from.byte_offset, sparse.count, e.size)?;
        let mut bytes = e.bytes.into_owned();
        for (index, value) in indices.chunks_exact(index_size).zip(values.chunks_exact(e.size)) {
            let index = index.iter().rev().fold(0usize, |i, b| i << 8 | usize::from(*b));
            if index >= e.count {
                return Err(format!("has the sparse index {index} of {} elements", e.count));
            }
            let begin = index * e.stride;
            bytes[begin..begin + e.size].copy_from_slice(value);
        }
        Ok(Elements { bytes: Cow::Owned(bytes), ..e })
    }
}

impl Elements<'_> {
    /// Each element through `convert`; one copy where nothing is converted and nothing lies between.
    fn collect<T: Pod, O: Pod>(&self, pick: Pick, convert: impl Fn(T) -> O) -> Vec<O> {
        debug_assert_eq!(size_of::<T>(), self.size);
        let at = |bytes: &[u8]| convert(bytemuck::pod_read_unaligned(&bytes[..self.size]));
        if let Some(pick) = pick {
            return pick.iter().map(|i| at(&self.bytes[*i as usize * self.stride..])).collect();
        }
        if TypeId::of::<T>() == TypeId::of::<O>() && self.stride == self.size {
            return bytemuck::pod_collect_to_vec(&self.bytes[..self.count * self.size]);
        }
        let mut out = Vec::with_capacity(self.count);
        out.extend(self.bytes.chunks(self.stride.max(1)).take(self.count).map(at));
        out
    }
}

fn place(index: usize) -> String {
    format!("accessor {index}")
}
