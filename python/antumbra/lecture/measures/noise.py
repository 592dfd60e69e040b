"""The pictures of a variant replicate by replicate, and how far they are from the truth."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.replicates import of_interval
from antumbra.lecture.pictures import luminance
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.study import statistics


def luminances(run: Run, key: str) -> NDArray[np.float64]:
    """Luminance [W·m⁻²·sr⁻¹] of each replicate of a variant, (K, H, W)."""
    return np.array([luminance(image.pixels) for image in run.images(key)])


def reflected(run: Run, key: str) -> NDArray[np.float64]:
    """Each replicate of a variant without the light that it shows itself, (K, H, W, 3)."""
    return np.array([image.pixels - image.aov["emission"] for image in run.images(key)], np.float64)


def noise_over(run: Run, key: str, other: str) -> Quantity:
    """Standard deviation of one variant over that of another, from the scatter of replicates: it needs no truth."""
    return of_interval(
        statistics.ratio(*(statistics.root(statistics.variance(luminances(run, k))) for k in (key, other)))
    )


def of_lit_pixels(run: Run, key: str, reference: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Luminance of the replicates of a variant and of a reference, (K, N) and (R, N), where the reference has light."""
    truth = luminances(run, reference)
    lit = truth.mean(0) > 0
    return luminances(run, key)[:, lit], truth[:, lit]


def squared_errors(run: Run, key: str, reference: str) -> NDArray[np.float64]:
    """Mean squared error of luminance [W²·m⁻⁴·sr⁻²] of each replicate of a variant, (K,), against a reference variant.

    Only pixels that receive light count; the reference is the mean of its replicates, whose own noise is taken off.
    By that a replicate that is as good as the reference may come below 0.
    """
    each, truth = of_lit_pixels(run, key, reference)
    own = truth.var(0, ddof=1) / len(truth) if len(truth) > 1 else 0.0
    return statistics.squared_errors(each, truth.mean(0), own)


def reference_half(run: Run, key: str, reference: str) -> float:
    """Half of the interval of their mean that the reference's own noise gives, which all replicates share."""
    return statistics.reference_half(*of_lit_pixels(run, key, reference))
