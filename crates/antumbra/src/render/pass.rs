//! One pass of a render, for estimators that live elsewhere: its viewing rays and its random numbers.

use antumbra_math::Vec3;

use super::view::{camera, view};
use crate::sampler::{AnySampler, PassPlan, Use};
use crate::scene::{Scene, SceneError};
use crate::sensor::{CameraSensor, View};
use crate::settings::Settings;

/// Pass `number` of the render that settings ask for: pixel by pixel, row after row from the top.
pub struct Pass {
    sensor: CameraSensor,
    view: View,
    sampler: AnySampler,
    seed: u32,
    plan: PassPlan,
    number: u32,
}

impl Pass {
    /// Pass `number`, below the number of viewing rays.
    pub fn new(scene: &Scene, settings: &Settings, number: u32) -> Result<Pass, SceneError> {
        let camera = camera(scene, settings, &mut Vec::new())?;
        let view = view(&camera, settings)?;
        let plan = settings.passes_of(settings.viewing_rays);
        if number >= plan.count {
            let what = format!("there is no pass {number}: {} viewing rays make as many passes", plan.count);
            return Err(SceneError::new("", what, ""));
        }
        let sensor = CameraSensor::new(&camera, view);
        Ok(Pass { sensor, view, sampler: settings.sampler(), seed: settings.seed, plan, number })
    }

    /// Origin and unit direction of the viewing ray through the centre of each pixel.
    pub fn centres(&self) -> impl Iterator<Item = (Vec3, Vec3)> + '_ {
        self.pixels().map(|[x, y]| self.sensor.ray(f64::from(x) + 0.5, f64::from(y) + 0.5))
    }

    /// Origin and unit direction of each pixel's viewing ray: the very rays that a render of these settings takes.
    pub fn viewing_rays(&self) -> impl Iterator<Item = (Vec3, Vec3)> + '_ {
        self.pixels().map(|pixel| self.sensor.sample(pixel, &self.sampler, self.sample_of(pixel)))
    }

    /// Two numbers in [0, 1) for each pixel: those that a render of these settings has for this use.
    pub fn numbers(&self, what: Use, bounce: u32) -> impl Iterator<Item = [f32; 2]> + '_ {
        self.pixels().map(move |pixel| {
            let (stream, index, of) = self.sample_of(pixel);
            self.sampler.pair(stream, index, of, what.at(bounce))
        })
    }

    fn sample_of(&self, pixel: [u32; 2]) -> (u32, u32, u32) {
        let (replicate, index, of) = self.plan.locate(self.number);
        (self.sensor.stream(pixel, self.seed, replicate), index, of)
    }

    fn pixels(&self) -> impl Iterator<Item = [u32; 2]> + use<> {
        let [left, top, width, height] = self.view.crop;
        (0..height).flat_map(move |y| (0..width).map(move |x| [left + x, top + y]))
    }
}
