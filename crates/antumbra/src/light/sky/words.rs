//! A sky in words: `sky:elevation=30:azimuth=120:turbidity=4:albedo=0.3`, angles in degrees.

use super::Sky;

impl Sky {
    /// The sky that `text` means; `None` if it does not begin with `sky:`. What is not said stays as in
    /// [`Sky::default`]. `Err`: what is wrong with it.
    pub fn from_words(text: &str) -> Option<Result<Sky, String>> {
        text.strip_prefix("sky:").map(read)
    }

    /// Those words.
    pub fn words(&self) -> String {
        let (elevation, azimuth) = (self.elevation.to_degrees(), self.azimuth.to_degrees());
        // Seven places: a hundredth of the sun's width in a million.
        let short = |x: f64| format!("{x:.7}").trim_end_matches('0').trim_end_matches('.').to_string();
        let (elevation, azimuth) = (short(elevation), short(azimuth));
        format!(
            "sky:elevation={elevation}:azimuth={azimuth}:turbidity={}:albedo={}",
            self.turbidity, self.albedo
        )
    }
}

fn read(words: &str) -> Result<Sky, String> {
    let mut sky = Sky::default();
    for word in words.split(':').filter(|w| !w.is_empty()) {
        let (name, value) = word.split_once('=').unwrap_or((word, ""));
        let number: f64 =
            value.parse().map_err(|_| format!("\"{word}\": a name and a number are needed, as {EXAMPLE}"))?;
        match name {
            "elevation" => sky.elevation = number.to_radians(),
            "azimuth" => sky.azimuth = number.to_radians(),
            "turbidity" => sky.turbidity = number,
            "albedo" => sky.albedo = number,
            _ => return Err(format!("a sky has no \"{name}\" (elevation, azimuth, turbidity, albedo)")),
        }
    }
    sky.fault().map_or(Ok(sky), Err)
}

const EXAMPLE: &str = "sky:elevation=30:turbidity=4";
