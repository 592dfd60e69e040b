"""What a study found: its rows, curves, slopes, biases; as CSV and JSON."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from antumbra.study import statistics
from antumbra.study.bias import Bias
from antumbra.study.plot import Curve
from antumbra.study.rows import Row, blunt, untested
from antumbra.study.statistics import Interval


@dataclass(frozen=True)
class Findings:
    """A table of error against rays and seconds.

    `rows`: one per variant; `axis`: what is on the axis of the plots (a setting, `budget`, or nothing); `varied`: the
    names and values; `reference`: what it was held against, in words; `messages`: notes and warnings (level, place,
    text); `complete`: False if it was stopped before all rows were done; `command`: how it was called, if known;
    `pilots`: what short renders found before it began.
    """

    scene: str
    size: tuple[int, int]
    seeds: int
    axis: str
    varied: dict[str, list[str]]
    fixed: dict[str, str]
    reference: str
    rows: list[Row] = field(default_factory=list)
    messages: list[tuple[str, str, str]] = field(default_factory=list)
    complete: bool = True
    budget: str = ""
    fingerprint: str = ""
    command: str = ""
    pilots: dict[str, Any] = field(default_factory=dict)

    def curves(self) -> dict[str, list[Row]]:
        """The rows of each curve in the order of the axis, by name: the values that are not on the axis."""
        found: dict[str, list[Row]] = {}
        for row in self.rows:
            found.setdefault(self.name_of(row), []).append(row)
        return {name: sorted(rows, key=lambda r: r.n or 0.0) for name, rows in found.items()}

    def name_of(self, row: Row) -> str:
        """The curve that a row belongs to: `area · owen`, `light-size 0.5`."""
        several = [n for n, values in self.varied.items() if len(values) > 1 and n != self.axis]
        words = [_said(n, row.values[n]) for n in several]
        return " · ".join(words) or self.fixed.get("estimator", "path")

    def flagged(self) -> list[Row]:
        """Rows whose mean differs from the reference by more than noise explains."""
        return [r for r in self.rows if r.bias is not None and r.bias.flagged]

    def black(self) -> list[Row]:
        """Rows that found no light where too few samples tell why, and those whose reference found none."""
        return [r for r in self.rows if r.black]

    def tested(self) -> bool:
        """Whether bias was tested anywhere: there is a reference, and enough samples found light."""
        return any(r.tested for r in self.rows)

    def untested(self) -> float:
        """The share of tiles, of all rows with a reference, where bias could not be tested; 0 without a reference."""
        return untested(self.rows)

    def untestable(self) -> float:
        """How large a bias may be that noise hides, as a part of the mean, where that is more than 5 %; else 0."""
        return blunt(self.rows)

    def reference_error(self) -> tuple[float, float] | None:
        """The standard error of the reference [W·m⁻²·sr⁻¹], a pixel, and the largest part of a row's noise that it is.

        None without a reference, or where nothing is known of its noise.
        """
        known = [r for r in self.rows if r.mse is not None and r.reference_variance > 0]
        if not known:
            return None
        parts = [r.reference_variance / r.variance.value for r in known if r.noisy]
        most = max(r.reference_variance for r in known)
        return math.sqrt(most), math.sqrt(max(parts)) if parts else math.inf

    def error(self, row: Row) -> Interval | None:
        """Root mean square error (RMSE) of a row against the reference; None without one. `Row.noise` needs none."""
        return row.rmse

    def slope(self, name: str) -> Interval | None:
        """Slope of log variance against log N of a curve: −1 for independent samples. Of the noise it is half of that.

        None where it cannot be fitted: N is not a number of rays, or there is a bias, which more rays do not reduce.
        """
        rows = self.curves()[name]
        if not self._fits(rows):
            return None
        return statistics.variance_slope([r.n or 0.0 for r in rows], _variances(rows))

    def _unbiased(self, rows: Sequence[Row]) -> bool:
        return all(r.noisy and not (r.bias and r.bias.flagged) for r in rows)

    def _fits(self, rows: Sequence[Row]) -> bool:
        of_rays = self.axis in ("shadow_rays", "viewing_rays", "budget") and len(rows) > 1
        return of_rays and self._unbiased(rows) and bool((_variances(rows) > 0).all())

    def most_efficient(self) -> Row | None:
        """The row of the greatest 1/(variance × seconds), among those without a bias."""
        fit = [r for rows in self.curves().values() if self._unbiased(rows) for r in rows]
        return max(fit, key=lambda r: r.efficiency.value, default=None)

    def plot_curves(self, over: str = "axis") -> list[Curve]:
        """For `plot.error_curves`, over the axis or "seconds": marks are the RMSE, or without reference the noise.

        The line is the power law of the noise.
        """
        return [self._curve(name, rows, over) for name, rows in self.curves().items()]

    def _curve(self, name: str, rows: Sequence[Row], over: str) -> Curve:
        x = [r.seconds.value if over == "seconds" else r.n or 0.0 for r in rows]
        nothing = Interval(math.nan, math.nan, math.nan)
        known = [r.rmse if r.mse else r.noise for r in rows]
        errors = [e if e and e.value > 0 else nothing for e in known]
        y, low, high = ([float(e[i]) for e in errors] for i in range(3))
        bars = (low, high) if all(r.noisy for r in rows) else ([], [])
        slope = self.slope(name) if over == "axis" else None
        if slope is None:
            return Curve(name, x, y, *bars, note=self._without_slope(rows))
        line = statistics.variance_line(x, _variances(rows), np.geomspace(min(x), max(x), 24))
        half = Interval(slope.value / 2, slope.low / 2, slope.high / 2)
        return Curve(name, x, y, *bars, line, f"slope {half}")

    def _without_slope(self, rows: Sequence[Row]) -> str:
        if any(r.bias and r.bias.flagged for r in rows):
            return "biased" if any(r.noisy for r in rows) else "the same error each time"
        return "" if all(r.noisy for r in rows) else "no noise"

    def csv(self) -> str:
        """One line per row, for a spreadsheet."""
        file = io.StringIO()
        lines = [flat(self, row) for row in self.rows]
        writer = csv.DictWriter(file, lines[0].keys() if lines else ["empty"], lineterminator="\n")
        writer.writeheader()
        writer.writerows(lines)
        return file.getvalue()

    def json(self) -> str:
        """Everything, with stable keys: intervals as [value, low, high], what is unknown as null."""
        whole: dict[str, Any] = {
            "scene": self.scene, "size": list(self.size), "seeds": self.seeds, "axis": self.axis,
            "varied": self.varied, "fixed": self.fixed, "budget": self.budget, "reference": self.reference,
            "reference_error": self.reference_error(), "complete": self.complete,
            "messages": [list(m) for m in self.messages],
            "variance_slopes": {name: self.slope(name) for name in self.curves()},
            "rows": [row.as_json() for row in self.rows], "command": self.command, "fingerprint": self.fingerprint,
            "pilots": self.pilots,
        }  # fmt: skip
        return json.dumps(_plain(whole), indent=1, ensure_ascii=False) + "\n"

    def __repr__(self) -> str:
        """`<Study of pillars: 12 rows × 8 seeds, 1 flagged>`."""
        state = "" if self.complete else ", stopped"
        flagged = f", {len(self.flagged())} flagged as biased" if self.flagged() else ""
        return f"<Study of {self.scene}: {len(self.rows)} rows × {self.seeds} seeds{flagged}{state}>"


def _said(name: str, value: str) -> str:
    """A value as a curve's name has it: words alone, numbers with what they are of."""
    shown = name.removeprefix("D.").replace("_", "-")
    try:
        return f"{shown} {float(value):g}"
    except ValueError:
        return f"{shown} {value}" if value in ("on", "off", "none") else value


