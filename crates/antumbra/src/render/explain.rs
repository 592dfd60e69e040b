//! One pixel taken apart: every viewing ray, every ray to the lights, every factor. What they bring sums to the pixel.

use antumbra_math::{Rgb, Vec3, World};
use antumbra_trace::{Bits, Hits, NO_PRIM, PrimId, Visibility};

use super::{bounces, camera, view};
use crate::estimator::{
    Drawn, Draws, Estimator, EstimatorKind, Found, FoundLight, Mistake, Onward, Proposals, plane_of,
};
use crate::film::{Film, Planes};
use crate::light::sampler::Scratch as LightWeights;
use crate::light::{End, Light, LightId};
use crate::receiver::Receiver;
use crate::scene::{Message, Ray, Scene, SceneError, SceneVisibility};
use crate::schedule::Flow;
use crate::sensor::{CameraSensor, Looking, Scratch, Seen, Sensor, Tile, View};
use crate::settings::{Masks, SettingValue, Settings};

/// Rows of the longest table.
const MOST: u64 = 1 << 16;

/// A pixel with everything that makes it.
#[derive(Clone, Debug)]
pub struct Explained {
    /// Width and height of the whole picture.
    pub size: [u32; 2],
    /// Radiance of the pixel [W·m⁻²·sr⁻¹]: Σ of what is brought below; a render with the same settings has it.
    pub value: [f64; 3],
    /// Every viewing ray, in order.
    pub viewing_rays: Vec<ViewingRay>,
    /// Names of the lights, by their number.
    pub lights: Vec<String>,
    /// Notes and warnings.
    pub messages: Vec<Message>,
}

/// One viewing ray.
#[derive(Clone, Debug)]
pub struct ViewingRay {
    /// Where it starts.
    pub origin: Vec3,
    /// Its unit direction.
    pub direction: Vec3,
    /// What it meets; `None` = the sky.
    pub met: Option<SurfaceMet>,
    /// What the light that is seen itself brings to the pixel.
    pub emission: [f64; 3],
    /// Every ray from what it meets to the lights, in order.
    pub light_rays: Vec<LightRay>,
}

/// What a viewing ray meets: the receiver and its names.
#[derive(Clone, Debug)]
pub struct SurfaceMet {
    /// The point, its normal, its reflection.
    pub receiver: Receiver,
    /// Distance along the viewing ray.
    pub distance: f64,
    /// Name of the object; may be empty.
    pub object: String,
    /// Name of its material; may be empty.
    pub material: String,
}

/// One ray from a receiver to a light.
#[derive(Clone, Debug)]
pub struct LightRay {
    /// It was drawn as a direction (not as a point of a light).
    pub by_direction: bool,
    /// The light; `None` = the direction found none.
    pub light: Option<LightId>,
    /// ω_i; 0 if the light does not shine here at all.
    pub wi: World,
    /// p′; `None` at infinity, or if there is none.
    pub point: Option<World>,
    /// Distance to it; +∞ at infinity.
    pub distance: f32,
    /// |cos θ| at the receiver; 1 for mirrors, whose f_r holds it.
    pub cos: f32,
    /// |cos θ′| at the light; 1 where it has no surface, NaN where it was found by a direction.
    pub cos_light: f32,
    /// L_e [W·m⁻²·sr⁻¹]; for lights without size the irradiance at normal incidence.
    pub radiance: Rgb,
    /// f_r [1/sr]; for mirrors f_r cos θ / pdf.
    pub brdf: Rgb,
    /// p(light) · p(ω_i) [1/sr]; for single directions p(light).
    pub pdf: f32,
    /// Share against the other strategy, times what a mistake adds and what an alpha mask covers.
    pub weight: f32,
    /// V; `None` = nothing was asked, because nothing could be carried.
    pub visible: Option<bool>,
    /// The object that blocks it first.
    pub blocker: Option<String>,
    /// What it brings to the pixel.
    pub brings: [f64; 3],
}

/// What stays the same for all viewing rays of a pixel.
struct Pixel<'a> {
    scene: &'a Scene,
    settings: &'a Settings,
    visibility: SceneVisibility<'a>,
    estimator: Box<dyn Estimator>,
    draws: Draws<'a>,
    /// Viewing rays that are added up.
    count: f64,
}

