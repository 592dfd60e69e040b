//! Where light is asked for. Floor 5.

mod camera;
mod points;

use antumbra_trace::{Hits, SegmentBuffer, Visibility};

pub use camera::{CameraSensor, Filter, View, Viewing};
pub use points::{PointSensor, Query};

use crate::film::Film;
use crate::receiver::Receiver;
use crate::sampler::{AnySampler, PassPlan};
use crate::scene::{Look, Scene};

/// Some cells of the film: a rectangle of pixels, or a run of points (height 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// Left column, or first point.
    pub x: u32,
    /// Upper row.
    pub y: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Tile {
    /// Number of cells.
    pub fn cells(&self) -> u32 {
        self.width * self.height
    }
}

/// What a sensor needs to look.
pub struct Looking<'a> {
    /// At this scene,
    pub scene: &'a Scene,
    /// through this tree,
    pub visibility: &'a dyn Visibility,
    /// in this way,
    pub look: Look,
    /// noting this at once,
    pub seen: Seen,
    /// with these numbers.
    pub sampler: &'a AnySampler,
    /// Seed of all streams.
    pub seed: u32,
    /// The passes of the whole render.
    pub passes: PassPlan,
}

/// What a sensor adds to the film where it looks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Seen {
    /// Light that what is seen gives off; the sky where nothing is.
    #[default]
    Light,
    /// 1 where nothing is (ambient occlusion).
    Open,
}

/// Buffers that are filled again and again.
#[derive(Default)]
pub struct Scratch {
    /// Rays to trace.
    pub rays: SegmentBuffer,
    /// Streams of their random numbers.
    pub streams: Vec<u32>,
    /// What they met.
    pub hits: Hits,
}

/// Law: a pure function of (tile, pass); every receiver's cell lies in the tile's film.
pub trait Sensor: Sync {
    /// Receivers of one pass of a tile; what the sensor sees at once (emission, normals, …) goes into the film.
    fn receivers(
        &self,
        looking: &Looking<'_>,
        tile: Tile,
        pass: u32,
        scratch: &mut Scratch,
        film: &mut Film,
        out: &mut Vec<Receiver>,
    );

    /// Width and height in cells.
    fn size(&self) -> [u32; 2];

    /// The tiles that cover it, in order.
    fn tiles(&self) -> Vec<Tile>;
}

/// Cuts a picture into tiles of at most `side` pixels.
fn grid([width, height]: [u32; 2], side: [u32; 2]) -> Vec<Tile> {
    let mut tiles = Vec::new();
    for y in (0..height).step_by(side[1] as usize) {
        for x in (0..width).step_by(side[0] as usize) {
            tiles.push(Tile { x, y, width: side[0].min(width - x), height: side[1].min(height - y) });
        }
    }
    tiles
}
