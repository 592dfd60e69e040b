//! Points of lights, for estimators that live elsewhere: drawn with their density, or found along a direction.

use antumbra_math::{Rgb, World};
use antumbra_trace::{Hits, NO_PRIM, SegmentBuffer, Visibility};

use crate::estimator::LightChoice;
use crate::light::sampler::{Choose, Chooser, LightSampler, Pick, Scratch};
use crate::light::{End, LightId, LightPoints};
use crate::receiver::Receiver;
use crate::scene::{Ray, Scene};
use crate::schedule::{self, Flow};
use crate::sensor::Query;
use crate::settings::Settings;

/// Entries that a thread takes at once.
const CHUNK: usize = 1024;

/// One light point for a receiver: what a student's own estimator of the area form needs.
#[derive(Clone, Copy, Debug)]
pub struct LightDraw {
    /// ω_i, a unit vector; 0 where there is no light point.
    pub direction: [f32; 3],
    /// Where the shadow ray ends, or a point far along ω_i for lights at infinity.
    pub target: [f32; 3],
    /// Distance to the light point; +∞ at infinity.
    pub distance: f32,
    /// L_e; for lights without size the irradiance at normal incidence.
    pub radiance: [f32; 3],
    /// p(light) · p(ω_i) [1/sr]; lights without size: p(light).
    pub pdf: f32,
    /// |cos θ′| at the light point; 1 for lights without a surface.
    pub cos_light: f32,
    /// Which light.
    pub light: LightId,
}

impl LightDraw {
    /// No light can reach: nothing arrives, and nothing is divided by 0.
    pub const NONE: LightDraw = LightDraw {
        direction: [0.0; 3],
        target: [0.0; 3],
        distance: 1.0,
        radiance: [0.0; 3],
        pdf: 1.0,
        cos_light: 1.0,
        light: 0,
    };
}

/// The light that a direction finds.
#[derive(Clone, Copy, Debug)]
pub struct LightFound {
    /// L_e toward the receiver, of what the ray meets first; of all light at infinity where it meets nothing.
    pub radiance: [f32; 3],
    /// p(light) · p(ω) [1/sr]: how densely `sample_light` with the same settings draws this direction.
    pub pdf: f32,
}

impl LightFound {
    /// No light lies there.
    pub const NONE: LightFound = LightFound { radiance: [0.0; 3], pdf: 0.0 };
}

/// How light points are drawn: which light, which point of it.
struct Lights<'a> {
    scene: &'a Scene,
    sampler: LightSampler,
    how: LightPoints,
    /// Middle and radius of all there is.
    around: (World, f32),
}

