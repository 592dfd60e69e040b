"""Every hit of every ray, in order, each place once; and whether points lie inside. Exact, on whole arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra._boxes import Boxes
from antumbra._law import NEAR, Exact, Pairs, hits, vectors

Array = NDArray[Any]


def pairs_of(origins: Array, directions: Array, corners: Array, rays: Array, faces: Array) -> Pairs:
    """Rays and triangles by their numbers."""
    a, b, c = (vectors(corners[:, k][faces]) for k in range(3))
    return Pairs(vectors(origins[rays]), vectors(directions[rays]), a, b, c)


def crossings(boxes: Boxes, corners: Array, origins: Array, directions: Array) -> tuple[Array, Array, Array]:
    """Ray, face and t of every hit, sorted by ray and distance. `origins`, `directions` in the precision of the boxes.

    Of the faces that a ray meets at the same place (their t are equal as real numbers: at an edge, at a corner, where
    faces lie in one another) the one with the lowest number is named.
    """
    found: list[tuple[Array, Array, Array]] = []
    near = boxes.near(origins, directions)
    origins, directions = origins.astype(np.float64), directions.astype(np.float64)
    for rays, faces in near:
        met, t = hits(pairs_of(origins, directions, corners, rays, faces))
        found.append((rays[met], faces[met], t))
    if not found:
        none = np.zeros(0, np.int64)
        return none, none, np.zeros(0)
    rays, faces, t = (np.concatenate(part) for part in zip(*found, strict=True))
    order = np.lexsort((faces, t, rays))
    rays, faces, t = rays[order], faces[order], t[order]
    kept, moved = _places(origins, directions, corners, rays, faces, t)
    return rays[moved][kept], faces[moved][kept], t[moved][kept]


def _places(
    origins: Array, directions: Array, corners: Array, rays: Array, faces: Array, t: Array
) -> tuple[Array, Array]:
    """Which hits are the first of their place, and the order in which they lie: hits that are close, exactly."""
    order, kept = np.arange(len(rays)), np.ones(len(rays), bool)
    follows = np.zeros(len(rays), bool)
    follows[1:] = (rays[1:] == rays[:-1]) & (t[1:] - t[:-1] <= NEAR * t[1:])
    close = np.flatnonzero(follows | np.append(follows[1:], False))
    if not len(close):
        return kept, order
    run = np.cumsum(~follows)[close]
    key = Exact(pairs_of(origins, directions, corners, rays[close], faces[close])).order()
    # One number that sorts by run, then by distance; faces come in the order of their numbers beforehand.
    whole = np.left_shift(run.astype(object), max(int(k).bit_length() for k in key)) + key
    by_face = np.argsort(faces[close], kind="stable")
    sorted_ = by_face[np.argsort(whole[by_face], kind="stable")]
    order[close] = close[sorted_]
    whole = whole[sorted_]
    kept[close[1:]] = whole[1:] != whole[:-1]
    return kept, order
