//! The tree of nodes: every node of the scene once, with its place in the world.

use antumbra_math::{DVec3, Transform};

use super::document::{Document, Node};
use crate::error::ReadError;
use crate::read::Counted;

/// A node in its place.
pub(super) struct Placed {
    pub node: usize,
    pub world: Transform,
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    Unseen,
    /// On the way from the root to the node at hand.
    Above,
    Done,
}

enum Step {
    Enter(usize, Transform, Option<usize>),
    Leave(usize),
}

/// Walks through the scene without recursion: deep trees are no danger, cycles are found.
pub(super) fn walk(doc: &Document, root: &Transform, said: &mut Counted) -> Result<Vec<Placed>, ReadError> {
    let mut state = vec![State::Unseen; doc.nodes.len()];
    let mut placed = Vec::new();
    let mut steps: Vec<_> = roots(doc)?.into_iter().rev().map(|n| Step::Enter(n, *root, None)).collect();
    while let Some(step) = steps.pop() {
        let (index, world, parent) = match step {
            Step::Enter(index, world, parent) => (index, world, parent),
            Step::Leave(index) => {
                state[index] = State::Done;
                continue;
            }
        };
        let Some(node) = doc.nodes.get(index) else {
            let what = format!("node {index} is named; there are {}", doc.nodes.len());
            return Err(ReadError::new(parent.map_or("scene".into(), |p| format!("node {p}")), what));
        };
        match state[index] {
            State::Unseen => {}
            State::Above => {
                let what = "is its own ancestor: the nodes form a circle";
                return Err(ReadError::new(format!("node {index}"), what).hint("Its exporter is wrong."));
            }
            State::Done => {
                said.warn(format!("node {index}"), "has two parents (not a tree): drawn under the first one");
                continue;
            }
        }
        state[index] = State::Above;
        steps.push(Step::Leave(index));
        if is_hidden(node) {
            continue;
        }
        let world = world.after(&local(node));
        placed.push(Placed { node: index, world });
        steps.extend(node.children.iter().rev().map(|c| Step::Enter(*c, world, Some(index))));
    }
    Ok(placed)
}

/// The top nodes of the scene that the file wants shown; of all nodes if it has no scene.
fn roots(doc: &Document) -> Result<Vec<usize>, ReadError> {
    let index = doc.scene.unwrap_or(0);
    if let Some(scene) = doc.scenes.get(index) {
        return Ok(scene.nodes.clone());
    }
    if doc.scene.is_some() {
        return Err(ReadError::new(
            "scene",
            format!("scene {index} is named; there are {}", doc.scenes.len()),
        ));
    }
    let mut is_child = vec![false; doc.nodes.len()];
    for child in doc.nodes.iter().flat_map(|n| &n.children) {
        if let Some(c) = is_child.get_mut(*child) {
            *c = true;
        }
    }
    Ok((0..doc.nodes.len()).filter(|n| !is_child[*n]).collect())
}

/// KHR_node_visibility hides it with all that hangs below.
fn is_hidden(node: &Node) -> bool {
    let visible = node.extensions.get("KHR_node_visibility").and_then(|e| e.get("visible"));
    visible.and_then(|v| v.as_bool()) == Some(false)
}

/// Node → parent.
fn local(node: &Node) -> Transform {
    if let Some(m) = &node.matrix {
        return Transform::from_columns(m);
    }
    let t = node.translation.map_or(DVec3::ZERO, DVec3::from_array);
    let s = node.scale.map_or(DVec3::ONE, DVec3::from_array);
    trs(t, node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]), s)
}

/// Translation, rotation and scale; the quaternion is brought to unit length, which text of few digits is not.
pub(super) fn trs(t: DVec3, q: [f64; 4], s: DVec3) -> Transform {
    let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    let q = if length > 0.0 && length.is_finite() { q.map(|c| c / length) } else { [0.0, 0.0, 0.0, 1.0] };
    Transform::from_trs(t, q, s)
}
