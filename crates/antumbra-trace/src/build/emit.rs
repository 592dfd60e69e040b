//! Writes the nodes and leaf blocks that the cost calculation chose.

use super::PARALLEL;
use super::binary::{Binary, Plan};
use super::collapse::Summary;
use super::item::{Item, bounds_of};
use crate::layout::{Bounds, Child, LeafIds, Node, WIDTH, leaf_ids, roomy};

/// A subtree in its final form; children count from its own beginning.
#[derive(Debug, Default)]
pub(crate) struct Part {
    pub nodes: Vec<Node>,
    pub leaves: Vec<LeafIds>,
    pub depth: usize,
}

/// A subtree of the binary tree.
#[derive(Clone, Copy)]
struct Subtree<'a> {
    items: &'a [Item],
    nodes: &'a [Binary],
    bounds: Bounds,
}

impl<'a> Subtree<'a> {
    fn new(items: &'a [Item], nodes: &'a [Binary]) -> Subtree<'a> {
        let bounds = nodes.first().map_or_else(|| bounds_of(items), |n| n.bounds);
        Subtree { items, nodes, bounds }
    }

    fn halves(&self, node: &Binary) -> [Subtree<'a>; 2] {
        let left = node.left as usize;
        let (l, r) = self.items.split_at(left);
        [Subtree::new(l, &self.nodes[1..left]), Subtree::new(r, &self.nodes[left..])]
    }

    fn is_leaf(&self) -> bool {
        self.nodes.first().is_none_or(|n| n.summary.is_leaf())
    }

    /// The subtrees that fill `slots` slots of a node, in the cheapest way.
    fn gather(self, mut slots: usize, out: &mut Vec<Subtree<'a>>) {
        let Some(node) = self.nodes.first() else { return out.push(self) };
        while slots > 1 && node.summary.ways[slots - 1] == 0 {
            slots -= 1;
        }
        if slots == 1 {
            return out.push(self);
        }
        let to_left = usize::from(node.summary.ways[slots - 1]);
        let [left, right] = self.halves(node);
        left.gather(to_left, out);
        right.gather(slots - to_left, out);
    }

    /// The children of the wide node that this subtree becomes, best blocker last.
    fn children(self, plan: &Plan) -> Vec<Subtree<'a>> {
        let mut out = Vec::with_capacity(WIDTH);
        match self.nodes.first() {
            Some(node) if !node.summary.is_leaf() => {
                let to_left = usize::from(node.summary.ways[0]);
                let [left, right] = self.halves(node);
                left.gather(to_left, &mut out);
                right.gather(WIDTH - to_left, &mut out);
            }
            _ => out.push(self),
        }
        out.sort_by(|a, b| a.merit(plan).total_cmp(&b.merit(plan)));
        out
    }

    /// What it may block for what it costs: an any-hit query tries the largest first.
    fn merit(&self, plan: &Plan) -> f32 {
        let summary = match self.nodes.first() {
            Some(node) => node.summary,
            None => Summary::of_one(&self.items[0], plan.measure.half_area(&self.bounds), &plan.measure),
        };
        summary.blocks / summary.cost[0]
    }
}

impl Part {
    /// The whole tree; its root is node 0 even if there is but one leaf.
    pub fn of_root(items: &[Item], nodes: &[Binary], scale: f64, plan: &Plan) -> Part {
        Part::of(Subtree::new(items, nodes), scale, plan)
    }

    fn of(subtree: Subtree<'_>, scale: f64, plan: &Plan) -> Part {
        let mut part = Part::default();
        if subtree.items.len() <= 8 * PARALLEL {
            part.depth = part.emit(subtree, scale, plan);
            return part;
        }
        let children = subtree.children(plan);
        let mut below: Vec<Part> = children.iter().map(|_| Part::default()).collect();
        plan.workers.parts(&mut below, 1, &|i, slot| {
            if !children[i].is_leaf() {
                slot[0] = Part::of(children[i], scale, plan);
            }
        });
        part.nodes = roomy(1 + below.iter().map(|p| p.nodes.len()).sum::<usize>());
        part.leaves = roomy(WIDTH + below.iter().map(|p| p.leaves.len()).sum::<usize>());
        let mut node = Node::EMPTY;
        part.nodes.push(node);
        for (lane, (child, mut made)) in children.iter().zip(below).enumerate() {
            let to = if child.is_leaf() { part.leaf(child) } else { part.append(&mut made) };
            node.set(lane, &child.bounds, scale, to);
        }
        part.nodes[0] = node;
        part
    }

    /// Writes `subtree` as a node; the length of the longest chain from it.
    fn emit(&mut self, subtree: Subtree<'_>, scale: f64, plan: &Plan) -> usize {
        let at = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let mut node = Node::EMPTY;
        let mut depth = 0;
        for (lane, child) in subtree.children(plan).into_iter().enumerate() {
            let to = if !subtree.nodes.is_empty() && !child.is_leaf() {
                let to = Child::node(self.nodes.len());
                depth = depth.max(self.emit(child, scale, plan));
                to
            } else {
                self.leaf(&child)
            };
            node.set(lane, &child.bounds, scale, to);
        }
        self.nodes[at] = node;
        depth + 1
    }

    fn leaf(&mut self, subtree: &Subtree<'_>) -> Child {
        self.leaves.push(leaf_ids(subtree.items.iter().map(Item::id)));
        Child::leaf(self.leaves.len() - 1)
    }

    /// Takes over another part; where its root is now.
    fn append(&mut self, other: &mut Part) -> Child {
        let (nodes, leaves) = (self.nodes.len(), self.leaves.len());
        for node in &mut other.nodes {
            for child in &mut node.child {
                *child = match *child {
                    Child::NONE => Child::NONE,
                    leaf if leaf.is_leaf() => Child::leaf(leaf.index() + leaves),
                    inner => Child::node(inner.index() + nodes),
                };
            }
        }
        self.nodes.append(&mut other.nodes);
        self.leaves.append(&mut other.leaves);
        self.depth = self.depth.max(other.depth + 1);
        Child::node(nodes)
    }
}
