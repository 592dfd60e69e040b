//! `Camera`, `Film`, `Sampler`, `PixelFilter`, `Integrator`: the view, and settings that the file asks for.

use antumbra::scene::{Camera, Lens, Projection};
use antumbra::settings::Settings;
use antumbra_math::{DVec3, Transform, real};

use super::Reader;
use super::parameters::Parameters;
use crate::error::ReadError;

/// What stands before `WorldBegin` and waits for it, since its order is free.
#[derive(Default)]
pub(super) struct View {
    /// The camera with its plugin and world → camera.
    pub camera: Option<(Parameters, String, Transform)>,
    /// The film.
    pub film: Option<Parameters>,
}

impl Reader<'_> {
    /// Adds the camera and the size of its picture.
    pub(super) fn look(&mut self) -> Result<(), ReadError> {
        let size = match self.view.film.take() {
            Some(film) => self.film(&film)?,
            None => [1280, 720],
        };
        let Some((p, plugin, to_camera)) = self.view.camera.take() else { return Ok(()) };
        if !["perspective", "orthographic"].contains(&plugin.as_str()) {
            self.lacks(&p, "seen by a camera that shows the whole scene");
            return Ok(());
        }
        let camera = to_camera.inverse().ok_or_else(|| p.error("the transform of the camera is singular"))?;
        let world = self.context.root.after(&camera);
        let (eye, forward) = (world.translation, world.vector(DVec3::Z));
        let scale = forward.length();
        let (half, shift) = self.window(&p, size)?;
        let projection = if plugin == "perspective" {
            let fov = p.float("fov", 90.0)?;
            if !(fov > 0.0 && fov < 180.0) {
                return Err(p.error(format!("\"fov\" is {fov}: an angle between 0 and 180 is needed")));
            }
            Projection::Perspective {
                vertical_fov: 2.0 * real::atan(half * real::tan(0.5 * fov.to_radians())),
            }
        } else {
            Projection::Orthographic { height: 2.0 * half * scale }
        };
        let lens = self.lens(&p, scale)?;
        p.pass_over(&["shutteropen", "shutterclose"]);
        self.name_the_unread(&p);
        // The distance to the point looked at is only a matter of digits: as far as the eye stands from 0.
        let far = eye.length().max(1.0);
        let seen = Camera::perspective(eye, eye + forward / scale * far, 40.0);
        // pbrt's camera has x to its right, y up, z ahead: in our right-handed world its transform mirrors.
        let mirrored = !world.mirrors();
        let camera = Camera { up: world.vector(DVec3::Y), projection, lens, shift, mirrored, ..seen };
        self.scene.cameras.push(camera.sized(size[0], size[1]));
        Ok(())
    }

    /// Half the height of the window on the picture, whose shorter side is 2, and how far its middle lies off.
    fn window(&mut self, p: &Parameters, [w, h]: [u32; 2]) -> Result<(f64, [f64; 2]), ReadError> {
        let aspect = f64::from(w) / f64::from(h);
        let asked = p.float("frameaspectratio", aspect)?;
        let [x0, x1, y0, y1] = match p.list("screenwindow")? {
            None if asked > 1.0 => [-asked, asked, -1.0, 1.0],
            None => [-1.0, 1.0, -1.0 / asked, 1.0 / asked],
            Some([x0, x1, y0, y1]) => [*x0, *x1, *y0, *y1],
            Some(all) => {
                return Err(p.error(format!("\"screenwindow\" takes four numbers, {} are here", all.len())));
            }
        };
        let (width, height) = (x1 - x0, y1 - y0);
        if !(width > 0.0 && height > 0.0 && width.is_finite() && height.is_finite()) {
            return Err(p.error("\"screenwindow\" is empty: it is x0 x1 y0 y1"));
        }
        if (width / height / aspect - 1.0).abs() > 1e-3 {
            let what = "the window of the camera has another aspect than its picture: drawn by its height";
            self.said.warn(p.at.words(), what);
        }
        Ok((0.5 * height, [0.5 * (x0 + x1) / width, -0.5 * (y0 + y1) / height]))
    }

    fn lens(&mut self, p: &Parameters, scale: f64) -> Result<Option<Lens>, ReadError> {
        let radius = p.float("lensradius", 0.0)?;
        let focus = p.positive("focaldistance", 1e6)?;
        if radius < 0.0 {
            return Err(p.error(format!("\"lensradius\" is {radius}: it must not be negative")));
        }
        Ok((radius > 0.0).then_some(Lens { radius: radius * scale, focus: focus * scale }))
    }

    /// The size of the picture; suggests its part.
    fn film(&mut self, p: &Parameters) -> Result<[u32; 2], ReadError> {
        p.pass_over(&["filename", "diagonal", "savefp16", "sensor", "maxcomponentvalue", "nbuckets"]);
        p.pass_over(&["lambdamin", "lambdamax", "coordinatesystem"]);
        let size = [p.count("xresolution")?.unwrap_or(1280), p.count("yresolution")?.unwrap_or(720)];
        let [w, h] = size;
        let sized = Settings::default().set("size", &format!("{w}x{h}"));
        sized.map_err(|e| p.error(format!("a film of {w} x {h} pixels: {}", e.what)))?;
        let exposure = p.float("exposuretime", 1.0)? * p.float("iso", 100.0)? / 100.0;
        if exposure != 1.0 {
            let what = format!("the exposure of the film ({exposure} of the usual) is left out");
            self.said.warn(p.at.words(), what);
        }
        if p.get("whitebalance").is_some() {
            self.said.warn(p.at.words(), "\"whitebalance\" is not read: colours are those of sRGB");
        }
        let part = match (p.list("cropwindow")?, p.list("pixelbounds")?) {
            (_, Some([x0, x1, y0, y1])) => Some([*x0, *x1, *y0, *y1]),
            (Some([x0, x1, y0, y1]), _) => {
                let (w, h) = (f64::from(w), f64::from(h));
                Some([(x0 * w).ceil(), (x1 * w).ceil(), (y0 * h).ceil(), (y1 * h).ceil()])
            }
            _ => None,
        };
        if let Some([x0, x1, y0, y1]) = part {
            if !(0.0 <= x0 && x0 < x1 && x1 <= f64::from(w) && 0.0 <= y0 && y0 < y1 && y1 <= f64::from(h)) {
                return Err(p.error(format!("the part {x0} {x1} {y0} {y1} does not lie in {w} x {h} pixels")));
            }
            self.suggest(p, "crop", format!("{x0},{y0},{},{}", x1 - x0, y1 - y0))?;
        }
        self.name_the_unread(p);
        Ok(size)
    }

    /// Suggests viewing rays.
    pub(super) fn sampler(&mut self, p: &Parameters) -> Result<(), ReadError> {
        p.pass_over(&["seed", "randomization", "jitter"]);
        let each = (p.count("xsamples")?.unwrap_or(4), p.count("ysamples")?.unwrap_or(4));
        let count = if p.words.contains("stratified") { each.0.saturating_mul(each.1) } else { 16 };
        let count = p.count("pixelsamples")?.unwrap_or(count);
        self.name_the_unread(p);
        self.suggest(p, "viewing_rays", count.max(1).to_string())
    }

    /// Suggests the pixel filter.
    pub(super) fn filter(&mut self, p: &Parameters, plugin: &str) -> Result<(), ReadError> {
        p.pass_over(&["xradius", "yradius", "sigma", "B", "C", "tau"]);
        self.name_the_unread(p);
        let name = match plugin {
            "box" => "box",
            "triangle" => "tent",
            "gaussian" => "gaussian",
            _ => {
                let what = format!(
                    "the filter \"{plugin}\" has negative lobes or is unknown: drawn with blackman-harris"
                );
                self.said.warn(p.at.words(), what);
                return Ok(());
            }
        };
        self.said.note(p.at.words(), "the width of the pixel filter is not read: drawn with its usual one");
        self.suggest(p, "filter", name.into())
    }

    /// Suggests the estimator and the length of paths.
    pub(super) fn integrator(&mut self, p: &Parameters, plugin: &str) -> Result<(), ReadError> {
        p.pass_over(&[
            "regularize",
            "lightsampler",
            "rrthreshold",
            "samplelights",
            "samplebsdf",
            "cossample",
        ]);
        p.pass_over(&["visualizestrategies", "visualizeweights", "photonsperiteration", "radius", "seed"]);
        p.pass_over(&["mutationsperpixel", "bootstrapsamples", "chains", "sigma", "largestepprobability"]);
        match plugin {
            "path" | "simplepath" | "volpath" | "simplevolpath" | "bdpt" | "mlt" | "sppm" | "lightpath" => {
                self.suggest(p, "estimator", "path".into())?;
            }
            "randomwalk" => self.suggest(p, "estimator", "path-hemisphere".into())?,
            "ambientocclusion" => {
                self.suggest(p, "estimator", "ambient-occlusion".into())?;
                if let Some(radius) = p.number("maxdistance")?.filter(|r| r.is_finite() && *r > 0.0) {
                    self.suggest(p, "radius", radius.to_string())?;
                }
            }
            _ => self.lacks(p, "drawn by path"),
        }
        let depth = p.count("maxdepth")?.unwrap_or(5);
        self.name_the_unread(p);
        if plugin == "ambientocclusion" {
            Ok(())
        } else {
            self.suggest(p, "bounces", depth.min(1000).to_string())
        }
    }

    /// A setting that the file asks for; a person's own stays above it.
    fn suggest(&mut self, p: &Parameters, name: &'static str, value: String) -> Result<(), ReadError> {
        let checked = Settings::default().set(name, &value);
        checked.map_err(|e| p.error(e.what))?;
        self.scene.suggested.retain(|s| s.0 != name);
        self.scene.suggested.push((name, value));
        Ok(())
    }
}
