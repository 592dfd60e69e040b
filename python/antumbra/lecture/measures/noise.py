"""How far the pictures of a variant are from the truth, replicate by replicate."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.pictures import luminance
from antumbra.lecture.run import Run
from antumbra.study import statistics


def squared_errors(run: Run, key: str, reference: str) -> NDArray[np.float64]:
    """Mean squared error of luminance [W²·m⁻⁴·sr⁻²] of each replicate of a variant, (K,), against a reference variant.

    Only pixels that receive light count; the reference is the mean of its replicates, whose own noise is taken off.
    """
    truth = np.array([luminance(image.pixels) for image in run.images(reference)])
    lit = truth.mean(0) > 0
    own = truth[:, lit].var(0, ddof=1) / len(truth) if len(truth) > 1 else 0.0
    each = np.array([luminance(image.pixels)[lit] for image in run.images(key)])
    return statistics.squared_errors(each, truth[:, lit].mean(0), own)
