"""Whether what was measured supports a claim of the page."""

from __future__ import annotations

import math
from collections.abc import Mapping

from antumbra.lecture.figure import Claim
from antumbra.lecture.quantity import Quantity
from antumbra.study.statistics import Interval, Verdict
from antumbra.study.statistics import verdict as of_interval


def expected(claim: Claim, measured: Mapping[str, Quantity]) -> str:
    """What a claim expects of its quantity, its tolerance among it, as the page writes it."""
    unit = measured[claim.of].unit

    def text(bound: float | str) -> str:
        return f"{measured[bound]:v}" if isinstance(bound, str) else f"{Quantity(bound, unit=unit)}"

    if claim.near is not None:
        within = f"± {Quantity(claim.within, unit=unit)}"
        return f"expected within {within}" if claim.near == 0 else f"expected {text(claim.near)}, {within}"
    return (
        f"expected below {text(claim.below)}"
        if claim.below is not None
        else f"expected above {text(claim.above or 0.0)}"
    )


def verdict(claim: Claim, measured: Mapping[str, Quantity]) -> Verdict:
    """By the 95 % interval of the claim's quantity, less its bound (with the interval of that, if it was measured)."""
    bound = next(b for b in (claim.near, claim.below, claim.above) if b is not None)
    other = measured[bound] if isinstance(bound, str) else Quantity(bound)
    interval = _difference(measured[claim.of], other)
    if claim.near is not None:
        return of_interval(interval, near=0.0, within=claim.within)
    return of_interval(interval, below=0.0) if claim.below is not None else of_interval(interval, above=0.0)


def _difference(a: Quantity, b: Quantity) -> Interval:
    """a − b of two independent quantities: distances to the ends that work the same way add in the square."""
    value, (low, high), (least, most) = a.value - b.value, a.interval, b.interval
    down, up = math.hypot(a.value - low, most - b.value), math.hypot(high - a.value, b.value - least)
    return Interval(value, value - down, value + up)
