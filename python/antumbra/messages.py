"""What antumbra tells people of a scene or a picture."""

from __future__ import annotations

from typing import NamedTuple


class Message(NamedTuple):
    """A note or warning about a scene: its `level`, the `place` in the file (may be empty), and what it says."""

    level: str
    place: str
    text: str
