"""What users reported of ray engines, as questions with known answers: what stops a ray, how often, what is inside.

Answers are closed forms, except for the grazed slivers, which are decided in rational numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np

Array = Any


class Case(NamedTuple):
    """A mesh, a question and its answer."""

    # Where it was reported, and what goes wrong.
    report: str
    what: str
    vertices: Array
    faces: Array
    # "blocked": (N,) bool of rays; "count": (N,) places that a ray hits; "inside": (N,) bool of points.
    question: str
    origins: Array
    directions: Array
    answer: Array


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


def lattice(low: float, high: float, step: float) -> Array:
    """All points of a grid, (N, 3)."""
    ticks = np.arange(low, high + step / 2, step)
    return np.stack(np.meshgrid(ticks, ticks, ticks, indexing="ij"), axis=-1).reshape(-1, 3)


def through_corners() -> Case:
    """Rays from the middle of a cube through points of a grid, on edges and corners of its triangles."""
    directions = lattice(-30, 30, 10)
    directions = directions[np.abs(directions).max(axis=1) == 30]
    return Case(
        "trimesh #1496, #2317",
        "from inside through edges and corners of a cube's triangles: one hit each",
        *box(40, 4, -20),
        "count",
        np.zeros_like(directions),
        directions,
        np.ones(len(directions), int),
    )


def along_the_grid() -> Case:
    """Parallel rays through the corners of a cube's triangles, in and out again."""
    u, v = (x.reshape(-1) for x in np.meshgrid(np.arange(1, 8) / 8, np.arange(1, 8) / 8))
    origins = np.stack([u, v, np.full(49, -1.0)], axis=1)
    return Case(
        "Embree #188, libigl #2026",
        "through a cube along a grid of corners: in and out, two hits",
        *box(1, 8),
        "count",
        origins,
        np.tile([0.0, 0, 1], (49, 1)),
        np.full(49, 2),
    )


def rims() -> Case:
    """Rays that go down the upright edges of small blocks, which belong to them."""
    blocks = [(v / 64 + np.array([2.0 * k, 0, 0]) / 64, f) for k in range(8) for v, f in [box(1, 1, 17)]]
    x = (17 + np.arange(16)) / 64
    origins = np.stack([x, np.full(16, 17.5 / 64), np.ones(16)], axis=1)
    return Case(
        "trimesh #2324",
        "down along the rims of blocks of 1/64",
        *joined(*blocks),
        "blocked",
        origins,
        np.tile([0.0, 0, -1], (16, 1)),
        np.ones(16, bool),
    )


def nested() -> Case:
    """Prisms one in another, sizes 1, 2, 4, …, and rays from their axis that meet an edge of each."""
    n = 12
    angle = 2 * np.pi * np.arange(n) / n
    rim = np.stack([np.cos(angle), np.sin(angle)], axis=1).astype(np.float32).astype(float)
    ring = np.concatenate([np.column_stack([rim, np.full(n, z)]) for z in (-1.0, 1.0)])
    i, j = np.arange(n), (np.arange(n) + 1) % n
    walls = np.concatenate([np.stack([i, j, j + n], axis=1), np.stack([i, j + n, i + n], axis=1)])
    meshes = [(ring * 2.0**k, walls) for k in range(8)]
    heights = np.arange(-3, 4) / 4
    directions = np.concatenate([np.column_stack([rim, np.full(n, h)]) for h in heights])
    return Case(
        "Embree #181",
        "through the edges of eight prisms one in another",
        np.concatenate([v for v, _ in meshes]),
        np.concatenate([f + 2 * n * k for k, (_, f) in enumerate(meshes)]),
        "count",
        np.zeros_like(directions),
        directions,
        np.full(len(directions), 8),
    )


