"""Whether points lie inside a closed mesh: exact for the numbers as given, in double precision."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra._boxes import Boxes
from antumbra._crossings import pairs_of
from antumbra._law import FLOOR, TEN_W, Exact, Pairs, Vectors, minus, plane, sign, vectors

Array = NDArray[Any]


def inside(boxes: Boxes, corners: Array, points: Array, closed: bool) -> Array:
    """(N,) bool: in the solid that the triangles bound, its surface included.

    A point is in it if a ray from it crosses the surface an odd number of times. Rays go along +z. Where one meets an
    edge or a corner, the point is thought to be moved by (ε, ε²), ε > 0 smaller than any number: then each crossing
    belongs to one triangle. Of a mesh with open edges the answer depends on the direction: the majority of ±x, ±y and
    ±z says it, three of six is outside.
    """
    found = np.zeros(len(points), bool)
    asked = np.flatnonzero(np.all((points >= boxes.low) & (points <= boxes.high), axis=1))
    within = points[asked]
    odd, surface = _parity(boxes, corners, within, axis=2, side=1)
    if not closed:
        votes = odd.astype(int)
        for axis, side in ((2, -1), (0, 1), (0, -1), (1, 1), (1, -1)):
            votes += _parity(boxes, corners, within, axis, side)[0]
        odd = votes > 3
    found[asked] = odd | surface
    return found


def _parity(boxes: Boxes, corners: Array, points: Array, axis: int, side: int) -> tuple[Array, Array]:
    """Whether a ray from each point along ± an axis crosses an odd number of times; whether it lies on the surface."""
    direction = np.zeros(3)
    direction[axis] = side
    along = np.broadcast_to(direction, points.shape)
    count, surface = np.zeros(len(points), np.int64), np.zeros(len(points), bool)
    for rays, faces in boxes.near(points, along):
        pairs = _turned(pairs_of(points, along, corners, rays, faces), axis)
        crosses, on = _crosses(pairs, side)
        count += np.bincount(rays[crosses], minlength=len(points))
        surface[rays[on]] = True
    return count % 2 == 1, surface


def _turned(pairs: Pairs, axis: int) -> Pairs:
    """Axes renamed in turn, so that the ray goes along the last."""
    order = ((axis + 1) % 3, (axis + 2) % 3, axis)
    o, d, a, b, c = ((v[order[0]], v[order[1]], v[order[2]]) for v in pairs)
    return Pairs(o, d, a, b, c)


def _crosses(pairs: Pairs, side: int) -> tuple[Array, Array]:
    """Which rays along ± z cross their triangle, and which start on it."""
    o, a, b, c = pairs.o, pairs.a, pairs.b, pairs.c
    turns, sure = zip(*(_turn(o, p, q) for p, q in ((a, b), (b, c), (c, a))), strict=True)
    above, below = (
        np.all([s & (side_ * w > 0) for w, s in zip(turns, sure, strict=True)], axis=0) for side_ in (1, -1)
    )
    some_above, some_below = (
        np.any([s & (side_ * w > 0) for w, s in zip(turns, sure, strict=True)], axis=0) for side_ in (1, -1)
    )
    v, room = plane(pairs)
    height = np.where(above, 1, -1) * side * v
    clear = (above | below) & (np.abs(v) > room)
    crosses, on = clear & (height > 0), np.zeros(len(v), bool)
    open_ = np.flatnonzero(~clear & ~(some_above & some_below))
    if len(open_):
        crosses[open_], on[open_] = _exactly(pairs.take(open_), side)
    return crosses, on


def _turn(o: Vectors, p: Vectors, q: Vectors) -> tuple[Array, Array]:
    """On which side of p → q the point o is, seen along z: the number, and whether its sign is sure."""
    x, y, u, v = p[0] - o[0], p[1] - o[1], q[0] - o[0], q[1] - o[1]
    left, right = x * v, y * u
    return left - right, np.abs(left - right) > TEN_W * (np.abs(left) + np.abs(right)) + FLOOR


def _exactly(pairs: Pairs, side: int) -> tuple[Array, Array]:
    """The same in whole numbers, with the rule for edges and corners."""
    count = len(pairs.o[0])
    ups = np.zeros(count), np.zeros(count), np.ones(count)
    exact = Exact(pairs._replace(d=ups))
    edges = (pairs.a, pairs.b), (pairs.b, pairs.c), (pairs.c, pairs.a)
    turns = [_moved(sign(w), p, q) for w, (p, q) in zip(exact.w, edges, strict=True)]
    one_side = (turns[0] != 0) & (turns[0] == turns[1]) & (turns[1] == turns[2])
    height = sign(exact.v)
    crosses = one_side & (height * turns[0] * side > 0)
    on = (height == 0) & (sign(exact.det) != 0) & exact.encloses()
    # Upright triangles have no area from above: whether a point lies on one is seen along x or y.
    for axis in (0, 1):
        upright = np.flatnonzero((sign(exact.det) == 0) & (height == 0) & ~on)
        if len(upright):
            other = Exact(
                _turned(pairs.take(upright), axis)._replace(d=vectors(np.stack(ups, axis=1)[upright]))
            )
            on[upright] = (sign(other.det) != 0) & other.encloses()
    return crosses, on


def _moved(turn: Array, p: Vectors, q: Vectors) -> Array:
    """The sign of W for the point moved by (ε, ε²): W + ε (p_y − q_y) + ε² (q_x − p_x), the first that is not 0."""
    step = minus(p, q)
    first = np.where(turn != 0, turn, sign(step[1]))
    return np.where(first != 0, first, -sign(step[0]))


def is_closed(vertices: Array, faces: Array) -> bool:
    """Every edge belongs to an even number of faces, by index or at least by place."""
    if _even_edges(faces):
        return True
    # +0: the place −0 is the place 0.
    _, same = np.unique(vertices + 0.0, axis=0, return_inverse=True)
    return _even_edges(same.reshape(-1)[faces])


def _even_edges(faces: Array) -> bool:
    ends = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1).astype(
        np.int64
    )
    _, counts = np.unique(ends[:, 0] * (faces.max() + 1) + ends[:, 1], return_counts=True)
    return bool(np.all(counts % 2 == 0))
