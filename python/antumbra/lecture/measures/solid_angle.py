"""The solid angle of a light in two ways: random directions that find it, and points of its area."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.points import UP
from antumbra.lecture.measures.ratio import ratio
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.scene import Scene

_GROUPS = 32
Array = NDArray[np.float64]


def directions(u: Array) -> Array:
    """Directions (N, 3) around +y, uniform in solid angle, of numbers (N, 2) in [0, 1): cos θ = u₀, φ = 2π u₁."""
    across, turn = np.sqrt(1 - u[:, 0] ** 2), 2 * np.pi * u[:, 1]
    return np.stack([across * np.cos(turn), u[:, 0], across * np.sin(turn)], 1)


def found(scene: Scene, point: Any, along: Array) -> NDArray[np.bool_]:
    """Which rays from a point meet something."""
    hit: NDArray[np.bool_] = np.isfinite(
        scene.closest_hit(np.tile(np.asarray(point, np.float64), (len(along), 1)), along).t
    )
    return hit


def pieces(scene: Scene, point: Any, u: Array) -> tuple[Array, Array]:
    """Points of the scene's light for numbers (N, 2): unit vectors to them, and cos θ′ A / r² [sr] of each.

    Their mean is Ω: the density of a uniform point of the area A is r² / (A cos θ′) in solid angle. 0 for points whose
    back is seen.
    """
    cube = np.concatenate([np.full((len(u), 1), 0.5), u], 1)
    drawn = scene.sample_light(
        np.tile(np.asarray(point, np.float64), (len(u), 1)), UP, cube, light_points="area"
    )
    seen = drawn.radiance[:, 0] > 0
    return drawn.direction.astype(np.float64), np.where(seen, 1 / drawn.pdf.astype(np.float64), 0.0)


def share_of_directions(scene: Scene, point: Any, count: int, seed: int) -> Quantity:
    """Share of `count` random directions of the hemisphere over a point that meet the light: Ω / 2π."""
    hits = found(scene, point, directions(np.random.default_rng((seed, 1)).random((count, 2))))
    return mean_of(hits.reshape(_GROUPS, -1).mean(1), "%", f"{count:,} directions")


def sum_over_area(scene: Scene, point: Any, count: int, seed: int) -> Quantity:
    """Ω [sr] as Σ cos θ′ dA / r² over `count` random points of the light."""
    _, omega = pieces(scene, point, np.random.default_rng((seed, 2)).random((count, 2)))
    return mean_of(omega.reshape(_GROUPS, -1).mean(1), "sr", f"{count:,} points")


def both_ways(scene: Scene, exact: float, count: int, seed: int, name: str) -> dict[str, Quantity]:
    """Ω of the light from the origin in both ways, and the sum over its area against the `exact` Ω.

    share-`name`: of the directions; directions-`name`: that, times 2π; area-`name`; over-`name`: that over the exact.
    """
    share = share_of_directions(scene, np.zeros(3), count, seed)
    area = sum_over_area(scene, np.zeros(3), count, seed)
    omega = Quantity(2 * math.pi * share.value, 2 * math.pi * share.error, "sr")
    return {
        f"share-{name}": share,
        f"directions-{name}": omega,
        f"area-{name}": area,
        f"over-{name}": ratio(area, Quantity(exact)),
    }


def sum_over_patches(scene: Scene, point: Any, side: int) -> float:
    """Ω [sr] as Σ cos θ′ dA / r² over the middles of side² equal patches."""
    _, omega = pieces(scene, point, patches(side))
    return float(omega.mean())


def patches(side: int) -> Array:
    """Middles of side² cells of the unit square, (side², 2)."""
    middles = (np.arange(side) + 0.5) / side
    return np.stack(np.meshgrid(middles, middles), -1).reshape(-1, 2)


def of_rectangle(corner: tuple[float, float], size: tuple[float, float], height: float) -> float:
    """Ω of a level rectangle from `corner` (x, z) over the origin: the signed sum of atan2(ab, h √(a² + b² + h²))."""

    def part(a: float, b: float) -> float:
        return math.atan2(a * b, height * math.sqrt(a * a + b * b + height * height))

    (x, z), (u, v) = corner, size
    return part(x + u, z + v) - part(x, z + v) - part(x + u, z) + part(x, z)


def of_triangle(a: Array, b: Array, c: Array) -> float:
    """Ω of a triangle seen from the origin (Van Oosterom and Strackee 1983)."""
    la, lb, lc = (float(np.linalg.norm(v)) for v in (a, b, c))
    under = la * lb * lc + float(a @ b) * lc + float(a @ c) * lb + float(b @ c) * la
    return 2 * math.atan2(abs(float(a @ np.cross(b, c))), under)
