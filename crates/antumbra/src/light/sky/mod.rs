//! An analytic sky with its sun: a lat-long picture of the dome and the ground, and a disc.
//!
//! Axes: +y up, north −z, east +x, so that the picture's left border is north, its quarter east and its middle south.
//! Radiance is linear Rec. 709 of ∫ L(λ) x̄ȳz̄(λ) dλ [W·m⁻²·sr⁻¹]: luminance [cd/m²] is 683 times ours.

mod dome;
mod place;
mod sunlight;
mod words;

use std::sync::Arc;

use antumbra_math::{DVec3, Rgb, closed, real, solid_angle};

use super::{Environment, Light, Sun};
use crate::texture::{Image, Texels};
use dome::Dome;
pub use place::{Air, SunPosition, sun_position};

/// Half-angle of the sun at a distance of one astronomical unit [rad]: 959.63″ (Auwers).
pub const SUN_HALF_ANGLE: f64 = 959.63 / 3600.0 * std::f64::consts::PI / 180.0;

/// A clear or hazy sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// Of the sun's middle above the horizon, in [0, π/2] [rad].
    pub elevation: f64,
    /// Of the sun, clockwise from north (−z) over east (+x) [rad].
    pub azimuth: f64,
    /// Haze, in [1, 10]: 2 very clear, 3 clear, 6 hazy, 10 very hazy.
    pub turbidity: f64,
    /// Reflectance of the ground, in [0, 1]. It brightens the sky, and is what lies below the horizon: diffuse, level and
    /// lit by this sky and sun.
    pub albedo: f64,
    /// Half-angle of the sun [rad].
    pub half_angle: f64,
}

impl Default for Sky {
    /// An afternoon: the sun 45° high in the south-west.
    fn default() -> Sky {
        let (elevation, azimuth) = (45f64.to_radians(), 225f64.to_radians());
        Sky { elevation, azimuth, turbidity: 3.0, albedo: 0.3, half_angle: SUN_HALF_ANGLE }
    }
}

impl Sky {
    /// What is wrong with its numbers.
    pub fn fault(&self) -> Option<String> {
        let degrees = self.elevation.to_degrees();
        if !(0.0..=90.0).contains(&degrees) {
            let known = "the model knows it from 0° to 90°";
            return Some(format!("the sun stands {degrees:.2}° above the horizon: {known}"));
        }
        if !self.azimuth.is_finite() {
            return Some(format!("its azimuth is {}", self.azimuth));
        }
        if !(1.0..=10.0).contains(&self.turbidity) {
            return Some(format!("turbidity {} is not from 1 to 10", self.turbidity));
        }
        (!(0.0..=1.0).contains(&self.albedo)).then(|| format!("albedo {} is not from 0 to 1", self.albedo))
    }

    /// Unit vector toward the middle of the sun.
    pub fn to_sun(&self) -> DVec3 {
        let level = real::cos(self.elevation);
        let (sin, cos) = (real::sin(self.azimuth), real::cos(self.azimuth));
        DVec3::new(sin * level, real::sin(self.elevation), -cos * level)
    }

    /// The disc of the sun, of even radiance.
    pub fn sun(&self) -> Sun {
        let radiance = sunlight::radiance(self.elevation, self.turbidity);
        let sun = Sun::new(self.to_sun().as_vec3(), self.half_angle as f32, radiance);
        Sun { of_sky: true, ..sun }
    }

    /// What a scene takes: the dome as an environment, `width` texels around, and the sun as a light of its own.
    pub fn lights(&self, width: u32) -> Result<[(String, Light); 2], String> {
        let dome = Environment::image(Arc::new(self.picture(width, false)?));
        Ok([("sky".into(), dome.into()), ("sun".into(), self.sun().into())])
    }

    /// The whole as a lat-long picture, `width` × `width`/2 texels; `with_sun` spreads the disc over the texels that it
    /// covers, its energy kept.
    pub fn picture(&self, width: u32, with_sun: bool) -> Result<Image, String> {
        let width = width.max(2) & !1;
        let height = width / 2;
        if let Some(what) = self.fault() {
            return Err(what);
        }
        let dome = Dome::new(self.elevation, self.turbidity, self.albedo);
        let dome = dome.ok_or("the sky model refuses these numbers")?;
        let (to_sun, grid) = (self.to_sun(), Grid { width, height });
        let mut texels = Vec::with_capacity((width * height) as usize);
        let mut level = [0.0; 3];
        for y in 0..height.div_ceil(2) {
            for x in 0..width {
                let d = grid.direction(f64::from(x) + 0.5, f64::from(y) + 0.5);
                let cos = d.dot(to_sun).clamp(-1.0, 1.0);
                let l = dome.radiance(d.y.max(0.0), angle(d, to_sun), cos);
                (0..3).for_each(|c| level[c] += f64::from(l[c]) * grid.level_part(y));
                texels.push(l);
            }
        }
        texels.resize((width * height) as usize, self.ground(level));
        if with_sun {
            self.draw_sun(&mut texels, &grid);
        }
        Image::new(width, height, Texels::Float(texels)).ok_or_else(|| "it has no texels".into())
    }

