"""One row of a study: what K pictures of one variant, rendered with different seeds, say."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra.study import statistics
from antumbra.study.bias import Bias, bias
from antumbra.study.statistics import Interval

# A test of bias that would miss more than this, as a part of the mean, is no test.
_BLUNT = 0.05

Pictures = NDArray[np.float64]


@dataclass(frozen=True)
class Reference:
    """What the variants are held against: R pictures (R, H, W, 3) whose mean it is, or one with its standard error.

    `name` says what it is. `error` (H, W, 3) is None for replicates, whose spread says it, and where it is unknown.
    """

    name: str
    pictures: Pictures
    error: Pictures | None = None

    @property
    def mean(self) -> Pictures:
        """The picture, (H, W, 3)."""
        found: Pictures = self.pictures.mean(axis=0)
        return found

    @property
    def variance(self) -> float:
        """Variance of its own noise, averaged over the cells; 0 where nothing is known of it."""
        if self.error is not None:
            return float((self.error**2).mean())
        if len(self.pictures) == 1:
            return 0.0
        return float(self.pictures.var(axis=0, ddof=1).mean()) / len(self.pictures)


@dataclass(frozen=True)
class Row:
    """A variant and its numbers. Radiance in W·m⁻²·sr⁻¹, errors averaged over pixels and channels, intervals 95 %.

    `values`: what was varied; `n`: its place on the axis (of a budget, what was really spent); `budget`: what it was to
    spend, if there was one; `rays`: of any kind that were traced per pixel; `seconds` per picture; `mse` and `bias`
    against the reference, whose own `reference_variance` is taken off `mse` (None without one); `efficiency` =
    1/(variance × seconds). `squared`: squared error of each seed; `variances`: of all seeds, and without each in turn.
    `truth`: which of the references.
    """

    values: dict[str, str]
    n: float | None
    viewing_rays: int
    shadow_rays: int
    rays: float
    seconds: Interval
    variance: Interval
    efficiency: Interval
    mean: float
    truth: int
    variances: list[float]
    squared: list[float]
    budget: float | None = None
    mse: Interval | None = None
    reference_variance: float = 0.0
    bias: Bias | None = None

    @property
    def noise(self) -> Interval:
        """Root of `variance`: the standard deviation over seeds, which needs no reference."""
        return statistics.root(self.variance)

    @property
    def rmse(self) -> Interval | None:
        """Root of `mse`."""
        return statistics.root(self.mse) if self.mse else None

    @property
    def true_mean(self) -> float:
        """Mean of the reference over the picture, or of the row itself without one."""
        found = self.mean - self.bias.difference.value if self.bias else self.mean
        # What is left of a difference of equal numbers in double precision is nothing.
        return 0.0 if abs(found) < 1e-12 * abs(self.mean) else found

    @property
    def black(self) -> bool:
        """Whether it found no light, or its reference did not, and that is not known to be a bias."""
        flagged = self.bias is not None and self.bias.flagged
        return not flagged and (not self.mean or not self.true_mean)

    @property
    def tested(self) -> bool:
        """Whether its bias could be tested, at least in one tile."""
        return self.bias is not None and self.bias.tested > 0

    @property
    def hidden(self) -> float:
        """A bias that is not flagged may be as large as this, as a part of the mean; infinite if nothing is known."""
        if not self.tested or self.bias is None or not self.true_mean:
            return math.inf
        return self.bias.hidden / abs(self.true_mean)

    @property
    def noisy(self) -> bool:
        """Whether its seeds differ at all; a regular grid has the same error each time."""
        return self.variance.value > 0

    def as_json(self) -> dict[str, Any]:
        """Plain numbers, for `Row.of_json`."""
        return asdict(self)

    @classmethod
    def of_json(cls, plain: dict[str, Any]) -> Row:
        """The row that `as_json` wrote."""
        found = dict(plain)
        for name in ("seconds", "variance", "efficiency", "mse"):
            found[name] = None if plain[name] is None else _interval(plain[name])
        if plain["bias"] is not None:
            flagged, p, difference, tile, tested, hidden = plain["bias"]
            p, hidden = math.nan if p is None else p, math.inf if hidden is None else hidden
            place = tuple(tile) if tile else None
            found["bias"] = Bias(flagged, p, _interval(difference), place, tested, hidden)
        return cls(**found)


def blunt(rows: Sequence[Row]) -> float:
    """The largest `hidden` of all rows whose bias was tested and not found, if it is above 5 %; else 0."""
    hidden = max((r.hidden for r in rows if r.tested and r.bias and not r.bias.flagged), default=0.0)
    return hidden if hidden > _BLUNT else 0.0


def untested(rows: Sequence[Row]) -> float:
    """The share of tiles where bias could not be tested, of all rows that have a reference; 0 if none has."""
    shares = [1 - row.bias.tested for row in rows if row.bias is not None]
    return sum(shares) / len(shares) if shares else 0.0


def _interval(ends: list[float | None]) -> Interval:
    """Of JSON, which has null for a number that is not finite."""
    value, low, high = (math.nan if end is None else end for end in ends)
    return Interval(value, low, high)


def _own_half(pictures: Pictures, reference: Reference) -> float:
    """What the reference's own noise adds to the interval of the error; 0 where nothing is known of it."""
    if reference.error is not None:
        return statistics.error_half(pictures, reference.mean, reference.error)
    return statistics.reference_half(pictures, reference.pictures) if len(reference.pictures) > 2 else 0.0


def measured(pictures: Pictures, seconds: list[float], reference: Reference | None, **about: Any) -> Row:
    """The row of K pictures (K, H, W, 3) and their times; `about`: the fields that say which variant it is."""
    variance, time = statistics.variance(pictures), statistics.mean(seconds)
    row = {
        **about,
        "seconds": Interval(time.value, max(time.low, 0.0), time.high),
        "variance": variance,
        "efficiency": statistics.efficiency(variance, time),
        "mean": float(pictures.mean()),
        "variances": [float(v) for v in statistics.variances_without(pictures)],
        "squared": [],
    }
    if reference is not None:
        squared = statistics.squared_errors(pictures, reference.mean, reference.variance)
        several = len(reference.pictures) > 1
        row |= {
            "squared": [float(e) for e in squared],
            "mse": statistics.mse_of(squared, own_half=_own_half(pictures, reference)),
            "reference_variance": reference.variance,
            "bias": bias(
                pictures,
                reference.pictures if several else reference.pictures[0],
                reference.error,
                samples=about["viewing_rays"] * about["shadow_rays"],
            ),
        }
    return Row(**row)
