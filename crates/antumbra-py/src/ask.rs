//! Questions about many rays at once, gathered from arrays as they lie.

use std::ops::Range;
use std::sync::{Arc, Mutex, PoisonError};

use antumbra::scene::Scene;
use antumbra::schedule;
use antumbra::sensor::Query;
use antumbra::trace::{NO_PRIM, SegmentBuffer};
use numpy::ndarray::{ArrayView1, Axis, Slice};
use pyo3::prelude::*;

use crate::arrays::{Rows, View};
use crate::errors;
use crate::receivers::{Receivers, Start};
use crate::watch::watched;

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
    /// A view relative to the scene's origin; receivers must belong to `scene`.
    pub fn view(&self, scene: &Arc<Scene>, origin: [f64; 3]) -> PyResult<Starts<'_>> {
        match self {
            Origins::Rows(rows) => Ok(Starts::Points(rows.about(origin))),
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
    /// Gathers a run of entries. An entry that cannot be asked about becomes a ray of length 0, which meets nothing;
    /// if it is the caller's mistake it is noted in `wrong`.
    pub fn gather(&self, run: Range<usize>, buffer: &mut SegmentBuffer, wrong: &Wrong) {
        buffer.clear();
        if self.gather_points(run.clone(), buffer) {
            return;
        }
        buffer.clear();
        for i in run {
            match self.entry(i) {
                Ok(Some(Entry { origin, end, reach: Some(reach), first })) => {
                    buffer.push_ray(origin, end, reach, first, i as u32);
                }
                Ok(Some(Entry { origin, end, reach: None, first })) => {
                    buffer.push_segment(origin, end, first, NO_PRIM, i as u32);
                }
                Ok(None) => buffer.push_ray([0.0; 3], [1.0; 3], 0.0, NO_PRIM, i as u32),
                Err(what) => {
                    buffer.push_ray([0.0; 3], [1.0; 3], 0.0, NO_PRIM, i as u32);
                    wrong.note(i, what);
                }
            }
        }
    }

    /// Gathers a run of bare points, component by component; false if they are not bare or one cannot be asked about.
    fn gather_points(&self, run: Range<usize>, buffer: &mut SegmentBuffer) -> bool {
        let Starts::Points(points) = self.starts else { return false };
        let mut rays = buffer.grow(run.len(), run.start as u32);
        let sound = points.split(run.clone(), &mut rays.origin) & self.ends.split(run.clone(), &mut rays.end);
        let Some(reach) = self.reach else { return sound };
        let reach = reach.slice_axis(Axis(0), Slice::from(run));
        reach.iter().zip(rays.reach).fold(sound, |sound, (t, out)| {
            *out = *t as f32;
            sound & (*t >= 0.0)
        })
    }

    /// Entry `i`; `None` = it starts at a ray that missed.
    fn entry(&self, i: usize) -> Result<Option<Entry>, String> {
        let end = single(self.name, i, self.ends.finite::<3>(self.name, i)?)?;
        let reach = self.reach.map(|reach| distance(reach[i], i)).transpose()?;
        let (origin, first) = match self.starts {
            Starts::Points(points) => (single("origins", i, points.finite::<3>("origins", i)?)?, NO_PRIM),
            Starts::Receivers(receivers) => match receivers.start(i) {
                Some(start) => (start.origin, self.first(&start, end)),
                None => return Ok(None),
            },
        };
        Ok(Some(Entry { origin, end, reach, first }))
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
}

struct Entry {
    origin: [f32; 3],
    end: [f32; 3],
    reach: Option<f32>,
    first: u32,
}

/// The first entry that is the caller's mistake, whichever thread finds it.
#[derive(Default)]
pub struct Wrong(Mutex<Option<(usize, String)>>);

impl Wrong {
    /// Entry `i` is wrong, and how.
    pub fn note(&self, i: usize, what: String) {
        let mut first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if first.as_ref().is_none_or(|(known, _)| i < *known) {
            *first = Some((i, what));
        }
    }

    /// ValueError, if there is one.
    pub fn raise(self) -> PyResult<()> {
        match self.0.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some((_, what)) => Err(errors::value(what)),
            None => Ok(()),
        }
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
pub fn queries(
    py: Python<'_>,
    starts: Starts<'_>,
    normals: Option<View<'_>>,
) -> PyResult<(Vec<Query>, Vec<usize>)> {
    const CHUNK: usize = 4096;
    let one = |i: usize| match (starts, normals) {
        (Starts::Receivers(receivers), _) => Ok(receivers.query(i)),
        (Starts::Points(points), Some(normals)) => bare(points, normals, i).map(Some),
        (Starts::Points(_), None) => Err("normals are missing: one per point is needed".into()),
    };
    let (mut all, wrong) = (vec![None; starts.len()], Wrong::default());
    let ask = |from: usize, out: &mut [Option<Query>], _: &mut ()| {
        for (i, out) in (from..).zip(out) {
            match one(i) {
                Ok(query) => *out = query,
                Err(what) => wrong.note(i, what),
            }
        }
    };
    watched(py, |look| schedule::chunks(&mut all, CHUNK, 0, ask, &mut |_| look()))?;
    wrong.raise()?;
    let rows = (0..all.len()).filter(|i| all[*i].is_some()).collect();
    Ok((all.into_iter().flatten().collect(), rows))
}

fn bare(points: View<'_>, normals: View<'_>, i: usize) -> Result<Query, String> {
    let (p, n) = (points.finite::<3>("points", i)?, normals.finite::<3>("normals", i)?);
    let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
    if length == 0.0 {
        return Err(format!("normals[{i}] is (0, 0, 0): it points nowhere"));
    }
    Ok(Query { p, n: n.map(|c| c / length), start: None })
}
