//! PNG, eight bits, sRGB: a picture for the eye, with its settings as text.

use std::io::Cursor;
use std::path::Path;

use super::{Look, Picture, write_whole};
use crate::error::{ReadError, WriteError};
use crate::files::read_limited;
use crate::limits::Limits;
use crate::srgb::decode;

/// Writes a picture as a PNG, whole or not at all.
pub fn write_png(path: &Path, picture: &Picture, look: &Look) -> Result<(), WriteError> {
    let bytes = png_bytes(picture, look);
    let bytes = bytes.map_err(|why| WriteError { file: path.display().to_string(), why })?;
    write_whole(path, &bytes)
}

/// A PNG in memory. Its text holds the metadata, the exposure and the name of the tone curve.
pub fn png_bytes(picture: &Picture, look: &Look) -> Result<Vec<u8>, String> {
    if let Some(fault) = picture.fault() {
        return Err(fault);
    }
    let mut bytes = Vec::new();
    encode(picture, look, &mut bytes).map_err(|e| e.to_string())?;
    Ok(bytes)
}

fn encode(picture: &Picture, look: &Look, out: &mut Vec<u8>) -> Result<(), png::EncodingError> {
    let mut encoder = png::Encoder::new(out, picture.width, picture.height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    let shown = [("tone", look.tone.name().to_string()), ("exposure", format!("{} EV", look.exposure))];
    let shown = shown.into_iter().filter(|(k, _)| !picture.metadata.iter().any(|m| m.0 == *k));
    let shown: Vec<_> = shown.map(|(k, v)| (k.to_string(), v)).collect();
    for (key, value) in shown.iter().chain(&picture.metadata) {
        // tEXt holds Latin-1 only; other text goes into iTXt.
        if value.chars().all(|c| u32::from(c) < 256) {
            encoder.add_text_chunk(key.clone(), value.clone())?;
        } else {
            encoder.add_itxt_chunk(key.clone(), value.clone())?;
        }
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&look.encode(&picture.pixels))?;
    writer.finish()
}

/// Reads a PNG as linear colours.
pub fn read_png(path: &Path) -> Result<Picture, ReadError> {
    let limits = Limits::default();
    let name = path.display().to_string();
    let bytes = read_limited(path, limits.file_bytes)
        .map_err(|why| ReadError::new("", format!("cannot be read ({why})")).of(name.clone()))?;
    read_png_bytes(&bytes, &limits).map_err(|e| e.of(name))
}

/// Reads a PNG from memory as linear colours, with its text.
pub fn read_png_bytes(bytes: &[u8], limits: &Limits) -> Result<Picture, ReadError> {
    let broken = |e: png::DecodingError| ReadError::new("", format!("the PNG is broken ({e})"));
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
    let head = decoder.read_header_info().map_err(broken)?;
    let (width, height) = (head.width, head.height);
    let pixels = u64::from(width) * u64::from(height);
    if pixels > limits.pixels || pixels / 8 / 1032 > bytes.len() as u64 {
        let what = format!("announces {width} × {height} pixels in {} bytes", bytes.len());
        return Err(ReadError::new("", what));
    }
    let mut reader = decoder.read_info().map_err(broken)?;
    let size = reader.output_buffer_size().ok_or_else(|| ReadError::new("", "the PNG is too large"))?;
    let mut data = vec![0; size];
    let frame = reader.next_frame(&mut data).map_err(broken)?;
    let linear: [f32; 256] = std::array::from_fn(|k| decode(k as f64 / 255.0));
    let samples = frame.color_type.samples();
    let pixel = |c: &[u8]| {
        let rgb = if samples < 3 { [c[0]; 3] } else { [c[0], c[1], c[2]] };
        rgb.map(|k| linear[usize::from(k)])
    };
    let pixels = data[..frame.buffer_size()].chunks_exact(samples).map(pixel).collect();
    Ok(Picture { width, height, pixels, aovs: Vec::new(), metadata: text(reader.info()), window: None })
}

fn text(info: &png::Info) -> Vec<(String, String)> {
    let latin = info.uncompressed_latin1_text.iter().map(|t| (t.keyword.clone(), t.text.clone()));
    let other = info.utf8_text.iter().map(|t| (t.keyword.clone(), t.get_text().unwrap_or_default()));
    latin.chain(other).collect()
}
