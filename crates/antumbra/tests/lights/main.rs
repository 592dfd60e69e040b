//! The laws of every kind of light and of every way to choose among lights, walked through `Light::examples()`.

// A broken table or example should stop the test.
#![allow(clippy::unwrap_used)]

mod closed_forms;
mod draws;
mod faults;
mod power;
mod samplers;
mod scale;
mod surface;

use antumbra::bsdf::{Bsdf, Diffuse};
use antumbra::light::{Light, LightPoints, LightSample};
use antumbra::math::hash::{hash3, unit_f32};
use antumbra::math::{Frame, Local, Rgb, World};
use antumbra::receiver::Receiver;
use antumbra::trace::NO_PRIM;

/// A bare point p with the unit normal n along `normal`.
fn receiver(p: [f32; 3], normal: [f32; 3]) -> Receiver {
    let n = World::from_array(normal).normalize();
    Receiver {
        p: World::from_array(p),
        start: p,
        beyond: p,
        prim: NO_PRIM,
        ng: n,
        frame: Frame::about(n),
        wo: Local::new(0.0, 0.0, 1.0),
        bsdf: Bsdf::Diffuse(Diffuse { albedo: Rgb::WHITE }),
        cell: 0,
        stream: 0,
        index: 0,
        throughput: Rgb::WHITE,
        bounce: 0,
    }
}

/// Below the lights, tilted, near, beside them with the horizon across, and far away.
fn receivers() -> Vec<Receiver> {
    vec![
        receiver([0.0; 3], [0.0, 1.0, 0.0]),
        receiver([0.1, 0.2, 0.3], [1.0, 2.0, -1.0]),
        receiver([0.3, 1.42, -0.2], [0.2, 1.0, 0.0]),
        receiver([-2.0, 1.1, 0.4], [1.0, 0.1, 0.0]),
        receiver([15.0, -30.0, 20.0], [-1.0, 2.0, -1.0]),
    ]
}

/// Two numbers of a stream that depends on nothing else.
fn numbers(i: u32, seed: u32) -> [f32; 2] {
    [0, 1].map(|k| unit_f32(hash3(i, k, seed)))
}

/// `n` draws of a light; the ones that give no light are `None`.
fn draws(
    light: &Light,
    at: &Receiver,
    how: LightPoints,
    n: u32,
    seed: u32,
) -> impl Iterator<Item = Option<LightSample>> {
    (0..n).map(move |i| light.sample(at, numbers(i, seed), how))
}

const HOWS: [LightPoints; 2] = [LightPoints::SolidAngle, LightPoints::Area];

/// Mean and standard error of the mean.
fn mean(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (mut n, mut sum, mut sum2) = (0.0, 0.0, 0.0);
    values.for_each(|x| {
        n += 1.0;
        sum += x;
        sum2 += x * x;
    });
    let mean = sum / n;
    (mean, ((sum2 / n - mean * mean).max(0.0) / (n - 1.0)).sqrt())
}
