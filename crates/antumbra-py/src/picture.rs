//! A finished picture: its arrays for Python, and its way into a file.

use std::path::Path;

use antumbra::render::{Picture as Rendered, hash_of};
use antumbra::settings::{ExrNumbers, Settings, Tone};
use antumbra_io::WriteError;
use antumbra_io::picture::{self as file, Aov, Channels, Look, Precision};
use numpy::ndarray::{Array3, ArrayD};
use numpy::{IntoPyArray, PyArray3, PyArrayDyn, PyReadonlyArray3, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::errors;

/// Layers whose numbers a half does not hold well.
const FULL: [&str; 4] = ["position", "depth", "sample-count", "standard-error"];

/// passes done, passes, shadow rays, other rays, window.
type Counts = (u32, u32, u64, u64, [u32; 4]);

/// What `render` returned, or what was pickled of it.
#[pyclass(frozen, module = "antumbra._core")]
pub struct Picture {
    rendered: Rendered,
    look: Look,
    exr: ExrNumbers,
}

impl Picture {
    /// A picture with how the settings want it shown.
    pub fn new(rendered: Rendered, settings: &Settings) -> Picture {
        let tone = match settings.tone {
            Tone::Linear => file::Tone::Linear,
            Tone::Filmic => file::Tone::Filmic,
        };
        Picture { rendered, look: Look { exposure: settings.exposure, tone }, exr: settings.exr }
    }

    fn to_file(&self) -> file::Picture {
        let r = &self.rendered;
        let [x, y, width, height] = r.window;
        let layer = |(name, channels, values): &(String, usize, Vec<f32>)| {
            let full = match self.exr {
                ExrNumbers::Auto => FULL.contains(&name.as_str()) || !fits_half(values),
                exr => exr == ExrNumbers::Float,
            };
            let channels = match channels {
                1 => Channels::One(values.clone()),
                _ => Channels::Three(values.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect()),
            };
            Aov { name: name.clone(), channels, full }
        };
        file::Picture {
            width: r.width,
            height: r.height,
            pixels: r.pixels.clone(),
            aovs: r.aovs.iter().map(layer).collect(),
            metadata: r.metadata.clone(),
            window: Some(file::Window { x: x as i32, y: y as i32, width, height }),
        }
    }

    fn precision(&self) -> Precision {
        match self.exr {
            ExrNumbers::Float => Precision::Float,
            ExrNumbers::Auto if !fits_half(self.rendered.pixels.as_flattened()) => Precision::Float,
            _ => Precision::Half,
        }
    }

    fn shape(&self) -> [usize; 2] {
        [self.rendered.height as usize, self.rendered.width as usize]
    }
}

/// No number is beyond the largest half.
fn fits_half(values: &[f32]) -> bool {
    values.iter().all(|v| v.abs() <= 65_504.0 || v.is_nan())
}

#[pymethods]
impl Picture {
    /// Columns.
    #[getter]
    fn width(&self) -> u32 {
        self.rendered.width
    }

    /// Rows.
    #[getter]
    fn height(&self) -> u32 {
        self.rendered.height
    }

    /// Radiance, (H, W, 3) float32.
    fn pixels<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f32>>> {
        image(py, self.shape(), self.rendered.pixels.as_flattened().to_vec())
    }

    /// Standard error of each value, (H, W, 3) float32, or None.
    fn standard_error<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray3<f32>>>> {
        let known = self.rendered.standard_error.as_ref();
        known.map(|e| image(py, self.shape(), e.as_flattened().to_vec())).transpose()
    }

    /// Name and (H, W, 3) or (H, W) float32 of every other plane.
    fn aovs<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, Bound<'py, PyArrayDyn<f32>>)>> {
        let [h, w] = self.shape();
        let plane = |(name, channels, values): &(String, usize, Vec<f32>)| {
            let shape = if *channels == 1 { vec![h, w] } else { vec![h, w, *channels] };
            let array =
                ArrayD::from_shape_vec(shape, values.clone()).map_err(|e| errors::value(e.to_string()))?;
            Ok((name.clone(), array.into_pyarray(py)))
        };
        self.rendered.aovs.iter().map(plane).collect()
    }

    /// Names and values.
    #[getter]
    fn metadata(&self) -> Vec<(String, String)> {
        self.rendered.metadata.clone()
    }

    /// Notes and warnings of this render: (level, place, text).
    #[getter]
    fn messages(&self) -> Vec<(&'static str, String, String)> {
        self.rendered.messages.iter().map(crate::scene::said).collect()
    }

    /// Passes that it holds.
    #[getter]
    fn passes_done(&self) -> u32 {
        self.rendered.passes_done
    }

    /// Passes that were asked for.
    #[getter]
    fn passes(&self) -> u32 {
        self.rendered.passes
    }

    /// Shadow rays.
    #[getter]
    fn segments(&self) -> u64 {
        self.rendered.segments
    }

    /// Viewing rays and rays onward.
    #[getter]
    fn rays(&self) -> u64 {
        self.rendered.rays
    }

    /// Hash of the pixels' bits.
    #[getter]
    fn hash(&self) -> u32 {
        self.rendered.hash
    }

    /// Mean standard error over mean, or None.
    fn relative_error(&self) -> Option<f64> {
        self.rendered.relative_error()
    }

    /// Writes an EXR or a PNG by its suffix, whole or not at all.
    fn save(&self, py: Python<'_>, path: &str) -> PyResult<()> {
        let (target, picture) = (Path::new(path), self.to_file());
        let written = match suffix(target).as_str() {
            "exr" => py.detach(|| file::write_exr(target, &picture, self.precision())),
            "png" => py.detach(|| file::write_png(target, &picture, &self.look)),
            _ => return Err(errors::value(format!("\"{path}\": a picture ends in .exr or .png"))),
        };
        written.map_err(|e| errors::write(&e))
    }

    /// The bytes of a PNG.
    fn png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = file::png_bytes(&self.to_file(), &self.look).map_err(errors::value)?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// All of it as plain values: what `from_parts` takes.
    #[expect(clippy::type_complexity, reason = "a tuple for pickle, spelled out once")]
    fn parts<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(
        Bound<'py, PyArray3<f32>>,
        Option<Bound<'py, PyArray3<f32>>>,
        Vec<(String, Bound<'py, PyArrayDyn<f32>>)>,
        Vec<(String, String)>,
        Counts,
    )> {
        let r = &self.rendered;
        let counts = (r.passes_done, r.passes, r.segments, r.rays, r.window);
        Ok((self.pixels(py)?, self.standard_error(py)?, self.aovs(py)?, self.metadata(), counts))
    }

    /// The picture that `parts` came from, or that was made elsewhere: its hash is that of its pixels.
    #[staticmethod]
    fn from_parts(
        pixels: PyReadonlyArray3<'_, f32>,
        standard_error: Option<PyReadonlyArray3<'_, f32>>,
        aovs: Vec<(String, PyReadonlyArrayDyn<'_, f32>)>,
        mut metadata: Vec<(String, String)>,
        counts: Counts,
    ) -> PyResult<Picture> {
        let [height, width, _] = *pixels.as_array().shape() else {
            return Err(errors::value("pixels: (H, W, 3)"));
        };
        let (passes_done, passes, segments, rays, window) = counts;
        let pixels = triples(&pixels);
        let hash = hash_of(&pixels);
        for (_, value) in metadata.iter_mut().filter(|(name, _)| name == "antumbra.pixel-hash") {
            *value = format!("{hash:08x}");
        }
        let plane = |(name, array): (String, PyReadonlyArrayDyn<'_, f32>)| {
            let array = array.as_array();
            (name, array.shape().get(2).copied().unwrap_or(1), array.iter().copied().collect())
        };
        let rendered = Rendered {
            width: width as u32,
            height: height as u32,
            pixels,
            standard_error: standard_error.as_ref().map(triples),
            aovs: aovs.into_iter().map(plane).collect(),
            metadata,
            messages: Vec::new(),
            passes_done,
            passes,
            segments,
            rays,
            hash,
            window,
        };
        let settings = settings_of(&rendered.metadata);
        Ok(Picture::new(rendered, &settings))
    }
}

/// The settings that a picture's metadata tells.
fn settings_of(metadata: &[(String, String)]) -> Settings {
    let mut settings = Settings::default();
    for (name, value) in metadata {
        if let Some(name) = name.strip_prefix("antumbra.") {
            // What is no setting there (version, hashes) is left out.
            let _ = settings.set(name, value);
        }
    }
    settings
}

fn triples(array: &PyReadonlyArray3<'_, f32>) -> Vec<[f32; 3]> {
    array.as_array().rows().into_iter().map(|row| [row[0], row[1], row[2]]).collect()
}

fn image(py: Python<'_>, [h, w]: [usize; 2], values: Vec<f32>) -> PyResult<Bound<'_, PyArray3<f32>>> {
    let array = Array3::from_shape_vec((h, w, 3), values).map_err(|e| errors::value(e.to_string()))?;
    Ok(array.into_pyarray(py))
}

fn suffix(path: &Path) -> String {
    path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase()
}

/// Reads an EXR, HDR or PNG as linear (H, W, 3) float32.
#[pyfunction]
pub fn read_picture<'py>(py: Python<'py>, path: &str) -> PyResult<Bound<'py, PyArray3<f32>>> {
    read_part(py, path).map(|(pixels, _)| pixels)
}

/// The same, and where it lies: x and y of its upper left pixel, width and height of the whole picture.
#[pyfunction]
pub fn read_part<'py>(py: Python<'py>, path: &str) -> PyResult<(Bound<'py, PyArray3<f32>>, [i64; 4])> {
    let picture = py.detach(|| file::read_picture(Path::new(path))).map_err(|e| errors::read(&e))?;
    let window = picture.window.unwrap_or(file::Window::of([picture.width, picture.height]));
    let part = [window.x.into(), window.y.into(), window.width.into(), window.height.into()];
    let shape = [picture.height as usize, picture.width as usize];
    Ok((image(py, shape, picture.pixels.into_flattened())?, part))
}

/// Writes an (H, W, 3) float32 picture of linear colours as a PNG or EXR, whole or not at all.
#[pyfunction]
pub fn write_picture(py: Python<'_>, path: &str, pixels: PyReadonlyArray3<'_, f32>) -> PyResult<()> {
    let [height, width, _] = *pixels.as_array().shape() else {
        return Err(errors::value("pixels: (H, W, 3)"));
    };
    let picture = file::Picture {
        width: width as u32,
        height: height as u32,
        pixels: triples(&pixels),
        ..file::Picture::default()
    };
    let target = Path::new(path);
    let written = match suffix(target).as_str() {
        "exr" => py.detach(|| file::write_exr(target, &picture, Precision::Float)),
        "png" => py.detach(|| file::write_png(target, &picture, &Look::default())),
        _ => return Err(errors::choice(format!("\"{path}\": a picture ends in .exr or .png"))),
    };
    written.map_err(|e| errors::write(&e))
}

/// Raises OSError if a file could not be written there. Leaves nothing behind.
#[pyfunction]
pub fn check_writable(path: &str) -> PyResult<()> {
    antumbra_io::picture::check_writable(Path::new(path)).map_err(|e: WriteError| errors::write(&e))
}
