"""Umbra, penumbra and antumbra in maps of regions."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.lecture.measures.replicates import of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.study._quantiles import t_quantile
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


def _disks(regions: NDArray[np.integer[Any]]) -> list[NDArray[np.bool_]]:
    return [regions == UMBRA, regions == ANTUMBRA, (regions >= 0) & (regions != LIT)]


def crossing(x: ArrayLike, y: ArrayLike, unit: str = "", note: str = "") -> Quantity:
    """Where the straight line through points crosses zero, with its 95 % interval from what they scatter about it."""
    u, v = np.asarray(x, np.float64), np.asarray(y, np.float64)
    n, centre = len(u), u.mean()
    spread = float(((u - centre) ** 2).sum())
    slope = float(((u - centre) * v).sum()) / spread
    rest = v - v.mean() - slope * (u - centre)
    zero = centre - v.mean() / slope
    error = math.sqrt(float((rest**2).sum()) / (n - 2) * (1 / n + (zero - centre) ** 2 / spread)) / abs(slope)
    half = t_quantile(0.975, n - 2) * error
    return of_interval(Interval(zero, zero - half, zero + half), unit, note)
