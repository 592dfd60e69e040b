"""A box without a lid, empty or with a body on its floor, made of rectangles that can be covered with vertices."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

import antumbra as am
from antumbra.lecture.scenes import SceneOf

# Height of the walls; edge and height of the body.
TRAY, EDGE, HEIGHT = 0.25, 0.3, 0.35
# Vertices stand so far inside of their rectangle: what they see is the limit from inside.
_INSIDE = 1e-4


class Patch(NamedTuple):
    """A rectangle corner + s u + t v, s and t in [0, 1], with its front along u × v."""

    corner: NDArray[np.float64]
    u: NDArray[np.float64]
    v: NDArray[np.float64]

    @property
    def normal(self) -> NDArray[np.float64]:
        """Unit normal."""
        n = np.cross(self.u, self.v)
        return np.asarray(n / np.linalg.norm(n), np.float64)

    def vertices(self, cells: int) -> NDArray[np.float64]:
        """A grid (M, N, 3) of about `cells` cells per unit of length, at least one."""
        s, t = (
            np.linspace(0, 1, max(1, round(cells * float(np.linalg.norm(e)))) + 1) for e in (self.u, self.v)
        )
        s, t = (np.clip(x, _INSIDE, 1 - _INSIDE) for x in (s, t))
        return np.asarray(self.corner + s[:, None, None] * self.u + t[None, :, None] * self.v, np.float64)

    def places(self, points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """s and t of points (N, 3) in its plane."""
        from_corner = points - self.corner
        s, t = (from_corner @ e / (e @ e) for e in (self.u, self.v))
        return s, t

    def holds(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which points (N, 3) lie on it."""
        s, t = self.places(points)
        near = np.abs((points - self.corner) @ self.normal) < 1e-5
        return np.asarray(near & (np.abs(s - 0.5) <= 0.5 + 1e-6) & (np.abs(t - 0.5) <= 0.5 + 1e-6), np.bool_)


def _patch(corner: ArrayLike, u: ArrayLike, v: ArrayLike) -> Patch:
    return Patch(*(np.array(x, np.float64) for x in (corner, u, v)))


FLOOR = _patch((0, 0, 0), (0, 0, 1), (1, 0, 0))


def walls(height: float) -> list[Patch]:
    """The four walls of the box, fronts inside."""
    h = height
    return [
        _patch((0, 0, 0), (0, h, 0), (0, 0, 1)),
        _patch((1, 0, 0), (0, 0, 1), (0, h, 0)),
        _patch((0, 0, 0), (1, 0, 0), (0, h, 0)),
        _patch((0, 0, 1), (0, h, 0), (1, 0, 0)),
    ]


def body(x: float, z: float) -> list[Patch]:
    """The top and the sides of the body whose corner is (x, 0, z)."""
    a, h = EDGE, HEIGHT
    return [
        _patch((x, h, z), (0, 0, a), (a, 0, 0)),
        _patch((x, 0, z), (0, 0, a), (0, h, 0)),
        _patch((x + a, 0, z), (0, h, 0), (0, 0, a)),
        _patch((x, 0, z), (0, h, 0), (a, 0, 0)),
        _patch((x, 0, z + a), (a, 0, 0), (0, h, 0)),
    ]


def around(x: float, z: float) -> list[Patch]:
    """The floor beside the body, cut along its edges into eight rectangles."""
    xs, zs = (0.0, x, x + EDGE, 1.0), (0.0, z, z + EDGE, 1.0)
    return [
        _patch((xs[i], 0, zs[k]), (0, 0, zs[k + 1] - zs[k]), (xs[i + 1] - xs[i], 0, 0))
        for i in range(3)
        for k in range(3)
        if (i, k) != (1, 1)
    ]


@cache
def open_box(height: float, place: tuple[float, float] | None = None) -> SceneOf:
    """The box with walls of this height, and in it the body with its corner at this (x, z)."""

    def build() -> am.Scene:
        scene = am.Scene("open-box")
        for k, patch in enumerate([FLOOR, *walls(height), *(body(*place) if place else ())]):
            corners = [
                patch.corner,
                patch.corner + patch.u,
                patch.corner + patch.u + patch.v,
                patch.corner + patch.v,
            ]
            scene.add_mesh(np.array(corners), [[0, 1, 2], [0, 2, 3]], name=f"patch-{k}")
        return scene

    return build
