"""What stands on the colour bar of a map: numbers at their places, and a sign where the map goes beyond them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from antumbra._words import written


def ticks(
    values: ArrayLike, low: float, high: float, unit: str = "", at: Mapping[float, str] | None = None
) -> list[tuple[float, str]]:
    """Places along the bar, 0 to 1, and their text: `at` says which, else both ends and the middle.

    "≤" and "≥" at an end say that values beyond it have its colour. The unit "%" writes shares as per cent.
    """
    scale = 100.0 if unit == "%" else 1.0
    plus = "+" if low < 0 < high else ""

    def text(x: float) -> str:
        return (plus if x > 0 else "") + written(scale * x, 2)

    marks = dict(at) if at else {x: text(x) for x in (low, (low + high) / 2, high)}
    found = [((x - low) / (high - low), words) for x, words in sorted(marks.items())]
    if unit == "%":
        found[-1] = (found[-1][0], found[-1][1] + "\u202f%")
    (first, least), (last, most) = found[0], found[-1]
    known = np.asarray(values, np.float64)
    # Half a tone of 128 beyond the end is the same colour anyway.
    slack = (high - low) / 256
    if first == 0.0 and np.nanmin(known) < low - slack:
        found[0] = (first, f"≤ {least}")
    if last == 1.0 and np.nanmax(known) > high + slack:
        found[-1] = (last, f"≥ {most}")
    return found
