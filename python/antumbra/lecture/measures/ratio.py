"""Ratios and products of uncertain numbers."""

from __future__ import annotations

from collections.abc import Iterable

from antumbra.lecture.measures.replicates import of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.study import statistics
from antumbra.study.statistics import Interval


def ratio(a: Quantity, b: Quantity, unit: str = "", note: str = "") -> Quantity:
    """a / b of two independent positive quantities, as `statistics.ratio`."""
    return of_interval(statistics.ratio(_interval(a), _interval(b)), unit, note)


def _interval(a: Quantity) -> Interval:
    return Interval(a.value, *a.interval)


def times(a: Quantity, b: Quantity, unit: str = "", note: str = "") -> Quantity:
    """a · b of two independent positive quantities: a over 1/b, as `statistics.ratio`, so that no end is below 0."""
    inverse = statistics.ratio(Interval(1.0, 1.0, 1.0), _interval(b))
    return of_interval(statistics.ratio(_interval(a), inverse), unit, note)


def farthest_from_one(quantities: Iterable[Quantity]) -> Quantity:
    """That whose interval reaches farthest from 1: where it is within a tolerance, all of them are."""
    return max(quantities, key=lambda q: max(abs(end - 1) for end in q.interval))


def squared(a: Quantity, unit: str = "", note: str = "") -> Quantity:
    """a² of a positive quantity, its interval end by end."""
    low, high = a.interval
    return of_interval(Interval(a.value**2, max(low, 0.0) ** 2, high**2), unit, note)


def excess(share: Quantity) -> Quantity:
    """A ratio less 1, in per cent."""
    low, high = share.interval
    return of_interval(Interval(share.value - 1.0, low - 1.0, high - 1.0), "%", share.note)


def scaled(a: Quantity, factor: float, unit: str = "", note: str = "") -> Quantity:
    """a · factor, an exact number above 0: its interval end by end, wherever 0 lies."""
    return of_interval(Interval(*(factor * end for end in _interval(a))), unit, note)
