//! A picture of the whole sky in latitude and longitude: looked up, and drawn from.
//!
//! d = (sin φ sin θ, cos θ, −cos φ sin θ), φ = 2πu, θ = πv, v = 0 at the top row. Directions are in the map's frame.

mod cells;
mod harmonics;
mod parts;
mod sun;

use std::sync::Arc;

use antumbra_math::{Rgb, World};

use super::flat::amount_fault;
use crate::texture::Image;
use cells::{Grid, Place};
use harmonics::Harmonics;
use parts::{Chances, Part, Regards, Tiles};
use sun::Split;

/// The picture and what was computed from it once.
pub struct LatLong {
    image: Arc<Image>,
    grid: Grid,
    /// Of the picture without its sun.
    harmonics: Harmonics,
    /// The sun and its flux.
    sun: Option<(Split, f64)>,
    /// The sun first, if there is one, then tiles of the rest.
    parts: Vec<Part>,
    regards: Regards,
    tiles: Tiles,
    fault: Option<String>,
}

/// Short: its size and a hash of its light, not a million texels.
impl std::fmt::Debug for LatLong {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let color = self.image.mean().0.map(f32::to_bits);
        let light = self.parts.iter().flat_map(|part| part.cells.words());
        let hash = antumbra_math::hash::fnv1a_words(light.chain(color));
        write!(f, "LatLong({} x {}, {hash:016x})", self.image.width, self.image.height)
    }
}

/// A direction drawn from the picture.
#[derive(Clone, Copy, Debug)]
pub struct Drawn {
    /// The direction.
    pub wi: World,
    /// Radiance from it.
    pub radiance: Rgb,
    /// p(ω) [1/sr].
    pub pdf: f32,
}

impl LatLong {
    /// From a picture; looked up at the nearest texel or bilinearly between texel centres.
    pub fn new(image: Arc<Image>, nearest: bool) -> LatLong {
        let grid = Grid::new(image.width, image.height, nearest);
        let (mut light, fault) = luminances(&image);
        let (w, h) = (grid.width, grid.height);
        let at = |light: &[f32], x: u32, y: u32| light[y as usize * w as usize + x as usize];
        let mut harmonics = Harmonics::of(w, h, |x, y| at(&light, x, y));
        let whole = 4.0 * std::f64::consts::PI * harmonics.mean();
        let sun = Split::find(&grid, whole, |x, y| at(&light, x, y));
        let mut parts = Vec::new();
        if let Some((split, _)) = &sun {
            let of_sun = |x, y| split.of(x, y, at(&light, x, y));
            parts.extend(Part::new(&grid, grid.touched(split.texels), of_sun));
            for (i, l) in light.iter_mut().enumerate() {
                *l -= split.of((i % w as usize) as u32, (i / w as usize) as u32, *l);
            }
            harmonics = Harmonics::of(w, h, |x, y| at(&light, x, y));
        }
        let tiles = Tiles::new(&grid, |x, y| at(&light, x, y), &mut parts);
        let regards = Regards::of(&parts);
        LatLong { image, grid, harmonics, sun, parts, regards, tiles, fault }
    }

    /// The picture.
    pub fn image(&self) -> &Arc<Image> {
        &self.image
    }

    /// Looked up at the nearest texel.
    pub fn nearest(&self) -> bool {
        self.grid.nearest
    }

    /// Radiance from the unit direction `d`.
    #[inline]
    pub fn radiance(&self, d: World) -> Rgb {
        let place = self.grid.place(d);
        between(self.colors(place), place)
    }

    /// Draws a direction for a receiver with the normal `n`: a part by about what it gives there, in it in proportion to
    /// its luminance.
    #[inline]
    pub fn sample(&self, u: [f32; 2], n: World) -> Option<Drawn> {
        let chances = Chances::new(&self.regards, n);
        let choice = chances.pick(u[1])?;
        let (cells, u) = (&self.parts[choice.index].cells, [u[0], choice.rest]);
        let (place, wi) = cells.sample(u, |corners| {
            let light = corners.map(|(x, y)| self.light(x, y));
            match &self.sun {
                Some((sun, _)) if choice.index == 0 => suns(sun, corners, light),
                _ => self.rest(corners, light),
            }
        })?;
        let colors = self.colors(place);
        Some(Drawn { wi, radiance: between(colors, place), pdf: self.density(place, colors, &chances) })
    }