impl<'a> Lights<'a> {
    fn new(scene: &'a Scene, settings: &Settings) -> Lights<'a> {
        let choose = match settings.lights {
            LightChoice::Power => Choose::Power,
            LightChoice::Contribution => Choose::Contribution,
            _ => Choose::Uniform,
        };
        let sampler = LightSampler::new(choose, scene.lights(), scene.radius());
        let [low, high] = scene.bounds().unwrap_or_default();
        let around = ((low + high) / 2.0, (high - low).length() / 2.0);
        Lights { scene, sampler, how: settings.light_points, around }
    }

    /// A point along `wi` beyond all there is.
    fn beyond(&self, at: &Receiver, wi: World) -> World {
        let start = World::from(at.start);
        let (middle, radius) = self.around;
        start + wi * (2.0 * ((start - middle).length() + radius)).max(1.0)
    }

    fn chooser<'s>(&'s self, at: &Receiver, scratch: &'s mut Scratch) -> Chooser<'s> {
        self.sampler.prepare(self.scene.lights(), at, scratch)
    }

    /// A point of the light that was picked.
    fn draw(&self, at: &Receiver, chooser: Chooser<'_>, pick: Pick, u: [f32; 2]) -> Option<LightDraw> {
        let s = self.scene.lights()[pick.light as usize].sample(at, u, self.how)?;
        let target = match s.end {
            End::Point(q) => q,
            End::Infinity => self.beyond(at, s.wi),
        };
        let mut drawn = LightDraw {
            direction: s.wi.to_array(),
            target: target.to_array(),
            distance: s.distance,
            radiance: s.radiance.0,
            pdf: pick.prob * s.density.weight(),
            cos_light: s.cos,
            light: pick.light,
        };
        // Lights at infinity lie behind one another (a sun in its sky): any of them may draw what all of them send.
        if s.end == End::Infinity && !s.density.is_delta() {
            LightFound { radiance: drawn.radiance, pdf: drawn.pdf } = self.at_infinity(at, chooser, s.wi);
        }
        Some(drawn)
    }

    fn at_infinity(&self, at: &Receiver, chooser: Chooser<'_>, wi: World) -> LightFound {
        let mut found = (Rgb::BLACK, 0.0);
        for (light, radiance) in self.scene.from_infinity(wi) {
            found = (found.0 + radiance, found.1 + self.pdf(at, chooser, light, wi));
        }
        LightFound { radiance: found.0.0, pdf: found.1 }
    }

    fn on_surface(&self, at: &Receiver, chooser: Chooser<'_>, ray: &Ray) -> LightFound {
        let found = self.scene.emitted(ray);
        found.map_or(LightFound::NONE, |(light, radiance)| LightFound {
            radiance: radiance.0,
            pdf: self.pdf(at, chooser, light, ray.d),
        })
    }

    fn pdf(&self, at: &Receiver, chooser: Chooser<'_>, light: LightId, wi: World) -> f32 {
        chooser.prob(light) * self.scene.lights()[light as usize].pdf(at, wi, self.how)
    }
}

/// Draws a light point for every query, from three numbers each (which light, where on it).
pub fn sample_light(
    scene: &Scene,
    queries: &[Query],
    u: &[[f32; 3]],
    settings: &Settings,
    watch: &mut dyn FnMut(u64) -> Flow,
) -> Vec<LightDraw> {
    let lights = Lights::new(scene, settings);
    let mut out = vec![LightDraw::NONE; queries.len()];
    let answer = |from: usize, out: &mut [LightDraw], scratch: &mut Scratch| {
        for (i, out) in out.iter_mut().enumerate() {
            let (at, u) = (queries[from + i].receiver(1.0), u[from + i]);
            let chooser = lights.chooser(&at, scratch);
            let drawn = chooser.pick(u[0]).and_then(|pick| lights.draw(&at, chooser, pick, [u[1], u[2]]));
            *out = drawn.unwrap_or(LightDraw::NONE);
        }
    };
    schedule::chunks(&mut out, CHUNK, settings.threads, answer, watch);
    out
}

/// What a ray from every query along its unit direction finds of the lights.
pub fn find_light(
    scene: &Scene,
    queries: &[Query],
    directions: &[[f32; 3]],
    settings: &Settings,
    watch: &mut dyn FnMut(u64) -> Flow,
) -> Vec<LightFound> {
    type State = (SegmentBuffer, Hits, Scratch);
    let lights = Lights::new(scene, settings);
    let visibility = scene.visibility(false);
    let mut out = vec![LightFound::NONE; queries.len()];
    let answer = |from: usize, out: &mut [LightFound], (rays, hits, scratch): &mut State| {
        let to = from + out.len();
        let receivers: Vec<Receiver> = queries[from..to].iter().map(|query| query.receiver(1.0)).collect();
        rays.clear();
        for (at, wi) in receivers.iter().zip(&directions[from..to]) {
            let first = if at.sees_side(World::from(*wi)) { at.prim } else { NO_PRIM };
            rays.push_ray(at.start, *wi, f32::INFINITY, first, 0);
        }
        visibility.nearest(rays.as_segments(), hits);
        for (i, (at, out)) in receivers.iter().zip(out).enumerate() {
            let (o, d) = (World::from(at.start), World::from(directions[from + i]));
            let chooser = lights.chooser(at, scratch);
            *out = if hits.prim[i] == NO_PRIM {
                lights.at_infinity(at, chooser, d)
            } else {
                let ray = Ray { o, d, t: hits.t[i], prim: hits.prim[i], uv: hits.uv[i], number: 0 };
                lights.on_surface(at, chooser, &ray)
            };
        }
    };
    schedule::chunks(&mut out, CHUNK, settings.threads, answer, watch);
    out
}
