//! Umbra, penumbra, antumbra, lit: from which points of a light are visible.

use antumbra_math::Rgb;
use antumbra_trace::{Bits, NO_PRIM, Visibility};

use crate::density::Density;
use crate::estimator::Proposals;
use crate::film::Planes;
use crate::light::{Light, LightId, LightSample};
use crate::receiver::Receiver;
use crate::scene::{Scene, SceneVisibility};
use crate::schedule::{self, Flow};
use crate::sensor::Query;
use crate::settings::{Masks, Settings};

/// Which part of a light a point sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// Nothing of it.
    Umbra,
    /// Some of it.
    Penumbra,
    /// Its whole outline, but not all of its inside: a ring of light around the occluder.
    Antumbra,
    /// All of it.
    Lit,
}

impl Region {
    /// The number that stands for it in pictures and arrays: 0 umbra, 1 penumbra, 2 antumbra, 3 lit; −1 for none.
    pub fn code(region: Option<Region>) -> i8 {
        region.map_or(-1, |r| r as i8)
    }
}

/// Points of a light: how many there are, how many of them stand above the receiver's horizon, how many are visible.
#[derive(Clone, Copy, Default)]
struct Points {
    all: u32,
    above: u32,
    visible: u32,
}

/// `None` where the light does not shine: from its dark side, or if all of it is below the horizon.
fn region(inside: Points, outline: Points) -> Option<Region> {
    let whole = |points: Points| points.visible == points.all;
    if inside.all == 0 || inside.above + outline.above == 0 {
        None
    } else if inside.visible + outline.visible == 0 {
        Some(Region::Umbra)
    } else if whole(inside) && whole(outline) {
        Some(Region::Lit)
    } else if outline.all > 0 && whole(outline) {
        Some(Region::Antumbra)
    } else {
        Some(Region::Penumbra)
    }
}

/// Segments that are asked about at once.
const BATCH: usize = 1 << 14;

/// Buffers of one thread.
#[derive(Default)]
pub struct RegionScratch {
    proposals: Proposals,
    blocked: Bits,
    asked: Vec<[Points; 2]>,
}

/// Asks which part of a light points see: N points inside the light and N on its outline, the same ones from everywhere,
/// so that borders are crisp. What is thinner than the distance of two such points may be missed.
pub struct RegionFinder<'a> {
    scene: &'a Scene,
    visibility: SceneVisibility<'a>,
    n: u32,
}

