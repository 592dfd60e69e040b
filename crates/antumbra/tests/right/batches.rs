//! Estimators make no more segments and rays than they say, by which batches are cut.

use antumbra::bsdf::{Bsdf, Facets, RoughDielectric};
use antumbra::estimator::{Draws, Estimator, EstimatorKind, LightChoice, Proposals, VisibleFraction};
use antumbra::light::Point;
use antumbra::math::{Rgb, Vec3};
use antumbra::scene::Scene;
use antumbra::settings::Settings;

use super::rooms;
use super::scenes::receiver;

/// The most that a receiver got of an estimator, on a wall and in ground glass, and what the estimator says.
fn made(scene: &Scene, estimator: &dyn Estimator, settings: &Settings) -> (usize, usize) {
    let sampler = settings.sampler();
    let draws = Draws::new(&sampler, settings.passes_of(1), settings.shadow_rays);
    let wall = receiver([0.0, 0.5, 1.0], [0.0, 1.0, 0.0]).receiver(0.5);
    let glass = Bsdf::RoughDielectric(RoughDielectric::new(1.5, Facets::isotropic(0.5)));
    let most = [wall, antumbra::receiver::Receiver { bsdf: glass, ..wall }].into_iter().map(|at| {
        let mut out = Proposals::default();
        estimator.propose(scene, &[at], &draws, &mut out);
        out.carried.len() + out.onward.len()
    });
    (most.max().unwrap(), estimator.most_proposed(scene, settings.shadow_rays as usize))
}

#[test]
fn no_estimator_makes_more_than_it_says() {
    let mut room = rooms::lit();
    for i in 0..40 {
        let position = Vec3::new(0.05 * i as f32, 3.0, 1.0);
        room.light("point", Point { position, intensity: Rgb::WHITE });
    }
    let scene = room.build().unwrap();
    for kind in EstimatorKind::ALL {
        for lights in [LightChoice::All, LightChoice::Power] {
            let settings =
                Settings { estimator: *kind, lights, shadow_rays: 8, bounces: 3, ..Settings::default() };
            let (most, said) = made(&scene, &*kind.make(&scene, settings.options()), &settings);
            assert!(most <= said, "{kind:?}, {lights:?}: {most}, not {said}");
        }
    }
    let settings = Settings { shadow_rays: 8, ..Settings::default() };
    let (most, said) = made(&scene, &VisibleFraction::mean(), &settings);
    assert!(most <= said && said == 8 * 16, "{most}, not {said}");
}
