//! The lines of an OBJ: numbers, faces with the state they stand in (group, material, smoothing).

use crate::error::ReadError;
use crate::read::text::{float, show};

/// No texture coordinate, no normal.
pub(super) const NONE: u32 = u32::MAX;

/// A corner of a face: indices of position, texture coordinate and normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    pub v: u32,
    pub vt: u32,
    pub vn: u32,
}

/// A face: its corners and the state it stands in.
#[derive(Clone, Copy)]
pub(super) struct Face {
    pub first: usize,
    pub count: usize,
    pub group: u32,
    pub material: u32,
    /// Smoothing group; 0 = off.
    pub smoothing: u32,
}

/// A file, taken apart.
#[derive(Default)]
pub(super) struct Obj {
    pub positions: Vec<[f32; 3]>,
    /// One for each position, or none at all.
    pub colors: Vec<[f32; 3]>,
    pub uvs: Vec<[f32; 2]>,
    pub normals: Vec<[f32; 3]>,
    pub corners: Vec<Corner>,
    pub faces: Vec<Face>,
    pub groups: Vec<String>,
    /// Names by `usemtl`; the first one stands for none.
    pub materials: Vec<String>,
    pub libraries: Vec<String>,
    /// Points, lines, and faces of less than three corners.
    pub not_drawn: usize,
    /// Curves and free-form surfaces.
    pub curved: usize,
}

/// The largest index of each kind, with its line.
type Largest = [(u32, usize); 3];

/// Takes a file apart; every index is in range.
pub(super) fn parse(text: &[u8]) -> Result<Obj, ReadError> {
    let mut obj = Obj { groups: vec![String::new()], materials: vec![String::new()], ..Obj::default() };
    let mut state = Face { first: 0, count: 0, group: 0, material: 0, smoothing: 0 };
    let mut largest: Largest = [(0, 0); 3];
    let mut joined = Vec::new();
    for (number, line) in text.split(|b| *b == b'\n').enumerate() {
        let line = line.trim_ascii();
        if let Some(begin) = line.strip_suffix(b"\\") {
            joined.extend_from_slice(begin);
            joined.push(b' ');
            continue;
        }
        let fail = |what: String| ReadError::new(format!("line {}", number + 1), what);
        if joined.is_empty() {
            obj.line(line, number, &mut state, &mut largest).map_err(fail)?;
        } else {
            joined.extend_from_slice(line);
            obj.line(&joined, number, &mut state, &mut largest).map_err(fail)?;
            joined.clear();
        }
    }
    obj.check(&largest)?;
    Ok(obj)
}

impl Obj {
    fn line(
        &mut self,
        line: &[u8],
        number: usize,
        state: &mut Face,
        largest: &mut Largest,
    ) -> Result<(), String> {
        let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
        let (word, rest) = (&line[..end], line[end..].trim_ascii());
        let name = || String::from_utf8_lossy(rest).into_owned();
        match word {
            b"v" => self.position(rest)?,
            b"vt" => {
                let (uv, n) = floats::<2>(rest)?;
                at_least(n, 1, rest)?;
                self.uvs.push(uv);
            }
            b"vn" => {
                let (normal, n) = floats::<3>(rest)?;
                at_least(n, 3, rest)?;
                self.normals.push(normal);
            }
            b"f" | b"fo" => self.face(rest, number, state, largest)?,
            b"p" | b"l" => self.not_drawn += 1,
            b"curv" | b"curv2" | b"surf" => self.curved += 1,
            b"o" | b"g" => state.group = index_of(&mut self.groups, name()),
            b"usemtl" => state.material = index_of(&mut self.materials, name()),
            b"mtllib" => self.libraries.push(name()),
            b"s" => state.smoothing = if rest == b"off" { 0 } else { name().parse().unwrap_or(1) },
            _ => {}
        }
        Ok(())
    }

    /// x y z, then w, or red green blue, or w and those.
    fn position(&mut self, rest: &[u8]) -> Result<(), String> {
        let ([x, y, z, a, b, c, d], n) = floats::<7>(rest)?;
        at_least(n, 3, rest)?;
        self.positions.push([x, y, z]);
        let color = match n {
            6 => Some([a, b, c]),
            7 => Some([b, c, d]),
            _ => None,
        };
        if let Some(color) = color {
            // Positions before the first coloured one are white.
            self.colors.resize(self.positions.len() - 1, [1.0; 3]);
            self.colors.push(color);
        }
        Ok(())
    }

