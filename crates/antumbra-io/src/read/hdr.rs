//! Radiance pictures (`.hdr`, `.pic`): RGBE with its two run-length codings (Radiance, `ray/src/common/color.c`).

use crate::error::ReadError;
use crate::limits::Limits;

/// A picture of linear radiance, row by row from the top.
pub(crate) struct Radiance {
    pub width: u32,
    pub height: u32,
    pub pixels: Vec<[f32; 3]>,
}

/// What the header says.
struct Header {
    width: usize,
    height: usize,
    /// Rows run upwards.
    upwards: bool,
    /// Columns run to the left.
    leftwards: bool,
    /// What the numbers were multiplied with.
    exposure: f32,
    /// Where the data begin.
    data: usize,
}

/// Decodes a picture.
pub(crate) fn decode(bytes: &[u8], limits: &Limits) -> Result<Radiance, ReadError> {
    let head = header(bytes, limits)?;
    let (w, h) = (head.width, head.height);
    let pixels = w as u64 * h as u64;
    // A run stands for at most 127 pixels and costs 8 bytes in four channels; the older coding is rare and small.
    let in_proportion = pixels <= 1 << 22 || pixels / 256 <= bytes.len() as u64;
    if pixels > limits.pixels || !in_proportion {
        let what = format!("announces {w} × {h} pixels in {} bytes", bytes.len());
        return Err(ReadError::new("header", what).hint("The file is cut short, or its writer is wrong."));
    }
    let mut rest = &bytes[head.data..];
    let mut rows: Vec<[f32; 3]> = Vec::new();
    let mut line = vec![[0u8; 4]; w];
    let scale = 1.0 / head.exposure;
    for y in 0..h {
        rest = scanline(rest, &mut line).ok_or_else(|| {
            let hint = "The file is cut short, or its writer is wrong.";
            ReadError::new(format!("row {y} of {h}"), "its data end early or are broken").hint(hint)
        })?;
        if head.leftwards {
            line.reverse();
        }
        rows.extend(line.iter().map(|p| radiance(*p, scale)));
    }
    if head.upwards {
        rows = rows.chunks_exact(w).rev().flatten().copied().collect();
    }
    Ok(Radiance { width: w as u32, height: h as u32, pixels: rows })
}

/// (mantissa + ½) · 2^(e − 136), and 0 for e = 0.
fn radiance([r, g, b, e]: [u8; 4], scale: f32) -> [f32; 3] {
    if e == 0 {
        return [0.0; 3];
    }
    let e = u32::from(e);
    // 2^(e − 136): the exponent field of an f32 is e − 9, and what lies below the normal numbers takes two exact steps.
    let power = match e {
        10.. => f32::from_bits((e - 9) << 23),
        _ => f32::from_bits(e << 23) * f32::from_bits((127 - 9) << 23),
    };
    [r, g, b].map(|m| (f32::from(m) + 0.5) * power * scale)
}

fn header(bytes: &[u8], limits: &Limits) -> Result<Header, ReadError> {
    let fail = |what: &str| ReadError::new("header", what);
    if !bytes.starts_with(b"#?") {
        return Err(fail("this is no Radiance picture: it does not begin with \"#?\""));
    }
    let (mut exposure, mut at) = (1.0f32, 0);
    let head = &bytes[..bytes.len().min(limits.header_bytes)];
    loop {
        let length = head[at..].iter().position(|b| *b == b'\n').ok_or_else(|| fail("it does not end"))?;
        let line = head[at..at + length].trim_ascii();
        at += length + 1;
        if line.is_empty() {
            break;
        }
        let text = String::from_utf8_lossy(line);
        if let Some(value) = text.strip_prefix("EXPOSURE=") {
            let value: f32 = value.trim().parse().unwrap_or(f32::NAN);
            exposure *= value;
        }
        if let Some(format) = text.strip_prefix("FORMAT=")
            && format.trim() != "32-bit_rle_rgbe"
        {
            return Err(fail(&format!("the format {} is not read; 32-bit_rle_rgbe is", format.trim())));
        }
    }
    if !(exposure > 0.0 && exposure.is_finite()) {
        return Err(fail("its EXPOSURE is not a number above 0"));
    }
    let length = head[at..].iter().position(|b| *b == b'\n').ok_or_else(|| fail("it names no size"))?;
    let size = String::from_utf8_lossy(&head[at..at + length]).into_owned();
    let words: Vec<_> = size.split_whitespace().collect();
    let [y @ ("-Y" | "+Y"), height, x @ ("+X" | "-X"), width] = words[..] else {
        return Err(fail(&format!("the size \"{}\" is not of the form \"-Y height +X width\"", size.trim())));
    };
    let number = |text: &str| text.parse::<u32>().ok().filter(|n| *n > 0).map(|n| n as usize);
    let (Some(width), Some(height)) = (number(width), number(height)) else {
        return Err(fail(&format!("the size \"{}\" is not usable", size.trim())));
    };
    Ok(Header { width, height, upwards: y == "+Y", leftwards: x == "-X", exposure, data: at + length + 1 })
}

/// One row; what follows it, or `None` if the data end early or run over the row.
fn scanline<'a>(bytes: &'a [u8], line: &mut [[u8; 4]]) -> Option<&'a [u8]> {
    let marked = bytes.len() >= 4 && bytes[0] == 2 && bytes[1] == 2 && bytes[2] < 128;
    let width = line.len();
    if (8..32768).contains(&width) && marked {
        if usize::from(bytes[2]) << 8 | usize::from(bytes[3]) != width {
            return None;
        }
        return runs_by_channel(&bytes[4..], line);
    }
    plain_or_repeated(bytes, line)
}

/// Each channel by itself: n > 128 repeats one byte n − 128 times, else n bytes follow.
fn runs_by_channel<'a>(mut bytes: &'a [u8], line: &mut [[u8; 4]]) -> Option<&'a [u8]> {
    for channel in 0..4 {
        let mut x = 0;
        while x < line.len() {
            let (&n, rest) = bytes.split_first()?;
            let (n, repeat) = if n > 128 { (usize::from(n - 128), true) } else { (usize::from(n), false) };
            let target = line.get_mut(x..x + n).filter(|t| !t.is_empty())?;
            let source = rest.get(..if repeat { 1 } else { n })?;
            for (i, pixel) in target.iter_mut().enumerate() {
                pixel[channel] = source[if repeat { 0 } else { i }];
            }
            bytes = &rest[source.len()..];
            x += n;
        }
    }
    Some(bytes)
}

/// Whole pixels; (1, 1, 1, n) repeats the last one n times, with n shifted by eight bits for each one in a row.
fn plain_or_repeated<'a>(mut bytes: &'a [u8], line: &mut [[u8; 4]]) -> Option<&'a [u8]> {
    let (mut x, mut shift) = (0, 0);
    while x < line.len() {
        let pixel: [u8; 4] = bytes.get(..4)?.try_into().ok()?;
        bytes = &bytes[4..];
        if pixel[..3] == [1, 1, 1] {
            let n = usize::from(pixel[3]).checked_shl(shift)?;
            let last = *line.get(x.checked_sub(1)?)?;
            line.get_mut(x..x.checked_add(n)?)?.fill(last);
            x += n;
            shift += 8;
            if shift > 24 {
                return None;
            }
        } else {
            line[x] = pixel;
            x += 1;
            shift = 0;
        }
    }
    Some(bytes)
}
