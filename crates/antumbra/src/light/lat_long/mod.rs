//! A picture of the whole sky in latitude and longitude: looked up, drawn from, and convolved with the cosine.
//!
//! d = (sin φ sin θ, cos θ, −cos φ sin θ), φ = 2πu, θ = πv, v = 0 at the top row. Directions are in the map's frame.

use std::sync::Arc;

use antumbra_math::{Rgb, World, real};

use super::flat::amount_fault;
use super::steps;
use crate::texture::{Image, Texture, Wrap};

/// The picture and what was computed from it once.
pub struct LatLong {
    texture: Texture,
    /// Choice of the row, then per row of the texel (width entries each; a row without light has zeros).
    rows: Vec<u32>,
    columns: Vec<u32>,
    /// cos θ of the borders of the rows, height + 1 of them.
    border_cos: Vec<f64>,
    /// Luminance in the nine real spherical harmonics up to l = 2.
    harmonics: [f64; 9],
    fault: Option<String>,
}

/// Short: its size and a hash of its light, not a million texels.
impl std::fmt::Debug for LatLong {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let light = self.rows.iter().chain(&self.columns).copied();
        let color = self.texture.image.mean().0.map(f32::to_bits);
        let hash = antumbra_math::hash::fnv1a_words(light.chain(color));
        write!(f, "LatLong({} x {}, {hash:016x})", self.texture.image.width, self.texture.image.height)
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
        let (w, h) = (image.width as usize, image.height as usize);
        let border_cos: Vec<f64> =
            (0..=h).map(|j| real::cos(std::f64::consts::PI * j as f64 / h as f64)).collect();
        let (light, fault) = luminances(&image);
        let harmonics = project(&light, w, &border_cos);
        let light = if nearest { light } else { cell_means(light, w, h) };
        let (mut columns, mut row_ends) = (Vec::with_capacity(w * h), Vec::with_capacity(w));
        for row in light.chunks_exact(w) {
            steps::share_out(row.iter().copied(), &mut row_ends);
            row_ends.resize(w, 0);
            columns.extend_from_slice(&row_ends);
        }
        let row_light = (0..h).map(|j| {
            let sum: f64 = light[j * w..(j + 1) * w].iter().map(|l| f64::from(*l)).sum();
            (sum * (border_cos[j] - border_cos[j + 1])) as f32
        });
        let mut rows = Vec::with_capacity(h);
        steps::share_out(row_light, &mut rows);
        let texture = Texture { wrap: [Wrap::Repeat, Wrap::Clamp], nearest, ..Texture::new(image) };
        LatLong { texture, rows, columns, border_cos, harmonics, fault }
    }

    /// The picture.
    pub fn image(&self) -> &Arc<Image> {
        &self.texture.image
    }

    /// Looked up at the nearest texel.
    pub fn nearest(&self) -> bool {
        self.texture.nearest
    }

    /// Radiance from the unit direction `d`.
    #[inline]
    pub fn radiance(&self, d: World) -> Rgb {
        self.look_up(coordinates(d))
    }

    /// Draws a texel in proportion to its luminance (mean of the interpolated picture) times its solid angle, then a
    /// direction in it, uniform in φ and in cos θ: constant density over the texel.
    #[inline]
    pub fn sample(&self, u: [f32; 2]) -> Option<Drawn> {
        let w = self.texture.image.width as usize;
        let row = steps::pick(&self.rows, u[1])?;
        let column = steps::pick(&self.columns[row.index * w..(row.index + 1) * w], u[0])?;
        let (upper, lower) = (self.border_cos[row.index], self.border_cos[row.index + 1]);
        let cos = upper + (lower - upper) * f64::from(row.rest);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let x = (column.index as f32 + column.rest) / w as f32;
        let phi = 2.0 * real::PI * x;
        let (sin32, cos32) = (sin as f32, cos as f32);
        let wi = World::new(real::sinf(phi) * sin32, cos32, -real::cosf(phi) * sin32);
        let v = real::atan2f(sin32, cos32) * real::INV_PI;
        let pdf = row.prob * column.prob / self.texel_solid_angle(row.index);
        Some(Drawn { wi, radiance: self.look_up([x, v]), pdf })
    }

    /// The density of `sample` in the unit direction `d`.
    #[inline]
    pub fn pdf(&self, d: World) -> f32 {
        if self.rows.is_empty() {
            return 0.0;
        }
        let (w, h) = (self.texture.image.width as usize, self.texture.image.height as usize);
        let [u, v] = coordinates(d);
        let (i, j) = (((u * w as f32) as usize).min(w - 1), ((v * h as f32) as usize).min(h - 1));
        let columns = &self.columns[j * w..(j + 1) * w];
        steps::prob(&self.rows, j) * steps::prob(columns, i) / self.texel_solid_angle(j)
    }

    /// ∫ L cos⁺ about the unit normal n, luminance: the nine harmonics, each weakened by the cosine to π, 2π/3, π/4
    /// (Ramamoorthi and Hanrahan 2001). Exact up to l = 2, a few percent off for smooth skies, and too broad under a
    /// sharp sun, so never less than a part of what an even sky of the same light would give.
    pub fn irradiance(&self, n: World) -> f32 {
        let pi = std::f64::consts::PI;
        let weaken = |l: usize| [pi, 2.0 * pi / 3.0, pi / 4.0][l];
        let basis = harmonics_at(n.as_dvec3().to_array());
        let sum: f64 = (0..9)
            .map(|i| weaken(usize::from(i > 0) + usize::from(i > 3)) * self.harmonics[i] * basis[i])
            .sum();
        let even = pi * self.mean();
        sum.max(0.05 * even) as f32
    }

    /// Mean luminance over the sphere.
    pub fn mean(&self) -> f64 {
        self.harmonics[0] * Y00
    }

    /// What is wrong with the picture.
    pub fn fault(&self) -> Option<String> {
        self.fault.clone()
    }

    #[inline]
    fn look_up(&self, uv: [f32; 2]) -> Rgb {
        let [r, g, b, _] = self.texture.at(uv);
        Rgb::new(r, g, b)
    }

    #[inline]
    fn texel_solid_angle(&self, row: usize) -> f32 {
        let width = 2.0 * std::f64::consts::PI / f64::from(self.texture.image.width);
        (width * (self.border_cos[row] - self.border_cos[row + 1])) as f32
    }
}

