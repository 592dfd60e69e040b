"""Umbra, penumbra and antumbra in maps of regions."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.lecture.measures.replicates import of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.scene import Scene
from antumbra.study.quantiles import t_quantile
from antumbra.study.statistics import Interval

UMBRA, PENUMBRA, ANTUMBRA, LIT = range(4)


class Radii(NamedTuple):
    """Radii of disks whose area is that of the regions of a map: 0 where there is none."""

    umbra: float
    antumbra: float
    outside: float

    @property
    def signed(self) -> float:
        """The umbra's, or less the antumbra's."""
        return self.umbra - self.antumbra


def radii(regions: NDArray[np.integer[Any]], pixel: float) -> Radii:
    """Radii in a map (H, W) of regions about one axis, whose pixels are `pixel` wide."""
    of = [pixel * math.sqrt(np.count_nonzero(chosen) / math.pi) for chosen in _disks(regions)]
    return Radii(*of)


def radii_of(run: Run, key: str, width: float) -> Radii:
    """Radii in the map of regions of a variant whose picture is `width` wide."""
    regions = run.aov(key, "regions").astype(int)
    return radii(regions, width / len(regions))


def ends_on_axis(scene: Scene, height: float, length: float, reach: float) -> Quantity:
    """How far behind an occluder at `height` over the origin the umbra ends on its axis, looked for within `reach` of
    `length`: the middle between the last point of the umbra and the first one of the antumbra, ± half of what lies
    between.

    Not a number, and sure of nothing, if the regions are not those two, in this order.
    """
    behind = length + reach * np.linspace(-1, 1, 2001)
    points = np.stack([0 * behind, height - behind, 0 * behind], 1)
    found = scene.regions(points, (0.0, 1.0, 0.0))
    first = int(np.argmax(found != UMBRA))
    if first == 0 or (found[first:] != ANTUMBRA).any():
        return Quantity(math.nan, math.inf, note=f"not from {behind[0]:g} to {behind[-1]:g} on the axis")
    last, next_one = float(behind[first - 1]), float(behind[first])
    return Quantity((last + next_one) / 2, (next_one - last) / 2, note="between two points on the axis")


def _disks(regions: NDArray[np.integer[Any]]) -> list[NDArray[np.bool_]]:
    return [regions == UMBRA, regions == ANTUMBRA, (regions >= 0) & (regions != LIT)]


def crossing(x: ArrayLike, y: ArrayLike, unit: str = "", note: str = "") -> Quantity:
    """Where the straight line through points crosses zero, ± what they scatter about it.

    The points are those of one map each, so ± is a spread (as wide as a 95 % t-interval of the fit), and no interval of
    replicates.
    """
    u, v = np.asarray(x, np.float64), np.asarray(y, np.float64)
    n, centre = len(u), u.mean()
    spread = float(((u - centre) ** 2).sum())
    slope = float(((u - centre) * v).sum()) / spread
    rest = v - v.mean() - slope * (u - centre)
    zero = centre - v.mean() / slope
    error = math.sqrt(float((rest**2).sum()) / (n - 2) * (1 / n + (zero - centre) ** 2 / spread)) / abs(slope)
    half = t_quantile(0.975, n - 2) * error
    return of_interval(Interval(zero, zero - half, zero + half), unit, note)
