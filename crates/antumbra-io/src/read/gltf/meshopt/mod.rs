//! EXT_meshopt_compression and KHR_meshopt_compression: buffer views that are unpacked before anything reads them.

mod attributes;
mod filters;
mod indices;

use serde::Deserialize;

use super::document::{Document, Extensions};
use crate::error::ReadError;
use crate::read::Context;

/// The two names of the extension.
pub(super) const NAMES: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// What the extension says of a buffer view.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Packed {
    buffer: usize,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    byte_stride: u64,
    count: u64,
    mode: String,
    #[serde(default)]
    filter: Option<String>,
}

/// A buffer that holds nothing: its views are all packed, and only readers without the extension would load it.
pub(super) fn is_placeholder(extensions: &Extensions) -> bool {
    NAMES
        .iter()
        .filter_map(|name| extensions.get(*name))
        .any(|e| e.get("fallback").and_then(|f| f.as_bool()) == Some(true))
}

/// The bytes of a buffer view that is packed; `None` for one that is not. `buffer` gives the bytes of a buffer.
pub(super) fn unpack<'a>(
    doc: &Document,
    view: usize,
    buffer: impl Fn(usize) -> Option<&'a [u8]>,
    context: &Context,
) -> Result<Option<Vec<u8>>, ReadError> {
    let extensions = &doc.buffer_views[view].extensions;
    let Some((name, value)) = NAMES.iter().find_map(|n| Some((*n, extensions.get(*n)?))) else {
        return Ok(None);
    };
    let fail = |what: String| {
        let hint = "The file is cut short, or its exporter is wrong.";
        ReadError::new(format!("buffer view {view} ({name})"), what).hint(hint)
    };
    let p = Packed::deserialize(value).map_err(|e| fail(e.to_string()))?;
    let all =
        buffer(p.buffer).ok_or_else(|| fail(format!("names buffer {}, which holds nothing", p.buffer)))?;
    let end = p.byte_offset.checked_add(p.byte_length).filter(|end| *end <= all.len() as u64);
    let end = end.ok_or_else(|| {
        let (length, offset) = (p.byte_length, p.byte_offset);
        fail(format!("reads {length} bytes at offset {offset} of a buffer that has {}", all.len()))
    })?;
    context.take(p.count, p.byte_stride).map_err(fail)?;
    decode(&p, &all[p.byte_offset as usize..end as usize]).map(Some).map_err(fail)
}

/// Unpacks and undoes the filter.
fn decode(p: &Packed, data: &[u8]) -> Result<Vec<u8>, String> {
    let (count, stride) = (p.count as usize, p.byte_stride as usize);
    let is_index = matches!(stride, 2 | 4);
    let mut bytes = match p.mode.as_str() {
        "ATTRIBUTES" if stride > 0 && stride <= 256 && stride.is_multiple_of(4) => {
            attributes::decode(data, count, stride)?
        }
        "TRIANGLES" if is_index && count.is_multiple_of(3) => {
            indices::bytes(&indices::triangles(data, count)?, stride)?
        }
        "INDICES" if is_index => indices::bytes(&indices::sequence(data, count)?, stride)?,
        "ATTRIBUTES" | "TRIANGLES" | "INDICES" => {
            return Err(format!("its mode {} does not go with {count} elements of {stride} bytes", p.mode));
        }
        other => return Err(format!("its mode \"{other}\" is unknown (ATTRIBUTES, TRIANGLES, INDICES)")),
    };
    let filter = p.filter.as_deref().unwrap_or("NONE");
    if filter != "NONE" {
        if p.mode != "ATTRIBUTES" {
            return Err(format!("its mode {} has no filter {filter}", p.mode));
        }
        filters::undo(filter, &mut bytes, stride)?;
    }
    Ok(bytes)
}

/// What is said of data that ends too early or goes on too long.
fn broken() -> String {
    "its packed data are broken".into()
}

