"""A number from independent replicates."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.lecture.quantity import Quantity
from antumbra.study import statistics
from antumbra.study.statistics import Interval


def mean_of(values: ArrayLike, unit: str = "", note: str = "") -> Quantity:
    """Mean of independent replicates (the first axis) with its 95 % interval (Student's t); infinite of one alone."""
    return of_interval(statistics.mean(values), unit, note)


def median_of(values: ArrayLike, unit: str = "", note: str = "") -> Quantity:
    """Median of repeats that something else may disturb (a busy machine), between two of the ordered repeats.

    Of K independent repeats the r-th smallest and the r-th largest hold the true median but for the chance that fewer
    than r of K fair coins fall on one side (David and Nagaraja 2003, section 7.1); r is the largest for which that is
    at most 5 %: 1 for 6 to 8 repeats, 6 for 21. Fewer than 6 say nothing with 95 %: their interval has no ends.
    """
    found = np.sort(np.asarray(values, np.float64))
    count = len(found)
    fewer = 2 * np.cumsum([math.comb(count, k) for k in range(count)]) / 2.0**count
    rank = int(np.searchsorted(fewer, 0.05, side="right"))
    low, high = (found[rank - 1], found[-rank]) if rank else (-math.inf, math.inf)
    return of_interval(Interval(float(np.median(found)), low, high), unit, note)


def slope_of_root(n: Sequence[int], squares: NDArray[np.float64]) -> Interval:
    """Slope of the root of mean `squares` (K, M) against `n` (M,): the jackknife's over K replicates.

    Single ones may be lost in noise, at 0 or below, where their mean is not; so may a mean without one of them: a
    thousandth of the whole mean stands in for it, which makes the interval wide. Not a number where a whole
    mean is not above 0.
    """
    means = squares.mean(0)
    if not (means > 0).all():
        return Interval(math.nan, -math.inf, math.inf)
    without = np.maximum((squares.sum(0) - squares) / (len(squares) - 1), 1e-3 * means)
    found = statistics.variance_slope(n, np.concatenate([means[None], without]))
    return Interval(*(end / 2 for end in found))


def of_interval(interval: Interval, unit: str = "", note: str = "") -> Quantity:
    """An interval of `antumbra.study.statistics` as a quantity of the page: ± its larger side, with both ends."""
    down, up = interval.value - interval.low, interval.high - interval.value
    if math.isclose(down, up, rel_tol=1e-9) or math.isnan(interval.value):
        return Quantity(interval.value, interval.half, unit, note)
    return Quantity(interval.value, max(down, up), unit, note, interval.low, interval.high)
