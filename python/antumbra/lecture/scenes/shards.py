"""Triangles that hang over a point: each of them takes some of its directions."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray

import antumbra as am

COUNT = 14


def shards() -> NDArray[np.float64]:
    """Corners of the triangles (COUNT, 3, 3) over the point 0, y up: the middle of each lies 1 to 3 m away."""
    rng = np.random.default_rng(3)
    height, turn = rng.uniform(0.25, 0.95, COUNT), 2.4 * np.arange(COUNT)
    flat = np.sqrt(1 - height**2)
    middle = np.stack([flat * np.cos(turn), height, flat * np.sin(turn)], 1) * rng.uniform(1, 3, (COUNT, 1))
    size = 0.8 * np.linalg.norm(middle, axis=1)[:, None, None]
    corners: NDArray[np.float64] = middle[:, None] + size * rng.uniform(-1, 1, (COUNT, 3, 3))
    corners[..., 1] = np.maximum(corners[..., 1], 0.05)
    return corners


@cache
def some_shards(first: int, last: int) -> Callable[[], am.Scene]:
    """The triangles from `first` up to, but without, `last`."""

    def build() -> am.Scene:
        scene = am.Scene("shards")
        corners = shards()[first:last]
        scene.add_mesh(corners.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3))
        return scene

    return build
