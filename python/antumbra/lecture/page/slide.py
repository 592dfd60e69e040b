"""How much of a slide its pictures get: columns of a long row, heights of what stands around them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import ceil
from typing import Any

# Of a slide of 1280 × 720: what the pictures have of it, and the gap between them [px].
_WIDTH, _HEIGHT, _GAP = 1184, 520, 24
# Its type is 28 px: a line, the mean width of a character, of a bold one, the space over a caption [px].
_LINE, _CHARACTER, _BOLD, _OVER = 34, 15, 17, 8
# A slider, a key, a line of tabs, a colour bar and each more line of it [px].
_SLIDER, _KEY, _TABS, _BAR, _NAME = 52, 70, 64, 60, 40
# What a tab has beside its name [px].
_BUTTON = 52


def columns(pictures: Sequence[Mapping[str, Any]]) -> int:
    """In how many columns equally wide pictures, each over its caption, are seen largest; the highest decides."""
    ratio: float = min(p["width"] / p["height"] for p in pictures)

    def wide(count: int) -> float:
        rows, width = ceil(len(pictures) / count), (_WIDTH - _GAP * (count - 1)) / count
        return min(width, ratio * (_HEIGHT - _TABS - rows * _under(pictures, width)) / rows)

    return max(range(1, len(pictures) + 1), key=wide)


def rest(stage: Sequence[Mapping[str, Any]]) -> tuple[int, int]:
    """What is not picture of a stage's height [px]: on the slide of the pictures, and on that of the number.

    There the key is gone. Of tabs it is that of the buttons; `own` is that of a panel.
    """
    return _around(stage, whole=True), _around(stage, whole=False)


def own(panel: Mapping[str, Any]) -> int:
    """What is not picture of the height of a panel of tabs [px]."""
    return _around(panel["parts"], whole=True)


def _around(parts: Sequence[Mapping[str, Any]], whole: bool) -> int:
    """Height of what stands above and below the pictures of these parts, the key among it or not."""
    height = 0
    for part in parts:
        kind = part["kind"]
        if kind == "key":
            height += whole * _KEY
        elif kind == "tabs":
            names = sum(_CHARACTER * len(panel["name"]) + _BUTTON for panel in part["panels"])
            height += _TABS * ceil(names / _WIDTH)
        elif kind == "strip":
            bars = (_bar(picture) for frame in part["frames"] for picture in frame["pictures"])
            height += _SLIDER + _labels(part) + max(bars)
        elif kind == "row":
            pictures, count = part["pictures"], columns(part["pictures"])
            rows, width = ceil(len(pictures) / count), (_WIDTH - _GAP * (count - 1)) / count
            height += rows * _under(pictures, width) + _OVER * (rows - 1) + max(map(_bar, pictures))
    return height


def _labels(strip: Mapping[str, Any]) -> int:
    """Height of the labels over the columns of a slider; a drawing's own is about twice as wide as the others."""
    if not strip["labels"]:
        return 0
    first = strip["frames"][0]
    width = _WIDTH / (len(first["pictures"]) + 2 * bool(first["drawing"]))
    return _OVER + _LINE * max(ceil(_BOLD * len(label) / width) for label in strip["labels"])


def _under(pictures: Sequence[Mapping[str, Any]], width: float) -> int:
    """Height of the captions of a row."""
    lines = max(ceil(_CHARACTER * len(p.get("caption", "")) / width) for p in pictures)
    return lines and _OVER + _LINE * lines


def _bar(picture: Mapping[str, Any]) -> int:
    """Height of a colour bar: a line more for its unit, one for each name."""
    bar = picture.get("bar")
    return (_BAR + _NAME * (bool(bar["unit"]) + bool(bar["names"]))) if bar else 0
