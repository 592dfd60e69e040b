//! Cameras with their films, and how the picture is made.

use antumbra::scene::{Camera, Projection};
use antumbra_math::real;

use super::Writer;
use super::xml::Element;

/// Pixels of a picture whose size nobody names.
const HEIGHT: u32 = 480;
const WIDTH: u32 = 640;

impl Writer<'_, '_> {
    /// What the scene asks for by name.
    fn suggested(&self, name: &str) -> Option<&str> {
        self.job.scene.suggested.iter().find(|s| s.0 == name).map(|s| s.1.as_str())
    }

    /// The estimator that the scene asks for; else paths of eight bounces.
    pub(super) fn integrator(&self) -> Element {
        let rays = self.suggested("shadow_rays").unwrap_or("1");
        let direct = |lights: &str, directions: &str| {
            let direct = Element::plugin("integrator", "direct");
            direct.integer("emitter_samples", lights).integer("bsdf_samples", directions)
        };
        match self.suggested("estimator") {
            Some("area") => direct(rays, "0"),
            Some("hemisphere") => direct("0", rays),
            Some("mis") => direct(rays, rays),
            _ => {
                let bounces = self.suggested("bounces").and_then(|b| b.parse::<u32>().ok()).unwrap_or(8);
                Element::plugin("integrator", "path").integer("max_depth", bounces.saturating_add(1))
            }
        }
    }

    /// The cameras of the scene, or one that sees everything.
    pub(super) fn cameras(&self) -> Vec<Camera> {
        let cameras = &self.job.scene.cameras;
        let bounds = self.job.bounds().filter(|_| cameras.is_empty());
        bounds.map_or_else(|| cameras.clone(), |[low, high]| vec![Camera::seeing(low, high)])
    }

    /// A camera; `first`: with the part of the picture that the scene asks for.
    pub(super) fn sensor(&mut self, camera: &Camera, first: bool) -> Element {
        let sized = |aspect: f64| [(f64::from(HEIGHT) * aspect + 0.5) as u32, HEIGHT];
        let [width, height] = camera.size.unwrap_or(camera.aspect.map_or([WIDTH, HEIGHT], sized));
        let aspect = f64::from(width) / f64::from(height);
        let mut scale = [1.0; 3];
        let (kind, fov) = match camera.projection {
            Projection::Perspective { vertical_fov } => {
                (if camera.lens.is_some() { "thinlens" } else { "perspective" }, Some(vertical_fov))
            }
            Projection::Orthographic { height } => {
                let half = 0.5 * height * aspect;
                scale = [half, half, 1.0];
                ("orthographic", None)
            }
        };
        if camera.mirrored {
            scale[0] = -scale[0];
        }
        let id = self.ids.give(&camera.name, "camera");
        let mut sensor = Element::plugin("sensor", kind).with("id", id);
        if let Some(fov) = fov {
            // To the last bit where the tangent of its half comes back.
            sensor = sensor.string("fov_axis", "y").float("fov", degrees(fov));
        }
        if let Some(lens) = camera.lens {
            sensor = sensor.float("aperture_radius", lens.radius).float("focus_distance", lens.focus);
        }
        for (name, shift) in ["x", "y"].into_iter().zip(camera.shift) {
            if shift != 0.0 {
                sensor = sensor.float(&format!("principal_point_offset_{name}"), shift);
            }
        }
        let axes = ["x", "y", "z"].into_iter().zip(scale);
        let scaled = axes.fold(Element::new("scale"), |e, (axis, s)| e.with(axis, s.to_string()));
        let before = (scale != [1.0; 3]).then_some(scaled);
        sensor = sensor.looking(before, camera.eye, camera.look_at, camera.up);
        let rays = self.suggested("viewing_rays").filter(|_| first).unwrap_or("16");
        let sampler = Element::plugin("sampler", "independent").integer("sample_count", rays);
        sensor.add(self.film([width, height], first)).add(sampler)
    }

    fn film(&self, [width, height]: [u32; 2], first: bool) -> Element {
        let mut film = Element::plugin("film", "hdrfilm").integer("width", width).integer("height", height);
        if let Some(crop) = self.suggested("crop").filter(|_| first) {
            let names = ["crop_offset_x", "crop_offset_y", "crop_width", "crop_height"];
            film =
                names.into_iter().zip(crop.split(',')).fold(film, |film, (n, x)| film.integer(n, x.trim()));
        }
        let known = self.suggested("filter").filter(|f| ["box", "tent", "gaussian"].contains(f));
        film.add(Element::plugin("rfilter", known.unwrap_or("gaussian")))
    }
}

/// The angle in degrees that reads as this one, if there is such a number beside the nearest.
fn degrees(angle: f64) -> f64 {
    let reads = |d: f64| 2.0 * real::atan(real::tan(0.5 * d.to_radians()));
    let near = angle.to_degrees();
    let mut tries = (-8i64..=8).map(|k| f64::from_bits(near.to_bits().wrapping_add_signed(k)));
    if reads(near) == angle { near } else { tries.find(|d| reads(*d) == angle).unwrap_or(near) }
}
