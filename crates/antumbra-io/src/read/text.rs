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
    std::str::from_utf8(token).ok()?.parse().ok()
}

/// The words of a text, between blanks and line ends.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty())
}
