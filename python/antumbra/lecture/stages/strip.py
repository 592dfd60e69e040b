"""A slider: a strip of precomputed frames, one of which is seen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from antumbra.lecture.stages.base import Drawing, Part, Picture


@dataclass(frozen=True)
class Frame(Part):
    """One position of a slider.

    `value`: as it stands in the address; `says`: the readout, the value and what it means; `more`: added for the ear;
    `short`: on paper; `drawing` beside the pictures; `facts`: for the entries of a `Key` of the same figure; `term`:
    which marked term of the figure's equation is lit (−1: all).
    """

    kind = "frame"
    value: str
    says: str
    pictures: Sequence[Picture]
    short: str = ""
    more: str = ""
    drawing: Drawing | None = None
    facts: Sequence[str] = ()
    term: int = -1


@dataclass(frozen=True)
class Strip(Part):
    """12–16 frames: `key` names the value in the address, `label` the slider, `labels` what stands over the columns.

    The frame `begins` is seen first and gives no answer away; six frames are printed, that among them which `tells`
    what the numbers are of (−1: none in particular).
    """

    kind = "strip"
    key: str
    label: str
    frames: Sequence[Frame]
    labels: Sequence[str] = ()
    note: str = ""
    tells: int = -1
    begins: int = 0

    def __post_init__(self) -> None:
        """All frames have the same columns, and the values differ."""
        if len({(len(f.pictures), f.drawing is None) for f in self.frames}) != 1:
            raise ValueError(f"{self.key}: the frames have different columns")
        if len({f.value for f in self.frames}) != len(self.frames):
            raise ValueError(f"{self.key}: two frames have the same value")
