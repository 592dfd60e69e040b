"""How the error falls with the number of shadow rays: RMSE, ratios and fitted slopes of several samplers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.noise import squared_errors
from antumbra.lecture.measures.replicates import of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.study import statistics
from antumbra.study.plot import Curve, measured

Counts = Mapping[str, Sequence[int]]


class Errors:
    """Squared errors of the variants `sampler`-`n`, for n in `counts` of each sampler, against the variant "truth".

    The unit is one random ray: the first count of the first sampler.
    """

    def __init__(self, run: Run, counts: Counts) -> None:
        """Compares the pictures."""
        self.counts = counts
        self.squares = {
            sampler: np.stack([squared_errors(run, f"{sampler}-{n}", "truth") for n in every], axis=1)
            for sampler, every in counts.items()
        }
        self._first = self.squares[next(iter(counts))][:, 0]

    @property
    def unit(self) -> Quantity:
        """RMSE of one random ray [W·m⁻²·sr⁻¹]."""
        return of_interval(statistics.mean(np.sqrt(self._first)), "W·m⁻²·sr⁻¹")

    def at(self, sampler: str, n: int) -> NDArray[np.float64]:
        """RMSE of each replicate with `n` rays."""
        return np.sqrt(self.squares[sampler][:, self.counts[sampler].index(n)])

    def relative(self, sampler: str, n: int) -> Quantity:
        """RMSE with `n` rays in % of that of one random ray; of one replicate alone (without noise) exact."""
        found = of_interval(statistics.mean(self.at(sampler, n) / self.unit.value), "%")
        return found if np.isfinite(found.error) else Quantity(found.value, 0.0, "%")

    def divided(self, sampler: str, n: int, other: str, m: int) -> Quantity:
        """RMSE with `n` rays of one sampler over that with `m` of another."""
        return of_interval(
            statistics.ratio(*(statistics.mean(self.at(*a)) for a in ((sampler, n), (other, m))))
        )

    def slopes(self, fitted: Counts) -> dict[str, Quantity]:
        """Slope of the RMSE over the counts that are `fitted`, for each sampler."""
        of = {s: np.stack([self.at(s, n) for n in every], axis=1) for s, every in fitted.items()}
        return {
            s: of_interval(statistics.slope(fitted[s], e), note="slope of the RMSE") for s, e in of.items()
        }

    def curve(self, sampler: str, fitted: Counts) -> Curve:
        """For `error_curves`, in units of one random ray."""
        counts, unit = self.counts[sampler], float(self._first.mean())
        return measured(
            sampler, counts, self.squares[sampler] / unit, fit=[n in fitted[sampler] for n in counts]
        )
