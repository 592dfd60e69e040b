//! Pictures that come out: EXR with everything in it, PNG for the eye; and both read again, to be compared.

mod exr;
mod png;
mod read;
mod tone;
mod whole;

pub use exr::{exr_bytes, read_exr, read_exr_bytes, write_exr};
pub use png::{png_bytes, read_png, read_png_bytes, write_png};
pub use read::read_picture;
pub(crate) use tone::Codes;
pub use tone::{Look, Tone};
pub(crate) use whole::write_together;
pub use whole::{check_writable, write_whole};

/// A picture with what else was measured at its pixels, row by row from the top.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Radiance, linear, Rec. 709 primaries.
    pub pixels: Vec<[f32; 3]>,
    /// Other layers.
    pub aovs: Vec<Aov>,
    /// Settings, seed, version, scene hash: names and values in their order.
    pub metadata: Vec<(String, String)>,
    /// Where it lies, if it is a part of a larger picture (EXR).
    pub window: Option<Window>,
}

/// Where a part of a picture lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Column of its upper left pixel in the whole picture.
    pub x: i32,
    /// Row of its upper left pixel.
    pub y: i32,
    /// Columns of the whole picture.
    pub width: u32,
    /// Rows of the whole picture.
    pub height: u32,
}

impl Window {
    /// That of a whole picture.
    pub fn of([width, height]: [u32; 2]) -> Window {
        Window { x: 0, y: 0, width, height }
    }
}

/// A layer of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Aov {
    /// Its name; channels are `name.R`, `name.G`, `name.B`, or `name` alone.
    pub name: String,
    /// What it holds.
    pub channels: Channels,
    /// Always 32 bits: positions, depths and counts do not fit the 11 significant bits of a half.
    pub full: bool,
}

/// The numbers of a layer, one entry a pixel.
#[derive(Clone, Debug, PartialEq)]
pub enum Channels {
    /// One number.
    One(Vec<f32>),
    /// Three numbers.
    Three(Vec<[f32; 3]>),
}

impl Channels {
    /// Number of pixels.
    pub fn len(&self) -> usize {
        match self {
            Channels::One(v) => v.len(),
            Channels::Three(v) => v.len(),
        }
    }

    /// There is no pixel.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Bits of a number in an EXR.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 16 bits; what is larger than 65,504 becomes infinite, so radiance is clipped there.
    #[default]
    Half,
    /// 32 bits.
    Float,
}

impl Picture {
    /// All layers have width · height pixels and there is at least one.
    fn fault(&self) -> Option<String> {
        let n = self.width as usize * self.height as usize;
        if n == 0 {
            return Some(format!("a picture of {} × {} pixels", self.width, self.height));
        }
        if self.pixels.len() != n {
            return Some(format!("{} pixels for {} × {}", self.pixels.len(), self.width, self.height));
        }
        let wrong = self.aovs.iter().find(|a| a.channels.len() != n)?;
        Some(format!("layer \"{}\" has {} pixels of {n}", wrong.name, wrong.channels.len()))
    }
}
