"""Light by the number of its reflections, from pictures of the variants "depth-k" that share their random numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.ratio import ratio
from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run

# From this bounce on the colours and the places of the first ones are forgotten.
_SETTLED = 4


def light_of(run: Run, k: int) -> NDArray[np.float64]:
    """Radiance (H, W, 3) that was reflected exactly k times; k = 0: emitted."""
    below = run.pixels(f"depth-{k - 1}") if k else 0.0
    return np.maximum(run.pixels(f"depth-{k}") - below, 0.0)


def _means(run: Run, last: int) -> NDArray[np.float64]:
    """Mean luminance of each replicate by reflections 1 … `last`, (K, `last`)."""
    sums = np.stack([luminances(run, f"depth-{k}").mean((1, 2)) for k in range(last + 1)], axis=1)
    return np.asarray(np.diff(sums, axis=1), np.float64)


def shares(run: Run, last: int) -> dict[str, Quantity]:
    """`share-k`: the part of all reflected light that was reflected k times; `left-k`: the part after more than k."""
    means = _means(run, last)
    part = means / means.sum(1, keepdims=True)
    left = 1.0 - np.cumsum(part, axis=1)
    return {f"share-{k + 1}": mean_of(part[:, k], "%") for k in range(last)} | {
        f"left-{k + 1}": mean_of(left[:, k], "%") for k in range(last)
    }


def after(run: Run, last: int) -> dict[str, Quantity]:
    """`rate`: the mean factor from one bounce to the next, from the fourth on (geometric mean)."""
    means = _means(run, last)
    steps = last - _SETTLED
    return {"rate": mean_of((means[:, -1] / means[:, _SETTLED - 1]) ** (1.0 / steps))}


def cut_off(run: Run, roulette: str, last: int) -> dict[str, Quantity]:
    """`kept`: the mean with roulette over that of paths of `last` reflections."""
    ended, whole = (mean_of(luminances(run, key).mean((1, 2))) for key in (roulette, f"depth-{last}"))
    return {"kept": ratio(ended, whole)}
