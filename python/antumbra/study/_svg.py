"""Turns the plotting library's SVG into a small element for a page: classes in place of colours and fonts."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from html import escape
from typing import TYPE_CHECKING
from xml.etree import ElementTree

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SVG, _LINK = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}href"
_NUMBER = re.compile(r"-?\d+\.\d+|-?\d+")


def converted(figure: Figure, names: list[str], on: str, label: str) -> str:
    """One `<svg>` with what has a gid `antumbra|CURVE|CLASS`, each curve in a group of its own, behind the rest."""
    file = io.StringIO()
    figure.savefig(file, format="svg", metadata={"Date": None, "Creator": None})
    root = ElementTree.fromstring(file.getvalue())
    # A shape stands where it is used first, and later curves point there.
    shapes = {path.get("id"): path.get("d", "") for path in root.iterfind(f".//{_SVG}defs/{_SVG}path")}
    shared: list[str] = []
    groups: list[list[str]] = [[] for _ in names]
    for group in root.iter(f"{_SVG}g"):
        mark, _, rest = group.get("id", "").partition("|")
        if mark == "antumbra":
            number, _, kind = rest.partition("|")
            (groups[int(number)] if number else shared).extend(_elements(group, kind, shapes))
    width, height = (round(float(v)) for v in root.get("viewBox", "0 0 0 0").split()[2:])
    curves = (
        f'<g data-s="{escape(name)}"{" class=on" if name == on else ""}>{"".join(parts)}</g>'.replace(
            "class=on", 'class="on"'
        )
        for name, parts in zip(names, groups, strict=True)
    )
    return (
        f'<svg class="plot" viewBox="0 0 {width} {height}" role="img" aria-label="{escape(label)}">'
        f"{''.join(shared)}{''.join(curves)}</svg>"
    )


def _elements(group: ElementTree.Element, kind: str, shapes: Mapping[str | None, str]) -> list[str]:
    named = f' class="{kind}"' if kind else ""
    found = []
    for path in group.findall(f"{_SVG}path"):
        found.append(f'<path{named} d="{_short(path.get("d", ""))}"/>')
    for use in group.iter(f"{_SVG}use"):
        shape = _short(shapes[use.get(_LINK, "")[1:]])
        x, y = _short(use.get("x", "0")), _short(use.get("y", "0"))
        found.append(f'<path{named} transform="translate({x} {y})" d="{shape}"/>')
    for text in group.iter(f"{_SVG}text"):
        found.append(_text(text, named))
    return found


def _text(text: ElementTree.Element, named: str) -> str:
    anchor = re.search(r"text-anchor: *(middle|end)", text.get("style", ""))
    side = f' text-anchor="{anchor[1]}"' if anchor else ""
    x, y = _short(text.get("x", "0")), _short(text.get("y", "0"))
    return f'<text{named} x="{x}" y="{y}"{side}>{escape("".join(text.itertext()))}</text>'


def _short(numbers: str) -> str:
    """Numbers to one decimal, white space once."""
    text = _NUMBER.sub(lambda n: f"{float(n[0]):.1f}".removesuffix(".0"), numbers)
    return " ".join(text.split()).replace("-0 ", "0 ")
