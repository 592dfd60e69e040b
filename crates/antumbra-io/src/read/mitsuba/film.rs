//! What a sensor's film, sampler and filter ask for, in the words of our settings.

use antumbra::settings::Settings;

use super::Reader;
use super::document::Element;
use crate::error::ReadError;

impl<'a> Reader<'a> {
    /// A setting that the file asks for; a person's own stays above it.
    pub(super) fn suggest(
        &mut self,
        at: &Element,
        name: &'static str,
        value: String,
    ) -> Result<(), ReadError> {
        let checked = Settings::default().set(name, &value);
        checked.map_err(|e| at.at.error(e.what))?;
        self.scene.suggested.retain(|s| s.0 != name);
        self.scene.suggested.push((name, value));
        Ok(())
    }

    /// The size of the picture; suggests its part, its filter and the samples of the first sensor.
    pub(super) fn film(&mut self, sensor: &'a Element, first: bool) -> Result<[u32; 2], ReadError> {
        for sampler in self.plugins(sensor, "sampler")? {
            sampler.pass_over(&["seed", "jitter"]);
            if let Some(count) = sampler.count("sample_count")?.filter(|_| first) {
                self.suggest(sampler, "viewing_rays", count.to_string())?;
            }
            self.name_the_unread(sampler);
        }
        let found = self.plugins(sensor, "film")?;
        let Some(film) = found.first() else { return Ok([768, 576]) };
        // How Mitsuba writes its own files.
        film.pass_over(&["file_format", "pixel_format", "component_format", "banner"]);
        film.pass_over(&["high_quality_edges", "sample_border", "compensate"]);
        let size = [film.count("width")?.unwrap_or(768), film.count("height")?.unwrap_or(576)];
        let [w, h] = size;
        let sized = Settings::default().set("size", &format!("{w}x{h}"));
        sized.map_err(|e| {
            let why = e.what.split_once(": ").map_or(e.what.as_str(), |w| w.1);
            film.at.error(format!("a film of {w} x {h} pixels: {why}"))
        })?;
        if first {
            self.crop(film, size)?;
            self.filter(film)?;
        }
        self.name_the_unread(film);
        Ok(size)
    }

    fn crop(&mut self, film: &Element, size: [u32; 2]) -> Result<(), ReadError> {
        let (x, y) = (film.count("crop_offset_x")?, film.count("crop_offset_y")?);
        let (w, h) = (film.count("crop_width")?, film.count("crop_height")?);
        if [x, y, w, h].iter().all(Option::is_none) {
            return Ok(());
        }
        let (x, y, w, h) = (x.unwrap_or(0), y.unwrap_or(0), w.unwrap_or(size[0]), h.unwrap_or(size[1]));
        let fits = |from: u32, length: u32, all: u32| u64::from(from) + u64::from(length) <= u64::from(all);
        if w == 0 || h == 0 || !fits(x, w, size[0]) || !fits(y, h, size[1]) {
            let what = format!("the crop {x},{y},{w},{h} does not lie in {} x {} pixels", size[0], size[1]);
            return Err(film.at.error(what));
        }
        self.suggest(film, "crop", format!("{x},{y},{w},{h}"))
    }

    fn filter(&mut self, film: &'a Element) -> Result<(), ReadError> {
        let found = self.plugins(film, "rfilter")?;
        // A Gaussian is what Mitsuba takes where the file says nothing.
        let (at, name) = found.first().map_or((film, "gaussian"), |f| (f, f.plugin()));
        match name {
            "box" | "tent" | "gaussian" => {
                if at.float("stddev", 0.5)? != 0.5 || at.float("radius", 1.0)? != 1.0 {
                    self.said.warn(
                        at.at.words(),
                        "the width of the pixel filter is not read: drawn with its usual one",
                    );
                }
                self.suggest(at, "filter", name.into())
            }
            _ => {
                let what = format!(
                    "the filter \"{name}\" has negative lobes or is unknown: drawn with blackman-harris"
                );
                at.children.iter().for_each(|c| c.used.set(true));
                self.said.warn(at.at.words(), what);
                Ok(())
            }
        }
    }
}
