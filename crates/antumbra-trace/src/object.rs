//! A geometry that instances share, in a tree of its own.

use crate::layout::Tree;
use crate::traverse::{ShapeTree, TriangleTree};

/// Primitives of one geometry in a tree of their own, shared by instances.
#[derive(Clone, Debug)]
pub(crate) enum Object {
    Triangles(TriangleTree),
    Shapes(ShapeTree),
}

impl Object {
    /// Its nodes.
    pub fn tree(&self) -> &Tree {
        match self {
            Object::Triangles(t) => &t.tree,
            Object::Shapes(s) => &s.tree,
        }
    }
}
