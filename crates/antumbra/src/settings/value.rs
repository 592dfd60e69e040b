//! How a setting's value is read from what a person wrote, and written back.

use super::nearest;
use crate::film::Planes;
use crate::scene::Start;

/// A type that settings can have.
pub trait SettingValue: Sized {
    /// The word for its values in help.
    const METAVAR: &'static str;
    /// The allowed words, if it is a choice or a list of words.
    const CHOICES: &'static [&'static str] = &[];
    /// It may be given more than once.
    const REPEATS: bool = false;
    /// Reads it; the error says what would be right.
    fn parse(text: &str) -> Result<Self, String>;
    /// What stands for a number that no value of this type can hold, so that the setting's own limit can tell it.
    fn beyond(_text: &str) -> Option<Self> {
        None
    }
    /// Writes it so that `parse` reads it back; empty = none.
    fn show(&self) -> String;
}

/// Makes an enum a setting: each variant with its word.
macro_rules! choices {
    ($ty:ident: $($variant:ident $word:literal),+ $(,)?) => {
        impl SettingValue for $ty {
            const METAVAR: &'static str = "NAME";
            const CHOICES: &'static [&'static str] = &[$($word),+];
            fn parse(text: &str) -> Result<Self, String> {
                match text {
                    $($word => Ok($ty::$variant),)+
                    _ => Err(crate::settings::value::no_such_word(text, Self::CHOICES)),
                }
            }
            fn show(&self) -> String {
                match self { $($ty::$variant => $word,)+ }.into()
            }
        }
    };
}
pub(super) use choices;

/// Why a value lies outside of what its setting takes.
pub(super) type Check<T> = fn(&T) -> Result<(), String>;

/// Reads a value and checks it.
pub(super) fn read<T: SettingValue>(text: &str, checks: &[Check<T>]) -> Result<T, String> {
    let sound = |value: &T| checks.iter().try_for_each(|check| check(value));
    match T::parse(text) {
        Ok(value) => sound(&value).map(|()| value),
        Err(what) => Err(T::beyond(text).and_then(|value| sound(&value).err()).unwrap_or(what)),
    }
}

/// A count as people write it: 1,048,576.
pub(super) fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let groups = digits.as_bytes().rchunks(3).rev().map(|group| String::from_utf8_lossy(group));
    groups.collect::<Vec<_>>().join(",")
}

/// "there is no …; did you mean …? (…)".
pub(super) fn no_such_word(text: &str, words: &[&str]) -> String {
    let hint = nearest(text, words).map(|w| format!("; did you mean \"{w}\"?")).unwrap_or_default();
    format!("there is no \"{text}\"{hint} ({})", words.join(", "))
}

macro_rules! numbers {
    ($($ty:ty, $metavar:literal, $what:literal;)*) => {$(
        impl SettingValue for $ty {
            const METAVAR: &'static str = $metavar;
            fn parse(text: &str) -> Result<Self, String> {
                text.trim().parse().map_err(|_| concat!($what, " is needed").to_string())
            }
            fn show(&self) -> String {
                self.to_string()
            }
        }
    )*};
}
numbers!(f32, "X", "a number"; f64, "X", "a number";);

impl SettingValue for u32 {
    const METAVAR: &'static str = "N";
    fn parse(text: &str) -> Result<Self, String> {
        let parsed = text.trim().parse();
        parsed.map_err(|_| match saturated(text) {
            Some(_) => format!("a whole number from 0 to {} is needed", grouped(u32::MAX.into())),
            None => "a whole number is needed".into(),
        })
    }
    fn beyond(text: &str) -> Option<Self> {
        saturated(text)
    }
    fn show(&self) -> String {
        self.to_string()
    }
}

/// The nearest number to a whole one of any size.
fn saturated(text: &str) -> Option<u32> {
    let text = text.trim();
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    Some(text.parse().unwrap_or(if text.starts_with('-') { 0 } else { u32::MAX }))
}

impl SettingValue for bool {
    const METAVAR: &'static str = "on|off";
    const CHOICES: &'static [&'static str] = &["on", "off"];
    fn parse(text: &str) -> Result<Self, String> {
        match text.to_lowercase().as_str() {
            "on" | "true" | "yes" | "1" => Ok(true),
            "off" | "false" | "no" | "0" => Ok(false),
            _ => Err("on or off is needed".into()),
        }
    }
    fn show(&self) -> String {
        if *self { "on" } else { "off" }.into()
    }
}

impl SettingValue for String {
    const METAVAR: &'static str = "NAME";
    fn parse(text: &str) -> Result<Self, String> {
        Ok(text.into())
    }
    fn show(&self) -> String {
        self.clone()
    }
}

