//! A world in the making: checks the geometry, fills the trees.

use crate::build::{BuildOptions, Item, Workers, build};
use crate::law::shape_box;
use crate::layout::{Bounds, TriangleBlock, WIDTH, filled};
use crate::object::Object;
use crate::place::{Place, PlaceTree};
use crate::traverse::{Limits, Numbered, ShapeTree, TriangleTree, walls};
use crate::{Geometry, Instance, NO_PRIM, PrimId, Shape, Triangles};

/// Why a world cannot be built.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum WorldError {
    /// An instance names a geometry that does not exist.
    #[error("instance {instance} shows geometry {geometry}, but there are only {count}")]
    NoSuchGeometry {
        /// The instance.
        instance: usize,
        /// What it names.
        geometry: u32,
        /// How many there are.
        count: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} of geometry {geometry} uses a vertex that does not exist")]
    NoSuchVertex {
        /// The geometry.
        geometry: usize,
        /// The triangle.
        triangle: usize,
    },
    /// A number is NaN or infinite, or a radius is not above 0.
    #[error(
        "primitive {primitive} of geometry {geometry} has a number that is not finite, or a radius not above 0"
    )]
    NotFinite {
        /// The geometry.
        geometry: usize,
        /// The primitive.
        primitive: usize,
    },
    /// More primitives than a [`PrimId`] can number.
    #[error("more than 4 294 967 294 primitives")]
    TooMany,
}

/// Indices exist, numbers are finite.
pub(crate) fn check(geometries: &[Geometry], workers: Workers) -> Result<(), WorldError> {
    for (geometry, g) in geometries.iter().enumerate() {
        match g {
            Geometry::Triangles(mesh) => check_mesh(mesh, geometry, workers)?,
            Geometry::Shapes(shapes) => {
                if let Some(primitive) = shapes.iter().position(|s| !is_sound(s)) {
                    return Err(WorldError::NotFinite { geometry, primitive });
                }
            }
        }
    }
    Ok(())
}

fn check_mesh(mesh: &Triangles, geometry: usize, workers: Workers) -> Result<(), WorldError> {
    let count = mesh.vertices.len();
    let wrong = |i: &[u32; 3]| i.iter().any(|&v| v as usize >= count);
    let infinite = |i: &[u32; 3]| i.iter().any(|&v| mesh.vertices[v as usize].iter().any(|x| !x.is_finite()));
    let bad = first_where(&mesh.indices, workers, &|i| wrong(i) || infinite(i));
    bad.map_or(Ok(()), |triangle| {
        let primitive = triangle;
        Err(if wrong(&mesh.indices[triangle]) {
            WorldError::NoSuchVertex { geometry, triangle }
        } else {
            WorldError::NotFinite { geometry, primitive }
        })
    })
}

/// Index of the first element for which `is`.
fn first_where<T: Sync>(data: &[T], workers: Workers, is: &(impl Fn(&T) -> bool + Sync)) -> Option<usize> {
    if data.len() < 1 << 16 {
        return data.iter().position(is);
    }
    let half = data.len() / 2;
    let (a, b) = workers.join(
        true,
        || first_where(&data[..half], workers, is),
        || first_where(&data[half..], workers, is),
    );
    a.or(b.map(|i| i + half))
}

fn is_sound(shape: &Shape) -> bool {
    let finite = |v: &[f32; 3]| v.iter().all(|x| x.is_finite());
    let (ok, radius) = match shape {
        Shape::Sphere { center, radius } => (finite(center), radius),
        Shape::Disk { center, normal, radius } => (finite(center) && finite(normal), radius),
        Shape::Cylinder { p, q, radius } => (finite(p) && finite(q), radius),
    };
    ok && radius.is_finite() && *radius > 0.0
}

/// A world in the making.
pub(crate) struct Draft<'a> {
    pub geometries: &'a [Geometry],
    pub instances: &'a [Instance],
    /// World number of each instance's primitive 0.
    pub base: &'a [PrimId],
    pub options: &'a BuildOptions,
    pub workers: Workers,
}

/// A mesh in a tree: the number of its triangle 0 there, and whether it is masked.
struct Run<'a> {
    /// Triangles of earlier runs.
    start: usize,
    base: PrimId,
    mesh: &'a Triangles,
    masked: bool,
}