/// Takes `n` bytes from the front.
fn take<'a>(data: &mut &'a [u8], n: usize) -> Result<&'a [u8], String> {
    let (front, rest) = data.split_at_checked(n).ok_or_else(broken)?;
    *data = rest;
    Ok(front)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers that any encoder may be asked for: a smooth column, a jumping one, a constant one, and noise.
    fn numbers(count: usize) -> Vec<u8> {
        let mut state = 1u32;
        let mut noise = move || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) as u16
        };
        let row = |i: usize, n: u16| [(3 * i) as u16, if i.is_multiple_of(7) { 900 } else { 1 }, 77, n];
        (0..count).flat_map(|i| row(i, noise())).flat_map(u16::to_le_bytes).collect()
    }

    fn packed(mode: &str, count: u64, stride: u64, filter: &str) -> Packed {
        let (mode, filter) = (mode.into(), Some(filter.into()));
        Packed { buffer: 0, byte_offset: 0, byte_length: 0, byte_stride: stride, count, mode, filter }
    }

    fn hex(text: &str) -> Vec<u8> {
        let digit = |b: u8| (b as char).to_digit(16).unwrap_or(0) as u8;
        text.as_bytes().chunks(2).map(|c| digit(c[0]) << 4 | digit(c[1])).collect()
    }

    // The packed bytes below were written by the format's own library (meshoptimizer 1.3.0).
    const COLUMNS: [&str; 2] = [
        "a02a06666666666666666666666666666666666666660000000000153003c00ffaf9faf9fa003c00f0f9faf9fa03c000\
         00f9fa1a0500000650000065000006500000650003c00000060500001f0000e3bafaaf831853daf0062e142729969622\
         9c74f69ad9cd59543b6c290e3effff00005256755b0e74ec361f00444666b0a4d06fecc1c558567ecc813deeb64ba139\
         0f7e5fd73f673bfa5c7effff000050b3d05229f13b530000000000000000000000000000000000000000000000000000\
         84034d00883c",
        "a159fa2a0666666666666666666666666666666666666666000000000082c1faf9faf9fa6030f9faf9fa1800f9fa0082\
         c10506050605603006050605180006050000e3bafaaf831853daf0062e1427299696229c74f69ad9cd59543b6c290e3e\
         5256755b0e74ec3600444666b0a4d06fecc1c558567ecc813deeb64ba1390f7e5fd73f673bfa5c7e50b3d05229f13b53\
         0000000000000000000000000000000084034d00883c0000",
    ];
    const TRIANGLES: &str = "e1fe1e100e100e100ece1e160e150e140ece1e140e140e140ece1e140e140e140effffff0f0a1d2ff60e07562a007687\
         566778a9866589689801690000";
    const SEQUENCE: &str = "d10004100e14020e04100e14020e04100e14020e04100e14020a04100e14020e04100e14020e04100e14020e04100e14\
         020a04100e14020e04100e14020e04100e14020e04100e14020a04100e14020e04100e14020e04100e14020e04100e14\
         025a602e120e4410020200000000";

    /// A grid of 4 × 4 squares in two triangles each, then three that have nothing to do with it.
    fn grid() -> Vec<u32> {
        let square = |i: u32| {
            let a = i / 4 * 5 + i % 4;
            [a, a + 1, a + 5, a + 1, a + 6, a + 5]
        };
        (0..16).flat_map(square).chain([0, 24, 12, 7, 3, 20, 24, 23, 22]).collect()
    }

    #[test]
    fn columns_of_both_versions_unpack_to_what_was_packed() {
        for text in COLUMNS {
            let got = decode(&packed("ATTRIBUTES", 40, 8, "NONE"), &hex(text));
            assert_eq!(got, Ok(numbers(40)));
        }
    }

    /// Triangles may come out turned.
    #[test]
    fn indices_unpack_to_what_was_packed() {
        let wide: Vec<u8> = grid().iter().flat_map(|i| i.to_le_bytes()).collect();
        assert_eq!(decode(&packed("INDICES", 105, 4, "NONE"), &hex(SEQUENCE)), Ok(wide));
        let got = indices::triangles(&hex(TRIANGLES), 105).unwrap_or_default();
        assert_eq!(got.len(), 105);
        for (got, want) in got.chunks(3).zip(grid().chunks(3)) {
            let turned = |k: usize| [want[k], want[(k + 1) % 3], want[(k + 2) % 3]];
            assert!((0..3).any(|k| got == turned(k)), "{got:?} {want:?}");
        }
    }

    #[test]
    fn filters_are_undone_to_the_bit() {
        for (filter, stride, before, after) in [
            ("OCTAHEDRAL", 4, "00007f0036b77f7fa6637f0055557f7f", "00007f004c9a007fd23d9a004949b67f"),
            (
                "OCTAHEDRAL",
                8,
                "00000000ff0700006d036efbff07ff7f58fa3e06ff07000055055505ff07ff7f",
                "00000000ff7f0000c54c95990000ff7ff7d16b3d92990000dd49dd4907b6ff7f",
            ),
            (
                "QUATERNION",
                8,
                "000000000000ff0759faa705a705fc070000c9060000fc07dffeea07dffefd07",
                "000000000000ff7f0f4006c0fa3ffa3f65660000cd4c000039f39f5939f39459",
            ),
            ("EXPONENTIAL", 4, "002000f300d8fff4803e00fcc52000e9", "0000803f000020c000007a440014833a"),
            ("COLOR", 4, "905ff1ff4081c0c08de75980", "fe8140ff0100ff801be64d00"),
            ("COLOR", 8, "0009ff0501ffff0f000401f800fc000c", "efff18800440ffff10000000ffff0880"),
        ] {
            let mut bytes = hex(before);
            assert_eq!(filters::undo(filter, &mut bytes, stride), Ok(()));
            assert_eq!(bytes, hex(after), "{filter} {stride}");
        }
        assert!(filters::undo("QUATERNION", &mut [0; 4], 4).is_err());
    }

    /// Data cut short, or with any byte changed, are refused or read as something else: nothing else happens.
    #[test]
    fn broken_data_break_nothing() {
        let kinds = [("ATTRIBUTES", 40, 8, COLUMNS[0]), ("ATTRIBUTES", 40, 8, COLUMNS[1])];
        let kinds =
            kinds.into_iter().chain([("TRIANGLES", 105, 2, TRIANGLES), ("INDICES", 105, 2, SEQUENCE)]);
        for (mode, count, stride, text) in kinds {
            let (whole, how) = (hex(text), packed(mode, count, stride, "NONE"));
            assert!(decode(&how, &whole).is_ok());
            for i in 0..whole.len() {
                assert!(decode(&how, &whole[..i]).is_err(), "{mode} cut to {i}");
                for change in [1, 0x55, 0xff] {
                    let mut bytes = whole.clone();
                    bytes[i] ^= change;
                    if let Ok(got) = decode(&how, &bytes) {
                        assert_eq!(got.len() as u64, count * stride);
                    }
                }
            }
        }
    }
}
