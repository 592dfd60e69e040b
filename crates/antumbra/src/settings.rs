//! The one table of settings: name, type, default, range and help of each. Floor 6.
//!
//! Command line, Python and picture metadata are made from [`TABLE`]; [`Settings`] holds one value of each. A new
//! setting is one entry of `settings!`.

mod meaning;
mod value;

pub use crate::scene::nearest;
pub use value::SettingValue;

use crate::estimator::{Directions, EstimatorKind, Falloff, LightChoice, Mistake};
use crate::film::Planes;
use crate::light::LightPoints;
use crate::light::sky::Sky;
use crate::sampler::{Pairing, SamplerKind};
use crate::scene::Start;
use crate::sensor::{Filter, Viewing};
use value::{choices, grouped};

/// One entry of the table.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    /// Its name in Rust and Python; the command line joins the words by `-`.
    pub name: &'static str,
    /// The group it stands in: Light, Camera, Sampling, Looks, Files, Teaching, Run.
    pub group: &'static str,
    /// The word for its values in help ("N", "NAME", "X,Y,Z").
    pub metavar: &'static str,
    /// The allowed words, if it is a choice or a list of words.
    pub choices: &'static [&'static str],
    /// Its default, as people would write it; empty = none.
    pub default: fn() -> String,
    /// What it does, in one line.
    pub help: &'static str,
    /// It may be given more than once.
    pub repeats: bool,
}

/// A value that does not fit its setting.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what}")]
pub struct SettingError {
    /// The setting, as it was written.
    pub name: String,
    /// What is wrong and what would be right, in one line.
    pub what: String,
}

