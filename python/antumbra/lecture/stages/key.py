"""What the colours of a map mean, each with a word, a drawing and the number of the chosen frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from antumbra.lecture.stages.base import Drawing, Part


@dataclass(frozen=True)
class Entry(Part):
    """A `colour` of the page, its `name` and what it is; `fact`: the number of the frame's fact that it shows, or −1.

    `always`: what it says where it has no fact.
    """

    kind = "entry"
    colour: str
    name: str
    text: str
    drawing: Drawing | None = None
    fact: int = -1
    always: str = ""


@dataclass(frozen=True)
class Key(Part):
    """Up to four entries side by side; facts are those of the `strip` (its key) of the same figure."""

    kind = "key"
    entries: Sequence[Entry]
    strip: str = ""
    note: str = ""
