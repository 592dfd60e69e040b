"""How pictures and estimates show themselves in a notebook."""

from __future__ import annotations

import base64
import html
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from antumbra.estimate import Estimate
    from antumbra.image import Image

_WIDEST = 960


def image_html(image: Image) -> str:
    """The picture, its size, error and time."""
    data = base64.b64encode(image.png()).decode("ascii")
    width = min(image.width, _WIDEST)
    return (
        f'<figure><img width="{width}" alt="{html.escape(image.name)}" src="data:image/png;base64,{data}">'
        f"<figcaption>{html.escape(image.summary())}</figcaption></figure>"
    )


def estimate_html(estimate: Estimate) -> str:
    """The summary, and five numbers of the spread."""
    text = html.escape(repr(estimate).strip("<>"))
    if not estimate.size:
        return f"<p>{text}</p>"
    marks = np.quantile(estimate.values, [0.0, 0.25, 0.5, 0.75, 1.0])
    heads = "".join(f"<th>{name}</th>" for name in ("least", "quarter", "half", "three quarters", "most"))
    cells = "".join(f"<td>{mark:.3g}</td>" for mark in marks)
    return f"<p>{text}</p><table><tr>{heads}</tr><tr>{cells}</tr></table>"
