"""Which quarters of a pixel meet which quarters of a light: the samples of one pixel, as `Scene.explain` lists them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.geometry import projector
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.three_pillars import CORNER, VIEW, U, V, three_pillars
from antumbra.lecture.variant import Pick

# A pixel of a coarse picture, at the edge of a shadow; a set of samples, of the four that the renderer makes.
COARSE: dict[str, Any] = VIEW | {"size": (32, 22)}
PIXEL, SET = (18, 18), 16
ONE = COARSE | {
    "estimator": "area", "light_points": "area", "filter": "box", "viewing_rays": 4 * SET, "shadow_rays": 1,
}  # fmt: skip
# How pixel and light point are drawn, and what theory says of the 16 pairs of quarters: of 16 tries each with 1/16, or
# of four rounds in which each quarter of the pixel meets one of the light at random (by hashes: 10.8).
WAYS: dict[str, dict[str, str]] = {
    "random": {"sampler": "random"}, "two": {"sampler": "owen", "pairing": "2d"}, "one": {"sampler": "owen"},
}  # fmt: skip
EXPECTED = {"random": 16 * (1 - (15 / 16) ** 16), "two": 16 * (1 - (3 / 4) ** 4), "one": 16.0}
_SEEDS = Pick(400, 4000)
_FLOOR = [(x, y) for y in (15, 17, 18, 19, 20) for x in range(8, 28, 2)]


class Samples(NamedTuple):
    """`SET` samples of the pixel: places in it (N, 2) from its upper left and on the light (N, 2), both in [0, 1)²."""

    pixel: NDArray[np.float64]
    light: NDArray[np.float64]
    free: NDArray[np.bool_]
    brings: NDArray[np.float64]
    """Luminance that each adds [W·m⁻²·sr⁻¹], the pixel being the mean of all."""

    @property
    def pairs(self) -> NDArray[np.int64]:
        """The quarter of the pixel and that of the light, (N, 2), each 0 … 3."""
        halves = (np.floor(2 * each).astype(np.int64) for each in (self.pixel, self.light))
        return np.stack([half[:, 0] + 2 * half[:, 1] for half in halves], 1)

    @property
    def different(self) -> int:
        """How many of the 16 pairs there are."""
        return len(np.unique(self.pairs, axis=0))


def samples(run: Run, way: str, replicate: int, pixel: tuple[int, int] = PIXEL) -> Samples:
    """The first set of a pixel."""
    found = run.scene(three_pillars).explain(pixel, seed=run.seeded(replicate), **ONE, **WAYS[way])
    project, eye = projector(**COARSE), np.asarray(COARSE["eye"])
    places = [project(eye + np.asarray(ray.direction)) for ray in found.viewing_rays[:SET]]
    rays = found.light_rays
    points = rays.array("point")[:SET] - CORNER
    light = np.stack([points @ edge / (edge @ edge) for edge in (U, V)], 1)
    brings = rays.array("brings")[:SET] @ np.array([0.2126, 0.7152, 0.0722]) * len(found.viewing_rays)
    return Samples(np.asarray(places) - pixel, light, rays.array("visible")[:SET] > 0, brings)


def usual(run: Run, way: str) -> Samples:
    """Of the first 16 sets the one whose number of different pairs is nearest to the mean of all sets."""
    every = [samples(run, way, n) for n in range(16)]
    return min(every, key=lambda each: abs(each.different - EXPECTED[way]))


def different_pairs(run: Run) -> dict[str, Quantity]:
    """`pairs-WAY`: how many of the 16 pairs of quarters a set has, mean of many sets: pixels and seeds."""
    seeds = run.pick(_SEEDS)
    note, count = f"{seeds} sets of {SET}", len(_FLOOR)

    def different(way: str, n: int) -> int:
        return samples(run, way, n // count, _FLOOR[n % count]).different

    return {f"pairs-{way}": mean_of([different(way, n) for n in range(seeds)], note=note) for way in WAYS}
