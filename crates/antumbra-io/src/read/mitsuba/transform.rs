//! `<transform>`: its steps in order, as one affine map.

use antumbra_math::{DMat3, DVec3, Transform};

use super::document::Element;
use crate::error::ReadError;

impl Element {
    /// The transform that is called `name`, or the identity.
    pub fn transform(&self, name: &str) -> Result<Transform, ReadError> {
        let found = self.children.iter().find(|c| c.tag == "transform" && c.given("name") == Some(name));
        let Some(found) = found else { return Ok(Transform::IDENTITY) };
        found.used.set(true);
        let mut whole = Transform::IDENTITY;
        for step in &found.children {
            whole = step.step()?.after(&whole);
        }
        if whole.is_finite() { Ok(whole) } else { Err(found.at.error("the transform is not finite")) }
    }

    /// A transform of texture coordinates: u′ = m0·u + m1·v + m2, v′ = m3·u + m4·v + m5.
    pub fn uv_transform(&self) -> Result<[f32; 6], ReadError> {
        let found = self.children.iter().find(|c| c.tag == "transform" && c.given("name") == Some("to_uv"));
        let mut whole = Transform::IDENTITY;
        if let Some(found) = found {
            found.used.set(true);
            for step in &found.children {
                let step = match step.list("value")?[..] {
                    // A 3 × 3 matrix moves by its third column.
                    [a, b, c, d, e, f, _, _, _] if step.tag == "matrix" => Transform {
                        linear: DMat3::from_cols(DVec3::new(a, d, 0.0), DVec3::new(b, e, 0.0), DVec3::Z),
                        translation: DVec3::new(c, f, 0.0),
                    },
                    _ => step.step()?,
                };
                whole = step.after(&whole);
            }
        }
        let (m, t) = (whole.linear, whole.translation);
        Ok([m.x_axis.x, m.y_axis.x, t.x, m.x_axis.y, m.y_axis.y, t.y].map(|x| x as f32))
    }

    /// One step.
    fn step(&self) -> Result<Transform, ReadError> {
        match self.tag.as_str() {
            "translate" => Ok(Transform::translation(self.xyz(0.0)?)),
            "scale" => {
                let by = match self.list("value")?[..] {
                    [s] => DVec3::splat(s),
                    _ => self.xyz(1.0)?,
                };
                Ok(Transform::linear(DMat3::from_diagonal(by)))
            }
            "rotate" => {
                let [degrees] = self.numbers::<1>("angle")?;
                let axis = self.xyz(0.0)?.try_normalize();
                let axis = axis.ok_or_else(|| self.at.error("a rotation about the axis 0, 0, 0"))?;
                Ok(Transform::rotation(axis, degrees.to_radians()))
            }
            "matrix" => self.matrix(),
            "lookat" => self.look_at(),
            tag => Err(self
                .at
                .error(format!("<{tag}> is no step of a transform"))
                .hint("translate, rotate, scale, matrix and lookat are.")),
        }
    }

    /// 16 numbers, row by row, or the 9 of its linear part.
    fn matrix(&self) -> Result<Transform, ReadError> {
        let m = self.list("value")?;
        let row = |i: usize, n: usize| DVec3::new(m[i], m[i + n], m[i + 2 * n]);
        match m.len() {
            9 => Ok(Transform::linear(DMat3::from_cols(row(0, 3), row(1, 3), row(2, 3)))),
            16 if m[12..15] == [0.0; 3] && m[15] == 1.0 => Ok(Transform {
                linear: DMat3::from_cols(row(0, 4), row(1, 4), row(2, 4)),
                translation: row(3, 4),
            }),
            16 => Err(self.at.error("the last row of a matrix is 0 0 0 1: others are not read")),
            n => Err(self.at.error(format!("a matrix of {n} numbers; 16 or 9 are needed"))),
        }
    }

    /// +z toward the target, +x to the left.
    fn look_at(&self) -> Result<Transform, ReadError> {
        let vector = |name| self.numbers::<3>(name).map(DVec3::from);
        let (origin, target) = (vector("origin")?, vector("target")?);
        let forward = (target - origin).try_normalize();
        let forward = forward.ok_or_else(|| self.at.error("origin and target are the same point"))?;
        let up = match self.given("up") {
            Some(_) => vector("up")?,
            None if forward.y.abs() < 0.999 => DVec3::Y,
            None => DVec3::Z,
        };
        let look = Transform::looking(origin, forward, up);
        look.ok_or_else(|| self.at.error("up points along the view: another one is needed"))
    }
}
