"""Where a path ends: error against work for a fixed number of reflections and for Russian roulette.

Of the variants "end-WAY" (random numbers, replicates): variance of one path and rays of one path; the bias of few
reflections is the light of more, from the variants "depth-k" that share their random numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.maps import box_mean
from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.ratio import ratio, scaled, times
from antumbra.lecture.measures.replicates import median_of, of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.study import statistics
from antumbra.study.statistics import Interval


class End(NamedTuple):
    """A way to end paths: by pixel, (H, W), and over all pixels."""

    bias: NDArray[np.float64]
    """Light that is left out [W·m⁻²·sr⁻¹], a mean over 5 × 5 pixels."""
    square: Quantity
    """Mean of its square over the picture [W²·m⁻⁴·sr⁻²]."""
    work: NDArray[np.float64]
    """Variance of one path times its rays, a mean over 5 × 5 pixels."""
    rays: float
    """Of one path."""
    product: Quantity
    """Variance of one path times its rays, mean over the picture."""

    def error(self, rays: float) -> NDArray[np.float64]:
        """RMSE with so many rays a pixel, (H, W)."""
        found: NDArray[np.float64] = np.sqrt(self.bias**2 + self.work / rays)
        return found


def end(run: Run, way: str, paths: int, depth: int, last: int) -> End:
    """The variant end-`way` of `paths` paths a pixel; paths of `depth` reflections lose what those of `last` have."""
    key, of = f"end-{way}", luminances(run, f"end-{way}")
    images = run.images(key)
    rays = float(np.mean([i.rays + i.shadow_rays for i in images])) / of[0].size / paths
    lost = luminances(run, f"depth-{last}") - luminances(run, f"depth-{depth}")
    bias, work = box_mean(lost.mean(0), 2), box_mean(of.var(0, ddof=1) * paths * rays, 2)
    found = of_interval(statistics.variance(of))
    return End(bias, square_of(lost), work, rays, times(found, Quantity(paths * rays)))


def compared(run: Run, ends: dict[str, End]) -> dict[str, Quantity]:
    """`worth`: variance × rays of the way "long" over that of "roulette", `clock`: the same by the clock; `level`: rays
    a pixel at which "short" and "roulette" have the same mean squared error; `rays-WAY`: of one path.
    """
    short, roulette, long = ends["short"], ends["roulette"], ends["long"]
    taken, least = (np.array([i.seconds for i in run.images(f"end-{way}")]) for way in ("long", "roulette"))
    variances = scaled(ratio(long.product, roulette.product), roulette.rays / long.rays)
    return {
        "worth": ratio(long.product, roulette.product),
        "clock": times(median_of(taken / least), variances),
        "level": level(roulette.product, short.product, short.square),
        **{f"rays-{way}": Quantity(each.rays) for way, each in ends.items()},
    }


def square_of(replicates: NDArray[np.float64]) -> Quantity:
    """Mean over pixels of the square of the mean of replicates (K, H, W), K ≥ 3, whose noise comes off.

    The interval is the jackknife's over replicates: that of the error of 0 against them as a reference.
    """
    nothing = np.zeros_like(replicates[:1])
    own = replicates.var(0, ddof=1) / len(replicates)
    value = float(statistics.squared_errors(nothing, replicates.mean(0), own)[0])
    return Quantity(value, statistics.reference_half(nothing, replicates))


def level(more: Quantity, less: Quantity, square: Quantity) -> Quantity:
    """Work at which more/work = square + less/work; it is nowhere sure where the square may be 0."""
    low, high = square.interval
    apart, error = more.value - less.value, float(np.hypot(more.error, less.error))
    if low <= 0:
        return of_interval(Interval(apart / square.value if square.value > 0 else np.nan, 0.0, np.inf))
    # Errors of both parts in quadrature, towards either end: the smaller square makes more of it.
    value = apart / square.value
    up = float(np.hypot(error / square.value, apart / low - value))
    down = float(np.hypot(error / square.value, value - apart / high))
    return of_interval(Interval(value, value - down, value + up))


def rmse(ends: Sequence[End], rays: float, light: float) -> list[float]:
    """RMSE of each over the picture with so many rays a pixel, over the mean light."""
    return [float(np.sqrt(e.square.value + e.product.value / rays)) / light for e in ends]