/// Several names, one a line (names in files may hold commas).
impl SettingValue for Vec<String> {
    const METAVAR: &'static str = "NAME";
    const REPEATS: bool = true;
    fn parse(text: &str) -> Result<Self, String> {
        Ok(text.lines().map(String::from).collect())
    }
    fn show(&self) -> String {
        self.join("\n")
    }
}

impl<T: SettingValue> SettingValue for Option<T> {
    const METAVAR: &'static str = T::METAVAR;
    const CHOICES: &'static [&'static str] = T::CHOICES;
    fn parse(text: &str) -> Result<Self, String> {
        if text.is_empty() { Ok(None) } else { T::parse(text).map(Some) }
    }
    fn beyond(text: &str) -> Option<Self> {
        T::beyond(text).map(Some)
    }
    fn show(&self) -> String {
        self.as_ref().map(T::show).unwrap_or_default()
    }
}

/// `n` numbers between separators, as an array.
fn numbers<T: std::str::FromStr, const N: usize>(text: &str, separators: &[char]) -> Option<[T; N]> {
    let parsed: Result<Vec<T>, _> = text.split(separators).map(|part| part.trim().parse::<T>()).collect();
    parsed.ok()?.try_into().ok()
}

impl SettingValue for [f64; 3] {
    const METAVAR: &'static str = "X,Y,Z";
    fn parse(text: &str) -> Result<Self, String> {
        numbers(text, &[','])
            .filter(|v: &[f64; 3]| v.iter().all(|c| c.is_finite()))
            .ok_or_else(|| "three numbers joined by commas are needed, as 1,2.5,0".into())
    }
    fn show(&self) -> String {
        format!("{},{},{}", self[0], self[1], self[2])
    }
}

/// What stands between width and height.
const SIDES: [char; 3] = ['x', '×', ','];

impl SettingValue for [u32; 2] {
    const METAVAR: &'static str = "WxH";
    fn parse(text: &str) -> Result<Self, String> {
        numbers(text, &SIDES).ok_or_else(|| "width x height is needed, as 640x480".into())
    }
    fn beyond(text: &str) -> Option<Self> {
        let sides: Option<Vec<u32>> = text.split(SIDES).map(saturated).collect();
        sides?.try_into().ok()
    }
    fn show(&self) -> String {
        format!("{}x{}", self[0], self[1])
    }
}

impl SettingValue for [u32; 4] {
    const METAVAR: &'static str = "X,Y,W,H";
    fn parse(text: &str) -> Result<Self, String> {
        numbers(text, &[','])
            .filter(|c: &[u32; 4]| c[2] > 0 && c[3] > 0)
            .ok_or_else(|| "x,y,width,height in whole pixels are needed, as 100,80,64,64".into())
    }
    fn show(&self) -> String {
        format!("{},{},{},{}", self[0], self[1], self[2], self[3])
    }
}

impl SettingValue for Start {
    const METAVAR: &'static str = "safe|none|epsilon:E";
    fn parse(text: &str) -> Result<Self, String> {
        match text.split_once(':') {
            None if text == "safe" => Ok(Start::Safe),
            None if text == "none" => Ok(Start::None),
            Some(("epsilon", e)) => {
                let e: Option<f32> = e.parse().ok().filter(|e: &f32| e.is_finite() && *e >= 0.0);
                e.map(Start::Epsilon).ok_or_else(|| "epsilon:E needs a length, as epsilon:1e-4".into())
            }
            _ => Err("safe, none or epsilon:E is needed, as epsilon:1e-4".into()),
        }
    }
    fn show(&self) -> String {
        match self {
            Start::Safe => "safe".into(),
            Start::None => "none".into(),
            Start::Epsilon(e) => format!("epsilon:{e}"),
        }
    }
}

impl SettingValue for Planes {
    const METAVAR: &'static str = "LIST";
    const CHOICES: &'static [&'static str] = Planes::NAMES;
    fn parse(text: &str) -> Result<Self, String> {
        let mut planes = Planes::NONE;
        for word in text.split(',').map(str::trim).filter(|w| !w.is_empty()) {
            match word {
                "all" => planes = planes.union(Planes::ALL),
                "none" => {}
                _ => match Planes::by_name(word) {
                    Some(plane) => planes = planes.union(plane),
                    None => return Err(no_such_word(word, Planes::NAMES)),
                },
            }
        }
        Ok(planes)
    }
    fn show(&self) -> String {
        self.list().join(",")
    }
}
