"""How pictures and estimates show themselves in a notebook."""

from __future__ import annotations

import base64
import html
from typing import Any

import numpy as np
from numpy.typing import NDArray

_WIDEST = 960


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
