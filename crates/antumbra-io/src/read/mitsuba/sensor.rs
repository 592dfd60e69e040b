//! Sensors: perspective, thinlens, orthographic.

use antumbra::scene::{Camera, Lens, Projection};
use antumbra_math::{DVec3, real};

use super::Reader;
use super::document::Element;
use crate::error::ReadError;

/// Adds the camera of a sensor with a film of this size.
type Make = for<'a> fn(&mut Reader<'a>, &'a Element, [u32; 2]) -> Result<(), ReadError>;

/// Every sensor plugin that is read. To add one: a function and a line here.
const SENSORS: [(&str, Make); 3] =
    [("perspective", perspective), ("thinlens", thinlens), ("orthographic", orthographic)];

impl<'a> Reader<'a> {
    /// Adds a camera; what its film asks for counts for the first one.
    pub(super) fn sensor(&mut self, element: &'a Element) -> Result<(), ReadError> {
        let Some((_, make)) = SENSORS.iter().find(|s| s.0 == element.plugin()) else {
            self.lacks(element, "left out");
            return Ok(());
        };
        let first = self.scene.cameras.is_empty();
        let size = self.film(element, first)?;
        make(self, element, size)?;
        self.name_the_unread(element);
        Ok(())
    }
}

/// A pinhole.
fn perspective<'a>(reader: &mut Reader<'a>, element: &'a Element, size: [u32; 2]) -> Result<(), ReadError> {
    element.pass_over(&["focus_distance"]);
    looking(reader, element, size, None)
}

/// A lens; it is in focus as far as the scene goes unless the file says otherwise.
fn thinlens<'a>(reader: &mut Reader<'a>, element: &'a Element, size: [u32; 2]) -> Result<(), ReadError> {
    let far = element.float("far_clip", 1e4)?;
    let (radius, focus) = (element.float("aperture_radius", 0.0)?, element.float("focus_distance", far)?);
    for (name, x, fits) in
        [("aperture_radius", radius, radius >= 0.0), ("focus_distance", focus, focus > 0.0)]
    {
        if !(fits && x.is_finite()) {
            let what = format!("\"{name}\" = {x} of {}: it must be above 0", element.words());
            return Err(element.at.error(what));
        }
    }
    looking(reader, element, size, Some(Lens { radius, focus }))
}

/// Parallel rays: the picture is as wide as −1 to 1 along x and, times its height over its width, as high along y.
fn orthographic<'a>(reader: &mut Reader<'a>, element: &'a Element, size: [u32; 2]) -> Result<(), ReadError> {
    let world = reader.context.root.after(&element.transform("to_world")?);
    let [wide, high] = [DVec3::X, DVec3::Y].map(|axis| world.vector(axis).length());
    // Hand-written matrices keep four digits.
    if (wide - high).abs() > 1e-4 * high {
        let what = "its pixels are not square: drawn with square ones, as wide as asked for";
        reader.said.warn(element.at.words(), what);
    }
    let height = 2.0 * wide / (f64::from(size[0]) / f64::from(size[1]));
    if !(height > 0.0 && height.is_finite()) {
        return Err(element.at.error("the sensor's transform is singular"));
    }
    placed(reader, element, size, (Projection::Orthographic { height }, None))
}

/// Adds a pinhole or a lens.
fn looking<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    size: [u32; 2],
    lens: Option<Lens>,
) -> Result<(), ReadError> {
    let [w, h] = size.map(f64::from);
    let half = half_height(element, w, h)?;
    placed(reader, element, size, (Projection::Perspective { vertical_fov: 2.0 * real::atan(half) }, lens))
}

/// Adds a camera that looks along z.
fn placed<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    size: [u32; 2],
    (projection, lens): (Projection, Option<Lens>),
) -> Result<(), ReadError> {
    for name in ["near_clip", "far_clip"] {
        if element.has(name) {
            reader.said.note(element.at.words(), format!("\"{name}\" is not read: nothing is cut off"));
        }
    }
    element.pass_over(&["shutter_open", "shutter_close"]);
    let shift = |name| element.float(name, 0.0);
    let shift = [shift("principal_point_offset_x")?, shift("principal_point_offset_y")?];
    let world = reader.context.root.after(&element.transform("to_world")?);
    let axis = |v: DVec3| world.vector(v).try_normalize();
    let (Some(forward), Some(up)) = (axis(DVec3::Z), axis(DVec3::Y)) else {
        return Err(element.at.error("the sensor's transform is singular"));
    };
    let (eye, scale) = (world.translation, world.vector(DVec3::Z).length());
    // The distance to the point looked at is only a matter of digits: as far as the eye stands from 0.
    let far = eye.length().max(1.0);
    let camera = Camera {
        name: element.attribute("id").into(),
        up,
        // A transform that scales the sensor scales its lens.
        lens: lens.map(|l| Lens { radius: l.radius * scale, focus: l.focus * scale }),
        shift,
        mirrored: world.mirrors(),
        projection,
        ..Camera::perspective(eye, eye + forward * far, 40.0)
    };
    reader.scene.cameras.push(camera.sized(size[0], size[1]));
    Ok(())
}

/// Half the height of the picture at distance 1.
fn half_height(element: &Element, w: f64, h: f64) -> Result<f64, ReadError> {
    let fits = |fov: f64| fov > 0.0 && fov < 180.0;
    let Some(fov) = element.number("fov")? else {
        let text = element.string("focal_length")?.unwrap_or("50mm");
        let length = element.one(text.trim_end_matches("mm").trim())?;
        if length <= 0.0 {
            return Err(element.at.error(format!("a focal length of {length} mm: it must be above 0")));
        }
        // Against the diagonal of 35-mm film, 36 × 24 mm.
        let diagonal = (36f64 * 36.0 + 24.0 * 24.0).sqrt() / (2.0 * length);
        return Ok(diagonal * h / (w * w + h * h).sqrt());
    };
    if !fits(fov) {
        return Err(element.at.error(format!("\"fov\" = {fov}: an angle between 0 and 180 is needed")));
    }
    let half = real::tan(0.5 * fov.to_radians());
    Ok(match element.choice("fov_axis", &["x", "y", "diagonal", "smaller", "larger"])? {
        "y" => half,
        "diagonal" => half * h / (w * w + h * h).sqrt(),
        "smaller" if h < w => half,
        "larger" if h >= w => half,
        _ => half * h / w,
    })
}