def far_map() -> Case:
    """A tilted square in map coordinates; rays that start a little above it, down to it and away from it."""
    corners = np.array([[-4.0, -3, 0], [4, -3, 1], [4, 3, 1], [-4, 3, 0]]) + [528980.85, 183526.1, 40]
    normal = np.array([-1, 0, 8]) / np.sqrt(65)
    rng = np.random.default_rng(48)
    weights = rng.dirichlet([2, 2, 2], 200)
    points = weights @ corners[:3]
    heights = np.repeat([0.01, 0.002], 100)[:, None]
    origins = np.concatenate([points + heights * normal] * 2)
    directions = np.concatenate([np.tile(-normal, (200, 1)), np.tile(normal, (200, 1))])
    return Case(
        "trimesh #48",
        "2 mm and 1 cm above a roof in map coordinates: down hits, away misses",
        corners,
        np.array([[0, 1, 2], [0, 2, 3]]),
        "blocked",
        origins,
        directions,
        np.repeat([True, False], 200),
    )


def far_start() -> Case:
    """Rays that start 10⁸ sizes away and aim at points inside."""
    rng = np.random.default_rng(5587)
    aims = rng.uniform(-0.25, 0.25, (200, 3))
    out = rng.normal(size=(200, 3))
    out /= np.linalg.norm(out, axis=1)[:, None]
    return Case(
        "PyVista #5587",
        "from 10⁸ sizes away into a ball",
        *sphere(0.5),
        "blocked",
        aims + 1e8 * out,
        -out,
        np.ones(200, bool),
    )


def thin_sheets() -> Case:
    """A closed sheet whose two sides are 2⁻²⁰ of its size apart."""
    vertices, faces = box(1, 3)
    vertices = vertices * [1, 1, 2.0**-20]
    u, v = (x.reshape(-1) for x in np.meshgrid(np.arange(1, 10) / 10, np.arange(1, 10) / 10))
    origins = np.stack([u, v, np.ones(81)], axis=1)
    return Case(
        "trimesh #457, #242",
        "through a closed sheet 10⁻⁶ of its size thick: two hits",
        vertices,
        faces,
        "count",
        origins,
        np.tile([0.0, 0, -1], (81, 1)),
        np.full(81, 2),
    )


def huge() -> Case:
    """A cube of 10⁹ units."""
    rng = np.random.default_rng(2504)
    origins = np.column_stack([rng.uniform(0.1, 0.9, (100, 2)) * 1e9, np.full(100, -1e9)])
    return Case(
        "trimesh #2504",
        "through a cube of 10⁹ units: two hits, not the same one again and again",
        *box(1e9, 2),
        "count",
        origins,
        np.tile([0.0, 0, 1], (100, 1)),
        np.full(100, 2),
    )


def crate() -> Case:
    """The box and the ray of the report, and the rays through the diagonals and corners of its sides."""
    vertices, faces = box(1, 1)
    rays = [[5, 2], [5, 5], [2, 2], [3, 7], [8, 8], [1, 9]]
    return Case(
        "PyVista #4842, #5372",
        "up through a crate of 10 × 10 × 6, on diagonals, too: two hits",
        vertices * [10, 10, 6],
        faces,
        "count",
        np.array([[x, y, -10.0] for x, y in rays]),
        np.tile([0.0, 0, 1], (len(rays), 1)),
        np.full(len(rays), 2),
    )


def along_a_step() -> Case:
    """Rays that slide on the low half of a step and run into the wall of the high one, at its foot."""
    low = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 0, 1], [1, 0, 1], [1, 0, 2], [2, 0, 2], [2, 0, 1]]
    front = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 7], [1, 7, 4], [4, 7, 6], [4, 6, 5]])
    vertices = np.concatenate([np.array(low, float), np.array(low, float) + [0, 4, 0]])
    rim = [0, 1, 2, 7, 6, 5, 4, 3]
    wall = [[a, a + 8, b + 8] for a, b in zip(rim, rim[1:] + rim[:1], strict=True)]
    wall += [[a, b + 8, b] for a, b in zip(rim, rim[1:] + rim[:1], strict=True)]
    y = np.arange(1, 32) / 8
    origins = np.stack([np.full(31, -1.0), y, np.ones(31)], axis=1)
    return Case(
        "Embree #423, #188",
        "along the top of a step into the foot of the next",
        vertices,
        np.concatenate([front, front[:, ::-1] + 8, wall]),
        "blocked",
        origins,
        np.tile([1.0, 0, 0], (31, 1)),
        np.ones(31, bool),
    )


