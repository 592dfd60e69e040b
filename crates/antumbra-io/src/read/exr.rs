//! OpenEXR: channels as planes of f32.

use std::io::Cursor;

use exr::prelude::{AttributeValue, MetaData, ReadChannels, ReadLayers, read};

use crate::error::ReadError;
use crate::limits::Limits;

/// The channels of a picture, by name, and its text.
pub(crate) struct Planes {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Its upper left pixel in the display window, and the size of that window.
    pub corner: [i32; 2],
    pub whole: [u32; 2],
    /// Text attributes by name.
    pub text: Vec<(String, String)>,
    planes: Vec<(String, Vec<f32>)>,
}

impl Planes {
    /// Takes one channel out.
    pub(crate) fn take(&mut self, name: &str) -> Option<Vec<f32>> {
        let at = self.planes.iter().position(|p| p.0 == name)?;
        Some(self.planes.remove(at).1)
    }

    /// Takes the channel of a picture that has no other.
    pub(crate) fn take_only(&mut self) -> Option<Vec<f32>> {
        if self.planes.len() == 1 { self.planes.pop().map(|p| p.1) } else { None }
    }

    /// Takes the channels R, G and B behind a prefix out, if they are all there.
    pub(crate) fn take_rgb(&mut self, prefix: &str) -> Option<Vec<[f32; 3]>> {
        let names = ["R", "G", "B"].map(|c| format!("{prefix}{c}"));
        if !names.iter().all(|n| self.planes.iter().any(|p| p.0 == *n)) {
            return None;
        }
        let [r, g, b] = names.map(|n| self.take(&n).unwrap_or_default());
        Some(r.iter().zip(&g).zip(&b).map(|((r, g), b)| [*r, *g, *b]).collect())
    }

    /// Takes the picture out: R, G and B, or luminance and chroma, or grey; of several layers the one that is named like
    /// a picture, else the first. With the layer's name; empty for the plain one.
    pub(crate) fn take_picture(&mut self) -> Option<(Vec<[f32; 3]>, String)> {
        let mut layers = vec![String::new()];
        let red = self.planes.iter().filter_map(|p| p.0.strip_suffix(".R"));
        layers.extend(red.map(|layer| format!("{layer}.")));
        let last = |layer: &str| layer.trim_end_matches('.').rsplit('.').next().unwrap_or("").to_lowercase();
        layers.sort_by_key(|layer| !layer.is_empty() && !PICTURES.contains(&last(layer).as_str()));
        for layer in layers {
            let found = if layer.is_empty() {
                self.take_rgb("").or_else(|| self.take_chroma()).or_else(|| self.take("Y").map(grey))
            } else {
                self.take_rgb(&layer)
            };
            if let Some(pixels) = found {
                return Some((pixels, layer.trim_end_matches('.').into()));
            }
        }
        let grey_layer = self.planes.iter().find_map(|p| p.0.strip_suffix(".Y")).map(String::from)?;
        Some((grey(self.take(&format!("{grey_layer}.Y"))?), grey_layer))
    }

    /// Luminance Y with the differences RY = (R − Y)/Y and BY = (B − Y)/Y, of the primaries of Rec. 709.
    fn take_chroma(&mut self) -> Option<Vec<[f32; 3]>> {
        let there = ["Y", "RY", "BY"].iter().all(|n| self.planes.iter().any(|p| p.0 == *n));
        let [y, ry, by] =
            if there { ["Y", "RY", "BY"].map(|n| self.take(n).unwrap_or_default()) } else { return None };
        let mixed = |((y, ry), by): ((&f32, &f32), &f32)| {
            let (r, b) = ((ry + 1.0) * y, (by + 1.0) * y);
            [r, (y - 0.2126 * r - 0.0722 * b) / 0.7152, b]
        };
        Some(y.iter().zip(&ry).zip(&by).map(mixed).collect())
    }

    /// The name of a channel that is still there.
    pub(crate) fn first_name(&self) -> Option<String> {
        self.planes.first().map(|p| p.0.clone())
    }
}

/// Layers that are called so hold the picture itself.
const PICTURES: [&str; 5] = ["combined", "beauty", "rgba", "rgb", "color"];

fn grey(y: Vec<f32>) -> Vec<[f32; 3]> {
    y.into_iter().map(|y| [y; 3]).collect()
}

