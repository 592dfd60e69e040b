"""An equation among the pictures, the term that a panel is about marked."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from antumbra.lecture.stages.base import Part


@dataclass(frozen=True)
class Formula(Part):
    """`lines` and `why` as in `figure.Equation`; slides leave it out."""

    kind = "formula"
    lines: Sequence[tuple[str, str]]
    why: str
