"""How the error falls with the number of shadow rays: RMSE, ratios and fitted slopes of several samplers."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.noise import reference_half, squared_errors
from antumbra.lecture.measures.replicates import of_interval, slope_of_root
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.study import statistics
from antumbra.study.plot import Curve, measured

Counts = Mapping[str, Sequence[int]]


class Errors:
    """Squared errors of the variants `sampler`-`n`, for n in `counts` of each sampler, against the variant "truth".

    The unit is one random ray: the first count of the first sampler. Intervals hold the scatter of the replicates and
    the noise of the truth, which all of them share.
    """

    def __init__(self, run: Run, counts: Counts) -> None:
        """Compares the pictures."""
        self.counts = counts
        self.squares = {
            sampler: np.stack([squared_errors(run, f"{sampler}-{n}", "truth") for n in every], axis=1)
            for sampler, every in counts.items()
        }
        self._own = {
            (sampler, n): reference_half(run, f"{sampler}-{n}", "truth")
            for sampler, every in counts.items()
            for n in every
        }
        self._first = self.squares[next(iter(counts))][:, 0]

    @property
    def unit(self) -> Quantity:
        """RMSE of one random ray [W·m⁻²·sr⁻¹]."""
        first = next(iter(self.counts))
        return of_interval(self.rmse(first, self.counts[first][0]), "W·m⁻²·sr⁻¹")

    def at(self, sampler: str, n: int) -> NDArray[np.float64]:
        """Squared error of each replicate with `n` rays; below 0 where the noise of the truth was as large."""
        found: NDArray[np.float64] = self.squares[sampler][:, self.counts[sampler].index(n)]
        return found

    def rmse(self, sampler: str, n: int) -> statistics.Interval:
        """RMSE with `n` rays; one replicate alone (a sampler without noise) has the noise of the truth only."""
        squares, own = self.at(sampler, n), self._own[sampler, n]
        if len(squares) > 1:
            return statistics.root(statistics.mse_of(squares, own_half=own))
        value = float(squares[0])
        return statistics.root(statistics.Interval(value, value - own, value + own))

    def relative(self, sampler: str, n: int) -> Quantity:
        """RMSE with `n` rays in % of that of one random ray."""
        unit = self.unit.value
        return of_interval(statistics.Interval(*(end / unit for end in self.rmse(sampler, n))), "%")

    def divided(self, sampler: str, n: int, other: str, m: int) -> Quantity:
        """RMSE with `n` rays of one sampler over that with `m` of another."""
        return of_interval(statistics.ratio(*(self.rmse(*a) for a in ((sampler, n), (other, m)))))

    def cell(self, sampler: str, n: int) -> Quantity | str:
        """`relative` for a table; a dash where nothing was measured."""
        return self.relative(sampler, n) if n in self.counts[sampler] else "–"

    def slopes(self, fitted: Counts) -> dict[str, Quantity]:
        """Slope of the RMSE over the counts that are `fitted`, for each sampler."""
        return {sampler: self._slope(sampler, every) for sampler, every in fitted.items()}

    def _slope(self, sampler: str, every: Sequence[int]) -> Quantity:
        """With the noise of the truth in the worst case: it moves all points of the line at once.

        Not a number where a mean is not above 0: the truth is too noisy to be compared with.
        """
        squares = np.stack([self.at(sampler, n) for n in every], axis=1)
        means = squares.mean(0)
        if not (means > 0).all():
            n = every[int(np.argmin(means))]
            return Quantity(
                math.nan, math.inf, note=f"with {n} rays it is as good as the truth, which needs more"
            )
        if len(squares) > 1 and not (squares > 0).all():
            found = slope_of_root(every, squares)
        else:
            found = statistics.slope(every, np.sqrt(squares))
        u = np.log(every) - np.mean(np.log(every))
        own = sum(
            abs(w) * self._own[sampler, n] / (2 * m)
            for w, n, m in zip(u / (u @ u), every, means, strict=True)
        )
        # A sampler without noise has the noise of the truth only.
        half = found.half if len(squares) > 1 else 0.0
        return Quantity(found.value, math.hypot(half, own), note="slope of the RMSE")

    def curve(self, sampler: str, fitted: Counts) -> Curve:
        """For `error_curves`, in units of one random ray: marks and bars of `relative`, the slope of `slopes`."""
        counts, unit = self.counts[sampler], float(self._first.mean())
        drawn = measured(
            sampler, counts, self.squares[sampler] / unit, fit=[n in fitted[sampler] for n in counts]
        )
        marks = [self.relative(sampler, n) for n in counts]
        low, high = zip(*(mark.interval for mark in marks), strict=True)
        slope = self._slope(sampler, fitted[sampler])
        return replace(drawn, y=[m.value for m in marks], low=low, high=high, note=f"slope {slope}")
