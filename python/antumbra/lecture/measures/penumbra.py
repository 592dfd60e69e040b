"""How wide a penumbra is, by the shadow rays to the two ends of a light."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.run import Run
from antumbra.scene import Scene

Place = tuple[float, float, float]


def penumbra_widths(
    run: Run, scene: Scene, line: tuple[Place, Place], ends: Sequence[Place], count: int, stream: int
) -> NDArray[np.float64]:
    """Length of the part of `line` that sees one of the `ends` of a light and not the other, (16,).

    16 replicates of `count` evenly spaced points, each with a random offset; `stream` gives them numbers of their own.
    """
    a, b = np.asarray(line, np.float64)
    step = float(np.linalg.norm(b - a)) / count
    widths = []
    for replicate in range(16):
        offset = np.random.default_rng((run.seeded(replicate), stream)).random()
        points = a + (b - a) * ((np.arange(count) + offset) / count)[:, None]
        blocked = [scene.occluded(points, np.array(end)) for end in ends]
        widths.append(step * np.count_nonzero(blocked[0] != blocked[1]))
    run.rays += 32 * count
    return np.array(widths)
