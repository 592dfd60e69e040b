"""Pictures side by side at one scale, each with its caption."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from antumbra.lecture.stages.base import Drawing, Part, Picture


@dataclass(frozen=True)
class Row(Part):
    """`pictures` of one height; more than three stand in two rows on a phone and on slides. `note`: a line below."""

    kind = "row"
    pictures: Sequence[Picture | Drawing]
    note: str = ""
