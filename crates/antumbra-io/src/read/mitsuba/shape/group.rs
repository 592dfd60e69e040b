//! Shapes of shapes: shapegroup, which draws nothing itself, instance, which draws one, and merge.

use super::super::Reader;
use super::super::document::Element;
use super::Within;
use crate::error::ReadError;

/// Places what a shape holds.
type Place = for<'a> fn(&mut Reader<'a>, &'a Element, &Within<'a>) -> Result<(), ReadError>;

/// Every shape that holds others.
pub(super) const GROUPS: [(&str, Place); 3] =
    [("shapegroup", shapegroup), ("instance", instance), ("merge", merge)];

/// Shapes within shapes.
const DEEPEST: u32 = 16;
/// Bytes that a placed shape takes in memory, about.
const PLACED_BYTES: u64 = 512;

/// Waits for its instances.
fn shapegroup<'a>(_: &mut Reader<'a>, element: &'a Element, within: &Within<'a>) -> Result<(), ReadError> {
    match within.depth {
        0 => Ok(()),
        _ => Err(element.at.error("a shapegroup within another shape")),
    }
}

/// Draws the shapes of a group, under its own transform. Meshes are shared; a sphere stays one where nothing squeezes it.
fn instance<'a>(reader: &mut Reader<'a>, element: &'a Element, within: &Within<'a>) -> Result<(), ReadError> {
    if within.instance.is_some() {
        return Err(element
            .at
            .error("an instance within a shapegroup")
            .hint("Place its shapes there instead."));
    }
    let found = reader.plugins(element, "shape")?;
    let [group] = found[..] else {
        return Err(element.at.error(format!("an instance needs one shapegroup, {} are here", found.len())));
    };
    if group.plugin() != "shapegroup" {
        let what = format!("an instance of {}: a shapegroup is needed", group.words());
        return Err(element.at.error(what));
    }
    let world = within.world.after(&element.transform("to_world")?);
    reader.name_the_unread(element);
    let inside = Within { world, instance: Some(element), depth: within.depth + 1 };
    members(reader, group, element, &inside)
}

/// Draws its shapes as if they stood alone.
fn merge<'a>(reader: &mut Reader<'a>, element: &'a Element, within: &Within<'a>) -> Result<(), ReadError> {
    members(reader, element, element, &Within { depth: within.depth + 1, ..*within })
}

/// Places the shapes of a group for `asked`.
fn members<'a>(
    reader: &mut Reader<'a>,
    group: &'a Element,
    asked: &'a Element,
    within: &Within<'a>,
) -> Result<(), ReadError> {
    if within.depth > DEEPEST {
        let what = format!("shapes lie more than {DEEPEST} deep in each other, or in themselves");
        return Err(asked.at.error(what));
    }
    let shapes = reader.plugins(group, "shape")?;
    reader.name_the_unread(group);
    for shape in shapes {
        reader.context.take(1, PLACED_BYTES).map_err(|what| asked.at.error(what))?;
        reader.shape_within(shape, within)?;
    }
    Ok(())
}
