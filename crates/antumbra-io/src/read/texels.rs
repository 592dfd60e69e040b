//! PNG, JPEG and WebP pictures for textures.

use std::io::Cursor;
use std::sync::Arc;

use antumbra::texture::{Image, Texels};
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::Context;
use super::environment::environment_picture;

const TOGETHER: &str = "the pictures of the scene are too large together";

/// Rows of RGBA texels, eight bits each.
struct Rgba {
    width: u32,
    height: u32,
    texels: Vec<[u8; 4]>,
}

/// A picture of any kind without its alpha: PNG, JPEG, WebP; OpenEXR and Radiance HDR, which are linear.
pub(super) fn picture(bytes: &[u8], srgb: bool, context: &Context) -> Result<Image, String> {
    if !matches!(bytes, [0x76, 0x2f, 0x31, 0x01, ..] | [b'#', b'?', ..]) {
        let mut image = decode(bytes, srgb, context)?;
        if let Texels::Srgb8(texels) | Texels::Linear8(texels) = &mut image.texels {
            texels.iter_mut().for_each(|texel| texel[3] = 255);
        }
        return Ok(image);
    }
    let picture = environment_picture(bytes, context.limits).map_err(|e| e.to_string())?;
    let image = Arc::unwrap_or_clone(picture.image);
    let room = context.textures.take(u64::from(image.width) * u64::from(image.height), 12);
    room.map_err(|_| TOGETHER.to_string())?;
    Ok(image)
}

/// Decodes a picture by its first bytes: colours as sRGB, or as plain numbers.
pub(super) fn decode(bytes: &[u8], srgb: bool, context: &Context) -> Result<Image, String> {
    let rgba = match bytes {
        [0x89, b'P', b'N', b'G', ..] => match png(bytes, srgb, context)? {
            Png::Bytes(rgba) => rgba,
            Png::Deep(image) => return Ok(image),
        },
        [0xff, 0xd8, ..] => jpeg(bytes, context)?,
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => webp(bytes, context)?,
        [0xab, b'K', b'T', b'X', ..] => return Err("KTX2 pictures (Basis Universal) are not read".into()),
        [b'D', b'D', b'S', ..] => return Err("DDS pictures are not read".into()),
        _ => return Err("it is neither PNG nor JPEG nor WebP".into()),
    };
    let texels = if srgb { Texels::Srgb8(rgba.texels) } else { Texels::Linear8(rgba.texels) };
    Image::new(rgba.width, rgba.height, texels).ok_or_else(|| "it has no pixels".into())
}

/// Holds the announced size against the limits, before anything is allocated.
fn admit(width: u32, height: u32, context: &Context) -> Result<usize, String> {
    let pixels = u64::from(width) * u64::from(height);
    let limit = context.limits.pixels;
    if pixels > limit {
        return Err(format!("it announces {width} × {height} pixels; at most {limit} are read"));
    }
    let room = context.textures.take(pixels, 4);
    room.map_err(|_| TOGETHER.to_string())?;
    Ok(pixels as usize)
}

/// One to four channels a pixel to RGBA.
fn widen(data: &[u8], channels: usize) -> Result<Vec<[u8; 4]>, String> {
    Ok(match channels {
        1 => data.iter().map(|g| [*g, *g, *g, 255]).collect(),
        2 => data.chunks_exact(2).map(|c| [c[0], c[0], c[0], c[1]]).collect(),
        3 => data.chunks_exact(3).map(|c| [c[0], c[1], c[2], 255]).collect(),
        4 => bytemuck::pod_collect_to_vec(data),
        n => return Err(format!("it has {n} channels")),
    })
}

/// A PNG: of eight bits, or of sixteen without alpha, which keeps them.
enum Png {
    Bytes(Rgba),
    Deep(Image),
}

/// Bytes of a pixel that is kept as floats beyond those of [`admit`].
const DEEP: u64 = 8;

fn png(bytes: &[u8], srgb: bool, context: &Context) -> Result<Png, String> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    let head = decoder.read_header_info().map_err(broken_png)?;
    let (width, height) = (head.width, head.height);
    let has_alpha = matches!(head.color_type, png::ColorType::GrayscaleAlpha | png::ColorType::Rgba);
    let mut deep = head.bit_depth == png::BitDepth::Sixteen && !has_alpha;
    let pixels = admit(width, height, context)?;
    // Deflate cannot shrink below one part in 1032: a smaller file does not hold these pixels.
    if pixels as u64 / 8 / 1032 > bytes.len() as u64 {
        return Err(format!("it announces {width} × {height} pixels in {} bytes", bytes.len()));
    }
    let mut reader = open_png(bytes, deep)?;
    // One colour may stand for "nothing here", which is alpha.
    if deep && reader.info().trns.is_some() {
        deep = false;
        reader = open_png(bytes, deep)?;
    }
    let size = reader.output_buffer_size().ok_or("the PNG is too large")?;
    let mut data = vec![0; size];
    let frame = reader.next_frame(&mut data).map_err(broken_png)?;
    let channels = frame.color_type.samples();
    let data = &data[..frame.buffer_size()];
    if !deep {
        return Ok(Png::Bytes(Rgba { width, height, texels: widen(data, channels)? }));
    }
    context.textures.take(pixels as u64, DEEP).map_err(|_| TOGETHER.to_string())?;
    let texels = Texels::Float(deep_texels(data, channels, srgb));
    Image::new(width, height, texels).map(Png::Deep).ok_or_else(|| "it has no pixels".into())
}

