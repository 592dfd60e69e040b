"""What antumbra tells people of a scene, a picture or a render."""

from __future__ import annotations

from typing import NamedTuple


class Message(NamedTuple):
    """A note or warning about a scene: its `level`, the `place` in the file (may be empty), and what it says."""

    level: str
    place: str
    text: str


class Progress(NamedTuple):
    """How far a render is: `passes_done` of `passes`, and the `done` share of all work, 0 to 1."""

    passes_done: int
    passes: int
    done: float
