"""Densities on a light: where they put points, and what their pictures are worth."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.ratio import excess, ratio
from antumbra.lecture.measures.replicates import mean_of, of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.scene import Scene
from antumbra.study import statistics


def against(run: Run, names: Collection[str], other: str, strip: str) -> dict[str, Quantity]:
    """The mean of each variant less that of `other`, in % of it; noise-…: its variance over that of the first.

    missing: what the light of the variant `strip` would take away; gap: of the last variant, what is missing
    less that, in % of `other`. All are over the same truth, so the gap is (mean + strip − truth) / truth as one.
    """
    truth, left_out = (mean_of(luminances(run, key).mean((1, 2))) for key in (other, strip))
    means = {name: mean_of(luminances(run, name).mean((1, 2))) for name in names}
    noise = {name: of_interval(statistics.variance(luminances(run, name))) for name in names}
    uniform, missing = noise[next(iter(names))], ratio(left_out, truth)
    return {
        **{name: excess(ratio(mean, truth)) for name, mean in means.items()},
        **{f"noise-{name}": ratio(noise[name], uniform) for name in names},
        "missing": Quantity(-missing.value, missing.error, "%"),
        "gap": _gap(list(means.values())[-1], left_out, truth),
    }


def _gap(mean: Quantity, left_out: Quantity, truth: Quantity) -> Quantity:
    """(mean + left out) / truth − 1 of three independent means."""
    both = Quantity(mean.value + left_out.value, math.hypot(mean.error, left_out.error))
    return excess(ratio(both, truth))


def drawn(
    scene: Scene, light: Sequence[NDArray[np.float64]], distance: float, how: str
) -> NDArray[np.float64]:
    """The density on a `light` (corner and two sides), (16, 16), uniform = 1, for a point in front of it.

    The point lies at a `distance` [m] from the middle of the last quarter. n of N points that are drawn in a cell say
    that ∫ p dA over it is n/N, and that its area is Σ 1/(N p): the mean of p is n / Σ 1/p.
    """
    corner, u, v = light
    normal = np.cross(u, v)
    point = corner + 0.75 * (u + v) + distance * normal / np.linalg.norm(normal)
    grid = (np.stack(np.meshgrid(*[np.arange(256)] * 2), -1).reshape(-1, 2) + 0.5) / 256
    numbers = np.column_stack([np.full(len(grid), 0.1), grid])
    found = scene.sample_light(np.tile(point, (len(grid), 1)), (0.0, 1.0, 0.0), numbers, light_points=how)
    down, right = ((found.target - corner) @ side / (side @ side) for side in (v, u))
    cells: dict[str, Any] = {"bins": 16, "range": [[0, 1], [0, 1]]}
    count = np.histogram2d(down, right, **cells)[0]
    area = np.histogram2d(
        down, right, weights=1.0 / (found.pdf_area * float(np.linalg.norm(normal))), **cells
    )[0]
    density: NDArray[np.float64] = np.divide(count, area, out=np.zeros_like(count), where=area > 0)
    return density