/// Every sample announced costs at least so many bytes: none of the compressions shrinks further than this.
const SAMPLES_PER_BYTE: u64 = 4096;
const BROKEN: &str = "The file is cut short, or its writer is wrong.";

/// Holds the header against the limits and the size of the file, before anything is allocated.
fn admit(bytes: &[u8], limits: &Limits) -> Result<(), ReadError> {
    let broken = |e: exr::error::Error| ReadError::new("EXR header", words(&e)).hint(advice(&e));
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(broken)?;
    let mut samples = 0u64;
    for header in &meta.headers {
        let (w, h) = (header.layer_size.width() as u64, header.layer_size.height() as u64);
        let pixels = w.saturating_mul(h);
        samples = samples.saturating_add(pixels.saturating_mul(header.channels.list.len() as u64));
        let too_large = pixels > limits.pixels || samples.saturating_mul(4) > limits.texture_bytes;
        if too_large || samples / SAMPLES_PER_BYTE > bytes.len() as u64 {
            let channels = header.channels.list.len();
            let what = format!("announces {w} × {h} pixels of {channels} channels in {} bytes", bytes.len());
            return Err(ReadError::new("EXR header", what).hint(BROKEN));
        }
        if (header.chunk_count as u64).saturating_mul(8) > bytes.len() as u64 {
            let what = format!("announces {} chunks in {} bytes", header.chunk_count, bytes.len());
            return Err(ReadError::new("EXR header", what).hint(BROKEN));
        }
    }
    Ok(())
}

/// All channels of all layers that have the size of the first one; those of a named layer as `layer.channel`.
pub(crate) fn planes(bytes: &[u8], limits: &Limits) -> Result<Planes, ReadError> {
    admit(bytes, limits)?;
    let broken = |e: exr::error::Error| ReadError::new("EXR", words(&e)).hint(advice(&e));
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(broken)?;
    let Some(first) = image.layer_data.first() else { return Err(ReadError::new("EXR", "it has no layer")) };
    let (size, at, shown) = (first.size, first.attributes.layer_position, image.attributes.display_window);
    let mut planes = Planes {
        width: size.width() as u32,
        height: size.height() as u32,
        corner: [at.x().saturating_sub(shown.position.x()), at.y().saturating_sub(shown.position.y())],
        whole: [shown.size.width() as u32, shown.size.height() as u32],
        text: Vec::new(),
        planes: Vec::new(),
    };
    for layer in image.layer_data.iter().filter(|l| l.size == size) {
        let prefix = layer.attributes.layer_name.as_ref().map_or(String::new(), |n| format!("{n}."));
        for (name, value) in &layer.attributes.other {
            if let AttributeValue::Text(text) = value {
                planes.text.push((utf8(name), utf8(text)));
            }
        }
        for channel in &layer.channel_data.list {
            let values = channel.sample_data.values_as_f32().collect();
            // A single named layer is what many programs write for a plain picture.
            let alone = image.layer_data.len() == 1;
            let prefix = if alone { "" } else { prefix.as_str() };
            planes.planes.push((format!("{prefix}{}", channel.name), values));
        }
    }
    planes.text.sort();
    planes.text.dedup();
    Ok(planes)
}

/// Text is written as UTF-8.
fn utf8(text: &exr::prelude::Text) -> String {
    String::from_utf8_lossy(text.as_slice()).into_owned()
}

/// What to do about an error.
fn advice(e: &exr::error::Error) -> &'static str {
    match e {
        exr::error::Error::NotSupported(_) => {
            "Write it plainly: `magick IN.exr -compress ZIP OUT.exr`, or from the program that it came from."
        }
        _ => BROKEN,
    }
}

/// The library's words in one line.
fn words(e: &exr::error::Error) -> String {
    use exr::error::Error as E;
    match e {
        E::Aborted => "it was interrupted".into(),
        E::NotSupported(what) if what.contains("subsampling") => {
            "its colours are kept at a part of its size (luminance and chroma, RY and BY): not read".into()
        }
        E::NotSupported(what) => format!("it is of a kind that is not read ({what})"),
        E::Invalid(what) => format!("it is broken: {what}"),
        E::Io(io) if io.kind() == std::io::ErrorKind::UnexpectedEof => "it ends too early".into(),
        E::Io(io) => format!("it is broken: {io}"),
    }
}
