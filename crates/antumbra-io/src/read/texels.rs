//! PNG, JPEG and WebP pictures for textures.

use std::io::Cursor;
use std::sync::Arc;

use antumbra::texture::{Image, Texels};
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::Context;
use super::environment::environment_picture;

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
    room.map_err(|_| "the pictures of the scene are too large together".to_string())?;
    Ok(image)
}

/// Decodes a picture by its first bytes: colours as sRGB, or as plain numbers.
pub(super) fn decode(bytes: &[u8], srgb: bool, context: &Context) -> Result<Image, String> {
    let rgba = match bytes {
        [0x89, b'P', b'N', b'G', ..] => png(bytes, context)?,
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
    room.map_err(|_| "the pictures of the scene are too large together".to_string())?;
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

fn png(bytes: &[u8], context: &Context) -> Result<Rgba, String> {
    let broken = |e: png::DecodingError| format!("the PNG is broken ({e})");
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::STRIP_16);
    let head = decoder.read_header_info().map_err(broken)?;
    let (width, height) = (head.width, head.height);
    let pixels = admit(width, height, context)?;
    // Deflate cannot shrink below one part in 1032: a smaller file does not hold these pixels.
    if pixels as u64 / 8 / 1032 > bytes.len() as u64 {
        return Err(format!("it announces {width} × {height} pixels in {} bytes", bytes.len()));
    }
    let mut reader = decoder.read_info().map_err(broken)?;
    let size = reader.output_buffer_size().ok_or("the PNG is too large")?;
    let mut data = vec![0; size];
    let frame = reader.next_frame(&mut data).map_err(broken)?;
    let channels = frame.color_type.samples();
    Ok(Rgba { width, height, texels: widen(&data[..frame.buffer_size()], channels)? })
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