def grazed_slivers() -> Case:
    """Thin triangles, each passed by one ray at a small angle to its plane, near its border."""
    rng = np.random.default_rng(387)
    n = 150
    corners = rng.uniform(-1, 1, (n, 3, 3)) * [8, 0.5, 0.5]
    corners[:, 2] = corners[:, 0] + (corners[:, 1] - corners[:, 0]) * 0.5 + rng.normal(size=(n, 3)) * 1e-3
    corners[..., 1] += 16 * np.arange(n)[:, None]
    corners = corners.astype(np.float32).astype(float)
    weights = rng.dirichlet([1, 1, 0.05], n) + rng.normal(size=(n, 3)) * 1e-5
    aims = np.einsum("nk,nkj->nj", weights / weights.sum(axis=1)[:, None], corners)
    along = (corners[:, 1] - corners[:, 0]) + rng.normal(size=(n, 3)) * 1e-3
    along *= np.sign(along[:, :1]) / np.abs(along[:, :1])
    origins = (aims - 16 * along).astype(np.float32).astype(float)
    directions = along.astype(np.float32).astype(float)
    answer = [meets(o, d, c) is not None for o, d, c in zip(origins, directions, corners, strict=True)]
    return Case(
        "Embree #387",
        "past thin triangles at a small angle",
        corners.reshape(-1, 3),
        np.arange(3 * n).reshape(n, 3),
        "blocked",
        origins,
        directions,
        np.array(answer),
    )


def cube_inside() -> Case:
    """Points of a grid around a cube: rays from them run along its edges and diagonals."""
    points = lattice(-1, 2, 0.25)
    distance = np.abs(points - 0.5).max(axis=1)
    points, distance = points[distance != 0.5], distance[distance != 0.5]
    return Case(
        "Open3D #5105, trimesh #85",
        "points of a grid around a cube",
        *box(1, 2),
        "inside",
        points,
        points,
        distance < 0.5,
    )


def ball_inside() -> Case:
    """Points of a grid around a ball, those nearer to its surface than its facets left out."""
    points = lattice(-0.875, 0.875, 0.0625)
    distance = np.linalg.norm(points, axis=1)
    clear = (distance < 0.78) | (distance > 0.8)
    return Case(
        "Open3D #5669, trimesh #242",
        "points of a grid around a ball",
        *sphere(0.8),
        "inside",
        points[clear],
        points[clear],
        distance[clear] < 0.79,
    )


def hollow() -> Case:
    """Points of a grid in a cube with a hollow cube in it."""
    vertices, faces = box(1, 4, 0.0)
    inner, turned = box(0.5, 2, 0.25)
    points = lattice(0.0625, 0.9375, 0.0625)
    distance = np.abs(points - 0.5).max(axis=1)
    points, distance = points[distance != 0.25], distance[distance != 0.25]
    return Case(
        "trimesh #2534, #1097",
        "points of a grid in a cube with a hollow",
        *joined((vertices, faces), (inner, turned[:, ::-1])),
        "inside",
        points,
        points,
        distance > 0.25,
    )


CASES: list[Callable[[], Case]] = [
    through_corners,
    along_the_grid,
    rims,
    nested,
    far_map,
    far_start,
    thin_sheets,
    huge,
    crate,
    along_a_step,
    grazed_slivers,
    cube_inside,
    ball_inside,
    hollow,
]


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