fn broken_png(e: png::DecodingError) -> String {
    format!("the PNG is broken ({e})")
}

/// A PNG as it is, or in bytes with its colours and its alpha spelt out.
fn open_png(bytes: &[u8], as_it_is: bool) -> Result<png::Reader<Cursor<&[u8]>>, String> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(match as_it_is {
        true => png::Transformations::IDENTITY,
        false => png::Transformations::EXPAND | png::Transformations::STRIP_16,
    });
    decoder.read_info().map_err(broken_png)
}

/// Sixteen bits a channel, big endian, one or three channels, to linear floats.
fn deep_texels(data: &[u8], channels: usize, srgb: bool) -> Vec<[f32; 3]> {
    let linear = |c: u16| {
        let c = f64::from(c) / 65535.0;
        if srgb { crate::srgb::decode(c) } else { c as f32 }
    };
    let table: Vec<f32> = (0..=u16::MAX).map(linear).collect();
    let value = |b: &[u8; 2]| table[usize::from(u16::from_be_bytes(*b))];
    let texel = |t: &[[u8; 2]]| match t {
        [r, g, b] => [value(r), value(g), value(b)],
        [one, ..] => [value(one); 3],
        [] => [0.0; 3],
    };
    data.as_chunks::<2>().0.chunks_exact(channels.max(1)).map(texel).collect()
}

fn jpeg(bytes: &[u8], context: &Context) -> Result<Rgba, String> {
    let broken = |e: zune_jpeg::errors::DecodeErrors| format!("the JPEG is broken ({e})");
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = zune_jpeg::JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(broken)?;
    let info = decoder.info().ok_or("the JPEG has no header")?;
    let (width, height) = (u32::from(info.width), u32::from(info.height));
    let pixels = admit(width, height, context)?;
    let data = decoder.decode().map_err(broken)?;
    Ok(Rgba { width, height, texels: widen(&data, data.len() / pixels.max(1))? })
}

fn webp(bytes: &[u8], context: &Context) -> Result<Rgba, String> {
    let broken = |e: image_webp::DecodingError| format!("the WebP is broken ({e})");
    let mut decoder = image_webp::WebPDecoder::new(Cursor::new(bytes)).map_err(broken)?;
    let (width, height) = decoder.dimensions();
    let pixels = admit(width, height, context)?;
    decoder.set_memory_limit(pixels.saturating_mul(16));
    let size = decoder.output_buffer_size().ok_or("the WebP is too large")?;
    let mut data = vec![0; size];
    decoder.read_image(&mut data).map_err(broken)?;
    Ok(Rgba { width, height, texels: widen(&data, if decoder.has_alpha() { 4 } else { 3 })? })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encoded(color: png::ColorType, nothing: Option<Vec<u8>>, data: &[u8]) -> Vec<u8> {
        let mut out = Vec::new();
        let mut encoder = png::Encoder::new(&mut out, 2, 1);
        encoder.set_color(color);
        encoder.set_depth(png::BitDepth::Sixteen);
        if let Some(nothing) = nothing {
            encoder.set_trns(nothing);
        }
        let written = encoder.write_header().and_then(|mut w| w.write_image_data(data));
        assert!(written.is_ok());
        out
    }

    /// Two numbers that eight bits cannot tell apart stay two; with alpha there are eight bits.
    #[test]
    fn sixteen_bits_are_kept() {
        let files = crate::files::MemoryFiles::default();
        let options = crate::read::ReadOptions::default();
        let context = crate::read::context(&files, &options, 1 << 20, false);
        let grey = [0x80, 0x10, 0x80, 0x20];
        let read = |bytes: &[u8], srgb| decode(bytes, srgb, &context).map(|image| image.texels);
        let plain = encoded(png::ColorType::Grayscale, None, &grey);
        let floats = |c: f64| [c as f32; 3];
        let (a, b) = (f64::from(0x8010) / 65535.0, f64::from(0x8020) / 65535.0);
        assert!(matches!(read(&plain, false), Ok(Texels::Float(t)) if t == [floats(a), floats(b)]));
        let linear = |c: f64| [crate::srgb::decode(c); 3];
        assert!(matches!(read(&plain, true), Ok(Texels::Float(t)) if t == [linear(a), linear(b)]));
        let nothing = encoded(png::ColorType::Grayscale, Some(vec![0x80, 0x20]), &grey);
        let texels = [[0x80, 0x80, 0x80, 255], [0x80, 0x80, 0x80, 0]];
        assert!(matches!(read(&nothing, false), Ok(Texels::Linear8(t)) if t == texels));
        let colors = [1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6, 0];
        let three = encoded(png::ColorType::Rgb, None, &colors);
        let want = |i: u32| f64::from(256 * i) / 65535.0;
        let first = [want(1) as f32, want(2) as f32, want(3) as f32];
        assert!(matches!(read(&three, false), Ok(Texels::Float(t)) if t[0] == first));
    }
}
