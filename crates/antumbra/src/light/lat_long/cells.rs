//! Drawing a direction in proportion to a lat-long picture as it is looked up.
//!
//! The sphere is cut into cells in which the picture is bilinear: between the middles of four texels (at the poles two,
//! twice), or the texels themselves where they are patches. Inside a cell, coordinates are (φ, cos θ), which keep areas:
//! the equal-area chart of Lambert. The density is bilinear in them between the four corners' luminances, so that it is
//! above 0 wherever the picture is, and follows it but for the bend of cos θ within a cell.

use std::sync::Arc;

use antumbra_math::{DVec3, World, real};

use super::super::steps;

/// The part of a picture that a table draws from: columns from `x` on (they go around), rows from `y` on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

/// A picture's size and how it is looked up.
#[derive(Clone, Debug)]
pub struct Grid {
    pub width: u32,
    pub height: u32,
    /// Texels are patches of one light.
    pub nearest: bool,
    /// ζ = 1 − cos θ at the borders of the rows of cells, with the digits of the nearer pole.
    borders: Arc<[f64]>,
}

/// A place in the picture: a cell and where in it, along φ and θ as texels are interpolated, and along cos θ.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    pub column: u32,
    pub row: u32,
    /// Along φ, in [0, 1].
    pub s: f32,
    /// Along θ, in [0, 1].
    pub v: f32,
    /// Along cos θ, in [0, 1].
    pub t: f32,
}

/// Running numbers of steps (`steps`) for the rows of cells and the cells of each row.
pub struct Cells {
    grid: Grid,
    window: Window,
    rows: Vec<u32>,
    columns: Vec<u32>,
}

impl Grid {
    /// Of a picture's size.
    pub fn new(width: u32, height: u32, nearest: bool) -> Grid {
        let (half, rows) = if nearest { (0.0, height) } else { (0.5, height + 1) };
        let quarter = 0.5 * std::f64::consts::PI;
        let border = |row: u32| {
            let place = (f64::from(row) - half).clamp(0.0, f64::from(height)) / f64::from(height);
            let sin = real::sin(quarter * place.min(1.0 - place));
            if place <= 0.5 { 2.0 * sin * sin } else { 2.0 - 2.0 * sin * sin }
        };
        Grid { width, height, nearest, borders: (0..=rows).map(border).collect() }
    }

    /// All cells.
    pub fn whole(&self) -> Window {
        let rows = if self.nearest { self.height } else { self.height + 1 };
        Window { x: 0, y: 0, width: self.width, height: rows }
    }

    /// The cells that the texels of a window touch.
    pub fn touched(&self, texels: Window) -> Window {
        if self.nearest {
            return texels;
        }
        // Cell i lies between texels i − 1 and i.
        let width = (texels.width + 1).min(self.width);
        Window { width, height: texels.height + 1, ..texels }
    }

    /// Of `count` bands of equal area from pole to pole, the one that the middle of a row of cells lies in.
    pub fn band(&self, row: u32, count: u32) -> u8 {
        let middle = 0.5 * (self.border(row) + self.border(row + 1));
        ((0.5 * middle * f64::from(count)) as u32).min(count - 1) as u8
    }