    /// Radiance of the ground: albedo / π times the irradiance of sky and sun.
    fn ground(&self, sky: [f64; 3]) -> [f32; 3] {
        let sun = self.sun();
        let versin = solid_angle::versin(self.half_angle);
        let seen = closed::cone(versin, real::sin(self.elevation));
        let all = |c: usize| sky[c] + seen * f64::from(sun.radiance.0[c]);
        std::array::from_fn(|c| (self.albedo / std::f64::consts::PI * all(c)) as f32)
    }

    /// Adds the sun's light to the texels it covers: each in proportion to how many of 16 × 16 places in it lie on the
    /// disc; all to one texel where the disc falls between the places.
    fn draw_sun(&self, texels: &mut [[f32; 3]], grid: &Grid) {
        const SIDE: u32 = 16;
        let to_sun = self.to_sun();
        let near = real::cos(self.half_angle + 3.0 * std::f64::consts::PI / f64::from(grid.height));
        let mut shares = Vec::new();
        for i in 0..texels.len() as u32 {
            let (x, y) = (f64::from(i % grid.width), f64::from(i / grid.width));
            // Near a pole texels are thin, never long.
            if grid.direction(x + 0.5, y + 0.5).dot(to_sun) < near {
                continue;
            }
            let inside = |k: &u32| {
                let place = |k: u32| (f64::from(k) + 0.5) / f64::from(SIDE);
                angle(grid.direction(x + place(k % SIDE), y + place(k / SIDE)), to_sun) <= self.half_angle
            };
            let covered = (0..SIDE * SIDE).filter(inside).count();
            if covered > 0 {
                shares.push((i as usize, covered as f64 * grid.solid_angle(i / grid.width)));
            }
        }
        if shares.is_empty() {
            let i = grid.texel_of(to_sun);
            shares.push((i, grid.solid_angle(i as u32 / grid.width)));
        }
        let sum: f64 = shares.iter().map(|s| s.1).sum();
        let energy = solid_angle::cone(solid_angle::versin(self.half_angle));
        let Rgb(sun) = self.sun().radiance;
        for (i, share) in shares {
            let solid_angle = grid.solid_angle(i as u32 / grid.width);
            let part = (energy * share / sum / solid_angle) as f32;
            (0..3).for_each(|c| texels[i][c] += part * sun[c]);
        }
    }
}

/// The texels of a lat-long picture.
struct Grid {
    width: u32,
    height: u32,
}

impl Grid {
    /// d at a place in texels.
    fn direction(&self, x: f64, y: f64) -> DVec3 {
        let phi = std::f64::consts::TAU * x / f64::from(self.width);
        let theta = std::f64::consts::PI * y / f64::from(self.height);
        let sin = real::sin(theta);
        DVec3::new(real::sin(phi) * sin, real::cos(theta), -real::cos(phi) * sin)
    }

    /// The texel that holds a direction.
    fn texel_of(&self, d: DVec3) -> usize {
        let u = real::atan2(d.x, -d.z) / std::f64::consts::TAU;
        let v = real::acos(d.y.clamp(-1.0, 1.0)) / std::f64::consts::PI;
        let x = ((u - u.floor()) * f64::from(self.width)) as usize;
        let y = (v * f64::from(self.height)) as usize;
        y.min(self.height as usize - 1) * self.width as usize + x.min(self.width as usize - 1)
    }

    /// Solid angle of a texel of a row [sr].
    fn solid_angle(&self, row: u32) -> f64 {
        let [upper, lower] = self.borders(row);
        std::f64::consts::TAU / f64::from(self.width) * (upper - lower)
    }

    /// ∫ cos⁺ about the zenith over a texel of a row [sr].
    fn level_part(&self, row: u32) -> f64 {
        let [upper, lower] = self.borders(row).map(|c| c.max(0.0));
        std::f64::consts::PI / f64::from(self.width) * (upper * upper - lower * lower)
    }

    /// cos θ of the upper and the lower border of a row.
    fn borders(&self, row: u32) -> [f64; 2] {
        [row, row + 1].map(|j| real::cos(std::f64::consts::PI * f64::from(j) / f64::from(self.height)))
    }
}

/// The angle between unit vectors, exact where it is small.
fn angle(a: DVec3, b: DVec3) -> f64 {
    2.0 * real::asin((0.5 * (a - b).length()).min(1.0))
}

#[cfg(test)]
mod tests;
