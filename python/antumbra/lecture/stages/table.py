"""A table of numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from antumbra.lecture.stages.base import Part


@dataclass(frozen=True)
class Table(Part):
    """`head` over the columns, `rows` of text (the first cell names the row), a `foot` row, a `caption` that says what.

    `fine`: numbers of columns that slides leave out, and paper if there are many; `note`: a line under it; `sorted`:
    the column by which the rows stand, largest first, where a reader may sort by another one (0: not to be sorted).
    """

    kind = "table"
    data = True
    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    caption: str
    foot: Sequence[str] = ()
    fine: Sequence[int] = ()
    note: str = ""
    sorted: int = 0

    def __post_init__(self) -> None:
        """Every row has as many cells as there are columns."""
        wrong = [
            row for row in (*self.rows, *([self.foot] if self.foot else [])) if len(row) != len(self.head)
        ]
        if wrong:
            raise ValueError(
                f"{self.caption}: {wrong[0]} has {len(wrong[0])} cells for {len(self.head)} columns"
            )
