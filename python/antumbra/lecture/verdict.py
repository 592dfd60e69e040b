"""Whether what was measured supports a claim."""

from __future__ import annotations

import math
from collections.abc import Mapping

from antumbra.lecture.figure import Claim
from antumbra.lecture.quantity import Quantity

SUPPORTED, UNDECIDED, NOT_SUPPORTED = "supported", "undecided", "not supported"


def verdict(claim: Claim, measured: Mapping[str, Quantity]) -> str:
    """One of the three words: by the 95 % interval of the quantity (less that of the bound, if it has one)."""
    quantity = measured[claim.of]
    if claim.near is not None:
        value, error = _less(quantity, claim.near, measured)
        return _of_interval(abs(value) - claim.within, error)
    if claim.below is not None:
        return _of_interval(*_less(quantity, claim.below, measured))
    if claim.above is not None:
        value, error = _less(quantity, claim.above, measured)
        return _of_interval(-value, error)
    raise AssertionError(f"{claim.text!r} asks nothing")


def _less(quantity: Quantity, bound: float | str, measured: Mapping[str, Quantity]) -> tuple[float, float]:
    other = measured[bound] if isinstance(bound, str) else Quantity(bound)
    return quantity.value - other.value, math.hypot(quantity.error, other.error)


def _of_interval(excess: float, error: float) -> str:
    """`excess` over the bound, ± error: supported where it is surely not above 0."""
    if math.isnan(excess) or math.isnan(error):
        return UNDECIDED
    if excess + error <= 0:
        return SUPPORTED
    return NOT_SUPPORTED if excess - error > 0 else UNDECIDED