impl<'a> RegionFinder<'a> {
    /// With N and the alpha masks of the settings.
    pub fn new(scene: &'a Scene, settings: &Settings) -> RegionFinder<'a> {
        let visibility = scene.visibility(settings.masks == Masks::Opaque);
        RegionFinder { scene, visibility, n: settings.region_points }
    }

    /// The region of each receiver. A light point below its horizon is not visible.
    pub fn find(&self, at: &[Receiver], light: LightId, b: &mut RegionScratch, out: &mut [Option<Region>]) {
        let light = &self.scene.lights()[light as usize];
        let run = (BATCH / (2 * self.n as usize)).max(1);
        for (at, out) in at.chunks(run).zip(out.chunks_mut(run)) {
            b.proposals.clear();
            b.asked.clear();
            b.asked.extend(at.iter().map(|at| self.propose(light, at, &mut b.proposals)));
            self.visibility.occluded(b.proposals.segments.as_segments(), &mut b.blocked);
            let mut segment = 0;
            for (asked, out) in b.asked.iter_mut().zip(out) {
                for part in asked.iter_mut() {
                    let segments = segment..segment + part.above as usize;
                    segment = segments.end;
                    part.visible = segments.filter(|i| !b.blocked.get(*i)).count() as u32;
                }
                *out = region(asked[0], asked[1]);
            }
        }
    }

    /// Segments to the points inside and to those on the outline.
    fn propose(&self, light: &Light, at: &Receiver, out: &mut Proposals) -> [Points; 2] {
        let [mut inside, mut outline] = [Points::default(); 2];
        let mut ask = |points: &mut Points, j: u32, to: &LightSample| {
            points.all += 1;
            if at.sees_side(to.wi) {
                points.above += 1;
                out.segment(at, j, to, Planes::NONE, Rgb::WHITE);
            }
        };
        // A light without size is one point.
        let n = if light.is_delta() { 1 } else { self.n };
        for k in 0..n {
            if let Some(to) = light.sample(at, hammersley(k, n), light.even()) {
                ask(&mut inside, k, &to);
            }
        }
        for k in 0..n {
            if let Some(rim) = light.outline(at, k as f32 / n as f32) {
                let (distance, radiance, density) = (f32::INFINITY, Rgb::WHITE, Density::Delta);
                let (wi, end, prim, cos) = (rim.wi, rim.end, NO_PRIM, 1.0);
                ask(&mut outline, n + k, &LightSample { wi, end, distance, radiance, density, prim, cos });
            }
        }
        [inside, outline]
    }
}

/// Point k of n that fill the unit square evenly (Hammersley), each in the middle of its strip of both axes.
fn hammersley(k: u32, n: u32) -> [f32; 2] {
    let half = 0.5 / n as f32;
    let inverse = f64::from(k.reverse_bits()) / 4_294_967_296.0;
    [k as f32 / n as f32 + half, (inverse as f32 + half).min(1.0 - f32::EPSILON)]
}

/// The region of each point with regard to one light; `watch` hears how many are answered.
pub fn regions(
    scene: &Scene,
    queries: &[Query],
    light: LightId,
    settings: &Settings,
    watch: &mut dyn FnMut(u64) -> Flow,
) -> Vec<Option<Region>> {
    const CHUNK: usize = 256;
    let finder = RegionFinder::new(scene, settings);
    let mut out = vec![None; queries.len()];
    let answer = |from: usize, out: &mut [Option<Region>], scratch: &mut RegionScratch| {
        let queries = queries[from..from + out.len()].iter().zip(from as u32..);
        let at: Vec<Receiver> = queries.map(|(q, i)| Receiver { stream: i, ..q.receiver(1.0) }).collect();
        finder.find(&at, light, scratch, out);
    };
    schedule::chunks(&mut out, CHUNK, settings.threads, answer, watch);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_points_fill_the_square_evenly() {
        for n in [1, 4, 64, 100] {
            let points: Vec<[f32; 2]> = (0..n).map(|k| hammersley(k, n)).collect();
            assert!(points.iter().flatten().all(|x| (0.0..1.0).contains(x)), "{points:?}");
            for axis in 0..2 {
                // Both axes are stratified for powers of two: one point a strip, so the mean is 1/2.
                let mean = points.iter().map(|p| p[axis]).sum::<f32>() / n as f32;
                assert!((mean - 0.5).abs() < 0.03, "{n}: {mean}");
            }
        }
    }

    #[test]
    fn regions_follow_from_counts() {
        let of = |inside: [u32; 3], outline: [u32; 3]| {
            let points = |[all, above, visible]: [u32; 3]| Points { all, above, visible };
            region(points(inside), points(outline))
        };
        assert_eq!(of([8, 8, 0], [8, 8, 0]), Some(Region::Umbra));
        assert_eq!(of([8, 8, 8], [8, 8, 8]), Some(Region::Lit));
        assert_eq!(of([8, 8, 3], [8, 8, 8]), Some(Region::Antumbra));
        assert_eq!(of([8, 8, 0], [8, 8, 8]), Some(Region::Antumbra));
        assert_eq!(of([8, 8, 0], [8, 8, 1]), Some(Region::Penumbra));
        assert_eq!(of([8, 8, 8], [8, 8, 7]), Some(Region::Penumbra));
        // Half below the horizon; wholly below; from behind; a point light; a sky, which has no outline.
        assert_eq!(of([8, 4, 4], [8, 4, 4]), Some(Region::Penumbra));
        assert_eq!(of([8, 0, 0], [8, 0, 0]), None);
        assert_eq!(of([0, 0, 0], [8, 8, 8]), None);
        assert_eq!(of([1, 1, 1], [0, 0, 0]), Some(Region::Lit));
        assert_eq!(of([8, 8, 5], [0, 0, 0]), Some(Region::Penumbra));
    }
}
