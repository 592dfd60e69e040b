"""A study of three variants that takes a moment."""

from __future__ import annotations

from typing import Any

SMALL: dict[str, Any] = {
    "vary": {"shadow_rays": [1, 2, 3]},
    "estimator": "area",
    "viewing_rays": 1,
    "size": (8, 6),
    "seeds": 3,
}