impl Draft<'_> {
    fn flat(&self) -> impl Iterator<Item = (usize, &Instance, &Geometry)> {
        let all = self.instances.iter().enumerate().filter(|(_, i)| i.transform.is_none());
        all.map(|(k, i)| (k, i, &self.geometries[i.geometry as usize]))
    }

    /// The tree of world-space triangles.
    pub fn triangles(&self) -> TriangleTree {
        let mut runs = Vec::new();
        let mut start = 0;
        for (k, instance, geometry) in self.flat() {
            if let Geometry::Triangles(mesh) = geometry {
                runs.push(Run { start, base: self.base[k], mesh: mesh.as_ref(), masked: instance.masked });
                start += mesh.indices.len();
            }
        }
        self.triangle_tree(&runs, start)
    }

    fn triangle_tree(&self, runs: &[Run<'_>], count: usize) -> TriangleTree {
        if count == 0 {
            return TriangleTree::default();
        }
        let mut items = filled(count, 1 << 13, self.workers, &|i| {
            let run = &runs[runs.partition_point(|r| r.start <= i) - 1];
            let k = i - run.start;
            Item::triangle(run.base + k as u32, run.mesh.corners(k))
        });
        let tree = build(&mut items, self.options, self.workers);
        drop(items);
        let run_of = |id: PrimId| &runs[runs.partition_point(|r| r.base <= id) - 1];
        let blocks = filled(tree.leaves.len(), 1 << 10, self.workers, &|leaf| {
            let ids = &tree.leaves[leaf];
            let mut corners = [[[0.0; 3]; 3]; WIDTH];
            let n = ids.iter().take_while(|&&id| id != NO_PRIM).count();
            for (c, &id) in corners.iter_mut().zip(&ids[..n]) {
                let run = run_of(id);
                *c = run.mesh.corners((id - run.base) as usize);
            }
            TriangleBlock::new(&corners[..n])
        });
        let mut masked = Vec::new();
        if runs.iter().any(|r| r.masked) {
            let bit = |id: PrimId| u8::from(id != NO_PRIM && run_of(id).masked);
            let bits = |ids: &[u32; WIDTH]| (0..WIDTH).fold(0, |m, lane| m | bit(ids[lane]) << lane);
            masked = tree.leaves.iter().map(bits).collect();
        }
        let mut out = TriangleTree { limits: Limits::of(&tree), tree, blocks, masked, walls: Vec::new() };
        out.walls = walls(&out);
        out
    }

    /// The tree of world-space shapes.
    pub fn shapes(&self) -> ShapeTree {
        let mut shapes = Vec::new();
        for (k, instance, geometry) in self.flat() {
            if let Geometry::Shapes(list) = geometry {
                shapes.extend(list.iter().zip(self.base[k]..).map(|(&shape, prim)| Numbered {
                    prim,
                    shape,
                    masked: instance.masked,
                }));
            }
        }
        self.shape_tree(shapes)
    }

    fn shape_tree(&self, shapes: Vec<Numbered>) -> ShapeTree {
        let item = |(i, s): (usize, &Numbered)| {
            let (lo, hi) = shape_box(&s.shape);
            let (x, y, z) = (hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]);
            Item::new(i as u32, &Bounds { lo, hi }, 0.5 * (x * y + y * z + z * x))
        };
        let mut items: Vec<Item> = shapes.iter().enumerate().map(item).collect();
        let tree = build(&mut items, self.options, self.workers);
        ShapeTree { limits: Limits::of(&tree), tree, shapes }
    }

    /// A tree for each geometry that an instance places.
    pub fn objects(&self) -> Vec<Option<Object>> {
        let mut used = vec![false; self.geometries.len()];
        for instance in self.instances.iter().filter(|i| i.transform.is_some()) {
            used[instance.geometry as usize] = true;
        }
        let object = |geometry: &Geometry| match geometry {
            Geometry::Triangles(mesh) => {
                let run = Run { start: 0, base: 0, mesh, masked: false };
                Object::Triangles(self.triangle_tree(&[run], mesh.indices.len()))
            }
            Geometry::Shapes(list) => {
                let local = |(&shape, prim)| Numbered { prim, shape, masked: false };
                Object::Shapes(self.shape_tree(list.iter().zip(0..).map(local).collect()))
            }
        };
        let made =
            self.geometries.iter().zip(used).map(|(g, used)| (used && !g.is_empty()).then(|| object(g)));
        made.collect()
    }

    /// The tree of instances with a transform.
    pub fn places(&self, objects: &[Option<Object>]) -> PlaceTree {
        let mut places = Vec::new();
        for (k, instance) in self.instances.iter().enumerate() {
            let geometry = instance.geometry as usize;
            let (Some(map), Some(object)) = (instance.transform, &objects[geometry]) else { continue };
            // A map without inverse makes what it places invisible.
            let Some(object_from_world) = map.inverse() else { continue };
            let (base, masked) = (self.base[k], instance.masked);
            let place = Place { geometry, base, masked, object_from_world };
            places.push((place, map, object.tree().bounds));
        }
        PlaceTree::new(places, self.options, self.workers)
    }
}
