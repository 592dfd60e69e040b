//! KHR_lights_punctual: points, spots and directional lights at nodes.

use antumbra::light::{Directional, Point, Spot};
use antumbra_math::{DVec3, Rgb, World, real};
use serde::Deserialize;

use super::Reader;
use super::document::{PunctualLight, SpotCone};
use super::material::named;
use super::node::Placed;
use crate::error::ReadError;

const NAME: &str = "KHR_lights_punctual";

impl Reader<'_> {
    /// Adds the light of a node; one that makes no sense is left out with a warning.
    pub(super) fn place_light(&mut self, at: &Placed) -> Result<(), ReadError> {
        let node = &self.doc.nodes[at.node];
        let Some(extension) = node.extensions.get(NAME) else { return Ok(()) };
        let list = self.doc.extensions.get(NAME).and_then(|e| e.get("lights"));
        let index = extension.get("light").and_then(|l| usize::try_from(l.as_u64()?).ok());
        let found = index.and_then(|i| Some((i, list?.get(i)?)));
        let Some((index, value)) = found else {
            let n = list.and_then(|l| l.as_array()).map_or(0, Vec::len);
            let named = extension.get("light").map_or("none".into(), |l| l.to_string());
            let what = format!("light {named} is named; there are {n}");
            return Err(ReadError::new(format!("node {}", at.node), what));
        };
        let light = PunctualLight::deserialize(value)
            .map_err(|e| ReadError::new(format!("{NAME} light {index}"), e.to_string()))?;
        let name = if node.name.is_empty() { &light.name } else { &node.name };
        let place = format!("{NAME} light {}", named(index, name));
        if light.kind == "point" && light.range.is_some() {
            self.said.warn(&place, "the range of point lights is not read: it shines on beyond");
        }
        if let Err(what) = self.add_light(at, name, &light) {
            self.said.warn(place, format!("{what}: left out"));
        }
        Ok(())
    }

    /// The light in its place; scale does not touch it.
    fn add_light(&mut self, at: &Placed, name: &str, light: &PunctualLight) -> Result<(), String> {
        let color = Rgb(light.color) * light.intensity;
        if !color.is_finite() || color.0.iter().any(|c| *c < 0.0) {
            return Err(format!("its intensity {} is negative or not finite", light.intensity));
        }
        let position = at.world.translation.as_vec3();
        // A light looks along −z of its node.
        let forward = at.world.vector(DVec3::NEG_Z).normalize_or_zero().as_vec3();
        if light.kind != "point" && forward == World::ZERO {
            return Err("its node has a singular transform".into());
        }
        match light.kind.as_str() {
            "point" => self.scene.light(name, Point { position, intensity: color }),
            "spot" => {
                let (inner, outer) = cone(&light.spot)?;
                let range = light.range.filter(|r| *r > 0.0);
                self.scene.light(name, Spot::new(position, forward, color, inner, outer, range));
            }
            "directional" => self.scene.light(name, Directional::new(-forward, color)),
            other => return Err(format!("its type \"{other}\" is unknown")),
        }
        Ok(())
    }
}

/// Inner and outer half-angle [rad].
fn cone(spot: &SpotCone) -> Result<(f32, f32), String> {
    let (inner, outer) = (spot.inner_cone_angle, spot.outer_cone_angle);
    if inner >= 0.0 && inner < outer && outer <= real::PI / 2.0 {
        return Ok((inner, outer));
    }
    Err(format!("its cone from {inner} to {outer} does not lie between 0 and π/2"))
}
