//! Pictures and the errors of their parts.

use antumbra::estimator::EstimatorKind;
use antumbra::render::{Picture, render};
use antumbra::scene::Scene;
use antumbra::schedule::Flow;
use antumbra::sensor::Viewing;
use antumbra::settings::Settings;

use super::judge::Judge;

/// Sides of pictures and of the blocks that are compared.
pub const SIZE: [u32; 2] = [20, 15];
const BLOCK: u32 = 5;

/// Settings of a small picture: 256 viewing rays, so that 16 replicates tell the error; all through the middle of their
/// pixel, so that the noise is that of the light.
pub fn small(estimator: EstimatorKind) -> Settings {
    let base = Settings { estimator, size: Some(SIZE), viewing: Viewing::Centre, ..Settings::default() };
    Settings { viewing_rays: 256, threads: 1, seed: 3, ..base }
}

/// Renders.
pub fn look(scene: &Scene, settings: &Settings) -> Picture {
    render(scene, settings, None, &mut |_| Flow::Continue).unwrap()
}

/// Mean and standard error of the pixels of a part (columns, rows) in one component. Pixels have random numbers of
/// their own.
fn part(picture: &Picture, [x0, y0, x1, y1]: [u32; 4], c: usize) -> [f64; 2] {
    let errors = picture.standard_error.as_ref().unwrap();
    let (mut sum, mut square, mut n) = (0.0, 0.0, 0.0);
    for y in y0..y1 {
        for x in x0..x1 {
            let i = (y * picture.width + x) as usize;
            sum += f64::from(picture.pixels[i][c]);
            square += f64::from(errors[i][c]) * f64::from(errors[i][c]);
            n += 1.0;
        }
    }
    [sum / n, square.sqrt() / n]
}

/// Mean and standard error of a whole picture in one component.
pub fn whole(picture: &Picture, c: usize) -> [f64; 2] {
    part(picture, [0, 0, picture.width, picture.height], c)
}

/// The whole pictures and their blocks agree.
pub fn compare(judge: &mut Judge, name: &str, a: &Picture, b: &Picture) {
    for c in [0, 2] {
        judge.agree(format!("{name}, component {c}"), whole(a, c), whole(b, c));
    }
    for y in (0..a.height).step_by(BLOCK as usize) {
        for x in (0..a.width).step_by(BLOCK as usize) {
            let block = [x, y, (x + BLOCK).min(a.width), (y + BLOCK).min(a.height)];
            judge.agree(format!("{name}, block {x},{y}"), part(a, block, 1), part(b, block, 1));
        }
    }
}

/// A plane of a picture by its name.
pub fn plane<'a>(picture: &'a Picture, name: &str) -> &'a [f32] {
    &picture.aovs.iter().find(|(n, ..)| n == name).unwrap_or_else(|| panic!("no plane {name}")).2
}
