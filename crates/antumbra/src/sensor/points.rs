//! Points with normals: the queries of arrays, one receiver a point and sample.

use antumbra_math::{Frame, Local, Rgb, Vec3};
use antumbra_trace::{NO_PRIM, PrimId, start};

use super::{Looking, Scratch, Sensor, Tile};
use crate::bsdf::{Bsdf, Diffuse};
use crate::film::Film;
use crate::receiver::Receiver;
use crate::sampler::stream;

/// Points of a tile: enough for a batch, few enough that all cores have some.
fn run(points: u32) -> u32 {
    (points / 32).clamp(32, 1024)
}

/// A point that asks for light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Query {
    /// Position p.
    pub p: [f64; 3],
    /// Unit normal n.
    pub n: [f64; 3],
    /// A start that is already known to be safe (from a hit), with the primitive it leaves.
    pub start: Option<([f32; 3], PrimId)>,
}

impl Query {
    /// The receiver of this query: diffuse, seen along its normal.
    pub fn receiver(&self, albedo: f32) -> Receiver {
        let n = Vec3::new(self.n[0] as f32, self.n[1] as f32, self.n[2] as f32).normalize_or_zero();
        let (start, prim) = self.start.unwrap_or_else(|| (start::start_free(self.p, self.n), NO_PRIM));
        Receiver {
            p: Vec3::new(self.p[0] as f32, self.p[1] as f32, self.p[2] as f32),
            start,
            beyond: start,
            prim,
            ng: n,
            frame: Frame::about(n),
            wo: Local::new(0.0, 0.0, 1.0),
            bsdf: Bsdf::Diffuse(Diffuse { albedo: Rgb::grey(albedo) }),
            cell: 0,
            stream: 0,
            index: 0,
            throughput: Rgb::WHITE,
            bounce: 0,
        }
    }
}

/// Points as a sensor. The surfaces are white (ρ = 1), so that radiance · π is the irradiance.
pub struct PointSensor<'a> {
    /// The points.
    pub queries: &'a [Query],
}

impl Sensor for PointSensor<'_> {
    fn receivers(
        &self,
        looking: &Looking<'_>,
        tile: Tile,
        pass: u32,
        _: &mut Scratch,
        _: &mut Film,
        out: &mut Vec<Receiver>,
    ) {
        let (replicate, index, _) = looking.passes.locate(pass);
        let queries = &self.queries[tile.x as usize..(tile.x + tile.width) as usize];
        out.extend(queries.iter().zip(0..).map(|(query, cell)| Receiver {
            cell,
            stream: stream(looking.seed, tile.x + cell, replicate),
            index,
            ..query.receiver(1.0)
        }));
    }

    fn size(&self) -> [u32; 2] {
        [self.queries.len() as u32, 1]
    }

    fn tiles(&self) -> Vec<Tile> {
        super::grid(self.size(), [run(self.size()[0]), 1])
    }
}