/// (u, v) in [0, 1]² of a direction; θ by atan2, which keeps its digits at the poles.
#[inline]
fn coordinates(d: World) -> [f32; 2] {
    let phi = real::atan2f(d.x, -d.z);
    let u = phi * (0.5 * real::INV_PI);
    let v = real::atan2f((d.x * d.x + d.z * d.z).sqrt(), d.y) * real::INV_PI;
    [if u < 0.0 { u + 1.0 } else { u }, v]
}

/// Luminance of every texel, and the first texel that is negative or not finite.
fn luminances(image: &Image) -> (Vec<f32>, Option<String>) {
    let mut fault = None;
    let mut light = Vec::with_capacity(image.width as usize * image.height as usize);
    for y in 0..image.height {
        for x in 0..image.width {
            let [r, g, b, _] = image.texel(x, y);
            let texel = Rgb::new(r, g, b);
            if fault.is_none() {
                fault = amount_fault(texel).map(|why| format!("texel ({x}, {y}) of its image: {why}"));
            }
            light.push(texel.luminance());
        }
    }
    (light, fault)
}

/// Mean of the bilinearly interpolated picture over each texel: (1 6 1)/8 along both axes, which is above 0 wherever
/// interpolation is.
fn cell_means(mut light: Vec<f32>, w: usize, h: usize) -> Vec<f32> {
    let blur = |before: f32, here: f32, after: f32| 0.125 * (before + 6.0 * here + after);
    let mut line = vec![0.0; w.max(h)];
    for row in light.chunks_exact_mut(w) {
        line[..w].copy_from_slice(row);
        for i in 0..w {
            row[i] = blur(line[(i + w - 1) % w], line[i], line[(i + 1) % w]);
        }
    }
    // Row by row with the row above kept, so that memory is read in order.
    let mut above = light[..w].to_vec();
    for j in 0..h {
        for i in 0..w {
            let here = light[j * w + i];
            let below = light[(j + 1).min(h - 1) * w + i];
            light[j * w + i] = blur(above[i], here, below);
            above[i] = here;
        }
    }
    light
}

/// Y₀₀.
const Y00: f64 = 0.282_094_791_773_878_14;

/// The real spherical harmonics up to l = 2 in the unit direction d.
fn harmonics_at([x, y, z]: [f64; 3]) -> [f64; 9] {
    const Y1: f64 = 0.488_602_511_902_919_9;
    const Y2: f64 = 1.092_548_430_592_079_2;
    const Y20: f64 = 0.315_391_565_252_520_05;
    const Y22: f64 = 0.546_274_215_296_039_6;
    [
        Y00,
        Y1 * y,
        Y1 * z,
        Y1 * x,
        Y2 * x * y,
        Y2 * y * z,
        Y20 * (3.0 * z * z - 1.0),
        Y2 * x * z,
        Y22 * (x * x - y * y),
    ]
}

/// ∫ L Y dω: every texel at its middle with its solid angle.
fn project(light: &[f32], w: usize, border_cos: &[f64]) -> [f64; 9] {
    let step = 2.0 * std::f64::consts::PI / w as f64;
    let around: Vec<[f64; 2]> = (0..w)
        .map(|i| {
            let phi = step * (i as f64 + 0.5);
            [real::sin(phi), -real::cos(phi)]
        })
        .collect();
    let mut sums = [0.0; 9];
    for (j, row) in light.chunks_exact(w).enumerate() {
        let cos = 0.5 * (border_cos[j] + border_cos[j + 1]);
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        let solid_angle = step * (border_cos[j] - border_cos[j + 1]);
        for (l, [x, z]) in row.iter().zip(&around) {
            let basis = harmonics_at([x * sin, cos, z * sin]);
            let weight = f64::from(*l) * solid_angle;
            (0..9).for_each(|i| sums[i] += weight * basis[i]);
        }
    }
    sums
}
