//! OpenEXR: R, G, B in the unnamed layer, other layers as `name.R` …, settings as text attributes.

use std::io::Cursor;
use std::path::Path;

use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes,
    IntegerBounds, Layer, LayerAttributes, LineOrder, Text, Vec2, WritableImage,
};
use half::f16;

use super::{Aov, Channels, Picture, Precision, Window, write_whole};
use crate::error::{ReadError, WriteError};
use crate::files::read_limited;
use crate::limits::Limits;
use crate::read::exr::{Planes, planes};

/// Writes a picture as an EXR, whole or not at all.
pub fn write_exr(path: &Path, picture: &Picture, precision: Precision) -> Result<(), WriteError> {
    let bytes = exr_bytes(picture, precision);
    let bytes = bytes.map_err(|why| WriteError { file: path.display().to_string(), why })?;
    write_whole(path, &bytes)
}

/// An EXR in memory: scan lines, ZIP. The same picture gives the same bytes.
pub fn exr_bytes(picture: &Picture, precision: Precision) -> Result<Vec<u8>, String> {
    if let Some(fault) = picture.fault() {
        return Err(fault);
    }
    let mut list = Vec::new();
    for (c, name) in ["R", "G", "B"].iter().enumerate() {
        list.push(AnyChannel::new(*name, samples(picture.pixels.iter().map(|p| p[c]), precision)));
    }
    for aov in &picture.aovs {
        let precision = if aov.full { Precision::Float } else { precision };
        match &aov.channels {
            Channels::One(v) => {
                list.push(AnyChannel::new(aov.name.as_str(), samples(v.iter().copied(), precision)));
            }
            Channels::Three(v) => {
                for (c, letter) in ["R", "G", "B"].iter().enumerate() {
                    let name = format!("{}.{letter}", aov.name);
                    list.push(AnyChannel::new(name.as_str(), samples(v.iter().map(|p| p[c]), precision)));
                }
            }
        }
    }
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let size = (picture.width as usize, picture.height as usize);
    let window = picture.window.unwrap_or(Window::of([picture.width, picture.height]));
    let attributes = LayerAttributes {
        // The data window lies inside the display window: parts of a picture compose.
        layer_position: Vec2(window.x, window.y),
        software_name: Some(Text::from(concat!("antumbra ", env!("CARGO_PKG_VERSION")))),
        ..LayerAttributes::default()
    };
    let whole = IntegerBounds::from_dimensions((window.width as usize, window.height as usize));
    let layer = Layer::new(size, attributes, encoding, AnyChannels::sort(list.into()));
    let image = Image::new(ImageAttributes::new(whole), layer);
    let mut bytes = Vec::new();
    let written = image.write().non_parallel().to_buffered(Cursor::new(&mut bytes));
    written.map_err(|e| e.to_string())?;
    with_text(bytes, &picture.metadata).ok_or_else(|| "its header is out of shape".into())
}

fn samples(values: impl Iterator<Item = f32>, precision: Precision) -> FlatSamples {
    match precision {
        Precision::Float => FlatSamples::F32(values.collect()),
        // Clipped, since an infinite pixel would spoil every mean taken of the picture.
        Precision::Half => {
            let max = f16::MAX.to_f32();
            FlatSamples::F16(
                values.map(|v| f16::from_f32(if v.is_finite() { v.clamp(-max, max) } else { v })).collect(),
            )
        }
    }
}

/// Adds text attributes at the end of the header, in their order (the library would write them in a random one), and
/// moves the table of offsets along.
fn with_text(bytes: Vec<u8>, metadata: &[(String, String)]) -> Option<Vec<u8>> {
    let mut added = Vec::new();
    for (name, value) in metadata.iter().filter(|(name, _)| !name.is_empty() && !name.contains('\0')) {
        added.extend_from_slice(name.get(..255).unwrap_or(name).as_bytes());
        added.extend_from_slice(b"\0string\0");
        added.extend_from_slice(&u32::try_from(value.len()).ok()?.to_le_bytes());
        added.extend_from_slice(value.as_bytes());
    }
    let end = header_end(&bytes)?;
    let word = |at: usize| Some(u64::from_le_bytes(bytes.get(at..at + 8)?.try_into().ok()?));
    let table = end + 1;
    // Lines increase, so the first entry of the table points behind the table.
    let chunks = usize::try_from(word(table)?).ok()?;
    let mut out = Vec::with_capacity(bytes.len() + added.len());
    out.extend_from_slice(&bytes[..end]);
    out.extend_from_slice(&added);
    out.push(0);
    for at in (table..chunks).step_by(8) {
        out.extend_from_slice(&(word(at)? + added.len() as u64).to_le_bytes());
    }
    out.extend_from_slice(bytes.get(chunks..)?);
    // Bit 10 of the version: names of more than 31 bytes.
    if metadata.iter().any(|(name, _)| name.len() > 31) {
        out[5] |= 4;
    }
    Some(out)
}

/// Where the zero byte that ends the header lies: attributes are name, type, size, data.
fn header_end(bytes: &[u8]) -> Option<usize> {
    let mut at = 8;
    let text = |at: usize| Some(at + bytes.get(at..)?.iter().position(|b| *b == 0)?);
    while *bytes.get(at)? != 0 {
        let kind = text(at)? + 1;
        let size = text(kind)? + 1;
        at = size + 4 + u32::from_le_bytes(bytes.get(size..size + 4)?.try_into().ok()?) as usize;
    }
    Some(at)
}

/// Reads an EXR with all its layers.
pub fn read_exr(path: &Path) -> Result<Picture, ReadError> {
    let limits = Limits::default();
    let name = path.display().to_string();
    let bytes = read_limited(path, limits.file_bytes)
        .map_err(|why| ReadError::new("", format!("cannot be read ({why})")).of(name.clone()))?;
    read_exr_bytes(&bytes, &limits).map_err(|e| e.of(name))
}

/// Reads an EXR from memory: R, G, B (or Y three times) as the picture, the rest as layers.
pub fn read_exr_bytes(bytes: &[u8], limits: &Limits) -> Result<Picture, ReadError> {
    let mut planes = planes(bytes, limits)?;
    let only = |planes: &mut Planes| planes.take_only().map(|y| y.into_iter().map(|y| [y; 3]).collect());
    let found = planes.take_picture().map(|found| found.0).or_else(|| only(&mut planes));
    let pixels = found.ok_or_else(|| ReadError::new("channels", "there are neither R, G, B nor Y"))?;
    let Planes { width, height, corner: [x, y], whole, .. } = planes;
    let window = Window { x, y, width: whole[0], height: whole[1] };
    let window = (window != Window::of([width, height])).then_some(window);
    let metadata = std::mem::take(&mut planes.text);
    Ok(Picture { width, height, pixels, aovs: layers(planes), metadata, window })
}

/// Groups `name.R`, `name.G`, `name.B` (or X, Y, Z).
fn layers(mut planes: Planes) -> Vec<Aov> {
    let mut aovs = Vec::new();
    while let Some(first) = planes.first_name() {
        let group = first.rsplit_once('.').map(|(group, _)| group.to_string());
        let rgb = group.as_ref().and_then(|g| planes.take_rgb(&format!("{g}.")));
        if let (Some(name), Some(rgb)) = (group, rgb) {
            aovs.push(Aov { name, channels: Channels::Three(rgb), full: false });
        } else if let Some(one) = planes.take(&first) {
            aovs.push(Aov { name: first, channels: Channels::One(one), full: false });
        }
    }
    aovs
}
