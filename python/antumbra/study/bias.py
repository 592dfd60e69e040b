"""Whether an estimator is right in the mean: its replicates against a reference, tile by tile, beyond both noises."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.study import statistics
from antumbra.study.quantiles import t_inside, t_quantile

# x, y, width, height in pixels.
Box = tuple[int, int, int, int]
# False alarms: at most one in a thousand tests of a right estimator.
ALPHA = 1e-3
# Tiles per side: a bias that is bright here and dark there must not cancel in the mean of the picture.
TILES = 4
# Means that vary more than this between replicates, as a part of themselves, come from few samples that found light:
# then their spread is no measure of their noise (none of 100 rays hit a small light: no spread, and no certainty).
MOST_SPREAD = 0.3
# What is black may have had bad luck: of so many samples, one at least is taken to find the light. Directions find the
# sun that often: half a degree wide, it has one part in 93,500 of the half-space.
RARE = 1e5


class Bias(NamedTuple):
    """What the test found.

    `flagged`: the mean differs by more than noise explains; `p`: how often noise alone would seem as large (at most,
    all tiles taken into account; NaN where nothing was tested); `difference`: mean of the picture less the
    reference's, with its 95 % interval; `tile`: (x, y, width, height) in pixels where it is clearest, None if that is
    the whole picture; `tested`: the share of tiles (the whole picture is one of them) that could be tested, 0 to 1, of
    those that have light in either: 0 says that nothing is known; `hidden`: a difference of the whole picture must be
    larger than this to be flagged, with all tiles taken into account.
    """

    flagged: bool
    p: float
    difference: statistics.Interval
    tile: Box | None
    tested: float
    hidden: float


def bias(
    replicates: ArrayLike,
    reference: ArrayLike,
    reference_error: ArrayLike | None = None,
    *,
    samples: float = 1.0,
    alpha: float = ALPHA,
    tiles: int = TILES,
) -> Bias:
    """Tests the mean of `replicates` (K, H, W[, 3]) against `reference`: R replicates (R, H, W[, 3]), or one picture.

    One picture (H, W[, 3]) is exact, or has `reference_error`, its standard error in each cell, cells independent.

    Each of the tiles² tiles, and the whole, has one mean per replicate. Their difference from the reference's, over
    its standard error √(s²/K + s_r²/R), is compared with Student's t of min(K, R) − 1 degrees of freedom (fewer than
    Welch's 1947, so careful). The least p of all of them, times their number (Bonferroni), must fall below `alpha`.
    Nothing is tested where the means of single replicates spread by more than 30 %, and in a tile (or a picture) that
    is black in one of the two: too few samples found light for their spread to measure their noise. But replicates that
    are black where the reference has light lack it, if they had samples enough, `samples` in each pixel of each: were
    one in `RARE` to find it, none of n in such pixels would with probability exp(−n / RARE), and p is at least that.
    """
    x, r = np.asarray(replicates, np.float64), np.asarray(reference, np.float64)
    r = r[None] if r.ndim == x.ndim - 1 else r
    if len(x) < 2 or x.shape[1:] != r.shape[1:]:
        raise ValueError(
            f"replicates {x.shape}, reference {r.shape}: at least 2, and the same picture, are needed"
        )
    own = (
        np.zeros(r.shape)
        if reference_error is None
        else np.broadcast_to(np.asarray(reference_error), r.shape)
    )
    boxes = _boxes(x.shape[1], x.shape[2], tiles)
    places: list[Box | None] = [None, *(boxes if len(boxes) > 1 else [])]
    per_cell = samples * x.shape[1] * x.shape[2] / x[0].size
    gaps = [_gap(_cells(x, place), _cells(r, place), _cells(own, place), per_cell) for place in places]
    lit = sum(gap.mean > 0 for gap in gaps)
    tests = {i: gap.p() for i, gap in enumerate(gaps) if gap.testable(alpha / len(gaps))}
    if not tests:
        return Bias(False, math.nan, gaps[0].interval(), None, 0.0, math.inf)
    best = min(tests, key=tests.__getitem__)
    p = min(1.0, tests[best] * len(gaps))
    hidden = gaps[0].least(alpha / len(gaps)) if 0 in tests else math.inf
    return Bias(p < alpha, p, gaps[0].interval(), places[best], len(tests) / lit, hidden)


class _Gap(NamedTuple):
    """A difference of two means, its standard error and degrees of freedom, the larger mean, the worst spread.

    `dark`: one of the two has no light, or both; `luck`: the probability of that, if it is the replicates, else 1.
    """

    value: float
    error: float
    dof: int
    mean: float
    spread: float
    dark: bool
    luck: float

    def testable(self, alpha: float) -> bool:
        """Whether enough samples found light in both, or so many found none that it is no bad luck."""
        return self.spread <= MOST_SPREAD and (not self.dark or self.luck < alpha)

    def p(self) -> float:
        """Two-sided p. Where neither has noise, only the rounding of single precision is forgiven."""
        if self.error == 0:
            return self._least_p() if abs(self.value) > 1e-6 * abs(self.mean) else 1.0
        return max(self._least_p(), 1.0 - t_inside(abs(self.value) / self.error, self.dof))

    def _least_p(self) -> float:
        return self.luck if self.dark else 0.0

    def least(self, alpha: float) -> float:
        """The difference whose two-sided p is alpha."""
        return t_quantile(1 - alpha / 2, self.dof) * self.error if self.error else 0.0

    def interval(self) -> statistics.Interval:
        """The difference with its 95 % interval."""
        half = t_quantile(0.975, self.dof) * self.error
        return statistics.Interval(self.value, self.value - half, self.value + half)


def _gap(x: NDArray[np.float64], r: NDArray[np.float64], own: NDArray[np.float64], samples: float) -> _Gap:
    """Of cells (K, n) of so many `samples` each from the reference's (R, n) with their own standard errors (R, n)."""
    a, b = x.mean(axis=1), r.mean(axis=1)
    square = float(a.var(ddof=1)) / len(a) + float((own**2).sum()) / own.size**2
    dof = len(a) - 1
    if len(b) > 1:
        square += float(b.var(ddof=1)) / len(b)
        dof = min(dof, len(b) - 1)
    mean = max(abs(float(a.mean())), abs(float(b.mean())))
    return _Gap(
        float(a.mean() - b.mean()),
        math.sqrt(square),
        dof,
        mean,
        max(_spread(a), _spread(b)),
        not (a.any() and b.any()),
        math.exp(-samples * len(x) * np.count_nonzero(r.any(axis=0)) / RARE) if not a.any() else 1.0,
    )


def _spread(means: NDArray[np.float64]) -> float:
    """Standard deviation of the means of single replicates, over their mean; of one alone nothing is known."""
    if len(means) == 1:
        return 0.0
    centre = abs(float(means.mean()))
    return float(means.std(ddof=1)) / centre if centre else 0.0


def _boxes(height: int, width: int, tiles: int) -> list[Box]:
    xs = sorted({round(width * i / tiles) for i in range(tiles + 1)})
    ys = sorted({round(height * i / tiles) for i in range(tiles + 1)})
    return [(x, y, x1 - x, y1 - y) for y, y1 in pairwise(ys) for x, x1 in pairwise(xs)]


def _cells(pictures: NDArray[np.float64], place: Box | None) -> NDArray[np.float64]:
    if place is not None:
        x, y, width, height = place
        pictures = pictures[:, y : y + height, x : x + width]
    return pictures.reshape(len(pictures), -1)
