"""Kinds of stage, what a figure shows between its question and its number: one file each, each with its template.

Row, Strip (a slider), Tabs, Plot, Table, Linked (rays over a picture and their table), Key. They hold what is shown;
`page/stages/KIND.html` is how.
"""

from __future__ import annotations

from antumbra.lecture.stages.base import Bar, Drawing, Part, Picture, plain
from antumbra.lecture.stages.drawing import Sketch
from antumbra.lecture.stages.key import Entry, Key
from antumbra.lecture.stages.linked import Linked
from antumbra.lecture.stages.plot import Plot
from antumbra.lecture.stages.row import Row
from antumbra.lecture.stages.strip import Frame, Strip
from antumbra.lecture.stages.table import Table
from antumbra.lecture.stages.tabs import Panel, Tabs

__all__ = [
    "Bar",
    "Drawing",
    "Entry",
    "Frame",
    "Key",
    "Linked",
    "Panel",
    "Part",
    "Picture",
    "Plot",
    "Row",
    "Sketch",
    "Strip",
    "Table",
    "Tabs",
    "plain",
]
