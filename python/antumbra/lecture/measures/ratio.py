"""Ratios and products of uncertain numbers."""

from __future__ import annotations

import math

from antumbra.lecture.quantity import Quantity


def ratio(a: Quantity, b: Quantity, unit: str = "", note: str = "") -> Quantity:
    """a / b of two independent quantities; relative errors add in the square."""
    value = a.value / b.value
    error = abs(value) * math.hypot(a.error / a.value, b.error / b.value)
    return Quantity(value, error, unit, note)


def times(a: Quantity, b: Quantity, unit: str = "", note: str = "") -> Quantity:
    """a · b of two independent quantities."""
    return Quantity(a.value * b.value, math.hypot(a.error * b.value, b.error * a.value), unit, note)


def excess(share: Quantity) -> Quantity:
    """A ratio less 1, in per cent."""
    return Quantity(share.value - 1.0, share.error, "%", share.note)
