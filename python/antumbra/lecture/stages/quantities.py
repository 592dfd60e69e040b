"""Tables and curves of measured quantities, and tabs that hold one row of pictures each."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.lecture.quantity import Quantity
from antumbra.lecture.stages.base import Picture
from antumbra.lecture.stages.row import Row
from antumbra.lecture.stages.table import Table
from antumbra.lecture.stages.tabs import Panel, Tabs
from antumbra.study.plot import Curve
from antumbra.study.statistics import Line


def table_of(
    head: Sequence[str],
    rows: Mapping[str, Sequence[Quantity | str]],
    caption: str,
    *,
    foot: Sequence[str] = (),
    fine: Sequence[int] = (),
    note: str = "",
    bare: bool = False,
    sorted_by: int = 0,
) -> Table:
    """A table with a row of quantities for each name, errors with one digit; `bare`: units stand in the head."""

    def cell(of: Quantity | str) -> str:
        if isinstance(of, str):
            return of
        return " ± ".join(filter(None, of.number(1))) if bare else f"{of:1}"

    text = [[name, *map(cell, cells)] for name, cells in rows.items()]
    return Table(head, text, caption, foot, fine, note, sorted_by)


def tabs_of(
    key: str,
    label: str,
    rows: Mapping[str, tuple[str, Sequence[Picture]]],
    late: Collection[str] = (),
) -> Tabs:
    """Tabs of one row of pictures each: by value, the name on the button and the pictures; `late` ones answer."""
    panels = [Panel(value, name, [Row(cells)], value in late) for value, (name, cells) in rows.items()]
    return Tabs(key, label, panels)


def curve_of(
    name: str,
    x: Sequence[float],
    found: Sequence[Quantity],
    exact: Callable[[NDArray[np.float64]], ArrayLike],
    note: str = "",
) -> Curve:
    """Measured marks with their 95 % bars, and the closed form as a line through x from its first to its last."""
    at = np.geomspace(x[0], x[-1], 40)
    line = np.asarray(exact(at), np.float64)
    low, high = zip(*(quantity.interval for quantity in found), strict=True)
    return Curve(name, x, [q.value for q in found], low, high, Line(at, line, line, line), note)
