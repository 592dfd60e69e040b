//! Scene and settings → picture. Floor 9.

mod explain;
mod maps;
mod pass;
mod view;

use antumbra_math::Rgb;

use crate::estimator::EstimatorKind;
use crate::film::{Film, Planes};
use crate::illuminate::{Job, LightPlanes};
use crate::light::Light;
use crate::scene::{Camera, Level, Message, Scene, SceneError};
use crate::schedule::{self, Finished, Flow, Progress};
use crate::sensor::{CameraSensor, Seen, Tile, View};
use crate::settings::{Masks, Settings};
use view::{camera, view};

pub use explain::{Explained, LightRay, SurfaceMet, ViewingRay, explain};
pub use pass::Pass;

/// A finished picture (or the part of it that was reached).
#[derive(Clone, Debug)]
pub struct Picture {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Radiance, row by row from the top [W·m⁻²·sr⁻¹].
    pub pixels: Vec<[f32; 3]>,
    /// Standard error of each pixel; `None` below two replicates (fewer than two viewing rays).
    pub standard_error: Option<Vec<[f32; 3]>>,
    /// The other planes: name, channels, values.
    pub aovs: Vec<(String, usize, Vec<f32>)>,
    /// Settings, seed, version, scene hash, pixel hash, …
    pub metadata: Vec<(String, String)>,
    /// Notes and warnings of this render (the scene has its own).
    pub messages: Vec<Message>,
    /// Passes that the picture holds.
    pub passes_done: u32,
    /// Passes that were asked for.
    pub passes: u32,
    /// Shadow rays (any hit).
    pub segments: u64,
    /// Viewing rays and rays onward (closest hit).
    pub rays: u64,
    /// Hash of the pixels' bits: the same for any number of threads and any SIMD level.
    pub hash: u32,
    /// Of which picture it is a part, and where: x and y of its upper left pixel, width and height of the whole.
    pub window: [u32; 4],
}

/// Renders `scene`; `environment` replaces the light from all around (empty: none).
pub fn render(
    scene: &Scene,
    settings: &Settings,
    environment: Option<Vec<(String, Light)>>,
    watch: &mut dyn FnMut(Progress) -> Flow,
) -> Result<Picture, SceneError> {
    let mut messages = settings.doubts();
    settings.check()?;
    let scene = settings.lit(scene, environment)?;
    let camera = camera(&scene, settings, &mut messages)?;
    let view = view(&camera, settings)?;
    let sensor = CameraSensor::new(&camera, view);
    let estimator = settings.estimator.make(&scene, settings.options());
    let clay = settings.clay.is_some() && settings.estimator == EstimatorKind::Area;
    for text in estimator.blind_to(&scene).into_iter().filter(|_| !clay) {
        messages.push(Message { level: Level::Warning, place: String::new(), text });
    }
    if scene.lights().is_empty() && settings.estimator != EstimatorKind::AmbientOcclusion {
        messages.push(Message {
            level: Level::Warning,
            place: String::new(),
            text: "the scene has no light: the picture is black (environment = sky adds one)".into(),
        });
    }
    let visibility = scene.visibility(settings.masks == Masks::Opaque);
    let job = Job {
        scene: &scene,
        visibility: &visibility,
        sensor: &sensor,
        estimator: estimator.as_ref(),
        sampler: settings.sampler(),
        seed: settings.seed,
        shadow_rays: settings.shadow_rays,
        bounces: bounces(settings),
        passes: settings.passes_of(settings.viewing_rays),
        planes: settings.aov.without(Planes::REGIONS),
        light_planes: LightPlanes::new(settings.aov, &scene, settings.options()),
        look: settings.look(),
        seen: seen(settings),
        shadows: settings.shadows,
        distance_test: settings.distance_test,
    };
    let (rays, maps) = costs(settings);
    let whole = rays + maps;
    let mut part = |p: Progress| watch(Progress { done: p.done * rays, total: p.total * whole, ..p });
    let finished = schedule::run(&job, settings.threads, &mut part);
    let maps = regions(&scene, settings, (&camera, view), &finished, &mut messages, watch);
    let mut picture = picture(&scene, settings, &view, finished, messages);
    picture.aovs.extend(maps);
    Ok(picture)
}

/// The maps of regions, if they are asked for and nobody stopped.
fn regions(
    scene: &Scene,
    settings: &Settings,
    view: (&Camera, View),
    finished: &Finished,
    messages: &mut Vec<Message>,
    watch: &mut dyn FnMut(Progress) -> Flow,
) -> Vec<maps::Layer> {
    if !settings.aov.has(Planes::REGIONS) {
        return Vec::new();
    }
    let (passes, passes_done) = (settings.viewing_rays, finished.passes_done);
    let (rays, maps) = costs(settings);
    let mut look = |done: u64, tiles: u64| {
        let (done, total) = (rays * tiles + maps * done, (rays + maps) * tiles);
        watch(Progress { done, total, passes_done, passes })
    };
    let asked = passes_done == settings.passes_of(passes).until;
    let maps = if asked { maps::region_maps(scene, settings, view, messages, &mut look) } else { None };
    maps.unwrap_or_else(|| {
        let text = "stopped before the maps of regions were done: they are left out".into();
        messages.push(Message { level: Level::Warning, place: String::new(), text });
        Vec::new()
    })
}