    fn face(
        &mut self,
        rest: &[u8],
        number: usize,
        state: &Face,
        largest: &mut Largest,
    ) -> Result<(), String> {
        let first = self.corners.len();
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        for token in rest.split(u8::is_ascii_whitespace).filter(|t| !t.is_empty()) {
            if token[0] == b'#' {
                break;
            }
            let mut indices = [NONE; 3];
            for (i, part) in token.split(|b| *b == b'/').enumerate() {
                if part.is_empty() && i > 0 {
                    continue;
                }
                let slot = indices.get_mut(i).ok_or_else(|| format!("{} has too many parts", show(token)))?;
                *slot = index(part, counts[i]).ok_or_else(|| wrong_index(part, counts[i]))?;
                if *slot >= largest[i].0 {
                    largest[i] = (*slot, number);
                }
            }
            let [v, vt, vn] = indices;
            self.corners.push(Corner { v, vt, vn });
        }
        let count = self.corners.len() - first;
        if count < 3 {
            self.corners.truncate(first);
            self.not_drawn += 1;
        } else {
            self.faces.push(Face { first, count, ..*state });
        }
        Ok(())
    }

    /// Indices may point forward, so they are held against the counts of the whole file.
    fn check(&mut self, largest: &Largest) -> Result<(), ReadError> {
        let counts = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let names = ["vertices", "texture coordinates", "normals"];
        for i in 0..3 {
            let (index, line) = largest[i];
            // The line is 0 where there was none at all, or where the first line names the first element.
            let named = line > 0 || index > 0;
            if named && index as usize >= counts[i] {
                let what =
                    format!("a face has the index {} of {} {}", u64::from(index) + 1, counts[i], names[i]);
                return Err(ReadError::new(format!("line {}", line + 1), what));
            }
        }
        if !self.faces.is_empty() && self.positions.is_empty() {
            return Err(ReadError::new("", "there are faces and no vertices"));
        }
        if !self.colors.is_empty() {
            self.colors.resize(self.positions.len(), [1.0; 3]);
        }
        Ok(())
    }
}

fn wrong_index(part: &[u8], count: usize) -> String {
    match part {
        b"0" => "a face has the index 0; indices start at 1 (or count back from −1)".into(),
        _ => format!("a face has the index {}, which is none of {count}", show(part)),
    }
}

/// From 1 upwards, or back from the last one so far.
fn index(token: &[u8], count: usize) -> Option<u32> {
    let (digits, back) = token.strip_prefix(b"-").map_or((token, false), |d| (d, true));
    if digits.is_empty() || digits.len() > 10 || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let n = digits.iter().fold(0u64, |n, d| 10 * n + u64::from(d - b'0'));
    let i = if back { (count as u64).checked_sub(n).filter(|_| n > 0)? } else { n.checked_sub(1)? };
    u32::try_from(i).ok().filter(|i| *i != NONE)
}

/// Up to N numbers, zeros behind them, and how many there were.
fn floats<const N: usize>(rest: &[u8]) -> Result<([f32; N], usize), String> {
    let (mut numbers, mut n) = ([0.0; N], 0);
    for token in rest.split(u8::is_ascii_whitespace).filter(|t| !t.is_empty()) {
        if n == N || token[0] == b'#' {
            break;
        }
        numbers[n] = float(token).ok_or_else(|| format!("{} is not a number", show(token)))?;
        n += 1;
    }
    Ok((numbers, n))
}

fn at_least(n: usize, least: usize, rest: &[u8]) -> Result<(), String> {
    if n >= least { Ok(()) } else { Err(format!("{} has {n} numbers of {least}", show(rest))) }
}

/// The place of a name in a list, at the end if it is new. Names come in runs, so the last one is tried first.
fn index_of(list: &mut Vec<String>, name: String) -> u32 {
    if list.last() != Some(&name) {
        list.push(name);
    }
    list.len() as u32 - 1
}
