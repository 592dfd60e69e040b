//! Latitude-longitude pictures as environments: Radiance `.hdr` and OpenEXR.

use std::path::Path;
use std::sync::Arc;

use antumbra::light::Environment;
use antumbra::scene::{Level, Message, SceneBuilder};
use antumbra::texture::{Image, Texels};

use super::exr::planes;
use super::{Context, ReadOptions, hdr};
use crate::error::ReadError;
use crate::files::read_limited;
use crate::limits::Limits;

/// A picture of radiance by direction, and what had to be said about it.
#[derive(Clone, Debug)]
pub struct EnvironmentPicture {
    /// Linear radiance, finite and not negative.
    pub image: Arc<Image>,
    /// Warnings.
    pub messages: Vec<Message>,
    /// What the file is ("OpenEXR", "Radiance HDR").
    pub source: &'static str,
}

/// Reads an environment from memory. Pixels that are NaN, infinite or negative are read as 0, with a warning.
pub fn environment_picture(bytes: &[u8], limits: &Limits) -> Result<EnvironmentPicture, ReadError> {
    let mut layer = String::new();
    let (width, height, mut pixels, source) = match bytes {
        [] => return Err(ReadError::new("", "the file is empty (0 bytes)")),
        [0x76, 0x2f, 0x31, 0x01, ..] => {
            let mut planes = planes(bytes, limits)?;
            let found = planes.take_picture();
            let (pixels, name) =
                found.ok_or_else(|| ReadError::new("channels", "there are neither R, G, B nor Y"))?;
            layer = name;
            (planes.width, planes.height, pixels, "OpenEXR")
        }
        [b'#', b'?', ..] => {
            let picture = hdr::decode(bytes, limits)?;
            (picture.width, picture.height, picture.pixels, "Radiance HDR")
        }
        _ => {
            let what = "this is neither OpenEXR nor Radiance HDR: its first bytes are others";
            return Err(ReadError::new("", what));
        }
    };
    let mut messages = clean(&mut pixels);
    if !layer.is_empty() {
        let text = format!("it has several layers: \"{layer}\" is shown");
        messages.push(Message { level: Level::Note, place: "layers".into(), text });
    }
    let image = Image::new(width, height, Texels::Float(pixels));
    let image = image.ok_or_else(|| ReadError::new("", format!("it has {width} × {height} pixels")))?;
    Ok(EnvironmentPicture { image: Arc::new(image), messages, source })
}

/// Reads an environment light from disk, with what had to be said about it.
pub fn read_environment(
    path: &Path,
    options: &ReadOptions,
) -> Result<(Environment, Vec<Message>), ReadError> {
    let name = path.display().to_string();
    let bytes = read_limited(path, options.limits.file_bytes)
        .map_err(|why| ReadError::new("", format!("cannot be read ({why})")).of(name.clone()))?;
    let picture = environment_picture(&bytes, &options.limits).map_err(|e| e.of(name))?;
    Ok((Environment::image(picture.image), picture.messages))
}

/// An environment as a scene: light and nothing else; what stands under it is the caller's matter.
pub(super) fn read(bytes: &[u8], context: &Context) -> Result<SceneBuilder, ReadError> {
    let picture = environment_picture(bytes, context.limits)?;
    let source = format!("{}, {} × {}", picture.source, picture.image.width, picture.image.height);
    let mut scene = SceneBuilder { source, ..SceneBuilder::default() };
    scene.light("environment", Environment::image(picture.image));
    scene.messages = picture.messages;
    Ok(scene)
}

/// Puts 0 where a number is no radiance.
fn clean(pixels: &mut [[f32; 3]]) -> Vec<Message> {
    let (mut odd, mut below) = (0, 0);
    for pixel in pixels.iter_mut() {
        let is_odd = pixel.iter().any(|c| !c.is_finite());
        let is_below = pixel.iter().any(|c| *c < 0.0);
        odd += usize::from(is_odd);
        below += usize::from(!is_odd && is_below);
        if is_odd || is_below {
            *pixel = pixel.map(|c| if c.is_finite() { c.max(0.0) } else { 0.0 });
        }
    }
    let said = [(odd, "NaN or infinite"), (below, "negative")];
    let warning = |(n, what): (usize, &str)| Message {
        level: Level::Warning,
        place: "pixels".into(),
        text: format!("{n} of {} are {what}: read as 0", pixels.len()),
    };
    said.into_iter().filter(|s| s.0 > 0).map(warning).collect()
}
