"""Rays over a picture, and their table: a row and its ray are one thing."""

from __future__ import annotations

from dataclasses import dataclass

from antumbra.lecture.stages.base import Drawing, Part, Picture
from antumbra.lecture.stages.table import Table


@dataclass(frozen=True)
class Linked(Part):
    """`overlay` has groups `<g class="rg1" data-j="i">` (`Sketch.linked`), one for each row i of `table`.

    `key` names the row in the address; `note`: a line under the picture.
    """

    kind = "linked"
    key: str
    picture: Picture
    overlay: Drawing
    table: Table
    note: str = ""
