//! A world: triangles and shapes in trees, instances that share them. Built once, then only asked.

use crate::build::{BuildOptions, Pool};
use crate::draft::{Draft, WorldError, check};
use crate::level::SimdLevel;
use crate::object::Object;
use crate::place::PlaceTree;
use crate::traverse::{ShapeTree, TriangleTree, Ways};
use crate::{Geometry, Instance, NO_PRIM, PrimId};

/// What a tree is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TreeStats {
    /// Bytes of nodes and leaf blocks of all trees, without the geometry that the caller gave.
    pub bytes: usize,
    /// Nodes of eight boxes.
    pub nodes: usize,
    /// Leaf blocks of up to eight primitives.
    pub leaves: usize,
    /// Primitives in those blocks (an instanced mesh counts once).
    pub primitives: usize,
    /// Longest chain of nodes in one tree.
    pub depth: usize,
    /// Expected node visits of a random line through the tree of world-space triangles (surface-area heuristic).
    pub sah_cost: f64,
}

/// Triangles and shapes, placed and searchable. Equals `Brute` bit for bit.
#[derive(Clone, Debug)]
pub struct World {
    pub(crate) geometries: Vec<Geometry>,
    pub(crate) instances: Vec<Instance>,
    /// World number of each instance's primitive 0; one more for the end.
    pub(crate) base: Vec<PrimId>,
    /// Triangles of all instances without a transform.
    pub(crate) triangles: TriangleTree,
    /// Shapes of all instances without a transform.
    pub(crate) shapes: ShapeTree,
    /// By geometry, where an instance with a transform shows it.
    pub(crate) objects: Vec<Option<Object>>,
    /// Instances with a transform.
    pub(crate) places: PlaceTree,
    pub(crate) level: SimdLevel,
    pub(crate) ways: Ways,
}

impl World {
    /// Builds the trees. The result is the same for every number of threads.
    pub fn build(
        geometries: Vec<Geometry>,
        instances: Vec<Instance>,
        options: &BuildOptions,
        pool: Pool<'_>,
    ) -> Result<World, WorldError> {
        let base = number(&geometries, &instances)?;
        pool.run(move |workers| {
            check(&geometries, workers)?;
            let draft =
                Draft { geometries: &geometries, instances: &instances, base: &base, options, workers };
            let (triangles, shapes) = (draft.triangles(), draft.shapes());
            let objects = draft.objects();
            let places = draft.places(&objects);
            Ok(World {
                triangles,
                shapes,
                objects,
                places,
                level: SimdLevel::Auto,
                ways: Ways::Measured,
                geometries,
                instances,
                base,
            })
        })
    }

    /// Number of primitives over all instances.
    pub fn prim_count(&self) -> u32 {
        self.base.last().copied().unwrap_or(0)
    }

    /// The instance that a primitive belongs to, and its index in that instance's geometry; `None` if there is no such
    /// primitive.
    pub fn locate(&self, prim: PrimId) -> Option<(u32, u32)> {
        let instance = locate(&self.base, prim)?;
        Some((instance as u32, prim - self.base[instance]))
    }

    /// The corners of a triangle in its object's space; `None` for shapes and numbers without a primitive.
    pub fn corners(&self, prim: PrimId) -> Option<[[f32; 3]; 3]> {
        let (instance, primitive) = self.locate(prim)?;
        match &self.geometries[self.instances[instance as usize].geometry as usize] {
            Geometry::Triangles(mesh) => Some(mesh.corners(primitive as usize)),
            Geometry::Shapes(_) => None,
        }
    }

    /// The geometries, as given.
    pub fn geometries(&self) -> &[Geometry] {
        &self.geometries
    }

    /// The instances, as given.
    pub fn instances(&self) -> &[Instance] {
        &self.instances
    }

    /// The box around everything: (lowest, highest) corner; +∞, −∞ if there is nothing.
    pub fn bounds(&self) -> ([f32; 3], [f32; 3]) {
        let all = self.triangles.tree.bounds.union(&self.shapes.tree.bounds).union(&self.places.bounds);
        (all.lo, all.hi)
    }

    /// Some instance is masked.
    pub fn has_masks(&self) -> bool {
        self.instances.iter().any(|i| i.masked)
    }

    /// Both have the same trees, bit for bit.
    pub fn same_trees(&self, other: &World) -> bool {
        let objects = |w: &World| w.objects.iter().flatten().map(|o| o.tree().clone()).collect::<Vec<_>>();
        self.triangles.tree == other.triangles.tree
            && self.shapes.tree == other.shapes.tree
            && self.places.tree == other.places.tree
            && objects(self) == objects(other)
    }

    /// Sizes of the trees.
    pub fn stats(&self) -> TreeStats {
        let mut stats = TreeStats { sah_cost: self.triangles.tree.sah_cost, ..TreeStats::default() };
        let objects = self.objects.iter().flatten();
        let triangles = objects.clone().filter_map(|o| match o {
            Object::Triangles(t) => Some(t),
            Object::Shapes(_) => None,
        });
        for t in triangles.chain([&self.triangles]) {
            stats.bytes += size_of_val(t.blocks.as_slice()) + t.masked.len();
        }
        for tree in objects.map(Object::tree).chain([&self.triangles.tree, &self.shapes.tree]) {
            stats.bytes += tree.bytes();
            stats.nodes += tree.nodes.len();
            stats.leaves += tree.leaves.len();
            stats.primitives += tree.leaves.iter().flatten().filter(|&&id| id != NO_PRIM).count();
            stats.depth = stats.depth.max(tree.depth);
        }
        stats.bytes += self.places.bytes();
        stats
    }
}

/// The instance that `prim` belongs to.
fn locate(base: &[PrimId], prim: PrimId) -> Option<usize> {
    // Instances of empty geometries share a base: the last one that is not above `prim` has it.
    let instance = base.partition_point(|&b| b <= prim).checked_sub(1)?;
    (instance + 1 < base.len()).then_some(instance)
}

/// The base of each instance, and the end.
fn number(geometries: &[Geometry], instances: &[Instance]) -> Result<Vec<PrimId>, WorldError> {
    let mut base = Vec::with_capacity(instances.len() + 1);
    let mut next = 0u64;
    for (i, instance) in instances.iter().enumerate() {
        base.push(next as PrimId);
        let geometry = geometries.get(instance.geometry as usize).ok_or(WorldError::NoSuchGeometry {
            instance: i,
            geometry: instance.geometry,
            count: geometries.len(),
        })?;
        next += geometry.len() as u64;
        if next >= u64::from(NO_PRIM) {
            return Err(WorldError::TooMany);
        }
    }
    base.push(next as PrimId);
    Ok(base)
}
