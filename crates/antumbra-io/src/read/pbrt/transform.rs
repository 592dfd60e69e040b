//! The current transform: what moves it, and the places that it remembers.

use antumbra_math::{DMat3, DVec3, Transform};

use super::Reader;
use super::text::At;
use crate::error::ReadError;
use crate::read::text::show;

impl Reader<'_> {
    /// The current transform after `step`, which acts first.
    fn moved(&mut self, at: &At, step: Transform) -> Result<(), ReadError> {
        self.set(at, self.state.world.after(&step))
    }

    fn set(&mut self, at: &At, to: Transform) -> Result<(), ReadError> {
        if !to.is_finite() {
            return Err(at.error("the transform is not finite"));
        }
        // What is only set for the end of the shutter's time is left out.
        if self.state.moves {
            self.state.world = to;
        }
        Ok(())
    }
}

pub(super) fn identity(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    reader.set(at, Transform::IDENTITY)
}

pub(super) fn translate(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let by = reader.text()?.numbers::<3>("Translate")?;
    reader.moved(at, Transform::translation(DVec3::from(by)))
}

pub(super) fn scale(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let by = DVec3::from(reader.text()?.numbers::<3>("Scale")?);
    reader.moved(at, Transform::linear(DMat3::from_diagonal(by)))
}

/// By degrees about an axis.
pub(super) fn rotate(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let [degrees, x, y, z] = reader.text()?.numbers::<4>("Rotate")?;
    let axis = DVec3::new(x, y, z).try_normalize();
    let axis = axis.ok_or_else(|| at.error("a rotation about the axis 0, 0, 0"))?;
    reader.moved(at, Transform::rotation(axis, degrees.to_radians()))
}

/// World → camera: eye, the point looked at, up; x to the right of who looks along z in pbrt's left-handed world.
pub(super) fn look_at(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let [a, b, c, d, e, f, g, h, i] = reader.text()?.numbers::<9>("LookAt")?;
    let (eye, look, up) = (DVec3::new(a, b, c), DVec3::new(d, e, f), DVec3::new(g, h, i));
    let forward = (look - eye).try_normalize();
    let forward = forward.ok_or_else(|| at.error("eye and the point looked at are the same"))?;
    let camera = Transform::looking(eye, forward, up);
    let camera = camera.ok_or_else(|| at.error("up points along the view: another one is needed"))?;
    let step = camera.inverse().ok_or_else(|| at.error("the transform is singular"))?;
    reader.moved(at, step)
}

/// Sixteen numbers, column by column.
fn matrix(reader: &mut Reader, at: &At, of: &str) -> Result<Transform, ReadError> {
    let m = reader.text()?.numbers::<16>(of)?;
    if [m[3], m[7], m[11]] != [0.0; 3] || m[15] == 0.0 {
        return Err(
            at.error(format!("{of} is not affine: the fourth number of each column is 0, of the last 1"))
        );
    }
    Ok(Transform::from_columns(&m.map(|x| x / m[15])))
}

pub(super) fn transform(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let to = matrix(reader, at, "Transform")?;
    reader.set(at, to)
}

pub(super) fn concat(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let step = matrix(reader, at, "ConcatTransform")?;
    reader.moved(at, step)
}

pub(super) fn remember(reader: &mut Reader, _: &At) -> Result<(), ReadError> {
    let name = reader.text()?.string("CoordinateSystem")?;
    reader.spaces.insert(name, reader.state.world);
    Ok(())
}

pub(super) fn recall(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let name = reader.text()?.string("CoordSysTransform")?;
    let known = reader.spaces.get(&name).copied();
    let to =
        known.ok_or_else(|| at.error(format!("no coordinate system is called {}", show(name.as_bytes()))))?;
    reader.set(at, to)
}

/// `All`, `StartTime` or `EndTime`: antumbra draws the start.
pub(super) fn active(reader: &mut Reader, at: &At) -> Result<(), ReadError> {
    let word = reader.text()?.word();
    reader.state.moves = match word.as_str() {
        "All" | "StartTime" => true,
        "EndTime" => {
            reader.said.warn(at.words(), "what moves is drawn where it is when the shutter opens");
            false
        }
        _ => return Err(at.error(format!("{} is none of All, StartTime, EndTime", show(word.as_bytes())))),
    };
    Ok(())
}
