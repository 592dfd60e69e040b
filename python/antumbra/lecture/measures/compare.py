"""Two pictures against each other."""

from __future__ import annotations

import numpy as np

from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.pictures import luminance
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run


def share_changed(run: Run, a: str, b: str, *, white: float, by: float = 0.02) -> Quantity:
    """The share of pixels whose luminance differs between two variants by more than the part `by` of `white`.

    Replicates are compared seed by seed, so that noise that both have does not count; mean and 95 % interval.
    """
    pairs = zip(run.images(a), run.images(b), strict=True)
    shares = [
        float(np.mean(np.abs(luminance(first.pixels) - luminance(second.pixels)) > by * white))
        for first, second in pairs
    ]
    return mean_of(shares, unit="%", note=f"pixels that change by more than {by:.0%} of white")
