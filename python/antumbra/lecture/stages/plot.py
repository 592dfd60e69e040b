"""A plot, and a table of the same numbers beside it."""

from __future__ import annotations

from dataclasses import dataclass

from antumbra.lecture.stages.base import Drawing, Part
from antumbra.lecture.stages.table import Table
from antumbra.lecture.stages.tabs import Tabs


@dataclass(frozen=True)
class Plot(Part):
    """`drawing`: axes and curves on a viewBox near 620 × 440, or the `<svg>` of `antumbra.study.plot.error_curves`.

    `note` says what the bars mean; `table` holds the same numbers, or tabs of tables do.
    """

    kind = "plot"
    data = True
    drawing: Drawing | str
    note: str = ""
    table: Table | Tabs | None = None