    /// Points along the rim of a window of cells.
    pub fn rim(&self, window: Window) -> impl Iterator<Item = DVec3> + '_ {
        let half = if self.nearest { 0.0 } else { 0.5 };
        let at = move |i: u32, j: u32| {
            let phi = std::f64::consts::TAU * (f64::from(window.x + i) - half) / f64::from(self.width);
            let zeta = self.border(window.y + j);
            let sin = (zeta * (2.0 - zeta)).max(0.0).sqrt();
            DVec3::new(real::sin(phi) * sin, 1.0 - zeta, -real::cos(phi) * sin)
        };
        let level = (0..=window.width).flat_map(move |i| [at(i, 0), at(i, window.height)]);
        level.chain((0..=window.height).flat_map(move |j| [at(0, j), at(window.width, j)]))
    }

    /// The four texels at the corners of a cell: left and right of the upper, then of the lower row.
    #[inline]
    pub fn corners(&self, column: u32, row: u32) -> [(u32, u32); 4] {
        if self.nearest {
            return [(column, row); 4];
        }
        let left = if column == 0 { self.width - 1 } else { column - 1 };
        let (above, below) = (row.saturating_sub(1), row.min(self.height - 1));
        [(left, above), (column, above), (left, below), (column, below)]
    }

    /// ζ at the upper border of a row of cells.
    #[inline]
    fn border(&self, row: u32) -> f64 {
        self.borders[row as usize]
    }

    /// θ at the upper border of a row of cells and the height of the row, in rows of texels.
    #[inline]
    fn span(&self, row: u32) -> [f32; 2] {
        let half = if self.nearest { 0.0 } else { 0.5 };
        let top = (row as f32 - half).max(0.0);
        [top, (row as f32 + 1.0 - half).min(self.height as f32) - top]
    }

    /// Solid angle of a cell of a row [sr].
    #[inline]
    fn solid_angle(&self, row: u32) -> f64 {
        std::f64::consts::TAU / f64::from(self.width) * (self.border(row + 1) - self.border(row))
    }

    /// Where a unit direction falls.
    #[inline]
    pub fn place(&self, d: World) -> Place {
        let half = if self.nearest { 0.0 } else { 0.5 };
        let turns = real::atan2f(d.x, -d.z) * (0.5 * real::INV_PI);
        let x = (if turns < 0.0 { turns + 1.0 } else { turns }) * self.width as f32 + half;
        let theta = real::atan2f((d.x * d.x + d.z * d.z).sqrt(), d.y);
        let y = theta * real::INV_PI * self.height as f32;
        let rows = self.whole().height;
        let row = ((y + half) as u32).min(rows - 1);
        let column = x as u32;
        let [top, height] = self.span(row);
        let [upper, lower] = [self.border(row), self.border(row + 1)];
        let t = ((zeta(d) - upper) / (lower - upper)).clamp(0.0, 1.0) as f32;
        let v = ((y - top) / height).clamp(0.0, 1.0);
        Place { column: column % self.width, row, s: x - column as f32, v, t }
    }

    /// The direction of a place.
    #[inline]
    fn direction(&self, place: Place, zeta: f64) -> World {
        let half = if self.nearest { 0.0 } else { 0.5 };
        let turns = (place.column as f32 - half + place.s) / self.width as f32;
        let phi = 2.0 * real::PI * turns;
        let sin = (zeta * (2.0 - zeta)).max(0.0).sqrt() as f32;
        World::new(real::sinf(phi) * sin, (1.0 - zeta) as f32, -real::cosf(phi) * sin)
    }
}

/// 1 − cos θ of a unit vector, exact near both poles.
#[inline]
fn zeta(d: World) -> f64 {
    let [x, y, z] = [d.x, d.y, d.z].map(f64::from);
    let level = x * x + z * z;
    if y >= 0.0 { level / (1.0 + y) } else { 2.0 - level / (1.0 - y) }
}

impl Cells {
    /// Over a window of cells, in proportion to `light`, the luminance of a texel; with ∫ of light × direction, and ∫ of
    /// light.
    pub fn new(grid: &Grid, window: Window, light: impl Fn(u32, u32) -> f32) -> (Cells, [f64; 4]) {
        let (w, h) = (window.width as usize, window.height as usize);
        let (mut columns, mut ends) = (Vec::with_capacity(w * h), Vec::with_capacity(w));
        let (mut row_light, mut line) = (Vec::with_capacity(h), vec![0.0f32; w]);
        let middle = if grid.nearest { 0.5 } else { 0.0 };
        let around: Vec<[f64; 2]> = (0..window.width)
            .map(|i| std::f64::consts::TAU * (f64::from(window.x + i) + middle) / f64::from(grid.width))
            .map(|phi| [real::sin(phi), -real::cos(phi)])
            .collect();
        let mut vector = [0.0; 4];
        for row in window.y..window.y + window.height {
            let [mut sum, mut x, mut z] = [0.0; 3];
            for (i, (mean, [east, south])) in line.iter_mut().zip(&around).enumerate() {
                let corners = grid.corners((window.x + i as u32) % grid.width, row);
                *mean = 0.25 * corners.iter().map(|(x, y)| light(*x, *y)).sum::<f32>();
                let l = f64::from(*mean);
                (sum, x, z) = (sum + l, x + l * east, z + l * south);
            }
            steps::share_out(line.iter().copied(), &mut ends);
            ends.resize(w, 0);
            columns.extend_from_slice(&ends);
            let (area, zeta) = (grid.solid_angle(row), 0.5 * (grid.border(row) + grid.border(row + 1)));
            let sin = (zeta * (2.0 - zeta)).max(0.0).sqrt();
            row_light.push((sum * area) as f32);
            let terms = [x * sin, sum * (1.0 - zeta), z * sin, sum];
            (0..4).for_each(|k| vector[k] += terms[k] * area);
        }
        let mut rows = Vec::with_capacity(h);
        steps::share_out(row_light.iter().copied(), &mut rows);
        (Cells { grid: grid.clone(), window, rows, columns }, vector)
    }

