//! What blocks: triangles and four shapes, placed in the world by instances.

use std::sync::Arc;

use antumbra_math::Transform;

/// A primitive of the world: unique over all instances, in builder order (instance, then primitive in its geometry).
pub type PrimId = u32;

/// No primitive.
pub const NO_PRIM: PrimId = u32::MAX;

/// An indexed triangle mesh; every index is below the number of vertices, every vertex is finite.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Vertex positions.
    pub vertices: Vec<[f32; 3]>,
    /// Three vertices a triangle; its front is where they run counter-clockwise.
    pub indices: Vec<[u32; 3]>,
}

impl Triangles {
    /// The three corners of triangle `i`.
    #[inline]
    pub fn corners(&self, i: usize) -> [[f32; 3]; 3] {
        self.indices[i].map(|v| self.vertices[v as usize])
    }
}

/// A primitive that one f64 formula decides (LAW §6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A sphere; both sides block.
    Sphere {
        /// Centre.
        center: [f32; 3],
        /// Radius, above 0.
        radius: f32,
    },
    /// A flat disk; both sides block.
    Disk {
        /// Centre.
        center: [f32; 3],
        /// Normal of any length above 0.
        normal: [f32; 3],
        /// Radius, above 0.
        radius: f32,
    },
    /// The side of a cylinder, without caps; both sides block.
    Cylinder {
        /// One end of the axis.
        p: [f32; 3],
        /// The other end.
        q: [f32; 3],
        /// Radius, above 0.
        radius: f32,
    },
}

/// Primitives in their own space, shared by any number of instances.
#[derive(Clone, Debug)]
pub enum Geometry {
    /// A mesh.
    Triangles(Arc<Triangles>),
    /// Curved or flat shapes.
    Shapes(Vec<Shape>),
}

impl Geometry {
    /// Number of primitives.
    pub fn len(&self) -> usize {
        match self {
            Geometry::Triangles(t) => t.indices.len(),
            Geometry::Shapes(s) => s.len(),
        }
    }

    /// There is no primitive.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A geometry placed in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Index of the geometry.
    pub geometry: u32,
    /// Object → world; `None` = the geometry's numbers are world numbers (no f64 map is applied).
    pub transform: Option<Transform>,
    /// Hits are asked back by the `passes` callback (alpha masks).
    pub masked: bool,
}
