//! Emitters: area (of a shape), point, spot, directional, constant, envmap; sunsky has a file of its own.

use std::sync::Arc;

use antumbra::light::{Directional, Environment, Point, Spot, SpotEdge};
use antumbra::texture::{Image, Texels};
use antumbra_math::{DVec3, Frame, Rgb, Transform};

use super::Reader;
use super::document::Element;
use crate::error::ReadError;
use crate::read::spectrum::Of;
use crate::read::texels;

/// Adds the light of an emitter; the transform takes it into the world.
type Make = for<'a> fn(&mut Reader<'a>, &'a Element, &Transform) -> Result<(), ReadError>;

/// Every emitter plugin that stands alone. To add one: a function and a line here.
const EMITTERS: [(&str, Make); 6] = [
    ("point", point),
    ("spot", spot),
    ("directional", directional),
    ("constant", constant),
    ("envmap", envmap),
    ("sunsky", super::sky::sunsky),
];

impl<'a> Reader<'a> {
    /// Adds a light.
    pub(super) fn emitter(&mut self, element: &'a Element) -> Result<(), ReadError> {
        let Some((_, make)) = EMITTERS.iter().find(|e| e.0 == element.plugin()) else {
            self.lacks(element, "left out");
            return Ok(());
        };
        let world = self.context.root.after(&element.transform("to_world")?);
        element.pass_over(&["sampling_weight", "id"]);
        make(self, element, &world)?;
        self.name_the_unread(element);
        Ok(())
    }

    /// What a shape radiates from its front, if it does.
    pub(super) fn area_emitter(&mut self, shape: &'a Element) -> Result<Option<Rgb>, ReadError> {
        let found = self.plugins(shape, "emitter")?;
        let Some(element) = found.first() else { return Ok(None) };
        if element.plugin() != "area" {
            self.lacks(element, "left out");
            return Ok(None);
        }
        element.property("sampling_weight");
        let radiance = self.amount(element, "radiance", 1.0)?;
        self.name_the_unread(element);
        Ok(Some(radiance))
    }

    /// An amount of light: not negative.
    fn amount(&mut self, element: &'a Element, name: &str, default: f32) -> Result<Rgb, ReadError> {
        let amount = self.color_of(element, name, default, Of::Light)?;
        if amount.0.iter().any(|c| *c < 0.0) {
            let what =
                format!("\"{name}\" of {} is {:?}: it must not be negative", element.words(), amount.0);
            return Err(element.at.error(what));
        }
        Ok(amount)
    }
}

fn name(element: &Element) -> &str {
    element.attribute("id")
}

/// `position`, or where the transform moves the origin.
fn point<'a>(reader: &mut Reader<'a>, element: &'a Element, world: &Transform) -> Result<(), ReadError> {
    let intensity = reader.amount(element, "intensity", 1.0)?;
    let position = element.vector("position")?;
    let position = position.map_or(world.translation, |p| reader.context.root.point(p)).as_vec3();
    reader.scene.light(name(element), Point { position, intensity });
    Ok(())
}

/// Along +z of its transform.
fn spot<'a>(reader: &mut Reader<'a>, element: &'a Element, world: &Transform) -> Result<(), ReadError> {
    let intensity = reader.amount(element, "intensity", 1.0)?;
    let cutoff = element.float("cutoff_angle", 20.0)?;
    let beam = element.float("beam_width", 0.75 * cutoff)?;
    if !(beam > 0.0 && beam <= cutoff && cutoff <= 90.0) {
        let what =
            format!("a cone from beam_width {beam}° to cutoff_angle {cutoff}°: 0 < beam ≤ cutoff ≤ 90");
        return Err(element.at.error(what));
    }
    let Some(forward) = world.vector(DVec3::Z).try_normalize() else {
        return Err(element.at.error("the transform of a spot is singular"));
    };
    let position = world.translation.as_vec3();
    let (inner, outer) = (beam.to_radians() as f32, cutoff.to_radians() as f32);
    let spot = Spot::new(position, forward.as_vec3(), intensity, inner, outer, None);
    reader.scene.light(name(element), Spot { edge: SpotEdge::Linear, ..spot });
    Ok(())
}

/// `direction` is where the light goes, or +z of its transform.
fn directional<'a>(
    reader: &mut Reader<'a>,
    element: &'a Element,
    world: &Transform,
) -> Result<(), ReadError> {
    let irradiance = reader.amount(element, "irradiance", 1.0)?;
    let given = element.vector("direction")?.map(|d| reader.context.root.vector(d));
    let direction = given.unwrap_or_else(|| world.vector(DVec3::Z)).try_normalize();
    let direction = direction.ok_or_else(|| element.at.error("the direction of the light is 0, 0, 0"))?;
    reader.scene.light(name(element), Directional::new(-direction.as_vec3(), irradiance));
    Ok(())
}

/// The same from everywhere.
fn constant<'a>(reader: &mut Reader<'a>, element: &'a Element, _: &Transform) -> Result<(), ReadError> {
    let radiance = reader.amount(element, "radiance", 1.0)?;
    reader.scene.light(name(element), Environment::constant(radiance));
    Ok(())
}

/// A latitude-longitude picture, turned by its transform.
fn envmap<'a>(reader: &mut Reader<'a>, element: &'a Element, world: &Transform) -> Result<(), ReadError> {
    let scale = element.float("scale", 1.0)?;
    element.property("mis_compensation");
    let file = element.filename()?;
    let fail = |why: String| element.at.error(format!("the picture \"{file}\": {why}"));
    let bytes = reader.open(file).map_err(|e| fail(e.to_string()))?;
    let image = texels::picture(&bytes, true, reader.context).map_err(fail)?;
    let axis = |v: DVec3| world.vector(v).try_normalize().map(|v| v.as_vec3());
    let (Some(s), Some(t), Some(n)) = (axis(DVec3::X), axis(DVec3::Y), axis(DVec3::Z)) else {
        return Err(element.at.error("the transform of the envmap is singular"));
    };
    if s.dot(t).abs().max(t.dot(n).abs()).max(n.dot(s).abs()) > 1e-3 {
        return Err(element.at.error("the transform of the envmap is not a rotation"));
    }
    let light = Environment::image(Arc::new(between_poles(image))).oriented(Frame { s, t, n });
    reader.scene.light(name(element), light.scaled(Rgb::grey(scale as f32)));
    Ok(())
}

/// Texels of an envmap in the rows that we need; beyond, the rows are only doubled.
const ENOUGH: u64 = 1 << 22;

/// Mitsuba lays the first and the last row of an envmap onto the poles, we lay them half a row below and above: rows
/// where ours are, by its interpolation, two to eight for each of its own so that the bends at its rows stay sharp.
fn between_poles(image: Image) -> Image {
    let (width, height) = (image.width, image.height);
    if height < 2 {
        return image;
    }
    let texels = u64::from(width) * u64::from(height);
    let each = [8, 4].into_iter().find(|n| texels * u64::from(*n) <= ENOUGH).unwrap_or(2);
    let rows = each * (height - 1);
    let mut texels = Vec::with_capacity(width as usize * rows as usize);
    for k in 0..rows {
        // Row k lies at j = (k + ½)/each of the file's rows.
        let (j, part) = (k / each, ((k % each) as f32 + 0.5) / each as f32);
        for x in 0..width {
            let (a, b) = (image.texel(x, j), image.texel(x, j + 1));
            texels.push([0, 1, 2].map(|c| a[c] + (b[c] - a[c]) * part));
        }
    }
    Image::new(width, rows, Texels::Float(texels)).unwrap_or(image)
}
