//! Lights: of their own, as shapes that shine, or from all around.

use antumbra::light::{Environment, Light, LightSurface, Rectangle, SpotEdge};
use antumbra::scene::Mesh;
use antumbra::texture::Image;
use antumbra_math::{DMat3, DVec3, Frame, Rgb, Transform, World};
use antumbra_trace::{Shape, Triangles};

use super::Writer;
use super::shape::{area, round};
use super::xml::Element;
use crate::write::light::{of_surface, sun_irradiance};
use crate::write::{environment, paint};

impl Writer<'_, '_> {
    /// All lights of the scene but for its emissive objects.
    pub(super) fn lights(&mut self) -> Result<Vec<Element>, String> {
        let scene = self.job.scene;
        let mut written = Vec::new();
        for (name, light) in &scene.lights {
            if light.is_environment() {
                continue;
            }
            let id = self.ids.give(name, "light");
            let place = format!("light \"{name}\"");
            if of_surface(light).is_some_and(|(_, both)| both) {
                self.both_sides(place.clone());
            }
            written.push(self.light(light, &place)?.with("id", id));
        }
        written.extend(self.environment()?);
        Ok(written)
    }

    fn light(&mut self, light: &Light, place: &str) -> Result<Element, String> {
        let from = |to_light: World, irradiance: Rgb| {
            let light = Element::plugin("emitter", "directional").place(
                "vector",
                "direction",
                (-to_light).to_array(),
            );
            light.rgb("irradiance", irradiance)
        };
        Ok(match light {
            Light::Point(l) => {
                let at = l.position.to_array();
                Element::plugin("emitter", "point")
                    .place("point", "position", at)
                    .rgb("intensity", l.intensity)
            }
            Light::Spot(l) => {
                if l.edge != SpotEdge::Linear || l.range.is_some() {
                    let what = "is a spot that falls off in another way than Mitsuba's: written with that";
                    self.warn(place, what);
                }
                let (eye, axis) = (l.position.as_dvec3(), l.direction.as_dvec3());
                let up = if axis.y.abs() < 0.9 { DVec3::Y } else { DVec3::X };
                // A beam of no width is not allowed.
                let beam = f64::from(l.inner).to_degrees().max(1e-3);
                let spot = Element::plugin("emitter", "spot").rgb("intensity", l.intensity);
                let spot =
                    spot.float("beam_width", beam).float("cutoff_angle", f64::from(l.outer).to_degrees());
                spot.looking(None, eye, eye + axis, up)
            }
            Light::Directional(l) => from(l.to_light, l.irradiance),
            Light::Sun(l) => {
                let what =
                    "has no size in Mitsuba: it shines from one direction, its shadows have hard edges";
                self.warn(place, what);
                from(l.to_light, sun_irradiance(l.radiance, l.half_angle))
            }
            Light::Rectangle(l) => rectangle(l).add(black()).add(area(l.radiance)),
            Light::Disk(l) => {
                let (center, normal) = (l.center.to_array(), l.normal.to_array());
                round(&Shape::Disk { center, normal, radius: l.radius }).add(black()).add(area(l.radiance))
            }
            Light::Sphere(l) => {
                let shape = Shape::Sphere { center: l.center.to_array(), radius: l.radius };
                round(&shape).add(black()).add(area(l.radiance))
            }
            Light::Triangle(l) => self.triangle(light.surface()).add(black()).add(area(l.radiance)),
            Light::Environment(_) => return Err("light from all around has its own place".into()),
        })
    }

    /// The triangles of a light.
    fn triangle(&mut self, surface: Option<LightSurface>) -> Element {
        let list = match surface {
            Some(LightSurface::Triangles(list)) => list,
            _ => Vec::new(),
        };
        let indices = (0..list.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let triangles = Triangles { vertices: list.into_flattened(), indices };
        let mesh = Mesh { triangles, ..Mesh::default() };
        let file = self.file("light", "ply", super::ply::bytes(&mesh, 0, None));
        Element::plugin("shape", "ply").string("filename", &file).boolean("face_normals", true)
    }

    /// Light from all around: one emitter.
    fn environment(&mut self) -> Result<Option<Element>, String> {
        let lights = &self.job.scene.lights;
        let all: Vec<&Environment> = environment::all(lights).collect();
        let name = lights.iter().find(|l| l.1.is_environment()).map_or("", |l| l.0.as_str());
        let id = self.ids.give(name, "environment");
        match all[..] {
            [] => Ok(None),
            [Environment { picture: None, radiance, .. }] => {
                Ok(Some(Element::plugin("emitter", "constant").with("id", id).rgb("radiance", *radiance)))
            }
            [Environment { picture: Some(picture), radiance, frame }] => {
                if picture.nearest() {
                    self.warn(
                        "",
                        "the texels of light from all around are patches: Mitsuba blends between them",
                    );
                }
                let (tint, scale) = if radiance.0 == [radiance.0[0]; 3] {
                    (Rgb::WHITE, radiance.0[0])
                } else {
                    (*radiance, 1.0)
                };
                let bytes = with_poles(picture.image(), tint)?;
                let envmap = self.envmap(bytes, id);
                let envmap = if scale == 1.0 { envmap } else { envmap.float("scale", scale) };
                Ok(Some(envmap.transform("to_world", &turn(frame))))
            }
            _ => {
                let image = environment::sum(&all)?;
                let bytes = with_poles(&image, Rgb::WHITE)?;
                Ok(Some(self.envmap(bytes, id)))
            }
        }
    }

    fn envmap(&mut self, bytes: Vec<u8>, id: String) -> Element {
        let file = self.file("environment", "exr", bytes);
        Element::plugin("emitter", "envmap").with("id", id).string("filename", &file)
    }
}

/// A surface that reflects nothing.
fn black() -> Element {
    Element::plugin("bsdf", "diffuse").rgb("reflectance", Rgb::BLACK)
}

/// From (−1, −1) to (1, 1), facing u × v.
fn rectangle(l: &Rectangle) -> Element {
    let [corner, u, v] = [l.corner, l.u, l.v].map(|p| p.as_dvec3());
    let (u, v) = (u * 0.5, v * 0.5);
    let linear = DMat3::from_cols(u, v, u.cross(v).normalize());
    Element::plugin("shape", "rectangle")
        .transform("to_world", &Transform { linear, translation: corner + u + v })
}

fn turn(frame: &Frame) -> Transform {
    let [x, y, z] = [frame.s, frame.t, frame.n].map(|v| v.as_dvec3());
    Transform { linear: DMat3::from_cols(x, y, z), translation: DVec3::ZERO }
}

/// Mitsuba lays the first and last row of an envmap onto the poles, we lay them half a row below and above: twice the rows
/// and one, each second one ours, hold the same light to the last bit between them.
fn with_poles(image: &Image, tint: Rgb) -> Result<Vec<u8>, String> {
    let (width, height) = (image.width, image.height);
    paint::exr([width, 2 * height + 1], &|x, k| {
        let row = |j: u32| Rgb(std::array::from_fn(|c| image.texel(x, j.min(height - 1))[c])) * tint;
        let Rgb([r, g, b]) = match k % 2 {
            1 => row(k / 2),
            _ => (row((k / 2).saturating_sub(1)) + row(k / 2)) * 0.5,
        };
        [r, g, b, 1.0]
    })
}
