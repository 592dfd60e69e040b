"""Quantiles of Student's t for whole degrees of freedom, from its finite sums."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache


@cache
def t_quantile(p: float, dof: int) -> float:
    """The number below which Student's t with `dof` degrees of freedom lies with probability p in (0, 1)."""
    if dof < 1:
        return math.inf
    if p < 0.5:
        return -t_quantile(1 - p, dof)
    return _root(lambda t: 0.5 + 0.5 * t_inside(t, dof), p)


def t_inside(t: float, dof: int) -> float:
    """P(|T| ≤ t): the finite sums of Abramowitz and Stegun 26.7.3 and 26.7.4."""
    angle = math.atan(t / math.sqrt(dof))
    sine, cosine = math.sin(angle), math.cos(angle)
    odd = dof % 2
    term, total = (cosine if odd else 1.0), 0.0
    for j in range(odd, dof - 1, 2):
        total += term
        term *= cosine**2 * (j + 1) / (j + 2)
    return 2 / math.pi * (angle + sine * total) if odd else sine * total


def _root(rising: Callable[[float], float], target: float) -> float:
    """Where a rising function on x ≥ 0 reaches the target, by bisection to the last bits."""
    low, high = 0.0, 1.0
    while rising(high) < target:
        low, high = high, 2 * high
    for _ in range(200):
        middle = (low + high) / 2
        if middle in (low, high):
            break
        low, high = (middle, high) if rising(middle) < target else (low, middle)
    return high
