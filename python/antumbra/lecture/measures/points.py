"""One point asked many times: its irradiance and what it sees of a light."""

from __future__ import annotations

from typing import Any

import numpy as np

from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.scene import Scene

UP = (0.0, 1.0, 0.0)


def irradiance_at(
    scene: Scene, point: Any, rays: int, seed: int, normal: Any = UP, **options: Any
) -> Quantity:
    """Irradiance [W/m²] at a point by 64 independent replicates of `rays` / 64 shadow rays each."""
    points = np.repeat(np.atleast_2d(np.asarray(point, np.float64)), 64, 0)
    found = scene.irradiance(points, normal, shadow_rays=max(1, rays // 64), seed=seed, **options)
    return mean_of(np.asarray(found)[:, 0], note=f"{rays:,} shadow rays")


def fraction_at(scene: Scene, point: Any, rays: int, seed: int, normal: Any = UP, **options: Any) -> Quantity:
    """Visible fraction of a light from a point, in the same way."""
    points = np.repeat(np.atleast_2d(np.asarray(point, np.float64)), 64, 0)
    found = scene.visible_fraction(points, normal, rays=max(1, rays // 64), seed=seed, **options)
    return mean_of(np.asarray(found), note=f"{rays:,} shadow rays")