/// Takes the pixel (column, row) of a render with these settings apart. Direct light only: `area`, `hemisphere`, `mis`.
///
/// `watch` is asked before each viewing ray whether to go on; stopped, what is there is no whole pixel.
pub fn explain(
    scene: &Scene,
    [x, y]: [u32; 2],
    settings: &Settings,
    environment: Option<Vec<(String, Light)>>,
    watch: &mut dyn FnMut() -> Flow,
) -> Result<Explained, SceneError> {
    check(scene, settings)?;
    let mut messages = settings.doubts();
    let scene = &settings.lit(scene, environment)?;
    let camera = camera(scene, settings, &mut messages)?;
    let size = view(&camera, &Settings { crop: None, ..settings.clone() })?.size;
    if x >= size[0] || y >= size[1] {
        let what = format!("pixel {x},{y} does not lie in {} × {} pixels", size[0], size[1]);
        return Err(SceneError::new("", what, "columns and rows count from 0, from the upper left"));
    }
    let crop = [x, y, 1, 1];
    let sensor =
        CameraSensor::new(&camera, View { size, crop, viewing: settings.viewing, filter: settings.filter });
    let (passes, sampler) = (settings.passes_of(settings.viewing_rays), settings.sampler());
    let opaque = settings.masks == Masks::Opaque;
    let pixel = Pixel {
        scene,
        settings,
        visibility: scene.visibility(opaque),
        estimator: settings.estimator.make(scene, settings.options()),
        draws: Draws::new(&sampler, passes, settings.shadow_rays),
        count: f64::from(passes.until),
    };
    let looking = Looking {
        scene,
        visibility: &pixel.visibility,
        look: settings.look(),
        seen: Seen::Light,
        sampler: &sampler,
        seed: settings.seed,
        passes,
    };
    let viewing_rays: Vec<ViewingRay> = (0..passes.until)
        .take_while(|_| watch() == Flow::Continue)
        .map(|pass| pixel.viewing_ray(&looking, &sensor, pass))
        .collect();
    let mut value = [0.0; 3];
    for ray in &viewing_rays {
        let all = ray.light_rays.iter().map(|l| l.brings).chain([ray.emission]);
        all.for_each(|brings| (0..3).for_each(|c| value[c] += brings[c]));
    }
    Ok(Explained { size, value, viewing_rays, lights: names(scene), messages })
}

/// Refuses what has no table, and tables that nobody can read.
fn check(scene: &Scene, s: &Settings) -> Result<(), SceneError> {
    s.check()?;
    if !matches!(s.estimator, EstimatorKind::Area | EstimatorKind::Hemisphere | EstimatorKind::Mis) {
        let what =
            format!("explain takes direct light apart: estimator {} has no such table", s.estimator.show());
        return Err(SceneError::new("", what, "Choose estimator area, hemisphere or mis."));
    }
    let rows = u64::from(s.viewing_rays) * u64::from(s.shadow_rays) * scene.lights().len().max(1) as u64;
    if rows > MOST {
        let what = format!("{rows} rays to the lights are too many to list (at most {MOST})");
        return Err(SceneError::new(
            "",
            what,
            "Take fewer viewing rays or shadow rays, or one light (`light` = NAME).",
        ));
    }
    Ok(())
}

/// The name of each light that shines, or its number.
fn names(scene: &Scene) -> Vec<String> {
    let named = scene.light_names();
    let mut names: Vec<String> = (0..scene.lights().len()).map(|i| i.to_string()).collect();
    for (slot, name) in named.slots.iter().zip(&named.names) {
        if let (Some(own), false) = (names.get_mut(*slot as usize), name.is_empty()) {
            own.clone_from(name);
        }
    }
    names
}

