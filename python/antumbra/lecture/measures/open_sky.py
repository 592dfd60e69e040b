"""What a point of the floor of the white box sees of the sky; albedo × L × AO against the picture under that sky."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.geometry import seen_from_above
from antumbra.lecture.measures.noise import luminances, reflected
from antumbra.lecture.measures.ratio import excess, ratio
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.pictures import luminance
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import white_box
from antumbra.lecture.variant import Pick

# The receivers, on a line to the back of the box between the tall block and the wall.
DEPTHS = [20 + 40 * n for n in range(14)]
CELLS = 8
# Cells along the edge of the whole hemisphere.
FINE = Pick(480, 960)
_BESIDE = 480.0


class Directions(NamedTuple):
    """Directions (N, 3), and which of them find the sky, (N,)."""

    along: NDArray[np.float64]
    free: NDArray[np.bool_]

    @property
    def share(self) -> float:
        """Which part of them finds the sky."""
        return float(self.free.mean())


class Seen(NamedTuple):
    """The hemisphere over a receiver: with `CELLS`² random directions, and with one in each of as many cells."""

    random: Directions
    cells: Directions
    sky: NDArray[np.bool_]
    """Where the sky is seen from straight above, as `geometry.seen_from_above` has it."""
    open: float
    """The bright part of that disk."""


def seen_from(run: Run, z: int) -> Seen:
    """What the receiver at depth z sees."""

    def free(along: NDArray[np.float64]) -> NDArray[np.bool_]:
        at = np.tile([_BESIDE, 0.0, float(z)], (len(along), 1))
        return ~run.scene(white_box).occluded(at, directions=along)

    def of(places: NDArray[np.float64]) -> Directions:
        along = _on_the_disk(places)
        return Directions(along, free(along))

    random = np.random.default_rng((run.seeded(0), z))
    corners = np.moveaxis(np.indices((CELLS, CELLS)), 0, -1).reshape(-1, 2)
    even, scattered = (corners + random.random((CELLS**2, 2))) / CELLS, random.random((CELLS**2, 2))
    inside, along = seen_from_above(run.pick(FINE))
    sky, bright = inside.copy(), free(along)
    sky[inside] = bright
    return Seen(of(scattered), of(even), sky, float(bright.mean()))


def _on_the_disk(places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Directions of density cos θ / π for points (N, 2) of the unit square: r = √u, φ = 2π v of the disk."""
    r, angle = np.sqrt(places[:, 0]), 2 * np.pi * places[:, 1]
    found: NDArray[np.float64] = np.stack([r * np.cos(angle), np.sqrt(1 - r**2), r * np.sin(angle)], 1)
    return found


def all_seen(run: Run) -> dict[int, Seen]:
    """`seen_from` for all `DEPTHS`."""
    found: dict[int, Seen] = run.once("open sky", lambda: {z: seen_from(run, z) for z in DEPTHS})
    return found


def product(run: Run, some: slice = slice(None)) -> NDArray[np.float64]:
    """Albedo × L × AO, L = 1, (H, W, 3), of replicates of "identity-ao"; its pixels without a surface are 0."""
    albedo: NDArray[np.float64] = np.asarray(run.aov("identity-ao", "albedo"), np.float64)
    return albedo * np.mean([image.pixels for image in run.images("identity-ao")[some]], 0, dtype=np.float64)


def compared(run: Run) -> dict[str, Quantity]:
    """`identical`: largest difference of product and picture of the same rays; `off`: that of their means, where random
    numbers and density of the directions are others.
    """
    same = float(np.abs(reflected(run, "identity-same")[0] - product(run, slice(1))).max())
    apart = luminance(reflected(run, "identity-other"))
    albedo = luminance(np.asarray(run.aov("identity-ao", "albedo"), np.float64))
    mine = albedo * luminances(run, "identity-ao")
    return {
        "identical": Quantity(same),
        "off": excess(ratio(mean_of(apart.mean((1, 2))), mean_of(mine.mean((1, 2))))),
    }
