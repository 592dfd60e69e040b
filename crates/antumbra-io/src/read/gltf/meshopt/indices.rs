//! Modes TRIANGLES and INDICES (EXT_meshopt_compression, appendices A and B).

use super::{broken, take};

/// The last 16 of something.
struct Fifo<T> {
    items: [T; 16],
    next: usize,
}

impl<T: Copy> Fifo<T> {
    fn new(empty: T) -> Fifo<T> {
        Fifo { items: [empty; 16], next: 0 }
    }

    fn push(&mut self, item: T) {
        self.items[self.next] = item;
        self.next = (self.next + 1) & 15;
    }

    /// The one that came `back` pushes before the next one.
    fn back(&self, back: usize) -> T {
        self.items[self.next.wrapping_sub(back) & 15]
    }
}

/// What triangles refer to.
struct Past {
    edges: Fifo<[u32; 2]>,
    vertices: Fifo<u32>,
    /// The next vertex that no triangle had before.
    fresh: u32,
    /// The last one that was written out.
    last: u32,
}

impl Past {
    fn take_fresh(&mut self) -> u32 {
        let index = self.fresh;
        self.fresh = self.fresh.wrapping_add(1);
        index
    }

    fn written(&mut self, data: &mut &[u8]) -> Result<u32, String> {
        let v = variable(data)?;
        self.last = self.last.wrapping_add(v >> 1 ^ (v & 1).wrapping_neg());
        Ok(self.last)
    }

    /// A corner: a fresh one, or that of `back` pushes ago.
    fn corner(&mut self, back: usize) -> u32 {
        if back == 0 { self.take_fresh() } else { self.vertices.back(back) }
    }

    /// A triangle of three new edges.
    fn lone(&mut self, data: &mut &[u8], code: u8, table: &[u8]) -> Result<[u32; 3], String> {
        if code < 0xfe {
            let aux = table[usize::from(code & 15)];
            let (b_back, c_back) = (usize::from(aux >> 4), usize::from(aux & 15));
            let a = self.take_fresh();
            let b = self.corner(b_back);
            let c = self.corner(c_back);
            self.keep(a, [(b, b_back == 0), (c, c_back == 0)]);
            return Ok([a, b, c]);
        }
        let aux = take(data, 1)?[0];
        let (b_back, c_back) = (usize::from(aux >> 4), usize::from(aux & 15));
        // This code starts again at vertex 0.
        if aux == 0 {
            self.fresh = 0;
        }
        let mut a = if code == 0xfe { self.take_fresh() } else { 0 };
        let mut b = self.corner(b_back);
        let mut c = self.corner(c_back);
        for (corner, is_written) in [(&mut a, code == 0xff), (&mut b, b_back == 15), (&mut c, c_back == 15)] {
            if is_written {
                *corner = self.written(data)?;
            }
        }
        self.keep(a, [(b, matches!(b_back, 0 | 15)), (c, matches!(c_back, 0 | 15))]);
        Ok([a, b, c])
    }

    fn keep(&mut self, a: u32, others: [(u32, bool); 2]) {
        self.vertices.push(a);
        for (vertex, is_new) in others {
            if is_new {
                self.vertices.push(vertex);
            }
        }
    }
}

/// A number in steps of seven bits, the lowest first.
fn variable(data: &mut &[u8]) -> Result<u32, String> {
    let mut value = 0;
    for shift in [0, 7, 14, 21, 28] {
        let byte = take(data, 1)?[0];
        value |= u32::from(byte & 127) << shift;
        if byte < 128 {
            break;
        }
    }
    Ok(value)
}

/// `count` indices of whole triangles.
pub(super) fn triangles(data: &[u8], count: usize) -> Result<Vec<u32>, String> {
    let mut rest = data;
    let version = head(&mut rest, 0xe0)?;
    // Up to here a vertex of the past is meant, above one that is written.
    let near = if version == 0 { 15 } else { 13 };
    let mut codes = take(&mut rest, count / 3)?;
    let body_size = rest.len().checked_sub(16).ok_or_else(broken)?;
    let (mut body, table) = rest.split_at(body_size);
    let mut past = Past { edges: Fifo::new([0; 2]), vertices: Fifo::new(0), fresh: 0, last: 0 };
    let mut out = Vec::with_capacity(count);
    while let Ok([code]) = take(&mut codes, 1) {
        let [a, b, c] = if *code < 0xf0 {
            let [a, b] = past.edges.back(usize::from(code >> 4) + 1);
            let c_back = usize::from(code & 15);
            let c = match c_back {
                0 => past.take_fresh(),
                n if n < near => past.vertices.back(n + 1),
                15 => past.written(&mut body)?,
                // 13 and 14: one before and one after the last that was written.
                n => {
                    past.last = past.last.wrapping_add(if n == 13 { u32::MAX } else { 1 });
                    past.last
                }
            };
            if c_back == 0 || c_back >= near {
                past.vertices.push(c);
            }
            past.edges.push([c, b]);
            past.edges.push([a, c]);
            [a, b, c]
        } else {
            let [a, b, c] = past.lone(&mut body, *code, table)?;
            [[b, a], [c, b], [a, c]].into_iter().for_each(|edge| past.edges.push(edge));
            [a, b, c]
        };
        out.extend([a, b, c]);
    }
    if body.is_empty() { Ok(out) } else { Err(broken()) }
}

/// `count` indices in any order.
pub(super) fn sequence(data: &[u8], count: usize) -> Result<Vec<u32>, String> {
    let mut rest = data;
    head(&mut rest, 0xd0)?;
    let body_size = rest.len().checked_sub(4).ok_or_else(broken)?;
    let mut body = &rest[..body_size];
    let mut last = [0u32; 2];
    let mut out = Vec::with_capacity(count);
    for _ in 0..count {
        let v = variable(&mut body)?;
        let (line, v) = ((v & 1) as usize, v >> 1);
        last[line] = last[line].wrapping_add(v >> 1 ^ (v & 1).wrapping_neg());
        out.push(last[line]);
    }
    if body.is_empty() { Ok(out) } else { Err(broken()) }
}

/// The version of the data, 0 or 1, behind the mark of their kind.
fn head(data: &mut &[u8], mark: u8) -> Result<u8, String> {
    let head = take(data, 1)?[0];
    if head & 0xf0 == mark && head & 15 <= 1 {
        return Ok(head & 15);
    }
    Err(format!("its packed data begin with {head:#04x}; {mark:#04x} and {:#04x} are read", mark + 1))
}

/// Indices as numbers of two or four bytes.
pub(super) fn bytes(indices: &[u32], stride: usize) -> Result<Vec<u8>, String> {
    if stride == 4 {
        return Ok(indices.iter().flat_map(|i| i.to_le_bytes()).collect());
    }
    let narrow = |i: &u32| u16::try_from(*i).map(u16::to_le_bytes);
    let pairs: Result<Vec<_>, _> = indices.iter().map(narrow).collect();
    Ok(pairs.map_err(|_| broken())?.into_flattened())
}
