"""Whether an estimator is right in the mean: its replicates against a reference, tile by tile, beyond both noises."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.study import statistics
from antumbra.study._quantiles import t_inside, t_quantile

# False alarms: at most one in a thousand tests of a right estimator.
ALPHA = 1e-3
# Tiles per side: a bias that is bright here and dark there must not cancel in the mean of the picture.
TILES = 4


class Bias(NamedTuple):
    """What the test found.

    `flagged`: the mean differs by more than noise explains; `p`: how often noise alone would seem as large (at most,
    all tiles taken into account); `difference`: mean of the picture less the reference's, with its 95 % interval;
    `tile`: (x, y, width, height) in pixels where it is clearest, None if that is the whole picture.
    """

    flagged: bool
    p: float
    difference: statistics.Interval
    tile: tuple[int, int, int, int] | None


def bias(
    replicates: ArrayLike,
    reference: ArrayLike,
    *,
    alpha: float = ALPHA,
    tiles: int = TILES,
) -> Bias:
    """Tests the mean of `replicates` (K, H, W[, 3]) against `reference`: (R, H, W[, 3]), or exact, (H, W[, 3]).

    Each of the tiles² tiles, and the whole, has one mean per replicate. Their difference from the reference's, over
    its standard error √(s²/K + s_r²/R), is compared with Student's t of min(K, R) − 1 degrees of freedom (fewer than
    Welch's 1947, so careful). The least p of all of them, times their number (Bonferroni), must fall below `alpha`.
    """
    x, r = np.asarray(replicates, np.float64), np.asarray(reference, np.float64)
    r = r[None] if r.ndim == x.ndim - 1 else r
    if len(x) < 2 or x.shape[1:] != r.shape[1:]:
        raise ValueError(
            f"replicates {x.shape}, reference {r.shape}: at least 2, and the same picture, are needed"
        )
    boxes = _boxes(x.shape[1], x.shape[2], tiles)
    places: list[tuple[int, int, int, int] | None] = [None, *(boxes if len(boxes) > 1 else [])]
    tests = [_p(_means(x, place), _means(r, place)) for place in places]
    best = min(range(len(tests)), key=tests.__getitem__)
    p = min(1.0, tests[best] * len(tests))
    return Bias(p < alpha, p, _difference(_means(x, None), _means(r, None)), places[best])


def _boxes(height: int, width: int, tiles: int) -> list[tuple[int, int, int, int]]:
    xs = sorted({round(width * i / tiles) for i in range(tiles + 1)})
    ys = sorted({round(height * i / tiles) for i in range(tiles + 1)})
    return [(x, y, x1 - x, y1 - y) for y, y1 in pairwise(ys) for x, x1 in pairwise(xs)]


def _means(pictures: NDArray[np.float64], place: tuple[int, int, int, int] | None) -> NDArray[np.float64]:
    if place is not None:
        x, y, width, height = place
        pictures = pictures[:, y : y + height, x : x + width]
    means: NDArray[np.float64] = pictures.reshape(len(pictures), -1).mean(axis=1)
    return means


def _p(x: NDArray[np.float64], r: NDArray[np.float64]) -> float:
    """Two-sided p of the difference of two means. Where neither has noise, only the rounding of single precision is."""
    error, dof = _error(x, r)
    gap = abs(float(x.mean() - r.mean()))
    if error == 0:
        return 0.0 if gap > 1e-6 * abs(float(r.mean())) else 1.0
    return max(0.0, 1.0 - t_inside(gap / error, dof))


def _difference(x: NDArray[np.float64], r: NDArray[np.float64]) -> statistics.Interval:
    error, dof = _error(x, r)
    gap, half = float(x.mean() - r.mean()), t_quantile(0.975, dof) * error
    return statistics.Interval(gap, gap - half, gap + half)


def _error(x: NDArray[np.float64], r: NDArray[np.float64]) -> tuple[float, int]:
    """Standard error of the difference of the means, and its degrees of freedom."""
    own = float(x.var(ddof=1)) / len(x)
    if len(r) == 1:
        return math.sqrt(own), len(x) - 1
    return math.sqrt(own + float(r.var(ddof=1)) / len(r)), min(len(x), len(r)) - 1
