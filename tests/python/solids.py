"""Closed meshes for tests, grids of points, and the law of visibility in rational numbers."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

Array = Any


def box(size: float = 1.0, cells: int = 1, low: float = 0.0) -> tuple[Array, Array]:
    """The surface of a cube from `low` to `low + size`, each side cut into cells² squares of two triangles."""
    ticks = low + size * np.arange(cells + 1) / cells
    sides = []
    for axis in range(3):
        for end in (0, cells):
            u, v = np.meshgrid(ticks, ticks, indexing="ij")
            side = np.empty((cells + 1, cells + 1, 3))
            side[..., axis], side[..., (axis + 1) % 3], side[..., (axis + 2) % 3] = ticks[end], u, v
            sides.append((side.reshape(-1, 3), _squares(cells) if end else _squares(cells)[:, ::-1]))
    return joined(*sides)


def _squares(cells: int) -> Array:
    i, j = np.meshgrid(np.arange(cells), np.arange(cells), indexing="ij")
    a = (i * (cells + 1) + j).reshape(-1)
    b, c, d = a + cells + 1, a + cells + 2, a + 1
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def joined(*meshes: tuple[Array, Array]) -> tuple[Array, Array]:
    """Several meshes as one; corners at the same place become one corner."""
    starts = np.cumsum([0] + [len(v) for v, _ in meshes])
    vertices, faces = (
        np.concatenate([v for v, _ in meshes]),
        [f + s for (_, f), s in zip(meshes, starts, strict=False)],
    )
    kept, same = np.unique(vertices, axis=0, return_inverse=True)
    return kept, same.reshape(-1)[np.concatenate(faces)]


def sphere(radius: float, rings: int = 20) -> tuple[Array, Array]:
    """A sphere of latitudes and longitudes, 2 · rings around."""
    theta = np.pi * np.arange(1, rings)[:, None] / rings
    phi = np.pi * np.arange(2 * rings)[None] / rings
    round_ = np.stack(
        np.broadcast_arrays(np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)), 2
    )
    vertices = radius * np.concatenate([round_.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    i, j = (x.reshape(-1) for x in np.meshgrid(np.arange(rings - 2), np.arange(2 * rings), indexing="ij"))
    n, j1, ring = 2 * rings, (j + 1) % (2 * rings), np.arange(2 * rings)
    a, b, c, d = i * n + j, (i + 1) * n + j, (i + 1) * n + j1, i * n + j1
    top, bottom, ahead = len(vertices) - 2, len(vertices) - 1, (ring + 1) % n
    last = (rings - 2) * n
    caps = [
        np.stack([np.full(n, top), ring, ahead], axis=1),
        np.stack([np.full(n, bottom), last + ahead, last + ring], axis=1),
    ]
    return vertices, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1), *caps])


def torus(major: float, minor: float, around: int = 32) -> tuple[Array, Array]:
    """A ring about the z axis."""
    angle = 2 * np.pi * np.arange(around) / around
    u, v = (x.reshape(-1) for x in np.meshgrid(angle, angle, indexing="ij"))
    out = major + minor * np.cos(v)
    i, j = (x.reshape(-1) for x in np.meshgrid(np.arange(around), np.arange(around), indexing="ij"))
    i1, j1 = (i + 1) % around, (j + 1) % around
    a, b, c, d = i * around + j, i1 * around + j, i1 * around + j1, i * around + j1
    faces = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return np.stack([out * np.cos(u), out * np.sin(u), minor * np.sin(v)], axis=1), faces


def normals_of_torus(points: Array, major: float) -> Array:
    """Unit normals of a ring at its points."""
    middle = points * [1, 1, 0]
    middle *= major / np.linalg.norm(middle, axis=1)[:, None]
    away = points - middle
    return away / np.linalg.norm(away, axis=1)[:, None]


def lattice(low: float, high: float, step: float) -> Array:
    """All points of a grid, (N, 3)."""
    ticks = np.arange(low, high + step / 2, step)
    return np.stack(np.meshgrid(ticks, ticks, ticks, indexing="ij"), axis=-1).reshape(-1, 3)


def meets(origin: Array, direction: Array, corners: Array) -> Fraction | None:
    """t where a ray meets a closed triangle that is not parallel to it, in rational numbers; None if it does not."""
    o, d = ([Fraction(float(x)) for x in v] for v in (origin, direction))
    a, b, c = ([Fraction(float(x)) - y for x, y in zip(corner, o, strict=True)] for corner in corners)
    w = [_dot(d, _cross(p, q)) for p, q in ((a, b), (b, c), (c, a))]
    det, v = sum(w), _dot(a, _cross(b, c))
    if det == 0 or any(side * det < 0 for side in w) or v * det <= 0:
        return None
    return v / det


def _cross(p: list[Fraction], q: list[Fraction]) -> list[Fraction]:
    return [p[i] * q[j] - p[j] * q[i] for i, j in ((1, 2), (2, 0), (0, 1))]


def _dot(p: list[Fraction], q: list[Fraction]) -> Fraction:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
