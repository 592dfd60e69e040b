"""What is believed of a kept record: a folder may come from somebody else and say anything."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any
from xml.etree import ElementTree

# Where a figure's files lie: a plain name in one of two folders.
_PLACE = re.compile(r"(pictures|exr)/[^./\\:\0][^/\\:\0]*")
# What the page and lecture.json take from every record, and from that of a figure.
_ALL: dict[str, type | tuple[type, ...]] = {
    "key": str, "antumbra": str, "quick": bool, "seed": int, "seconds": (int, float), "rays": int, "files": list,
    "stage": list,
}  # fmt: skip
_FIGURE: dict[str, type | tuple[type, ...]] = {
    "number": int, "chapter": int, "title": str, "question": dict, "answer": dict, "equation": dict, "claims": list,
    "numbers": dict, "command": str, "exr": list,
}  # fmt: skip
# What drawings are made of.
_ELEMENTS = {"svg", "g", "path", "line", "circle", "rect", "polygon", "text", "tspan"}
_ATTRIBUTES = {
    "aria-label", "class", "cx", "cy", "d", "data-j", "data-s", "fill", "height", "opacity", "points", "r", "role",
    "stroke",
    "stroke-dasharray", "stroke-width", "style", "text-anchor", "transform", "viewBox", "width", "x", "y",
}  # fmt: skip


def is_record(found: Any, name: str, form: int) -> bool:
    """Whether it is what a lecture keeps of this figure or opening: nothing missing, all files in their places, the
    pictures that it shows among them, and drawings that only draw.
    """
    if not isinstance(found, dict) or (found.get("form"), found.get("name")) != (form, name):
        return False
    asked = _ALL | ({} if name.startswith("chapter-") else _FIGURE)
    if not all(isinstance(found.get(what), kind) for what, kind in asked.items()):
        return False
    files = found["files"]
    if not all(isinstance(f, str) and _PLACE.fullmatch(f) for f in files):
        return False
    if not (
        math.isfinite(found["seconds"]) and found["seconds"] >= 0 and _are_claims(found.get("claims", []))
    ):
        return False
    shown = [*_of(found["stage"], "file"), *found.get("exr", [])]
    return all(file in files for file in shown) and all(map(only_draws, _drawings(found["stage"])))


def _are_claims(claims: list[Any]) -> bool:
    texts = ("text", "verdict", "measured")
    return all(isinstance(c, dict) and all(isinstance(c.get(t), str) for t in texts) for c in claims)


def _of(part: Any, name: str) -> Iterator[Any]:
    """What stands under a name in a stage, however deep."""
    if isinstance(part, Mapping):
        if name in part:
            yield part[name]
        part = list(part.values())
    if isinstance(part, list):
        for inner in part:
            yield from _of(inner, name)


def _drawings(stage: Any) -> Iterator[Any]:
    """All SVG of a stage: inside of drawings, and whole plots."""
    yield from _of(stage, "svg")
    yield from (drawing for drawing in _of(stage, "drawing") if isinstance(drawing, str))


def only_draws(svg: Any) -> bool:
    """Whether SVG has only elements and attributes that the lecture's drawings have: no script, no address."""
    if not isinstance(svg, str) or "<!" in svg or "<?" in svg:
        return False
    try:
        root = ElementTree.fromstring(f"<g>{svg}</g>")
    except ElementTree.ParseError:
        return False
    return all(
        each.tag in _ELEMENTS
        and all(name in _ATTRIBUTES and "url" not in value.lower() for name, value in each.items())
        for each in root.iter()
    )
