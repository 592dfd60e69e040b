"""A number from independent replicates."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from antumbra.lecture.quantity import Quantity

# Two-sided 95 % points of Student's t for 1, 2, … degrees of freedom.
_T = (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131)


def mean_of(values: Sequence[float], unit: str = "", note: str = "") -> Quantity:
    """Mean of independent replicates with its 95 % interval (Student's t)."""
    found = np.asarray(values, np.float64)
    n = len(found)
    if n < 2:
        return Quantity(float(found.mean()), 0.0, unit, note)
    t = _T[n - 2] if n - 2 < len(_T) else 1.96 + 2.5 / n
    return Quantity(float(found.mean()), t * float(found.std(ddof=1)) / n**0.5, unit, note)