/// What the picture and the maps of regions cost for each pixel, as numbers of rays: their shares of the progress.
fn costs(s: &Settings) -> (u64, u64) {
    let rays = u64::from(s.viewing_rays) * (1 + u64::from(s.shadow_rays));
    if s.aov.has(Planes::REGIONS) { (rays, 2 * u64::from(s.region_points)) } else { (1, 0) }
}

/// Width and height of the picture that the settings ask for.
pub fn picture_size(scene: &Scene, settings: &Settings) -> Result<[u32; 2], SceneError> {
    let [_, _, width, height] = view(&camera(scene, settings, &mut Vec::new())?, settings)?.crop;
    Ok([width, height])
}

/// Estimators of direct light end after one bounce.
fn bounces(s: &Settings) -> u32 {
    match s.estimator {
        EstimatorKind::Path | EstimatorKind::PathHemisphere => s.bounces,
        EstimatorKind::AmbientOcclusion => 1,
        _ => s.bounces.min(1),
    }
}

fn seen(s: &Settings) -> Seen {
    if s.estimator == EstimatorKind::AmbientOcclusion { Seen::Open } else { Seen::Light }
}

/// Films of tiles lie side by side.
fn picture(scene: &Scene, s: &Settings, view: &View, finished: Finished, messages: Vec<Message>) -> Picture {
    let [width, height] = [view.crop[2], view.crop[3]];
    let plane = |plane: Planes| assemble(width, height, &finished.tiles, |film, cell| film.mean(plane, cell));
    let pixels = plane(Planes::BEAUTY);
    let known = finished.tiles.iter().all(|(_, film)| film.replicates() >= 2);
    let standard_error = known.then(|| {
        assemble(width, height, &finished.tiles, |film, cell| film.standard_error(cell).unwrap_or_default())
    });
    let mut aovs = Vec::new();
    for (name, which, channels) in s.aov.without(Planes::REGIONS).named() {
        let values = match which {
            Planes::STANDARD_ERROR => {
                standard_error.clone().unwrap_or_else(|| vec![[f32::NAN; 3]; pixels.len()])
            }
            Planes::SAMPLE_COUNT => vec![[finished.passes_done as f32; 3]; pixels.len()],
            which => plane(which),
        };
        aovs.push((name.to_string(), channels, values.iter().flat_map(|v| v[..channels].to_vec()).collect()));
    }
    let hash = hash_of(&pixels);
    let mut metadata = vec![
        ("antumbra.version".to_string(), env!("CARGO_PKG_VERSION").to_string()),
        ("antumbra.scene".to_string(), scene.name.clone()),
        ("antumbra.scene-hash".to_string(), format!("{:016x}", scene.content_hash())),
        ("antumbra.pixel-hash".to_string(), format!("{hash:08x}")),
        ("antumbra.passes".to_string(), format!("{} of {}", finished.passes_done, s.viewing_rays)),
    ];
    metadata.extend(
        s.shown().into_iter().map(|(name, value)| (format!("antumbra.{}", name.replace('_', "-")), value)),
    );
    Picture {
        width,
        height,
        pixels,
        standard_error,
        aovs,
        metadata,
        messages,
        passes_done: finished.passes_done,
        passes: s.viewing_rays,
        segments: finished.counts.segments,
        rays: finished.counts.rays,
        hash,
        window: [view.crop[0], view.crop[1], view.size[0], view.size[1]],
    }
}

fn assemble(
    width: u32,
    height: u32,
    tiles: &[(Tile, Film)],
    value: impl Fn(&Film, usize) -> [f64; 3],
) -> Vec<[f32; 3]> {
    let mut pixels = vec![[0f32; 3]; width as usize * height as usize];
    for (tile, film) in tiles {
        for cell in 0..tile.cells() {
            let (x, y) = (tile.x + cell % tile.width, tile.y + cell / tile.width);
            pixels[y as usize * width as usize + x as usize] = value(film, cell as usize).map(|v| v as f32);
        }
    }
    pixels
}

/// The hash of a picture: FNV-1a over the bits, folded to 32.
pub fn hash_of(pixels: &[[f32; 3]]) -> u32 {
    let h = antumbra_math::hash::fnv1a_words(pixels.iter().flatten().map(|c| c.to_bits()));
    (h ^ (h >> 32)) as u32
}

impl Picture {
    /// Mean standard error over mean, by luminance; `None` if the error is not known or the picture is black.
    pub fn relative_error(&self) -> Option<f64> {
        let luminance = |p: &[f32; 3]| f64::from(Rgb(*p).luminance());
        let mean: f64 = self.pixels.iter().map(luminance).sum();
        let error: f64 = self.standard_error.as_ref()?.iter().map(luminance).sum();
        (mean > 0.0).then(|| error / mean)
    }
}
