//! What a uri of a scene file means: data inside it, or the path of a file beside.

use super::Context;

/// The bytes that a uri names, or what is wrong with it.
pub(super) fn fetch(uri: &str, context: &Context) -> Result<Vec<u8>, String> {
    let Some(data) = uri.strip_prefix("data:") else {
        let bytes = context.files.open(&decode(uri)?).map_err(|e| e.to_string())?;
        context.grant(bytes.len() as u64);
        return Ok(bytes);
    };
    let (kind, text) = data.split_once(',').ok_or("its data uri has no comma")?;
    if !kind.ends_with(";base64") {
        return Err("its data uri is not base64".into());
    }
    base64(text.as_bytes()).ok_or_else(|| "its base64 text is broken".into())
}

/// Percent-decoding.
fn decode(uri: &str) -> Result<String, String> {
    let mut out = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let hex = |b: u8| (b as char).to_digit(16);
        rest = after;
        if let (b'%', [a, b, tail @ ..]) = (first, after)
            && let (Some(high), Some(low)) = (hex(*a), hex(*b))
        {
            out.push((high * 16 + low) as u8);
            rest = tail;
        } else {
            out.push(first);
        }
    }
    String::from_utf8(out).map_err(|_| "its uri is not UTF-8".into())
}

/// Standard base64, with or without padding; `None` if it is broken.
fn base64(text: &[u8]) -> Option<Vec<u8>> {
    let text = text.strip_suffix(b"==").or_else(|| text.strip_suffix(b"=")).unwrap_or(text);
    let mut out = Vec::with_capacity(text.len() / 4 * 3 + 3);
    for group in text.chunks(4) {
        let mut word = 0u32;
        for &c in group {
            let digit = match c {
                b'A'..=b'Z' => c - b'A',
                b'a'..=b'z' => c - b'a' + 26,
                b'0'..=b'9' => c - b'0' + 52,
                b'+' => 62,
                b'/' => 63,
                _ => return None,
            };
            word = word << 6 | u32::from(digit);
        }
        let [_, a, b, c] = (word << (6 * (4 - group.len()))).to_be_bytes();
        match group.len() {
            4 => out.extend([a, b, c]),
            3 => out.extend([a, b]),
            2 => out.push(a),
            _ => return None,
        }
    }
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_all_lengths() {
        // RFC 4648, section 10.
        for (text, bytes) in [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg", "foob"),
            ("Zm9vYmE=", "fooba"),
        ] {
            assert_eq!(base64(text.as_bytes()).as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        assert_eq!((base64(b"Zm9v!"), base64(b"Z"), base64(b"Z=m9")), (None, None, None));
    }

    #[test]
    fn percent_signs() {
        assert_eq!(decode("cesium%20logo.png").as_deref(), Ok("cesium logo.png"));
        assert_eq!(decode("100%.png").as_deref(), Ok("100%.png"));
        assert_eq!(decode("%e5%90%8d").as_deref(), Ok("名"));
        assert!(decode("%ff").is_err());
    }
}
