//! sunsky: a clear sky with its sun. Both programs have the dome of Hosek and Wilkie; the sun is our own.
//!
//! Mitsuba's z points up, its x south and its y west.

use std::sync::Arc;

use antumbra::light::sky::{Air, Sky, sun_position};
use antumbra::light::{Environment, Sun};
use antumbra::texture::{Image, Texels};
use antumbra_math::{DVec3, Frame, Rgb, Transform, real};

use super::Reader;
use super::document::Element;
use crate::error::ReadError;

/// Texels of the dome's picture around the horizon.
const WIDTH: u32 = 1024;
/// Our radiance over Mitsuba's, ∫ ȳ dλ of CIE 1931 [nm].
const UNIT: f64 = 106.857;
/// Angle across the sun whose radiance both programs know [degrees].
const APERTURE: f64 = 0.5338;

/// The dome and the sun.
pub(super) fn sunsky<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    world: &Transform,
) -> Result<(), ReadError> {
    element.pass_over(&["complex_sun"]);
    let to_sun = to_sun(element)?;
    let aperture = element.float("sun_aperture", APERTURE)?;
    let [of_sky, of_sun] = [element.float("sky_scale", 1.0)?, element.float("sun_scale", 1.0)?];
    if !(aperture > 0.0 && aperture <= 180.0 && of_sky >= 0.0 && of_sun >= 0.0) {
        let what =
            format!("a sun {aperture}° across, scales {of_sky} and {of_sun}: they must not be negative");
        return Err(element.at.error(what));
    }
    let albedo = f64::from(reader.color(element, "albedo", 0.3)?.mean());
    let turbidity = element.float("turbidity", 3.0)?;
    let half_angle = 0.5 * aperture.to_radians();
    let sky = Sky { elevation: real::asin(to_sun.z), azimuth: 0.0, turbidity, albedo, half_angle };
    let fail = |what: String| element.at.error(format!("{}: {what}", element.words()));
    if let Some(what) = sky.fault() {
        return Err(fail(what));
    }
    // Our picture has its sun toward −z.
    let level = DVec3::new(to_sun.x, to_sun.y, 0.0).try_normalize().unwrap_or(DVec3::X);
    let axis = |v: DVec3| world.vector(v).try_normalize().map(|v| v.as_vec3());
    let (Some(up), Some(back), Some(toward)) = (axis(DVec3::Z), axis(-level), axis(to_sun)) else {
        return Err(element.at.error("the transform of the sky is singular"));
    };
    let name = element.attribute("id");
    if of_sky > 0.0 {
        reader.context.textures.take(u64::from(WIDTH * WIDTH / 2), 12).map_err(fail)?;
        let picture = above(sky.picture(WIDTH, false).map_err(fail)?);
        let frame = Frame { s: up.cross(back), t: up, n: back };
        let dome = Environment::image(Arc::new(picture)).oriented(frame);
        reader.scene.light(name, dome.scaled(Rgb::grey((of_sky / UNIT) as f32)));
    }
    if of_sun > 0.0 {
        let versin = |angle: f64| 1.0 - real::cos(0.5 * angle.to_radians());
        let radiance = sky.sun().radiance * (of_sun / UNIT * versin(APERTURE) / versin(aperture)) as f32;
        reader.scene.light("sun", Sun { of_sky: true, ..Sun::new(toward, half_angle as f32, radiance) });
        let what = "the sun of a sunsky has our own radiance, after Preetham; its dome is that of Mitsuba";
        reader.said.note(element.at.words(), what);
    }
    Ok(())
}

/// Nothing shines from below the horizon.
fn above(image: Image) -> Image {
    let (width, height) = (image.width, image.height);
    let texel = |x, y| {
        let [r, g, b, _] = image.texel(x, y);
        if 2 * y < height { [r, g, b] } else { [0.0; 3] }
    };
    let texels =
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| texel(x, y)).collect();
    Image::new(width, height, Texels::Float(texels)).unwrap_or(image)
}

/// Unit vector toward the sun as z is up: given, or by place and time, a summer afternoon in Tokyo unless the file says otherwise.
fn to_sun(element: &Element) -> Result<DVec3, ReadError> {
    if let Some(direction) = element.vector("sun_direction")? {
        // It stands in the world, whatever the transform.
        let to_local = element.transform("to_world")?.inverse();
        let to_local = to_local.ok_or_else(|| element.at.error("the transform of the sky is singular"))?;
        let unit = to_local.vector(direction).try_normalize();
        return unit.ok_or_else(|| element.at.error("\"sun_direction\" is 0, 0, 0"));
    }
    let number = |name, default| element.float(name, default);
    let (latitude, longitude) = (number("latitude", 35.6894)?, number("longitude", 139.6917)?);
    let days = days(number("year", 2010.0)?, number("month", 7.0)?, number("day", 10.0)?);
    let hours = number("hour", 15.0)? - number("timezone", 9.0)?;
    let unix = ((days * 24.0 + hours) * 60.0 + number("minute", 0.0)?) * 60.0 + number("second", 0.0)?;
    let air = Air { pressure: 0.0, ..Air::default() };
    let sun = sun_position(unix, latitude.to_radians(), longitude.to_radians(), air);
    let level = real::cos(sun.elevation);
    let [south, west] = [-real::cos(sun.azimuth), -real::sin(sun.azimuth)];
    Ok(DVec3::new(south * level, west * level, real::sin(sun.elevation)))
}

/// Days since 1970-01-01 of a date of the Gregorian calendar.
fn days(year: f64, month: f64, day: f64) -> f64 {
    // Years that begin in March end with the leap day.
    let (year, month) = if month <= 2.0 { (year - 1.0, month + 9.0) } else { (year, month - 3.0) };
    let leaps = (year / 4.0).floor() - (year / 100.0).floor() + (year / 400.0).floor();
    365.0 * year + leaps + ((153.0 * month + 2.0) / 5.0).floor() + day - 1.0 - 719_468.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_counted_from_1970() {
        assert_eq!(
            [days(1970.0, 1.0, 1.0), days(2000.0, 2.0, 29.0), days(2000.0, 3.0, 1.0)],
            [0.0, 11016.0, 11017.0]
        );
    }
}
