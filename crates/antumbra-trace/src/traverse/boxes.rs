//! Through the boxes in f32: eight at once, conservative (LAW §3).

use std::mem::MaybeUninit;

use fearless_simd::{Simd, f32x8, mask32x8, prelude::*};

use super::ray::{BoxRay, FastLine};
use crate::layout::{Child, MAX_DEPTH, Node, WIDTH};

/// 1 + 2⁻²⁰: how much a far plane is moved away.
pub(crate) const FAR_SLACK: f32 = 1.0 + 1.0 / 1_048_576.0;

/// What an any-hit query does at a leaf block.
pub(crate) trait VisitAny<S: Simd> {
    /// Something in leaf block `leaf` blocks the line.
    fn any(&mut self, simd: S, leaf: usize) -> bool;
    /// Leaf block `leaf` is visited soon.
    fn fetch_leaf(&self, leaf: usize);
    /// `child` is visited soon.
    #[inline(always)]
    fn fetch(&self, nodes: &[Node], child: Child) {
        if child.is_leaf() { self.fetch_leaf(child.index()) } else { prefetch(nodes, child.index()) }
    }
}

/// What a closest-hit query does at a leaf block.
pub(crate) trait VisitNearest<S: Simd> {
    /// Looks for closer hits in leaf block `leaf`; the largest t that still matters.
    fn nearest(&mut self, simd: S, leaf: usize) -> f32;
}

/// Which of the eight boxes the line meets before `tmax`, and where it enters them.
///
/// Pass iff tnear ≤ (1 + 2⁻²⁰) min(tfar, tmax). Where a level has no fused multiply-add, p·r is rounded: the same as
/// moving the plane by 2⁻²⁴ M; with the moves of o by its own rounding (instances) and that of o·r it makes three of
/// the four such units that the pad has.
#[inline(always)]
fn meet<S: Simd>(simd: S, node: &Node, ray: &BoxRay<S>, tmax: f32x8<S>) -> (mask32x8<S>, f32x8<S>) {
    let [nx, ny, nz] = ray.near;
    let plane = |row: usize| f32x8::load_array_ref(simd, &node.planes[row]);
    let [fx, fy, fz] = ray.far;
    let x0 = plane(nx).mul_add(ray.r[0], ray.or[0]);
    let y0 = plane(ny).mul_add(ray.r[1], ray.or[1]);
    let z0 = plane(nz).mul_add(ray.r[2], ray.or[2]);
    let x1 = plane(fx).mul_add(ray.r[0], ray.or[0]);
    let y1 = plane(fy).mul_add(ray.r[1], ray.or[1]);
    let z1 = plane(fz).mul_add(ray.r[2], ray.or[2]);
    let enter = x0.max(y0).max(z0.max(f32x8::splat(simd, 0.0)));
    let leave = x1.min(y1).min(z1.min(tmax));
    let pass = enter.simd_le(leave * FAR_SLACK);
    (pass, enter)
}