def flat(study: Findings, row: Row) -> dict[str, str | float]:
    """A row as a line of the CSV."""
    line: dict[str, str | float] = {"curve": study.name_of(row)}
    line |= {name.replace("_", "-"): value for name, value in row.values.items()}
    line |= {} if row.budget is None else {"budget": row.budget}
    line |= {"viewing-rays": row.viewing_rays, "shadow-rays": row.shadow_rays, "rays-per-pixel": row.rays}
    for name in ("seconds", "variance", "noise", "mse", "rmse", "efficiency"):
        found: Interval = getattr(row, name) or Interval(math.nan, math.nan, math.nan)
        line |= {name: found.value, f"{name}-low": found.low, f"{name}-high": found.high}
    line["reference-variance"] = row.reference_variance
    if row.bias is not None:
        line |= {"bias": row.bias.difference.value, "bias-low": row.bias.difference.low,
                 "bias-high": row.bias.difference.high, "bias-p": row.bias.p,
                 "bias-tested": row.bias.tested, "biased": _answer(row.bias)}  # fmt: skip
    return line


def _answer(bias: Bias) -> str:
    if not bias.tested:
        return "not tested"
    return "yes" if bias.flagged else "no"


def _variances(rows: Sequence[Row]) -> Any:
    return np.array([r.variances for r in rows]).T


def _plain(value: Any) -> Any:
    """For JSON, which has no NaN and no infinity."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _plain(v) for key, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    return value
