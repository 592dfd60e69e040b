//! Skies as arrays, and where the sun stands.

use std::collections::HashMap;

use antumbra::light::LightKind;
use antumbra::light::sky::{Air, sun_position as position};
use antumbra::texture::Texels;
use numpy::{IntoPyArray, PyArray3, PyArrayMethods};
use pyo3::prelude::*;

use crate::errors;
use crate::kinds::{self, Fields};

/// A picture (H, W, 3); `--environment` words; what the sun alone gives a surface that faces it [W/m²].
type Drawn<'py> = (Bound<'py, PyArray3<f32>>, String, [f32; 3]);

/// A sky of `antumbra.lights` as a lat-long picture, `width` × `width`/2, with its sun drawn in or without; and its words.
#[pyfunction]
pub fn sky(py: Python<'_>, fields: HashMap<String, Vec<f64>>, width: u32, sun: bool) -> PyResult<Drawn<'_>> {
    let sky = kinds::sky(&Fields::about(fields, [0.0; 3]))?;
    let image = py.detach(|| sky.picture(width, sun)).map_err(errors::value)?;
    let Texels::Float(texels) = image.texels else { return Err(errors::value("a sky has float texels")) };
    let disc = sky.sun();
    let faced = disc.power(1.0) / (std::f32::consts::PI * disc.radiance.luminance().max(f32::MIN_POSITIVE));
    let array = texels.into_flattened().into_pyarray(py);
    let pixels = array.reshape([image.height as usize, image.width as usize, 3])?;
    Ok((pixels, sky.words(), (disc.radiance * faced).0))
}

/// Where the sun stands at `unix` seconds since 1970 UTC: elevation and azimuth [rad], distance [au].
#[pyfunction]
pub fn sun_position(
    unix: f64,
    latitude: f64,
    longitude: f64,
    pressure: f64,
    temperature: f64,
) -> (f64, f64, f64) {
    let sun = position(unix, latitude, longitude, Air { pressure, temperature });
    (sun.elevation, sun.azimuth, sun.distance)
}