/// Asks for the memory of element `i`; what is not there is not asked for.
#[inline(always)]
pub(crate) fn prefetch<T>(of: &[T], i: usize) {
    #[cfg(target_arch = "x86_64")]
    if let Some(element) = of.get(i) {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let first = std::ptr::from_ref(element).cast::<i8>();
        for line in 0..size_of::<T>() / 64 {
            // SAFETY: a prefetch has no effect on memory or registers and cannot fault; the address is inside `element`.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(first.add(64 * line)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (of, i);
}

/// Every node on the way down leaves at most seven children behind.
pub(super) const STACK: usize = MAX_DEPTH * (WIDTH - 1) + 1;

/// A stack that is not cleared. Holds at most `N` elements: the pushes are bounded by the depth of the tree.
pub(super) struct Stack<T: Copy, const N: usize> {
    slots: [MaybeUninit<T>; N],
    len: usize,
}

impl<T: Copy, const N: usize> Stack<T, N> {
    #[inline(always)]
    pub fn new() -> Stack<T, N> {
        Stack { slots: [const { MaybeUninit::uninit() }; N], len: 0 }
    }

    #[inline(always)]
    pub fn push(&mut self, value: T) {
        // Bounds are checked here, so `len` ≤ N always.
        self.slots[self.len] = MaybeUninit::new(value);
        self.len += 1;
    }

    /// The element that [`pop`](Stack::pop) would take.
    #[inline(always)]
    fn top(&self) -> Option<T> {
        let last = self.len.checked_sub(1)?;
        // SAFETY: slots[0 .. len] were written by `push`, see `pop`.
        Some(unsafe { self.slots[last].assume_init() })
    }

    #[inline(always)]
    pub fn pop(&mut self) -> Option<T> {
        self.len = self.len.checked_sub(1)?;
        // SAFETY: slots[0 .. len] were written by `push`: it alone raises `len`, by one, after writing slots[len];
        // here `len` was lowered by one, so slots[len] is one of them. T is Copy: nothing is dropped twice.
        Some(unsafe { self.slots[self.len].assume_init() })
    }
}

/// Anything blocks the line between 0 and its tmax. A line that ends visits nearer boxes first; one that does not
/// visits children in their stored order, where the large blockers of a closed room come first.
#[inline(always)]
pub(crate) fn any_hit<S: Simd>(
    simd: S,
    nodes: &[Node],
    line: &FastLine,
    visit: &mut impl VisitAny<S>,
) -> bool {
    let ray = BoxRay::new(simd, line);
    let tmax = f32x8::splat(simd, line.tmax);
    let ends = line.tmax < f32::INFINITY;
    let mut stack = Stack::<(f32, Child), STACK>::new();
    let mut at = Child::node(0);
    loop {
        if at.is_leaf() {
            if visit.any(simd, at.index()) {
                return true;
            }
        } else {
            let node = &nodes[at.index()];
            let (pass, enter) = meet(simd, node, &ray, tmax);
            let (met, enter) = (pass.to_bitmask() as u32, enter.to_array());
            if met & met.wrapping_sub(1) != 0 {
                at = if ends {
                    nearest_child(node, met, |lane| enter[lane], &mut stack)
                } else {
                    last_child(node, met, &mut stack)
                };
                if let Some((_, next)) = stack.top() {
                    visit.fetch(nodes, next);
                }
                continue;
            }
            if met != 0 {
                at = node.child[met.trailing_zeros() as usize % WIDTH];
                continue;
            }
        }
        let Some((_, next)) = stack.pop() else { return false };
        at = next;
    }
}

/// The last child of `met`; the others go on the stack, last on top.
#[inline(always)]
fn last_child<const N: usize>(node: &Node, mut met: u32, stack: &mut Stack<(f32, Child), N>) -> Child {
    while met & (met - 1) != 0 {
        stack.push((0.0, node.child[met.trailing_zeros() as usize % WIDTH]));
        met &= met - 1;
    }
    node.child[met.trailing_zeros() as usize % WIDTH]
}

/// Visits all that may hold the closest hit, nearer boxes first.
#[inline(always)]
pub(crate) fn nearest_hit<S: Simd>(
    simd: S,
    nodes: &[Node],
    line: &FastLine,
    visit: &mut impl VisitNearest<S>,
) {
    let ray = BoxRay::new(simd, line);
    let meet = |node: &Node, tmax: f32| meet(simd, node, &ray, f32x8::splat(simd, tmax));
    go_on(simd, nodes, (meet, line.tmax), Child::node(0), &mut Stack::new(), visit);
}

/// As [`nearest_hit`] for a line that is already known to meet the children `met` of the root, which is not 0: it
/// enters them at `enter`. `meet` as for [`go_on`].
#[inline(always)]
pub(crate) fn nearest_hit_below<S: Simd>(
    simd: S,
    nodes: &[Node],
    line: (impl Fn(&Node, f32) -> (mask32x8<S>, f32x8<S>), f32),
    (met, enter): (u32, impl Fn(usize) -> f32),
    visit: &mut impl VisitNearest<S>,
) {
    let mut stack = Stack::new();
    let first = nearest_child(&nodes[0], met, enter, &mut stack);
    go_on(simd, nodes, line, first, &mut stack, visit);
}

/// From `at` through all that is on `stack`. `meet` says which boxes of a node a line meets before a t, and where it
/// enters them.
#[inline(always)]
fn go_on<S: Simd>(
    simd: S,
    nodes: &[Node],
    (meet, mut tmax): (impl Fn(&Node, f32) -> (mask32x8<S>, f32x8<S>), f32),
    mut at: Child,
    stack: &mut Stack<(f32, Child), STACK>,
    visit: &mut impl VisitNearest<S>,
) {
    loop {
        if at.is_leaf() {
            tmax = visit.nearest(simd, at.index());
        } else {
            let node = &nodes[at.index()];
            let (pass, enter) = meet(node, tmax);
            let met = pass.to_bitmask() as u32;
            if met != 0 {
                let enter = enter.to_array();
                at = nearest_child(node, met, |lane| enter[lane], stack);
                continue;
            }
        }
        loop {
            let Some((enter, child)) = stack.pop() else { return };
            if enter <= tmax * FAR_SLACK {
                at = child;
                break;
            }
        }
    }
}

/// The child of `met` that is entered first; the others go on the stack, nearest on top.
#[inline(always)]
fn nearest_child<const N: usize>(
    node: &Node,
    met: u32,
    enter: impl Fn(usize) -> f32,
    stack: &mut Stack<(f32, Child), N>,
) -> Child {
    let child = |met: u32| {
        let lane = met.trailing_zeros() as usize % WIDTH;
        (enter(lane), node.child[lane])
    };
    let mut first = child(met);
    let mut left = met & (met - 1);
    let bottom = stack.len;
    while left != 0 {
        let mut other = child(left);
        left &= left - 1;
        if other.0 < first.0 {
            (first, other) = (other, first);
        }
        insert(stack, bottom, other);
    }
    first.1
}

/// Keeps slots[first ..] sorted, nearest on top.
#[inline(always)]
fn insert<const N: usize>(stack: &mut Stack<(f32, Child), N>, first: usize, new: (f32, Child)) {
    stack.push(new);
    let mut i = stack.len - 1;
    while i > first {
        // SAFETY: first ≤ i − 1 < len, so the slot was written by `push` or by the line below.
        let below = unsafe { stack.slots[i - 1].assume_init() };
        if below.0 >= new.0 {
            break;
        }
        stack.slots[i] = MaybeUninit::new(below);
        stack.slots[i - 1] = MaybeUninit::new(new);
        i -= 1;
    }
}
