"""Tabs: one of several panels is seen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from antumbra.lecture.stages.base import Part


@dataclass(frozen=True)
class Panel(Part):
    """One tab: its `value` in the address (a word), its `name` on the button, its parts.

    `late`: it says the answer, so its button comes with it.
    """

    kind = "panel"
    value: str
    name: str
    parts: Sequence[Part]
    late: bool = False


@dataclass(frozen=True)
class Tabs(Part):
    """`key` names the value in the address, `label` says what is chosen.

    A `Plot` of the same figure whose curves carry `data-s` = a panel's value shows that curve as the chosen one.
    """

    kind = "tabs"
    key: str
    label: str
    panels: Sequence[Panel]
