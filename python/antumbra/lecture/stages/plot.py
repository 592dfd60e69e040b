"""A plot, and a table of the same numbers beside it."""

from __future__ import annotations

from dataclasses import dataclass

from antumbra.lecture.stages.base import Drawing, Part
from antumbra.lecture.stages.table import Table


@dataclass(frozen=True)
class Plot(Part):
    """`drawing`: axes and curves on a viewBox near 620 × 440, or the `<svg>` of `antumbra.study.plot.error_curves`.

    `note` says what the bars mean; `table` holds the same numbers.
    """

    kind = "plot"
    data = True
    drawing: Drawing | str
    note: str = ""
    table: Table | None = None