impl Pixel<'_> {
    fn viewing_ray(&self, looking: &Looking<'_>, sensor: &CameraSensor, pass: u32) -> ViewingRay {
        let (mut film, mut scratch) = (Film::block(1, Planes::NONE), Scratch::default());
        let mut receivers = Vec::new();
        let tile = Tile { x: 0, y: 0, width: 1, height: 1 };
        sensor.receivers(looking, tile, pass, &mut scratch, &mut film, &mut receivers);
        film.next_sample();
        let (rays, hits) = (scratch.rays.as_segments(), &scratch.hits);
        let met = receivers.first().map(|at| {
            let (object, _) = self.scene.locate(hits.prim[0]);
            let material = self.scene.materials[object.material as usize].name.clone();
            SurfaceMet { receiver: *at, distance: hits.t[0], object: object.name.clone(), material }
        });
        let mut light_rays = Vec::new();
        for at in receivers.iter().filter(|_| bounces(self.settings) > 0) {
            self.light_points(at, &mut light_rays);
            self.directions(at, &mut light_rays);
        }
        ViewingRay {
            origin: rays.origin_at(0).into(),
            direction: rays.end_at(0).into(),
            met,
            emission: self.share(film.mean(Planes::BEAUTY, 0)),
            light_rays,
        }
    }

    /// What a sample of a viewing ray brings to the pixel.
    fn share(&self, carried: [f64; 3]) -> [f64; 3] {
        carried.map(|c| c / self.count)
    }

    /// The shadow rays to points of the lights.
    fn light_points(&self, at: &Receiver, out: &mut Vec<LightRay>) {
        let mut proposals = Proposals { beyond_lights: !self.settings.distance_test, ..Proposals::default() };
        let mut asked = Vec::new();
        let mut list = |at: &Receiver, drawn: Drawn| {
            out.push(point_row(at, &drawn));
            if let (Some(to), false) = (&drawn.to, drawn.carried.is_black()) {
                proposals.segment(at, drawn.nth.j, to, plane_of(at), drawn.carried);
                asked.push(out.len() - 1);
            }
        };
        self.estimator.each_point(self.scene, at, &self.draws, &mut LightWeights::default(), &mut list);
        let segments = proposals.segments.as_segments();
        let (mut blocked, mut hits) = (Bits::default(), Hits::default());
        self.visibility.occluded(segments, &mut blocked);
        self.visibility.nearest(segments, &mut hits);
        for (i, row) in asked.into_iter().enumerate() {
            let free = !self.settings.shadows || !blocked.get(i);
            out[row].visible = Some(free);
            if free {
                out[row].brings = self.share(proposals.carried[i].light.0.map(f64::from));
            } else {
                out[row].blocker = self.object(hits.prim[i]);
            }
        }
    }

    /// The rays along directions, with the lights that they find.
    fn directions(&self, at: &Receiver, out: &mut Vec<LightRay>) {
        let mut proposals = Proposals::default();
        self.estimator.propose(self.scene, std::slice::from_ref(at), &self.draws, &mut proposals);
        let (rays, mut hits) = (proposals.rays.as_segments(), Hits::default());
        self.visibility.nearest(rays, &mut hits);
        for (i, onward) in proposals.onward.iter().enumerate() {
            let wi = World::from(rays.end_at(i));
            let prim = hits.prim[i];
            let met = (prim != NO_PRIM).then(|| {
                let (o, t, uv) = (rays.origin_at(i).into(), hits.t[i], hits.uv[i]);
                let ray = Ray { o, d: wi, t, prim, uv, number: rays.number[i] };
                self.scene.meet(&ray, &self.settings.look())
            });
            let found: Vec<(LightId, Rgb)> = match &met {
                _ if !self.settings.shadows => self.scene.from_everywhere(at.p, wi).collect(),
                Some(met) => met.emitted.into_iter().collect(),
                None => self.scene.from_infinity(wi).collect(),
            };
            let empty = LightRay {
                distance: hits.t[i] as f32,
                point: met.map(|met| met.receiver.p),
                blocker: self.object(prim),
                ..self.direction_row(at, wi, onward)
            };
            for &(light, radiance) in &found {
                let weight = match onward.found {
                    Found::All => 1.0,
                    Found::Weighed => {
                        let found = FoundLight { from: at, ray: onward, light, wi };
                        self.estimator.found_weight(self.scene, &found, &mut LightWeights::default())
                    }
                };
                let brings = self.share((onward.throughput * radiance * weight).0.map(f64::from));
                let weight = weight * empty.weight;
                let (light, visible, blocker) = (Some(light), Some(true), None);
                out.push(LightRay { light, radiance, weight, visible, blocker, brings, ..empty.clone() });
            }
            if found.is_empty() {
                out.push(empty);
            }
        }
    }

    /// A drawn direction that has found nothing yet.
    fn direction_row(&self, at: &Receiver, wi: World, onward: &Onward) -> LightRay {
        let local = at.to_local(wi);
        let n = self.draws.count(at) as f32;
        // Added up instead of averaged, each counts N times.
        let weight = if self.settings.mistake == Mistake::NoCount { n } else { 1.0 };
        let delta = onward.density.is_delta();
        let brdf = if delta { onward.throughput * (n / weight) } else { at.bsdf.eval(at.wo, local) };
        LightRay {
            by_direction: true,
            light: None,
            wi,
            point: None,
            distance: f32::INFINITY,
            cos: if delta { 1.0 } else { local.cos().abs() },
            cos_light: f32::NAN,
            radiance: Rgb::BLACK,
            brdf,
            pdf: onward.density.weight(),
            weight,
            visible: None,
            blocker: None,
            brings: [0.0; 3],
        }
    }

    fn object(&self, prim: PrimId) -> Option<String> {
        (prim != NO_PRIM).then(|| self.scene.locate(prim).0.name.clone())
    }
}

/// A drawn light point, before anybody asked whether it is visible.
fn point_row(at: &Receiver, drawn: &Drawn) -> LightRay {
    let nothing = LightRay {
        by_direction: false,
        light: Some(drawn.light),
        wi: World::ZERO,
        point: None,
        distance: f32::INFINITY,
        cos: 0.0,
        cos_light: 0.0,
        radiance: Rgb::BLACK,
        brdf: drawn.f,
        pdf: 0.0,
        weight: drawn.weight,
        visible: None,
        blocker: None,
        brings: [0.0; 3],
    };
    let Some(s) = drawn.to else { return nothing };
    LightRay {
        wi: s.wi,
        point: match s.end {
            End::Point(q) => Some(q),
            End::Infinity => None,
        },
        distance: s.distance,
        cos: at.to_local(s.wi).cos().abs(),
        cos_light: s.cos,
        radiance: s.radiance,
        pdf: drawn.prob * s.density.weight(),
        ..nothing
    }
}
