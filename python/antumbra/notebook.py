"""How scenes, pictures and estimates show themselves in a notebook."""

from __future__ import annotations

import base64
import html
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra._words import significant
from antumbra.messages import Message

_WIDEST = 960
_MOST = 8


def image_html(png: bytes, width: int, name: str, summary: str) -> str:
    """The picture, `width` pixels wide, over its size, error and time."""
    data = base64.b64encode(png).decode("ascii")
    return (
        f'<figure><img width="{min(width, _WIDEST)}" alt="{html.escape(name)}" src="data:image/png;base64,{data}">'
        f"<figcaption>{html.escape(summary)}</figcaption></figure>"
    )


def estimate_html(summary: str, values: NDArray[Any]) -> str:
    """The summary, and five numbers of the spread of `values`, any shape."""
    text = html.escape(summary)
    if not values.size:
        return f"<p>{text}</p>"
    marks = np.quantile(values, [0.0, 0.25, 0.5, 0.75, 1.0])
    heads = "".join(f"<th>{name}</th>" for name in ("least", "quarter", "half", "three quarters", "most"))
    cells = "".join(f"<td>{mark:.3g}</td>" for mark in marks)
    return f"<p>{text}</p><table><tr>{heads}</tr><tr>{cells}</tr></table>"


def scene_html(title: str, found: dict[str, Any], messages: Iterable[Message]) -> str:
    """What is in a scene (`found`: its info): its lights and cameras by name, what looks wrong, what was said of it."""
    rows = [
        ("lights", _names(f"{light['name']} ({light['kind']})" for light in found["lights"])),
        ("cameras", _names(camera["name"] for camera in found["cameras"])),
        ("size", _size(found["bounds"])),
        ("looks wrong", "; ".join(found["looks_wrong"])),
        *((said.level, ": ".join(part for part in (said.place, said.text) if part)) for said in messages),
    ]
    lines = "".join(
        f"<tr><th>{html.escape(name)}</th><td>{html.escape(text)}</td></tr>" for name, text in rows if text
    )
    return f"<p>{html.escape(title)}</p><table>{lines}</table>"


def _names(names: Iterable[str]) -> str:
    listed = list(names)
    more = [f"{len(listed) - _MOST:,} more"] if len(listed) > _MOST else []
    return ", ".join(listed[:_MOST] + more)


def _size(bounds: list[list[float]] | None) -> str:
    if bounds is None:
        return ""
    low, high = bounds
    sides = (significant(top - bottom) for bottom, top in zip(low, high, strict=True))
    return f"{' × '.join(sides)} units"
