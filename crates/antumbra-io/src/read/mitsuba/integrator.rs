//! Integrators: a hint for how the picture is made.

use super::Reader;
use super::document::Element;
use crate::error::ReadError;

/// Suggests settings.
type Make = for<'a> fn(&mut Reader<'a>, &'a Element) -> Result<(), ReadError>;

/// Every integrator plugin that means something here. To add one: a function and a line here.
const INTEGRATORS: [(&str, Make); 3] = [("path", path), ("volpath", path), ("direct", direct)];

impl<'a> Reader<'a> {
    /// Takes the hint.
    pub(super) fn integrator(&mut self, element: &'a Element) -> Result<(), ReadError> {
        let Some((_, make)) = INTEGRATORS.iter().find(|i| i.0 == element.plugin()) else {
            element.children.iter().for_each(|c| c.used.set(true));
            self.lacks(element, "drawn by path");
            return Ok(());
        };
        make(self, element)?;
        if element.boolean("hide_emitters", false)? {
            self.said.warn(element.at.words(), "\"hide_emitters\" is not read: emitters are seen");
        }
        self.name_the_unread(element);
        Ok(())
    }
}

/// `max_depth` counts the emitter; −1 is without end.
fn path<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<(), ReadError> {
    element.property("rr_depth");
    reader.suggest(element, "estimator", "path".into())?;
    let depth = element.float("max_depth", -1.0)?;
    if depth >= 1.0 {
        return reader.suggest(element, "bounces", format!("{}", depth.min(1001.0) - 1.0));
    }
    reader.said.note(element.at.words(), "paths of any length are asked for: drawn up to `bounces`");
    Ok(())
}

/// Light points and directions, as many as the file asks for.
fn direct<'a>(reader: &mut Reader<'a>, element: &'a Element) -> Result<(), ReadError> {
    let both = element.count("shading_samples")?;
    let of = |name| element.count(name).map(|n| n.or(both).unwrap_or(1));
    let (lights, directions) = (of("emitter_samples")?, of("bsdf_samples")?);
    let estimator = match (lights, directions) {
        (_, 0) => "area",
        (0, _) => "hemisphere",
        _ => "mis",
    };
    reader.suggest(element, "estimator", estimator.into())?;
    reader.suggest(element, "shadow_rays", lights.max(directions).max(1).to_string())
}
