//! Environments of the table: formulas of the direction, stored as pictures.

use std::sync::Arc;

use antumbra::light::Environment;
use antumbra::math::{DVec3, Rgb, real};
use antumbra::texture::{Image, Texels};
use serde_json::Value;

use super::table::{number, numbers};

const PI: f64 = std::f64::consts::PI;

/// A radiance by direction, and how many texels store it.
pub struct Sky {
    formula: Formula,
    width: u32,
    height: u32,
    /// Each texel a patch of one radiance: borders of the formula are borders of texels.
    nearest: bool,
}

enum Formula {
    Constant(f64),
    CosLobe { m: DVec3, k: f64 },
    Sh2 { c: f64, a: DVec3, b: f64 },
    Overcast(f64),
    Patch { elevation: [f64; 2], azimuth: [f64; 2], l: f64 },
}

impl Sky {
    /// Of an `env` of the table.
    pub fn of(env: &Value) -> Sky {
        let (width, height) = (256, 128);
        let vector = |k: &str| DVec3::from(numbers::<3>(&env[k]));
        match env["type"].as_str().unwrap() {
            "constant" => {
                Sky { formula: Formula::Constant(number(&env["L"])), width: 1, height: 1, nearest: true }
            }
            "cos_lobe" => {
                let formula = Formula::CosLobe { m: vector("m"), k: number(&env["k"]) };
                Sky { formula, width, height, nearest: false }
            }
            "sh2" => {
                let formula = Formula::Sh2 { c: number(&env["c"]), a: vector("a"), b: number(&env["b"]) };
                Sky { formula, width, height, nearest: false }
            }
            "overcast" => {
                Sky { formula: Formula::Overcast(number(&env["Lz"])), width, height, nearest: true }
            }
            "patch" => {
                let [elevation, azimuth] = [numbers(&env["g"]), numbers(&env["p"])];
                let formula = Formula::Patch { elevation, azimuth, l: number(&env["L"]) };
                // Rows of 5° for the zone from 20° to 40°, else the 64 × 32 map of the texel.
                let (width, height) = if azimuth[1] > 6.0 { (72, 36) } else { (64, 32) };
                Sky { formula, width, height, nearest: true }
            }
            other => panic!("an environment of type {other}"),
        }
    }

    /// L(ω).
    fn radiance(&self, w: DVec3) -> f64 {
        match self.formula {
            Formula::Constant(l) => l,
            Formula::CosLobe { m, k } => real::pow(w.dot(m).max(0.0), k),
            Formula::Sh2 { c, a, b } => c + a.dot(w) + b * 0.5 * (3.0 * w.y * w.y - 1.0),
            Formula::Overcast(lz) => {
                if w.y > 0.0 {
                    lz * (1.0 + 2.0 * w.y) / 3.0
                } else {
                    0.0
                }
            }
            Formula::Patch { elevation, azimuth, l } => {
                let (g, p) = (real::asin(w.y), real::atan2(w.z, w.x));
                let p = if p < 0.0 { p + 2.0 * PI } else { p };
                let inside = |x: f64, [from, to]: [f64; 2]| (from..=to).contains(&x);
                if inside(g, elevation) && inside(p, azimuth) { l } else { 0.0 }
            }
        }
    }

    /// The light.
    pub fn environment(&self) -> Environment {
        if let Formula::Constant(l) = self.formula {
            return Environment::constant(Rgb::grey(l as f32));
        }
        let texels = self.stored().into_iter().map(|l| [l as f32; 3]).collect();
        let image = Image::new(self.width, self.height, Texels::Float(texels)).unwrap();
        Environment::image(Arc::new(image)).nearest(self.nearest)
    }

    /// The radiance at the middle of each texel, row by row from the top.
    fn stored(&self) -> Vec<f64> {
        let texel = |i: u32| {
            let (x, y) = (f64::from(i % self.width) + 0.5, f64::from(i / self.width) + 0.5);
            self.radiance(self.direction(x, y))
        };
        (0..self.width * self.height).map(texel).collect()
    }

    /// d = (sin φ sin θ, cos θ, −cos φ sin θ) at a place in texels.
    fn direction(&self, x: f64, y: f64) -> DVec3 {
        let (phi, theta) = (2.0 * PI * x / f64::from(self.width), PI * y / f64::from(self.height));
        let sin = real::sin(theta);
        DVec3::new(real::sin(phi) * sin, real::cos(theta), -real::cos(phi) * sin)
    }

    /// ∫ (stored − L) cos⁺ about n dω by the midpoints of 6 × 6 parts of every texel.
    pub fn texels(&self, n: DVec3) -> f64 {
        const PARTS: u32 = 6;
        if matches!(self.formula, Formula::Constant(_)) {
            return 0.0;
        }
        let stored = self.stored();
        let (w, h) = (self.width as i32, self.height as i32);
        let at = |i: i32, j: i32| stored[(j.clamp(0, h - 1) * w + i.rem_euclid(w)) as usize];
        let look_up = |x: f64, y: f64| {
            if self.nearest {
                return at(x as i32, y as i32);
            }
            let (x, y) = (x - 0.5, y - 0.5);
            let (i, j) = (x.floor(), y.floor());
            let (fx, fy) = (x - i, y - j);
            let row = |j: i32| at(i as i32, j) * (1.0 - fx) + at(i as i32 + 1, j) * fx;
            row(j as i32) * (1.0 - fy) + row(j as i32 + 1) * fy
        };
        let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(PARTS);
        let cell = 2.0 * PI / f64::from(self.width * PARTS) * PI / f64::from(self.height * PARTS);
        let mut sum = 0.0;
        for y in (0..self.height * PARTS).map(middle) {
            let sin = real::sin(PI * y / f64::from(self.height));
            for x in (0..self.width * PARTS).map(middle) {
                let d = self.direction(x, y);
                let cos = d.dot(n);
                if cos > 0.0 {
                    sum += (look_up(x, y) - self.radiance(d)) * cos * sin * cell;
                }
            }
        }
        sum
    }
}
