//! A sun that stands out of a picture of the sky.
//!
//! The rule: about the brightest texel lies a cap of 2.5° (one and a half texels, where these are larger; none above 10°).
//! What of its texels is brighter than the mean of the ring around the cap, twice as wide, is a sun if it is at least a
//! twentieth of the picture's whole light.

use antumbra_math::{DVec3, real};

use super::cells::{Grid, Window};

/// Half-angle of the cap [rad].
const CAP: f64 = 2.5 * std::f64::consts::PI / 180.0;
/// The widest cap, where texels are large.
const WIDEST: f64 = 10.0 * std::f64::consts::PI / 180.0;
/// The least share of the light that is a sun.
const SHARE: f64 = 0.05;

/// Which texels are a sun's, and how much of their luminance.
pub struct Split {
    /// The texels of the sun.
    pub texels: Window,
    width: u32,
    /// Luminance above which light is the sun's.
    level: f32,
}

impl Split {
    /// How much of a texel's luminance is the sun's.
    #[inline]
    pub fn of(&self, x: u32, y: u32, light: f32) -> f32 {
        let column = (x + self.width - self.texels.x) % self.width;
        let inside = column < self.texels.width && y.wrapping_sub(self.texels.y) < self.texels.height;
        if inside { (light - self.level).max(0.0) } else { 0.0 }
    }

    /// The sun of a picture, if there is one, and ∫ of its luminance over all directions; `whole` is that of the picture.
    pub fn find(grid: &Grid, whole: f64, light: impl Fn(u32, u32) -> f32) -> Option<(Split, f64)> {
        let cap = CAP.max(1.5 * std::f64::consts::PI / f64::from(grid.height));
        if cap > WIDEST {
            return None;
        }
        let middle = brightest(grid, &light)?;
        let towards = direction(grid, middle.0, middle.1);
        let [inner, outer] = [real::cos(cap), real::cos(2.0 * cap)];
        let (mut ring, mut count) = (0.0, 0u32);
        for (x, y) in texels(grid, window(grid, middle, 2.0 * cap)) {
            let apart = direction(grid, x, y).dot(towards);
            if apart < inner && apart >= outer {
                ring += f64::from(light(x, y));
                count += 1;
            }
        }
        let level = if count > 0 { (ring / f64::from(count)) as f32 } else { 0.0 };
        let split = Split { texels: window(grid, middle, cap), width: grid.width, level };
        let part = |(x, y)| f64::from(split.of(x, y, light(x, y))) * solid_angle(grid, y);
        let flux: f64 = texels(grid, split.texels).map(part).sum();
        (flux > 0.0 && flux >= SHARE * whole).then_some((split, flux))
    }
}

/// The first of the brightest texels; `None` in a black picture.
fn brightest(grid: &Grid, light: impl Fn(u32, u32) -> f32) -> Option<(u32, u32)> {
    let (mut most, mut at) = (0.0, None);
    for y in 0..grid.height {
        for x in 0..grid.width {
            let l = light(x, y);
            if l > most {
                (most, at) = (l, Some((x, y)));
            }
        }
    }
    at
}

/// The texels that may lie within an angle of one.
fn window(grid: &Grid, (x, y): (u32, u32), angle: f64) -> Window {
    let row = std::f64::consts::PI / f64::from(grid.height);
    let reach = (angle / row).ceil() as u32;
    let (top, bottom) = (y.saturating_sub(reach), (y + reach).min(grid.height - 1));
    let whole = Window { x: 0, y: top, width: grid.width, height: bottom - top + 1 };
    if top == 0 || bottom == grid.height - 1 {
        return whole;
    }
    // The meridian that touches a circle of this radius: sin Δφ = sin(angle) / sin θ.
    let sine = real::sin(angle) / real::sin(row * (f64::from(y) + 0.5));
    if sine >= 1.0 {
        return whole;
    }
    let columns = (real::asin(sine) / std::f64::consts::TAU * f64::from(grid.width)).ceil() as u32;
    let width = 2 * columns + 1;
    if width >= grid.width {
        return whole;
    }
    Window { x: (x + grid.width - columns) % grid.width, width, ..whole }
}

fn texels(grid: &Grid, window: Window) -> impl Iterator<Item = (u32, u32)> + use<> {
    let across = grid.width;
    (window.y..window.y + window.height)
        .flat_map(move |y| (0..window.width).map(move |i| ((window.x + i) % across, y)))
}

fn direction(grid: &Grid, x: u32, y: u32) -> DVec3 {
    let phi = std::f64::consts::TAU * (f64::from(x) + 0.5) / f64::from(grid.width);
    let theta = std::f64::consts::PI * (f64::from(y) + 0.5) / f64::from(grid.height);
    let sin = real::sin(theta);
    DVec3::new(real::sin(phi) * sin, real::cos(theta), -real::cos(phi) * sin)
}

fn solid_angle(grid: &Grid, row: u32) -> f64 {
    let border = |j: u32| real::cos(std::f64::consts::PI * f64::from(j) / f64::from(grid.height));
    std::f64::consts::TAU / f64::from(grid.width) * (border(row) - border(row + 1))
}