    /// The density of `sample` in the unit direction `d`.
    #[inline]
    pub fn pdf(&self, d: World, n: World) -> f32 {
        let place = self.grid.place(d);
        self.density(place, self.colors(place), &Chances::new(&self.regards, n))
    }

    /// The density at a place whose cell has these colours at its corners.
    #[inline]
    fn density(&self, place: Place, colors: [Rgb; 4], chances: &Chances) -> f32 {
        let (corners, light) = (self.grid.corners(place.column, place.row), colors.map(Rgb::luminance));
        let mut sum = 0.0;
        if let Some(part) = self.tiles.part(place.column, place.row) {
            sum += chances.of(part) * self.parts[part].cells.pdf(place, self.rest(corners, light));
        }
        if let (Some((sun, _)), Some(part)) = (&self.sun, self.parts.first()) {
            sum += chances.of(0) * part.cells.pdf(place, suns(sun, corners, light));
        }
        sum
    }

    /// ∫ L cos⁺ about the unit normal n, luminance: the sun and the harmonics of the rest.
    pub fn irradiance(&self, n: World) -> f32 {
        let sun = self.parts.first().filter(|_| self.sun.is_some());
        sun.map_or(0.0, |s| s.irradiance(n)) + self.harmonics.irradiance(n)
    }

    /// Mean luminance over the sphere.
    pub fn mean(&self) -> f64 {
        let sun = self.sun.as_ref().map_or(0.0, |(_, flux)| *flux);
        self.harmonics.mean() + sun / (4.0 * std::f64::consts::PI)
    }

    /// What is wrong with the picture.
    pub fn fault(&self) -> Option<String> {
        self.fault.clone()
    }

    /// Those at the corners of the cell of a place.
    #[inline]
    fn colors(&self, place: Place) -> [Rgb; 4] {
        self.grid.corners(place.column, place.row).map(|(x, y)| color(&self.image, x, y))
    }

    #[inline]
    fn light(&self, x: u32, y: u32) -> f32 {
        luminance(&self.image, x, y)
    }

    /// What of the luminance of four texels is not the sun's.
    #[inline]
    fn rest(&self, corners: [(u32, u32); 4], light: [f32; 4]) -> [f32; 4] {
        let Some((sun, _)) = &self.sun else { return light };
        let suns = suns(sun, corners, light);
        std::array::from_fn(|k| light[k] - suns[k])
    }
}

/// What of the luminance of four texels is the sun's.
#[inline]
fn suns(sun: &Split, corners: [(u32, u32); 4], light: [f32; 4]) -> [f32; 4] {
    std::array::from_fn(|k| sun.of(corners[k].0, corners[k].1, light[k]))
}

/// The colour at a place between those at the corners of its cell.
#[inline]
fn between([a, b, c, d]: [Rgb; 4], place: Place) -> Rgb {
    let (top, bottom) = (a.lerp(b, place.s), c.lerp(d, place.s));
    top.lerp(bottom, place.v)
}

#[inline]
fn color(image: &Image, x: u32, y: u32) -> Rgb {
    let [r, g, b, _] = image.texel(x, y);
    Rgb::new(r, g, b)
}

#[inline]
fn luminance(image: &Image, x: u32, y: u32) -> f32 {
    color(image, x, y).luminance()
}

/// Luminance of every texel, and the first texel that is negative or not finite.
fn luminances(image: &Image) -> (Vec<f32>, Option<String>) {
    let mut fault = None;
    let mut light = Vec::with_capacity(image.width as usize * image.height as usize);
    for y in 0..image.height {
        for x in 0..image.width {
            let texel = color(image, x, y);
            if fault.is_none() {
                fault = amount_fault(texel).map(|why| format!("texel ({x}, {y}) of its image: {why}"));
            }
            light.push(texel.luminance());
        }
    }
    (light, fault)
}

#[cfg(test)]
mod tests;
