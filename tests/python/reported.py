"""What users reported of ray engines, as questions with known answers: what stops a ray, how often, what is inside.

Answers are closed forms, except for the grazed slivers, which are decided in rational numbers.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from solids import box, joined, lattice, meets, sphere

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
    """A wall in map coordinates; rays that start 2 mm and 1 cm in front of it, to it and away from it."""
    corners = np.array([[-4.0, -3, 0], [4, 3, 1], [4, 3, 7], [-4, -3, 6]]) + [528980.85, 183526.1, 40]
    normal = np.array([3, -4, 0]) / 5
    rng = np.random.default_rng(48)
    weights = rng.dirichlet([2, 2, 2], 200)
    points = weights @ corners[:3]
    heights = np.repeat([0.01, 0.002], 100)[:, None]
    origins = np.concatenate([points + heights * normal] * 2)
    directions = np.concatenate([np.tile(-normal, (200, 1)), np.tile(normal, (200, 1))])
    return Case(
        "trimesh #48",
        "2 mm and 1 cm before a wall in map coordinates: to it hits, away misses",
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


def leaving() -> Case:
    """Rays that start in a face, on an edge or at a corner of a cube's triangles and leave it."""
    ticks = np.arange(0, 9) / 8
    u, v = (x.reshape(-1) for x in np.meshgrid(ticks, ticks))
    origins = np.stack([u, v, np.ones(81)], axis=1)
    rng = np.random.default_rng(5430)
    directions = np.column_stack([rng.uniform(-1, 1, (81, 2)), rng.uniform(0.1, 1, 81)])
    return Case(
        "Open3D #5430, trimesh #331",
        "away from points of a cube's upper side: free",
        *box(1, 4),
        "blocked",
        origins,
        directions,
        np.zeros(81, bool),
    )


def from_within() -> Case:
    """Rays from a point in a flat, closed body through its corners and the middles of its edges: none leaves it."""
    vertices, faces = sphere(1.0, 24)
    rng = np.random.default_rng(1149)
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    vertices = vertices * [1, 0.3, 0.01] @ turn + [3.0, -2, 1]
    middles = (vertices[faces] + vertices[np.roll(faces, 1, axis=1)]).reshape(-1, 3) / 2
    aims = rng.permutation(np.concatenate([vertices, middles]))[:1000]
    start = np.array([3.0, -2, 1])
    return Case(
        "Mitsuba #1149, trimesh #1180",
        "out of a closed body through corners and edges",
        vertices,
        faces,
        "blocked",
        np.tile(start, (len(aims), 1)),
        aims - start,
        np.ones(len(aims), bool),
    )


def lens() -> Case:
    """Rays through points near the rim of a convex lens: each goes in once and out once."""
    vertices, faces = sphere(1.0, 12)
    vertices = vertices * [1, 1, 1e-3]
    rng = np.random.default_rng(457)
    angle, height = rng.uniform(0, 2 * np.pi, 400), rng.uniform(-0.1, 0.1, 400)
    out = np.sqrt(rng.uniform(0.5, 0.92, 400))
    aims = np.column_stack([out * np.cos(angle), out * np.sin(angle), 1e-3 * height])
    directions = rng.normal(size=(400, 3)) * [0.3, 0.3, 1]
    return Case(
        "trimesh #457, #242",
        "through the rim of a lens: in and out, two hits",
        vertices,
        faces,
        "count",
        aims - 4 * directions,
        directions,
        np.full(400, 2),
    )


def thin_wall() -> Case:
    """Points of a grid in a closed box whose walls are 2⁻²¹ of its size: they are not in the solid."""
    outer, inner = box(1, 3), box(1 - 2.0**-20, 3, 2.0**-21)
    points = lattice(0.09375, 0.90625, 0.0625)
    return Case(
        "trimesh #2534, #1097",
        "points of a grid in a box with thin walls: none is in them",
        *joined(outer, (inner[0], inner[1][:, ::-1])),
        "inside",
        points,
        points,
        np.zeros(len(points), bool),
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
    leaving,
    from_within,
    lens,
    cube_inside,
    ball_inside,
    hollow,
    thin_wall,
]