    /// Nothing to draw.
    pub fn is_black(&self) -> bool {
        self.rows.is_empty()
    }

    /// The numbers of the table, for a hash.
    pub fn words(&self) -> impl Iterator<Item = u32> + '_ {
        self.rows.iter().chain(&self.columns).copied()
    }

    /// Draws a place and its direction; `light` is the luminance at the corners of a cell, as the table was made of.
    #[inline]
    pub fn sample(
        &self,
        u: [f32; 2],
        light: impl FnOnce([(u32, u32); 4]) -> [f32; 4],
    ) -> Option<(Place, World)> {
        let w = self.window.width as usize;
        let row = steps::pick(&self.rows, u[1])?;
        let column = steps::pick(&self.columns[row.index * w..(row.index + 1) * w], u[0])?;
        let (i, j) =
            ((self.window.x + column.index as u32) % self.grid.width, self.window.y + row.index as u32);
        let [a, b, c, d] = light(self.grid.corners(i, j));
        let t = ramp(row.rest, a + b, c + d);
        let s = ramp(column.rest, a + (c - a) * t, b + (d - b) * t);
        let [upper, lower] = [self.grid.border(j), self.grid.border(j + 1)];
        let zeta = upper + (lower - upper) * f64::from(t);
        let sin = (zeta * (2.0 - zeta)).max(0.0).sqrt();
        let y = real::atan2f(sin as f32, (1.0 - zeta) as f32) * real::INV_PI * self.grid.height as f32;
        let [top, height] = self.grid.span(j);
        let place = Place { column: i, row: j, s, v: ((y - top) / height).clamp(0.0, 1.0), t };
        Some((place, self.grid.direction(place, zeta)))
    }

    /// The density at a place [1/sr]; `light` is the luminance at the corners of its cell.
    #[inline]
    pub fn pdf(&self, place: Place, light: [f32; 4]) -> f32 {
        let (w, window) = (self.window.width as usize, &self.window);
        let i = (place.column + self.grid.width - window.x) % self.grid.width;
        let j = place.row.wrapping_sub(window.y);
        if self.rows.is_empty() || i >= window.width || j >= window.height {
            return 0.0;
        }
        let [a, b, c, d] = light;
        let mean = 0.25 * (a + b + c + d);
        if mean <= 0.0 {
            return 0.0;
        }
        let (left, right) = (a + (c - a) * place.t, b + (d - b) * place.t);
        let here = left + (right - left) * place.s;
        let columns = &self.columns[j as usize * w..(j as usize + 1) * w];
        let prob = steps::prob(&self.rows, j as usize) * steps::prob(columns, i as usize);
        prob * (here / mean) / self.grid.solid_angle(place.row) as f32
    }
}

/// A number in [0, 1] with a density that goes linearly from `a` to `b`, not both 0.
#[inline]
fn ramp(u: f32, a: f32, b: f32) -> f32 {
    let (u, a, b) = (f64::from(u), f64::from(a), f64::from(b));
    let root = (a * a + u * (b * b - a * a)).max(0.0).sqrt();
    if a + root <= 0.0 {
        return u as f32;
    }
    ((u * (a + b) / (a + root)) as f32).clamp(0.0, 1.0)
}
