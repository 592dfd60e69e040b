"""A number from independent replicates."""

from __future__ import annotations

import math

from numpy.typing import ArrayLike

from antumbra.lecture.quantity import Quantity
from antumbra.study import statistics
from antumbra.study.statistics import Interval


def mean_of(values: ArrayLike, unit: str = "", note: str = "") -> Quantity:
    """Mean of independent replicates (the first axis) with its 95 % interval (Student's t); infinite of one alone."""
    return of_interval(statistics.mean(values), unit, note)


def of_interval(interval: Interval, unit: str = "", note: str = "") -> Quantity:
    """An interval of `antumbra.study.statistics` as a quantity of the page: ± its larger side, with both ends."""
    down, up = interval.value - interval.low, interval.high - interval.value
    if math.isclose(down, up, rel_tol=1e-9) or math.isnan(interval.value):
        return Quantity(interval.value, interval.half, unit, note)
    return Quantity(interval.value, max(down, up), unit, note, interval.low, interval.high)
