//! A thin lens: what is in focus is sharp, all else is a disk of the thin-lens formula.

use antumbra::estimator::EstimatorKind;
use antumbra::math::{DVec3, Rgb, Vec3, real};
use antumbra::render::Picture;
use antumbra::scene::{Camera, Lens, Material, SceneBuilder};
use antumbra::sensor::{Filter, Viewing};
use antumbra::settings::Settings;

use super::pictures::{look, small};
use super::scenes::parallelogram;

const SIDE: u32 = 64;

/// A bright square of 2 × 2 pixels, 4 ahead, through an opening of 0.4; a pixel is 1/320 wide at distance 1.
fn seen(focus: f64) -> Picture {
    let mut scene = SceneBuilder::new("spark");
    let bright = scene.material(Material::light(Rgb::WHITE));
    let (corner, side) = (Vec3::new(-0.0125, -0.0125, -4.0), 0.025);
    let square = parallelogram(corner, Vec3::new(side, 0.0, 0.0), Vec3::new(0.0, side, 0.0));
    scene.object("spark", square, bright);
    let fov = 2.0 * real::atan(0.1);
    let pinhole = Camera::perspective(DVec3::ZERO, DVec3::NEG_Z, fov.to_degrees());
    scene.cameras.push(Camera { lens: Some(Lens { radius: 0.2, focus }), ..pinhole });
    let ours = Settings { size: Some([SIDE; 2]), viewing: Viewing::Filter, ..small(EstimatorKind::Area) };
    look(&scene.build().unwrap(), &Settings { filter: Filter::Box, ..ours })
}

/// Light of a picture, and its mean squared distance from the middle [pixels²].
fn moment(picture: &Picture) -> [f64; 2] {
    let (mut light, mut square) = (0.0, 0.0);
    for (i, pixel) in picture.pixels.iter().enumerate() {
        let off = [i as u32 % SIDE, i as u32 / SIDE].map(|x| f64::from(x) + 0.5 - f64::from(SIDE) / 2.0);
        light += f64::from(pixel[1]);
        square += f64::from(pixel[1]) * (off[0] * off[0] + off[1] * off[1]);
    }
    [light, square / light]
}

#[test]
fn a_spark_in_focus_is_sharp_and_out_of_it_a_disk() {
    // Four pixels, their centres 1/√2 from the middle; rays are f32, so that edges are off by 10⁻⁵ pixels.
    let [light, square] = moment(&seen(4.0));
    assert!((light - 4.0).abs() < 0.01 && (square - 0.5).abs() < 0.01, "{light} {square}");
    for focus in [2.0, 8.0] {
        let [light, square] = moment(&seen(focus));
        // A·|d − f|/(d·f) at distance 1, in pixels; ⟨r²⟩ = R²/2 of an even disk, 2·2²/12 of the square, 2/12 of pixels.
        let diameter = 0.4 * (4.0 - focus).abs() / (4.0 * focus) * 320.0;
        let truth = diameter * diameter / 8.0 + 4.0 / 6.0 + 1.0 / 6.0;
        // 1024 rays hit it: 3 % of the light, 1.8 % (r² is even on the disk) of the moment, 1 σ each; 5 σ pass.
        assert!((light / 4.0 - 1.0).abs() < 0.16, "{focus} {light}");
        assert!((square / truth - 1.0).abs() < 0.09, "{focus} {square} {truth}");
    }
}
