//! What settings mean for the rooms below: estimator, sampler, passes, lights; and which contradict each other.

use super::{Masks, SettingValue, Settings};
use crate::estimator::{EstimatorKind, Falloff, Mistake, Options};
use crate::film::Planes;
use crate::light::{Light, LightPoints};
use crate::sampler::{AnySampler, PassPlan, SamplerKind, SamplerOptions};
use crate::scene::{Level, Look, Message, Scene, SceneError};

impl Settings {
    /// What estimators are made of.
    pub fn options(&self) -> Options {
        Options {
            shadow_rays: self.shadow_rays,
            bounces: self.bounces,
            lights: self.lights,
            light_points: self.light_points,
            directions: self.directions,
            roulette: self.roulette,
            radius: self.radius,
            falloff: self.falloff,
            opaque: self.masks == Masks::Opaque,
            mistake: self.mistake,
        }
    }

    /// The passes of a render with `count` samples. A grid that is the same for all has no independent replicates: it is
    /// one set, and its error is not known.
    pub fn passes_of(&self, count: u32) -> PassPlan {
        let fixed = self.sampler == SamplerKind::Regular && !self.rotate;
        let plan = PassPlan::of(count);
        let replicates = if fixed { 1 } else { plan.replicates };
        PassPlan { replicates, until: self.passes.unwrap_or(count).min(count), ..plan }
    }

    /// The scene with the lights that the settings leave on; `environment` replaces the light from all around
    /// (empty: none).
    pub fn lit(&self, scene: &Scene, environment: Option<Vec<(String, Light)>>) -> Result<Scene, SceneError> {
        let scene = match environment {
            Some(lights) => scene.under(lights),
            None => scene.clone(),
        };
        if self.light.is_empty() {
            return Ok(scene);
        }
        scene
            .only_lights(&self.light)
            .map_err(|unknown| SceneError::unknown("light", &unknown, &scene.distinct_light_names()))
    }

    /// How the scene is looked at.
    pub fn look(&self) -> Look {
        Look { clay: self.clay, start: self.self_intersection }
    }

    /// Refuses settings that contradict each other.
    pub fn check(&self) -> Result<(), SceneError> {
        let heeded = self.estimator == EstimatorKind::AmbientOcclusion;
        if heeded && self.falloff != Falloff::None && self.radius.is_infinite() {
            let what = format!("falloff = {} needs a radius", self.falloff.show());
            let hint = "Give `radius`, the distance at which an occluder stops counting.";
            return Err(SceneError::new("", what, hint));
        }
        Ok(())
    }

    /// What of the teaching switches a person should be told: those that do nothing with the estimator that was chosen, and
    /// a density that is wrong in silence.
    pub fn doubts(&self) -> Vec<Message> {
        let said = |text| Message { level: Level::Warning, place: String::new(), text };
        self.idle_mistake().into_iter().chain(self.hole()).map(said).collect()
    }

    fn idle_mistake(&self) -> Option<String> {
        use EstimatorKind::{Area, Hemisphere, Mis, Path};
        let kinds: &[EstimatorKind] = match self.mistake {
            Mistake::None => return None,
            Mistake::NoCosLight | Mistake::NoDistance | Mistake::WrongMeasure => &[Area, Mis, Path],
            Mistake::CountedTwice => &[Mis, Path],
            Mistake::NoCount => &[Area, Hemisphere, Mis, Path],
        };
        (!kinds.contains(&self.estimator)).then(|| {
            let (mistake, estimator) = (self.mistake.show(), self.estimator.show());
            format!("mistake = {mistake} is none with estimator = {estimator}: the picture is right")
        })
    }

    /// Directions find what a hole leaves out; without them it is lost.
    fn hole(&self) -> Option<String> {
        let what = match self.estimator {
            _ if self.light_points != LightPoints::Hole => return None,
            EstimatorKind::Area => "its light is missing",
            _ if self.aov.has(Planes::UNSHADOWED) => "its light is missing in the plane unshadowed-direct",
            _ => return None,
        };
        Some(format!("light_points = hole never draws a quarter of a flat light: {what}, on purpose"))
    }

    /// Where the random numbers come from.
    pub fn sampler(&self) -> AnySampler {
        let options = SamplerOptions { seed: self.seed, pairing: self.pairing, rotate: self.rotate };
        AnySampler::new(self.sampler, options)
    }
}
