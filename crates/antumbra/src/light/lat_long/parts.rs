//! A picture of the sky in parts, chosen among by what each gives a receiver: its sun, and 8 × 4 tiles of equal area of
//! the rest.

use antumbra_math::{World, real};

use super::super::steps;
use super::cells::{Cells, Grid, Window};

/// Tiles around, and from pole to pole.
const AROUND: u32 = 8;
const BANDS: u32 = 4;
/// The most parts: every tile, and a sun.
const MOST: usize = (AROUND * BANDS) as usize + 1;
/// The next number that eight divides.
const LANES: usize = MOST.next_multiple_of(8);

/// A part of the picture that is drawn from by its own table.
pub struct Part {
    pub cells: Cells,
    /// ∫ of its luminance.
    flux: f32,
    /// Where most of its light comes from, and cosine and sine of an angle about it that holds the part.
    middle: World,
    reach: [f32; 2],
}

impl Part {
    /// Over a window of cells; `None` if it is black.
    pub fn new(grid: &Grid, window: Window, light: impl Fn(u32, u32) -> f32) -> Option<Part> {
        let (cells, vector) = Cells::new(grid, window, light);
        if cells.is_black() {
            return None;
        }
        let [x, y, z, flux] = vector;
        let unit = antumbra_math::DVec3::new(x, y, z).normalize_or(antumbra_math::DVec3::Y);
        let middle = unit.as_vec3();
        let lowest = grid.rim(window).map(|d| d.dot(unit)).fold(1.0, f64::min);
        // A direction in f32 may be rounded out of its part.
        let reach = real::acos(lowest.clamp(-1.0, 1.0)) + 1e-5;
        let [cos, sin] =
            if reach < std::f64::consts::PI { [real::cos(reach), real::sin(reach)] } else { [-1.0, 0.0] };
        Some(Part { cells, flux: flux as f32, middle, reach: [cos as f32, sin as f32] })
    }

    /// See [`Regards::irradiance`].
    pub fn irradiance(&self, n: World) -> f32 {
        Regards::of(std::slice::from_ref(self)).irradiance(0, n)
    }
}

/// What a receiver asks of all parts, number by number: for loops over many at once.
pub struct Regards {
    middle: [[f32; LANES]; 3],
    reach: [[f32; LANES]; 2],
    /// Half the flux; 0 where there is no part.
    half: [f32; LANES],
    count: usize,
}

impl Regards {
    /// Of these parts.
    pub fn of(parts: &[Part]) -> Regards {
        let (middle, reach) = ([[0.0; LANES]; 3], [[0.0; LANES]; 2]);
        let mut all = Regards { middle, reach, half: [0.0; LANES], count: parts.len() };
        for (k, part) in parts.iter().enumerate() {
            (0..3).for_each(|axis| all.middle[axis][k] = part.middle[axis]);
            (0..2).for_each(|i| all.reach[i][k] = part.reach[i]);
            all.half[k] = 0.5 * part.flux;
        }
        all
    }

    /// About the irradiance of a part on the side of the unit normal `n`: halfway between what it would give from its
    /// middle and from its nearest point, and so above 0 wherever a piece of it is in sight.
    #[inline(always)]
    fn irradiance(&self, k: usize, n: World) -> f32 {
        let cos = self.middle[0][k] * n.x + self.middle[1][k] * n.y + self.middle[2][k] * n.z;
        let [reach_cos, reach_sin] = [self.reach[0][k], self.reach[1][k]];
        let aside = cos * reach_cos + real::safe_sqrt(1.0 - cos * cos) * reach_sin;
        let nearest = if cos >= reach_cos { 1.0 } else { aside };
        self.half[k] * (nearest.max(0.0) + cos.max(0.0))
    }
}

/// The tiles of a picture: windows of cells, and which a cell lies in.
pub struct Tiles {
    width: u32,
    /// The band of each row of cells.
    bands: Vec<u8>,
    /// The part that each tile is; `u8::MAX`: black.
    part_of: [u8; MOST - 1],
}

impl Tiles {
    /// Cuts the picture into tiles and appends those that shine to `parts`.
    pub fn new(grid: &Grid, light: impl Fn(u32, u32) -> f32, parts: &mut Vec<Part>) -> Tiles {
        let rows = grid.whole().height;
        let bands: Vec<u8> = (0..rows).map(|row| grid.band(row, BANDS)).collect();
        let mut part_of = [u8::MAX; MOST - 1];
        let mut y = 0;
        for band in 0..BANDS {
            let height = bands.iter().filter(|b| u32::from(**b) == band).count() as u32;
            for column in 0..AROUND {
                // The columns of a tile are those that `part` gives it.
                let [x, end] = [column, column + 1].map(|c| (c * grid.width).div_ceil(AROUND));
                let window = Window { x, y, width: end - x, height };
                if window.width > 0
                    && height > 0
                    && let Some(part) = Part::new(grid, window, &light)
                {
                    part_of[(band * AROUND + column) as usize] = parts.len() as u8;
                    parts.push(part);
                }
            }
            y += height;
        }
        Tiles { width: grid.width, bands, part_of }
    }

    /// The part that a cell lies in.
    #[inline]
    pub fn part(&self, column: u32, row: u32) -> Option<usize> {
        let across = u64::from(column) * u64::from(AROUND) / u64::from(self.width);
        let tile = u32::from(self.bands[row as usize]) * AROUND + across as u32;
        let part = self.part_of[tile as usize];
        (part != u8::MAX).then_some(usize::from(part))
    }
}

/// The chances of the parts for a receiver, as running numbers of steps.
pub struct Chances {
    /// Beyond the last part all steps.
    ends: [u32; LANES],
    count: usize,
}

impl Chances {
    /// In proportion to what each gives about the normal `n`.
    #[inline]
    pub fn new(parts: &Regards, n: World) -> Chances {
        let (mut weights, mut ends) = ([0.0; LANES], [0; LANES]);
        for (k, weight) in weights.iter_mut().enumerate() {
            *weight = parts.irradiance(k, n);
        }
        let any = steps::share_out_fast(&weights, &mut ends);
        Chances { ends, count: if any { parts.count } else { 0 } }
    }

    /// Draws a part.
    #[inline]
    pub fn pick(&self, u: f32) -> Option<steps::Choice> {
        if self.count > 0 { steps::pick_few(&self.ends, u) } else { None }
    }

    /// The chance of a part.
    #[inline]
    pub fn of(&self, part: usize) -> f32 {
        steps::prob(&self.ends[..self.count], part)
    }
}
