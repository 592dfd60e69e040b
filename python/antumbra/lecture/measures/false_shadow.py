"""The shadow that rays throw which do not end at the light."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.compare import share_changed
from antumbra.lecture.measures.points import UP
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.scene import Scene


def width_of_false_shadow(run: Run, scene: Scene, height: float, count: int) -> Quantity:
    """Half of its width [m] on the plane at `height`: what is lost along a line of 1 m across the cylinder.

    8 replicates of 16 shadow rays from each of `count` points.
    """
    z = (np.arange(count) + 0.5) / count
    line = np.stack([0 * z, 0 * z + height, z], 1)

    def light(test: str, seed: int) -> NDArray[np.float64]:
        found = scene.irradiance(line, UP, shadow_rays=16, light="light", distance_test=test, seed=seed)
        return np.asarray(found, np.float64)[:, 0]

    widths = [np.mean(1 - light("off", run.seeded(n)) / light("on", run.seeded(n))) for n in range(8)]
    return mean_of(widths, "m", f"8 replicates, {16 * count:,} shadow rays each")


def wrong_pixels(run: Run, height: float, exposed: float) -> Quantity:
    """Share of the pixels that differ with the plane at `height`, exposed as the picture of the plane at `exposed`."""
    return share_changed(run, f"off{height}", f"on{height}", white=run.white(f"on{exposed}"))
