//! Lights: punctual ones at nodes, area lights as emissive meshes, light from all around as a picture beside the file.

use antumbra::light::{Light, LightSurface, SpotEdge};
use antumbra::scene::{Emission, Material, Mesh};
use antumbra_math::{DVec3, Rgb, Transform, Vec3};
use antumbra_trace::Triangles;
use serde_json::{Value, json};

use super::mesh::Source;
use super::{Writer, number, numbers};
use crate::write::light::{of_surface, split, sun_irradiance};
use crate::write::{environment, solids};

/// Points, spots and directional lights.
pub(super) const PUNCTUAL: &str = "KHR_lights_punctual";

impl Writer<'_, '_> {
    /// All lights of the scene but for its emissive objects.
    pub(super) fn lights(&mut self) -> Result<(), String> {
        let scene = self.job.scene;
        for (i, (name, light)) in scene.lights.iter().enumerate() {
            let place = format!("light \"{name}\"");
            match light {
                Light::Point(l) => self.punctual(name, "point", l.intensity, at(l.position), None),
                Light::Spot(l) => {
                    if l.edge != SpotEdge::Smooth {
                        let what =
                            "is a spot whose edge falls off in another way than glTF's: written with that";
                        self.warn(place, what);
                    }
                    let cone = json!({"innerConeAngle": number(l.inner), "outerConeAngle": number(l.outer)});
                    let mut node = at(l.position);
                    node["rotation"] = facing(l.direction);
                    self.punctual(name, "spot", l.intensity, node, Some((cone, l.range)));
                }
                Light::Directional(l) => {
                    let node = json!({"rotation": facing(-l.to_light)});
                    self.punctual(name, "directional", l.irradiance, node, None);
                }
                Light::Sun(l) => {
                    let what =
                        "has no size in glTF: it shines from one direction, its shadows have hard edges";
                    self.warn(place, what);
                    let irradiance = sun_irradiance(l.radiance, l.half_angle);
                    let node = json!({"rotation": facing(-l.to_light)});
                    self.punctual(name, "directional", irradiance, node, None);
                }
                Light::Environment(_) => {}
                Light::Triangle(_) | Light::Rectangle(_) | Light::Disk(_) | Light::Sphere(_) => {
                    self.area(i, name, light)?;
                }
            }
        }
        self.environment()
    }

    fn punctual(
        &mut self,
        name: &str,
        kind: &str,
        amount: Rgb,
        mut node: Value,
        spot: Option<(Value, Option<f32>)>,
    ) {
        let (color, intensity) = split(amount);
        let mut light = json!({"type": kind, "color": numbers(color.0), "intensity": number(intensity)});
        if let Some((cone, range)) = spot {
            light["spot"] = cone;
            if let Some(range) = range {
                light["range"] = number(range);
            }
        }
        if !name.is_empty() {
            light["name"] = json!(name);
        }
        node["extensions"] = json!({PUNCTUAL: {"light": self.lights.len()}});
        self.lights.push(light);
        self.node(name, node);
    }

    /// An area light as a black mesh that shines.
    fn area(&mut self, index: usize, name: &str, light: &Light) -> Result<(), String> {
        let Some((surface, (radiance, both_sides))) = light.surface().zip(of_surface(light)) else {
            return Ok(());
        };
        let emission = Some(Emission { radiance, both_sides });
        let look = Material { emission, ..Material::diffuse(Rgb::BLACK) }.named(name);
        let material = self.add(&look, true)?;
        match surface {
            LightSurface::Triangles(list) => {
                let vertices = list.iter().flatten().copied().collect();
                let indices = (0..list.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
                let mesh = Mesh { triangles: Triangles { vertices, indices }, ..Mesh::default() };
                // Objects take the numbers from 0 on.
                let id = self.mesh_of(Source::Own(usize::MAX - index), &mesh, material)?;
                self.place(name, id, &Transform::IDENTITY);
            }
            LightSurface::Shape(shape) => {
                let (solid, at) = solids::of(&shape, true);
                let what = format!("is a {} that shines: written as a mesh of triangles", solid.name());
                self.warn(format!("light \"{name}\""), what);
                let id = self.mesh_of(Source::Solid(solid), &solid.mesh(), material)?;
                self.place(name, id, &at);
            }
        }
        Ok(())
    }

    /// Light from all around lies beside the file, since the format has no place for it.
    fn environment(&mut self) -> Result<(), String> {
        let lights = &self.job.scene.lights;
        let all: Vec<_> = environment::all(lights).collect();
        // Whoever reads the file gives it the default sky again.
        if all.is_empty() || self.job.sky_is_default {
            return Ok(());
        }
        let name = format!("{}-environment.exr", self.job.stem);
        let bytes = environment::exr(&all)?;
        self.job.file(&name, bytes);
        let what =
            format!("light from all around has no place in glTF: it lies beside, for `environment` = {name}");
        self.warn("", what);
        Ok(())
    }
}

/// A node at a place.
fn at(p: Vec3) -> Value {
    json!({"translation": numbers(p.to_array())})
}

/// The unit quaternion that turns −z to a direction.
fn facing(direction: Vec3) -> Value {
    let d = direction.as_dvec3().normalize();
    let (axis, w) = (DVec3::NEG_Z.cross(d), 1.0 - d.z);
    let length = (axis.length_squared() + w * w).sqrt();
    if length < 1e-9 {
        return json!([0.0, 1.0, 0.0, 0.0]);
    }
    json!([axis.x / length, axis.y / length, axis.z / length, w / length])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_turn_to_where_a_light_shines() {
        for d in [Vec3::X, Vec3::Z, Vec3::NEG_Z, Vec3::new(0.6, -0.8, 0.0), Vec3::new(1e-6, 0.0, 1.0)] {
            let q: Vec<f64> = serde_json::from_value(facing(d)).unwrap_or_default();
            let turn = Transform::from_trs(DVec3::ZERO, [q[0], q[1], q[2], q[3]], DVec3::ONE);
            assert!(turn.vector(DVec3::NEG_Z).abs_diff_eq(d.as_dvec3().normalize(), 1e-9), "{d}");
        }
    }
}
