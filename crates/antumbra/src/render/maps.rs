//! The maps of umbra, penumbra, antumbra and lit beside a picture: one a light, from the middle of each pixel.

use std::collections::HashSet;

use crate::film::{Film, Planes};
use crate::light::LightId;
use crate::query::{Region, RegionFinder, RegionScratch};
use crate::scene::{Camera, Level, Message, Scene};
use crate::schedule::{self, Flow};
use crate::sensor::{CameraSensor, Looking, Scratch, Seen, Sensor, Tile, View, Viewing};
use crate::settings::{Masks, Settings};

/// A scene with more lights gets the maps of the first of them.
const MOST: usize = 16;

/// A layer of a picture: name, channels, values.
pub(super) type Layer = (String, usize, Vec<f32>);

/// What a thread needs again and again.
#[derive(Default)]
struct Buffers {
    sensor: Scratch,
    regions: RegionScratch,
}

/// A tile with the codes of its pixels, light after light.
type Coded = (Tile, Vec<Vec<f32>>);

/// One layer a light, of 0 umbra, 1 penumbra, 2 antumbra, 3 lit, −1 where nothing is met or the light does not shine;
/// `None` if `watch` stopped it, which is called with the tiles that are done and all of them.
pub(super) fn region_maps(
    scene: &Scene,
    settings: &Settings,
    (camera, view): (&Camera, View),
    messages: &mut Vec<Message>,
    watch: &mut dyn FnMut(u64, u64) -> Flow,
) -> Option<Vec<Layer>> {
    let names = layer_names(scene);
    if names.len() < scene.lights().len() {
        let text = format!(
            "aov regions: the first {MOST} of {} lights have a map (`light` = NAME chooses others)",
            scene.lights().len()
        );
        messages.push(Message { level: Level::Note, place: String::new(), text });
    }
    let sensor = CameraSensor::new(camera, View { viewing: Viewing::Centre, ..view });
    let mut tiles: Vec<Coded> = sensor.tiles().into_iter().map(|tile| (tile, Vec::new())).collect();
    let lights = names.len() as LightId;
    let finder = RegionFinder::new(scene, settings);
    let answer = |_: usize, out: &mut [Coded], b: &mut Buffers| {
        for (tile, codes) in out {
            *codes = tile_codes(scene, settings, &sensor, *tile, (&finder, lights), b);
        }
    };
    let (mut stopped, count) = (false, tiles.len() as u64);
    let mut look = |done| {
        let flow = watch(done, count);
        stopped |= flow == Flow::Stop;
        flow
    };
    schedule::chunks(&mut tiles, 1, settings.threads, answer, &mut look);
    let layer = |(light, name): (usize, String)| {
        let [_, _, width, height] = view.crop;
        let mut values = vec![-1.0; width as usize * height as usize];
        for (tile, codes) in &tiles {
            for (row, codes) in codes[light].chunks(tile.width as usize).enumerate() {
                let first = (tile.y as usize + row) * width as usize + tile.x as usize;
                values[first..first + codes.len()].copy_from_slice(codes);
            }
        }
        (name, 1, values)
    };
    (!stopped).then(|| names.into_iter().enumerate().map(layer).collect())
}

/// The codes of a tile's pixels, light after light.
fn tile_codes(
    scene: &Scene,
    settings: &Settings,
    sensor: &CameraSensor,
    tile: Tile,
    (finder, lights): (&RegionFinder<'_>, LightId),
    b: &mut Buffers,
) -> Vec<Vec<f32>> {
    let looking = Looking {
        scene,
        visibility: &scene.visibility(settings.masks == Masks::Opaque),
        look: settings.look(),
        seen: Seen::Light,
        sampler: &settings.sampler(),
        seed: settings.seed,
        passes: settings.passes_of(1),
    };
    let mut film = Film::block(tile.cells() as usize, Planes::NONE);
    let mut receivers = Vec::new();
    sensor.receivers(&looking, tile, 0, &mut b.sensor, &mut film, &mut receivers);
    let mut regions = vec![None; receivers.len()];
    let mut codes = |light| {
        finder.find(&receivers, light, &mut b.regions, &mut regions);
        let mut codes = vec![-1.0; tile.cells() as usize];
        for (at, region) in receivers.iter().zip(&regions) {
            codes[at.cell as usize] = f32::from(Region::code(*region));
        }
        codes
    };
    (0..lights).map(&mut codes).collect()
}

/// `regions` for the only light, else `regions.NAME`; a light whose name is empty or taken is called by its number.
fn layer_names(scene: &Scene) -> Vec<String> {
    let names = scene.light_names();
    let shining: Vec<(u32, &String)> =
        names.slots.iter().copied().zip(&names.names).filter(|(slot, _)| *slot != u32::MAX).collect();
    if shining.len() == 1 {
        return vec!["regions".into()];
    }
    let mut taken = HashSet::new();
    let label = |(slot, name): (u32, &String)| {
        let free = !name.is_empty() && taken.insert(name.clone());
        format!("regions.{}", if free { name.clone() } else { slot.to_string() })
    };
    shining.into_iter().take(MOST).map(label).collect()
}
