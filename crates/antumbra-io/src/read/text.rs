//! Text files: byte-order marks, lines, tokens, numbers.

use std::borrow::Cow;

/// The bytes of a text as UTF-8 without a byte-order mark; UTF-16 with a mark is converted.
pub(super) fn plain(bytes: &[u8]) -> Cow<'_, [u8]> {
    let wide = |swap: fn([u8; 2]) -> u16| {
        let units = bytes[2..].chunks_exact(2).map(|c| swap([c[0], c[1]]));
        let text: String =
            char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
        Cow::Owned(text.into_bytes())
    };
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(rest),
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        _ => Cow::Borrowed(bytes),
    }
}

/// A token for a message: short, and readable whatever it holds.
pub(super) fn show(token: &[u8]) -> String {
    let text: String = String::from_utf8_lossy(token).chars().take(40).collect();
    format!("\"{}\"", text.escape_debug())
}

/// A number of any notation, `nan` and `inf` among them.
pub(super) fn float(token: &[u8]) -> Option<f32> {
    match decimal(token) {
        // Rounded twice it is rounded right, unless it lies halfway between two f32 after the first time.
        Some(x) if x.to_bits() & 0x1fff_ffff != 0x1000_0000 => Some(x as f32),
        _ => std::str::from_utf8(token).ok()?.parse().ok(),
    }
}

/// The same in f64.
pub(super) fn double(token: &[u8]) -> Option<f64> {
    decimal(token).or_else(|| std::str::from_utf8(token).ok()?.parse().ok())
}

/// Powers of ten, exact.
const TENS: [f64; 17] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16];

/// A sign, digits and a point, as most numbers are written, quickly: a quotient of two exact numbers is rounded right.
fn decimal(token: &[u8]) -> Option<f64> {
    let (digits, negative) = match token {
        [b'-', rest @ ..] => (rest, true),
        rest => (rest, false),
    };
    let (mut whole, mut point) = (0u64, None);
    if digits.is_empty() || digits.len() > TENS.len() {
        return None;
    }
    for (i, c) in digits.iter().enumerate() {
        match c {
            b'0'..=b'9' => whole = 10 * whole + u64::from(c - b'0'),
            b'.' if point.is_none() && digits.len() > 1 => point = Some(i + 1),
            _ => return None,
        }
    }
    let behind = point.map_or(0, |after| digits.len() - after);
    let x = whole as f64 / TENS[behind];
    (whole <= 1 << 53).then_some(if negative { -x } else { x })
}

/// The words of a text, between blanks and line ends.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_math::hash::hash2;

    /// To the last bit what the standard library reads, of digits of any length with and without a point.
    #[test]
    fn numbers_are_read_right() {
        for i in 0..200_000u32 {
            let digits = u64::from(hash2(i, 1)) << 32 | u64::from(hash2(i, 2));
            let mut text = (digits >> (hash2(i, 3) % 64)).to_string();
            text.insert(hash2(i, 4) as usize % (text.len() + 1), '.');
            let cut = if i % 3 == 0 { text.replace('.', "") } else { text };
            let token = if i % 2 == 0 { format!("-{cut}") } else { cut };
            let (wide, narrow) = (token.parse::<f64>().ok(), token.parse::<f32>().ok());
            assert_eq!(double(token.as_bytes()).map(f64::to_bits), wide.map(f64::to_bits), "{token}");
            assert_eq!(float(token.as_bytes()).map(f32::to_bits), narrow.map(f32::to_bits), "{token}");
        }
        // Halfway between two f32, and a digit beyond it.
        for token in ["16777217", "16777217.00000001", "-0", "1.", ".5", "1e5", "inf", "+3"] {
            assert_eq!(float(token.as_bytes()), token.parse().ok(), "{token}");
        }
        assert!(["", "-", ".", "1.2.3", "1x", "--1"].iter().all(|t| float(t.as_bytes()).is_none()));
    }
}
