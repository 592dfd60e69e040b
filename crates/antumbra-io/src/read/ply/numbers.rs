//! Where the numbers of a PLY come from: bytes of either order, or words.

use super::header::{Encoding, Kind};
use crate::read::text::{double, show};

/// Takes numbers one after the other.
pub(super) enum Numbers<'a> {
    /// What is left of the bytes, and whether the larger byte comes first.
    Bytes(&'a [u8], bool),
    /// What is left of the text.
    Words(&'a [u8]),
}

const ENDS: &str = "the data end early";

impl<'a> Numbers<'a> {
    pub(super) fn new(bytes: &'a [u8], encoding: Encoding) -> Numbers<'a> {
        match encoding {
            Encoding::Ascii => Numbers::Words(bytes),
            _ => Numbers::Bytes(bytes, encoding == Encoding::Big),
        }
    }

    /// The next `n` bytes of binary data.
    pub(super) fn bytes(&mut self, n: usize) -> Result<&'a [u8], String> {
        match self {
            Numbers::Bytes(rest, _) if rest.len() >= n => {
                let (taken, after) = rest.split_at(n);
                *rest = after;
                Ok(taken)
            }
            _ => Err(ENDS.into()),
        }
    }

    fn word(&mut self) -> Result<&'a [u8], String> {
        let Numbers::Words(text) = self else { return Err(ENDS.into()) };
        let text: &'a [u8] = text.trim_ascii_start();
        let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
        if end == 0 {
            return Err(ENDS.into());
        }
        let (word, after) = text.split_at(end);
        *self = Numbers::Words(after);
        Ok(word)
    }

    /// A number as f64, exact for all types.
    pub(super) fn float(&mut self, kind: Kind) -> Result<f64, String> {
        if let Numbers::Bytes(_, big) = *self {
            return Ok(value(self.bytes(kind.size())?, kind, big));
        }
        let word = self.word()?;
        double(word).ok_or_else(|| format!("{} is not a number", show(word)))
    }

    /// An integer; those below 0 and fractions have no meaning where this is asked.
    pub(super) fn integer(&mut self, kind: Kind) -> Result<u32, String> {
        let number = self.float(kind)?;
        if number >= 0.0 && number <= f64::from(u32::MAX) && number.trunc() == number {
            Ok(number as u32)
        } else {
            Err(format!("{number} stands where a count or an index belongs"))
        }
    }

    /// The bytes or characters that are left: no list can be longer.
    pub(super) fn left(&self) -> usize {
        match self {
            Numbers::Bytes(rest, _) | Numbers::Words(rest) => rest.len(),
        }
    }
}

/// The number that `bytes` spell.
#[inline]
pub(super) fn value(bytes: &[u8], kind: Kind, big: bool) -> f64 {
    let mut word = [0u8; 8];
    let n = kind.size().min(bytes.len());
    word[..n].copy_from_slice(&bytes[..n]);
    if big {
        word[..n].reverse();
    }
    let [a, b, c, d, ..] = word;
    match kind {
        Kind::I8 => f64::from(a as i8),
        Kind::U8 => f64::from(a),
        Kind::I16 => f64::from(i16::from_le_bytes([a, b])),
        Kind::U16 => f64::from(u16::from_le_bytes([a, b])),
        Kind::I32 => f64::from(i32::from_le_bytes([a, b, c, d])),
        Kind::U32 => f64::from(u32::from_le_bytes([a, b, c, d])),
        Kind::F32 => f64::from(f32::from_le_bytes([a, b, c, d])),
        Kind::F64 => f64::from_le_bytes(word),
    }
}