macro_rules! settings {
    ($($group:literal { $($(#[doc = $help:literal])+ $name:ident: $ty:ty $(as $metavar:literal)? = $default:expr $(, $check:expr)?;)* })*) => {
        /// A value for every setting.
        #[derive(Clone, Debug, PartialEq)]
        pub struct Settings {
            $($($(#[doc = $help])+ pub $name: $ty,)*)*
        }
        impl Default for Settings {
            fn default() -> Settings {
                Settings { $($($name: $default,)*)* }
            }
        }
        /// Every setting, in the order of the help.
        pub const TABLE: &[Setting] = &[$($(Setting {
            name: stringify!($name),
            group: $group,
            metavar: {
                const WORDS: &[&str] = &[<$ty as SettingValue>::METAVAR $(, $metavar)?];
                WORDS[WORDS.len() - 1]
            },
            choices: <$ty as SettingValue>::CHOICES,
            default: || { let value: $ty = $default; value.show() },
            help: concat!($($help),+),
            repeats: <$ty as SettingValue>::REPEATS,
        },)*)*];
        impl Settings {
            /// Sets one by its name (words joined by `_` or `-`) from what a person wrote.
            pub fn set(&mut self, name: &str, text: &str) -> Result<(), SettingError> {
                let key = name.replace('-', "_");
                match key.as_str() {
                    $($(stringify!($name) => {
                        let checks: &[value::Check<$ty>] = &[$($check)?];
                        self.$name = value::read(text, checks).map_err(|what| fault(name, text, what))?;
                    })*)*
                    _ => return Err(unknown(name)),
                }
                Ok(())
            }
            /// The value of each, as people would write it.
            pub fn shown(&self) -> Vec<(&'static str, String)> {
                vec![$($((stringify!($name), self.$name.show()),)*)*]
            }
        }
    };
}

settings! {
    "Light" {
        /// how reflected light is written as an integral and sampled
        estimator: EstimatorKind = EstimatorKind::Path;
        /// shadow rays per receiver (and light, with `lights` = all)
        shadow_rays: u32 = 1, |n| count(*n, 1 << 20, "use shadows = off to leave shadows out");
        /// longest path: 0 = emission only, 1 = direct light
        bounces: u32 = 8, |n| within(*n as f64, 0.0, 1000.0);
        /// every light, or one chosen per shadow ray; auto: all up to 4 lights, else the best chooser
        lights: LightChoice = LightChoice::Auto;
        /// keep only the light of this name (may be repeated)
        light: Vec<String> = Vec::new();
        /// how a point on a light is drawn: uniform in solid angle, or on its area (pdf = 1/A); for lectures, on flat
        /// lights: skewed to one side, about the point nearest to the receiver, never in a hole (biased)
        light_points: LightPoints = LightPoints::SolidAngle;
        /// how hemisphere directions are drawn
        directions: Directions = Directions::Bsdf;
        /// Russian roulette on long paths
        roulette: bool = true;
        /// ambient occlusion: occluders beyond this distance do not count
        radius: f32 as "R" = f32::INFINITY, |r| positive(*r);
        /// ambient occlusion: weight of an occluder at distance t: none, (1-t/R) or (1-t/R)²
        falloff: Falloff = Falloff::None;
    }
    "Camera" {
        /// the file's camera of this name
        camera: Option<String> = None;
        /// stand here
        eye: Option<[f64; 3]> = None;
        /// look at this point
        look_at: Option<[f64; 3]> = None;
        /// this way is up in the picture
        up: Option<[f64; 3]> = None;
        /// vertical angle of view in degrees
        fov: Option<f64> as "DEGREES" = None, |f| f.map_or(Ok(()), angle);
        /// radius of the lens in scene units; 0: a pinhole, all is sharp (default: the file's)
        aperture: Option<f64> as "R" = None, |r| r.map_or(Ok(()), |r| within(r, 0.0, 1e30));
        /// distance at which the lens is sharp (default: the file's, or what the middle of the picture shows)
        focus: Option<f64> as "T" = None, |t| t.map_or(Ok(()), |t| positive(t as f32));
        /// width x height of the picture in pixels
        size: Option<[u32; 2]> = None, |s| s.map_or(Ok(()), picture_size);
        /// render only this part of the picture: x,y of its upper left pixel, width, height
        crop: Option<[u32; 4]> = None;
    }
    "Sampling" {
        /// viewing rays per pixel
        viewing_rays: u32 = 16, |n| count(*n, 1 << 24, "one viewing ray sees something");
        /// stop after this many of the viewing rays: what a stopped picture holds, again
        passes: Option<u32> = None, |n| n.map_or(Ok(()), |n| count(n, 1 << 24, "one pass is the least"));
        /// where the random numbers come from
        sampler: SamplerKind = SamplerKind::Owen;
        /// shift the regular sampler's grid by a random offset per receiver
        rotate: bool = false;
        /// pixel and light point from one 4-D point, or from padded 2-D ones
        pairing: Pairing = Pairing::FourD;
        /// viewing rays over the pixel filter, or all through the pixel's centre
        viewing: Viewing = Viewing::Filter;
        /// pixel filter
        filter: Filter = Filter::BlackmanHarris;
        /// another seed, another noise
        seed: u32 = 0;
    }
    "Looks" {
        /// brighten a PNG by this many stops
        exposure: f32 as "EV" = 0.0, |e| within(f64::from(*e), -100.0, 100.0);
        /// numbers in an EXR: auto = half, or float in layers that half cannot hold
        exr: ExrNumbers = ExrNumbers::Auto;
        /// tone curve of a PNG
        tone: Tone = Tone::Linear;
        /// every surface two-sided diffuse with this reflectance
        clay: Option<f32> as "RHO" = None, |c| c.map_or(Ok(()), |c| within(f64::from(c), 0.0, 1.0));
        /// light from all around: a lat-long picture; sky; a clear sky with its sun, as
        /// sky:elevation=30:azimuth=120:turbidity=3:albedo=0.3 (degrees); or none (default: the scene's own)
        environment: Option<String> as "FILE|sky|none" = None, |e| e.as_deref().map_or(Ok(()), sky_words);
        /// alpha masks: as the file says, or opaque
        masks: Masks = Masks::File;
        /// pictures beside the main one in an EXR, joined by commas, or all
        aov: Planes = Planes::NONE;
        /// aov regions: this many points inside each light and as many on its outline
        region_points: u32 = 64, |n| within(f64::from(*n), 4.0, 65_536.0);
    }
    "Teaching" {
        /// off: nothing blocks
        shadows: bool = true;
        /// none: segments start at the surface; epsilon:E: a fixed distance E above it; safe: the exact start
        self_intersection: Start = Start::Safe;
        /// off: what lies behind a light shadows it too
        distance_test: bool = true;
        /// wrong on purpose. none: right;
        /// no-cos-light: without cos θ′ at the light;
        /// no-distance: without 1/r²;
        /// wrong-measure: a density over the light's area taken for one over solid angle, or the other way round;
        /// counted-twice: light points and directions both with full weight;
        /// no-count: the samples' sum, not their mean
        mistake: Mistake = Mistake::None;
    }
    "Run" {
        /// threads; 0 = all cores
        threads: u32 = 0, |n| within(f64::from(*n), 0.0, 1024.0);
    }
}

/// How radiance becomes the code values of a PNG.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tone {
    /// sRGB encoding, clipped at 1.
    #[default]
    Linear,
    /// A film-like shoulder before the sRGB encoding.
    Filmic,
}

/// How an EXR stores its numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExrNumbers {
    /// Half, or float in layers that half cannot hold.
    #[default]
    Auto,
    /// 16 bits.
    Half,
    /// 32 bits.
    Float,
}

/// What alpha masks do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Masks {
    /// As the file says.
    #[default]
    File,
    /// They block everywhere.
    Opaque,
}

choices!(EstimatorKind: Path "path", Area "area", Hemisphere "hemisphere", Surfaces "surfaces", Mis "mis",
    PathHemisphere "path-hemisphere", AmbientOcclusion "ambient-occlusion");
choices!(LightChoice: Auto "auto", All "all", Uniform "uniform", Power "power", Contribution "contribution");
choices!(LightPoints: SolidAngle "solid-angle", Area "area", Skewed "skewed", Nearest "nearest", Hole "hole");
choices!(Directions: Bsdf "bsdf", Cosine "cosine", Uniform "uniform");
choices!(Falloff: None "none", Linear "linear", Quadratic "quadratic");
choices!(SamplerKind: Owen "owen", Random "random", Stratified "stratified", Regular "regular");
choices!(Pairing: FourD "4d", TwoD "2d");
choices!(Viewing: Filter "filter", Centre "centre");
choices!(Filter: BlackmanHarris "blackman-harris", Box "box", Tent "tent", Gaussian "gaussian");
choices!(ExrNumbers: Auto "auto", Half "half", Float "float");
choices!(Tone: Linear "linear", Filmic "filmic");
choices!(Masks: File "file", Opaque "opaque");
choices!(Mistake: None "none", NoCosLight "no-cos-light", NoDistance "no-distance", WrongMeasure "wrong-measure",
    CountedTwice "counted-twice", NoCount "no-count");

fn fault(name: &str, text: &str, what: String) -> SettingError {
    let what = match what.strip_prefix("there is no ") {
        // "there is no estimator "arae"", but not "there is no lights".
        Some(rest) if !name.ends_with('s') => format!("there is no {name} {rest}"),
        _ => format!("{name} = {text}: {what}"),
    };
    SettingError { name: name.into(), what }
}

fn unknown(name: &str) -> SettingError {
    let known: Vec<&str> = TABLE.iter().map(|s| s.name).collect();
    let hint = nearest(&name.replace('-', "_"), &known).map(|n| format!("; did you mean \"{n}\"?"));
    SettingError {
        name: name.into(),
        what: format!("there is no setting \"{name}\"{}", hint.unwrap_or_default()),
    }
}

fn sky_words(environment: &str) -> Result<(), String> {
    Sky::from_words(environment).map_or(Ok(()), |sky| sky.map(|_| ()))
}

fn count(n: u32, most: u32, otherwise: &str) -> Result<(), String> {
    match n {
        0 => Err(format!("at least 1 is needed ({otherwise})")),
        n if n > most => Err(format!("at most {} are possible", grouped(most.into()))),
        _ => Ok(()),
    }
}

fn positive(x: f32) -> Result<(), String> {
    if x > 0.0 { Ok(()) } else { Err("a number above 0 is needed".into()) }
}

fn within(x: f64, low: f64, high: f64) -> Result<(), String> {
    if (low..=high).contains(&x) { Ok(()) } else { Err(format!("a number from {low} to {high} is needed")) }
}

/// An angle of view [degrees].
fn angle(x: f64) -> Result<(), String> {
    if (1e-9..=179.9).contains(&x) {
        Ok(())
    } else {
        Err("an angle above 0 and up to 179.9 is needed".into())
    }
}

fn picture_size([w, h]: [u32; 2]) -> Result<(), String> {
    const MOST: u64 = 1 << 28;
    match u64::from(w) * u64::from(h) {
        0 => Err("both sides must be at least 1 pixel".into()),
        n if n > MOST => Err(format!("a picture has at most {} pixels", grouped(MOST))),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_default_parses_back_to_itself() {
        let mut settings = Settings::default();
        for setting in TABLE {
            let text = (setting.default)();
            if !text.is_empty() {
                settings.set(setting.name, &text).unwrap();
            }
        }
        assert_eq!(settings, Settings::default());
    }

    #[test]
    fn wrong_names_get_the_nearest_right_one() {
        let error = Settings::default().set("shadow-ray", "4").unwrap_err();
        assert!(error.what.contains("shadow_rays"), "{error}");
        let error = Settings::default().set("estimator", "arae").unwrap_err();
        assert!(error.what.contains("did you mean \"area\"?"), "{error}");
    }

    #[test]
    fn numbers_beyond_every_integer_are_told_the_limit_of_their_setting() {
        for (name, text, said) in [
            ("shadow_rays", "0", "at least 1 is needed"),
            ("shadow_rays", "-3", "at least 1 is needed"),
            ("viewing_rays", "99999999999999999999999", "at most 16,777,216 are possible"),
            ("viewing_rays", "4294967295", "at most 16,777,216 are possible"),
            ("seed", "4294967296", "a whole number from 0 to 4,294,967,295 is needed"),
            ("seed", "-1", "a whole number from 0 to 4,294,967,295 is needed"),
            ("seed", "1.5", "a whole number is needed"),
            ("bounces", "99999999999", "a number from 0 to 1000 is needed"),
            ("size", "99999999999x2", "a picture has at most 268,435,456 pixels"),
            ("size", "-3x2", "both sides must be at least 1 pixel"),
            ("size", "3", "width x height is needed"),
            ("fov", "180", "an angle above 0 and up to 179.9 is needed"),
        ] {
            let error = Settings::default().set(name, text).unwrap_err();
            assert!(error.what.contains(said), "{error}");
        }
    }
}
