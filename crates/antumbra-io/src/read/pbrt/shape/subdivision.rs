//! loopsubdiv: Loop's surface (C. Loop 1987, "Smooth Subdivision Surfaces Based on Triangles"), as a mesh after some rounds,
//! its vertices on the limit.

use std::collections::BTreeMap;

use antumbra::scene::Mesh;
use antumbra_math::DVec3;
use antumbra_trace::Triangles;

use super::super::Reader;
use super::super::parameters::Parameters;
use super::mesh::{faces, rows, turned};
use super::{Body, Placing};
use crate::error::ReadError;
use crate::read::tessellate::smooth;

/// Rounds at most: each makes four triangles of one.
const MOST: u32 = 10;

/// `P` and `indices`, refined `levels` times.
pub(super) fn loopsubdiv(
    reader: &mut Reader,
    p: &Parameters,
    at: &Placing,
) -> Result<Option<Body>, ReadError> {
    let levels = p.count("levels")?.unwrap_or(3);
    p.pass_over(&["scheme"]);
    if levels > MOST {
        return Err(p.error(format!("\"levels\" is {levels}: at most {MOST} are made")));
    }
    let Some(points) = rows::<3>(p, "P")? else { return Err(p.error("\"point3 P\" is missing")) };
    let mut triangles = faces::<3>(p, points.len())?;
    let room = (triangles.len() as u64) << (2 * levels);
    reader.context.take(room, 128).map_err(|why| p.error(why))?;
    let mut points: Vec<_> = points.iter().map(|v| DVec3::from(v.map(f64::from))).collect();
    for _ in 0..levels {
        (points, triangles) = refined(&points, &triangles);
    }
    let edges = edges(&triangles);
    let points = moved(&points, &edges, |p, around, border| match border {
        // ⅗ of a vertex of the border, ⅕ of each of its neighbours there.
        true => p * 0.6 + around.iter().sum::<DVec3>() * 0.2,
        false => {
            let n = around.len() as f64;
            let weight = 1.0 / (n + 3.0 / (8.0 * beta(around.len())));
            p * (1.0 - n * weight) + around.iter().sum::<DVec3>() * weight
        }
    });
    let vertices = points.iter().map(|p| p.as_vec3().to_array()).collect();
    let mut mesh = Mesh { triangles: Triangles { vertices, indices: triangles }, ..Mesh::default() };
    mesh.normals = Some(smooth(&mesh));
    Ok(reader.mesh(turned(mesh, at.reverse)))
}

/// An edge, the lower vertex first: the corners across it in the one or two triangles that share it.
type Edges = BTreeMap<[u32; 2], Vec<u32>>;

fn edges(triangles: &[[u32; 3]]) -> Edges {
    let mut edges = Edges::new();
    for [a, b, c] in triangles {
        for [from, to, across] in [[a, b, c], [b, c, a], [c, a, b]] {
            edges.entry([*from.min(to), *from.max(to)]).or_default().push(*across);
        }
    }
    edges
}

/// Warren's weight of each neighbour of a vertex that has n of them.
fn beta(n: usize) -> f64 {
    if n == 3 { 3.0 / 16.0 } else { 3.0 / (8.0 * n as f64) }
}

/// Each vertex by its neighbours, those along the border where it lies on it.
fn moved(points: &[DVec3], edges: &Edges, rule: impl Fn(DVec3, &[DVec3], bool) -> DVec3) -> Vec<DVec3> {
    let mut around = vec![(Vec::new(), Vec::new()); points.len()];
    for ([a, b], across) in edges {
        for (here, there) in [(a, b), (b, a)] {
            let (all, border) = &mut around[*here as usize];
            all.push(points[*there as usize]);
            if across.len() == 1 {
                border.push(points[*there as usize]);
            }
        }
    }
    let each = points.iter().zip(&around).map(|(p, (all, border))| match (all.len(), border.len()) {
        (0, _) => *p,
        (_, 0) => rule(*p, all, false),
        (_, 2) => rule(*p, border, true),
        // Where more than one surface meets in a vertex it stays.
        _ => *p,
    });
    each.collect()
}

/// One round: vertices move, edges get a vertex each, triangles become four.
fn refined(points: &[DVec3], triangles: &[[u32; 3]]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let edges = edges(triangles);
    let mut finer = moved(points, &edges, |p, around, border| {
        let beta = if border { 0.125 } else { beta(around.len()) };
        p * (1.0 - around.len() as f64 * beta) + around.iter().sum::<DVec3>() * beta
    });
    let mut middle = BTreeMap::new();
    for (edge, across) in &edges {
        let [a, b] = edge.map(|i| points[i as usize]);
        let new = match across[..] {
            [c, d] => (a + b) * 0.375 + (points[c as usize] + points[d as usize]) * 0.125,
            _ => (a + b) * 0.5,
        };
        middle.insert(*edge, finer.len() as u32);
        finer.push(new);
    }
    let of = |a: u32, b: u32| middle[&[a.min(b), a.max(b)]];
    let four = |t: &[u32; 3]| {
        let [a, b, c] = *t;
        let (ab, bc, ca) = (of(a, b), of(b, c), of(c, a));
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    (finer, triangles.iter().flat_map(four).collect())
}
