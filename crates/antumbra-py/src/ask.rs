//! Questions about many rays at once: gathered from arrays a part at a time, answered by all cores.

use std::sync::Arc;

use antumbra::scene::Scene;
use antumbra::sensor::Query;
use antumbra::trace::{NO_PRIM, SegmentBuffer};
use numpy::ndarray::ArrayView1;
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::arrays::{Rows, View};
use crate::errors;
use crate::receivers::{Receivers, Start};

/// Rays that one thread takes at a time: enough for a batch, few enough to keep all cores busy.
const PART: usize = 4096;

/// Rays between two looks whether Ctrl-C was pressed.
const BETWEEN_SIGNALS: usize = 1 << 20;

/// Where rays start: receivers of a hit, or bare points.
#[derive(FromPyObject)]
pub enum Origins<'py> {
    /// Points that know their surface.
    Receivers(PyRef<'py, Receivers>),
    /// Bare points.
    Rows(Rows<'py>),
}

/// The same, usable without Python's lock.
#[derive(Clone, Copy)]
pub enum Starts<'a> {
    /// Points that know their surface.
    Receivers(&'a Receivers),
    /// Bare points, taken as they are.
    Points(View<'a>),
}

impl Origins<'_> {
    /// A view; receivers must belong to `scene`.
    pub fn view(&self, scene: &Arc<Scene>) -> PyResult<Starts<'_>> {
        match self {
            Origins::Rows(rows) => Ok(Starts::Points(rows.view())),
            Origins::Receivers(receivers) if Arc::ptr_eq(receivers.scene(), scene) => {
                Ok(Starts::Receivers(receivers))
            }
            Origins::Receivers(_) => Err(errors::value(
                "these receivers belong to another scene, or to this one before something was added to it",
            )),
        }
    }
}

impl Starts<'_> {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Starts::Receivers(receivers) => receivers.len(),
            Starts::Points(points) => points.len(),
        }
    }
}

/// Segments or rays of arrays.
pub struct Batch<'a> {
    /// Where they start.
    pub starts: Starts<'a>,
    /// Name of the ends, for errors.
    pub name: &'static str,
    /// End points, or directions where there is a reach.
    pub ends: View<'a>,
    /// Largest t of each ray; without: `ends` are points.
    pub reach: Option<ArrayView1<'a, f64>>,
}

impl Batch<'_> {
    /// Gathers entry `i`; `false` = it starts at a ray that missed, nothing to ask.
    fn push(&self, i: usize, buffer: &mut SegmentBuffer) -> Result<bool, String> {
        let end = single(self.name, i, self.ends.finite::<3>(self.name, i)?)?;
        let (origin, first) = match self.starts {
            Starts::Points(points) => (single("origins", i, points.finite::<3>("origins", i)?)?, NO_PRIM),
            Starts::Receivers(receivers) => match receivers.start(i) {
                Some(start) => (start.origin, self.first(&start, end)),
                None => return Ok(false),
            },
        };
        match self.reach {
            None => buffer.push_segment(origin, end, first, NO_PRIM, i as u32),
            Some(reach) => buffer.push_ray(origin, end, distance(reach[i], i)?, first, i as u32),
        }
        Ok(true)
    }

    /// The own surface is left out only where the ray leaves on the side that it starts from.
    fn first(&self, start: &Start, end: [f32; 3]) -> u32 {
        let along = match self.reach {
            Some(_) => end.map(f64::from),
            None => [0, 1, 2].map(|k| f64::from(end[k]) - f64::from(start.origin[k])),
        };
        let cos: f64 = along.iter().zip(start.normal).map(|(d, n)| d * n).sum();
        if cos > 0.0 { start.prim } else { NO_PRIM }
    }

    /// Asks about all entries, part by part on all cores: `answer` gets a gathered part, the numbers of its entries and
    /// the results of the part. Entries that start nowhere keep what `out` has.
    pub fn answer<T: Send>(
        &self,
        py: Python<'_>,
        out: &mut [T],
        answer: impl Fn(&SegmentBuffer, &[u32], usize, &mut [T]) + Sync,
    ) -> PyResult<()> {
        let pool = (out.len() > PART).then(|| rayon::ThreadPoolBuilder::new().build().ok()).flatten();
        for (chunk, out) in out.chunks_mut(BETWEEN_SIGNALS).enumerate() {
            let from = chunk * BETWEEN_SIGNALS;
            let part = |work: &mut Work, k: usize, out: &mut [T]| {
                let first = from + k * PART;
                work.clear();
                for i in first..first + out.len() {
                    if self.push(i, &mut work.buffer)? {
                        work.entries.push((i - first) as u32);
                    }
                }
                answer(&work.buffer, &work.entries, first, out);
                Ok(())
            };
            let done = py.detach(|| match &pool {
                Some(pool) => pool.install(|| {
                    let parts = out.par_chunks_mut(PART).enumerate();
                    parts.map_init(Work::default, |work, (k, out)| part(work, k, out)).collect()
                }),
                None => part(&mut Work::default(), 0, out),
            });
            done.map_err(|what: String| errors::value(what))?;
            py.check_signals()?;
        }
        Ok(())
    }
}

/// What a thread fills again and again.
#[derive(Default)]
struct Work {
    buffer: SegmentBuffer,
    entries: Vec<u32>,
}

impl Work {
    fn clear(&mut self) {
        self.buffer.clear();
        self.entries.clear();
    }
}

fn single(name: &str, i: usize, row: [f64; 3]) -> Result<[f32; 3], String> {
    let single = row.map(|c| c as f32);
    if single.iter().all(|c| c.is_finite()) {
        Ok(single)
    } else {
        Err(format!("{name}[{i}] is {row:?}: beyond the largest single-precision number"))
    }
}

fn distance(t: f64, i: usize) -> Result<f32, String> {
    if t >= 0.0 { Ok(t as f32) } else { Err(format!("max_distance[{i}] is {t}: 0 or more is needed")) }
}

/// The receivers that ask for light, and where each stands among the rows; rays that missed ask for none.
pub fn queries(starts: Starts<'_>, normals: Option<View<'_>>) -> Result<(Vec<Query>, Vec<usize>), String> {
    let mut queries = Vec::with_capacity(starts.len());
    let mut rows = Vec::with_capacity(starts.len());
    for i in 0..starts.len() {
        let query = match (starts, normals) {
            (Starts::Receivers(receivers), _) => receivers.query(i),
            (Starts::Points(points), Some(normals)) => Some(bare(points, normals, i)?),
            (Starts::Points(_), None) => return Err("normals are missing: one per point is needed".into()),
        };
        if let Some(query) = query {
            queries.push(query);
            rows.push(i);
        }
    }
    Ok((queries, rows))
}

fn bare(points: View<'_>, normals: View<'_>, i: usize) -> Result<Query, String> {
    let (p, n) = (points.finite::<3>("points", i)?, normals.finite::<3>("normals", i)?);
    let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
    if length == 0.0 {
        return Err(format!("normals[{i}] is (0, 0, 0): it points nowhere"));
    }
    Ok(Query { p, n: n.map(|c| c / length), start: None })
}
