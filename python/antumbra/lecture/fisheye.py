"""The hemisphere over a receiver as a disk: equal areas are equal solid angles, or equal parts of ∫ cos θ dω."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.lecture.pictures import linear

# The ground around the disk, the sky without light, the light, what finds it, what does not.
GROUND, SKY, LIGHT, FOUND, MISSED = "#fdf1c4", "#141a2e", "#f2b705", "#15181f", "#8ea9d1"
_FINER = 3


class Fisheye:
    """A picture of `side` pixels: straight up in the middle, the horizon as the rim, +x at the right, +z up."""

    def __init__(self, side: int, cosine: bool = False) -> None:
        """An empty sky; `cosine`: the hemisphere from straight above, equal areas are equal parts of ∫ cos θ dω."""
        from PIL import Image, ImageDraw

        self.side, self._cosine, wide = side, cosine, side * _FINER
        self._image = Image.new("RGB", (wide, wide), GROUND)
        self._draw = ImageDraw.Draw(self._image)
        self._radius = 0.49 * wide
        self._disk((0.0, 0.0), self._radius, SKY)

    def fill(self, lit: ArrayLike, colour: str) -> None:
        """Colours what is `lit` of the hemisphere from straight above, (S, S) as `geometry.seen_from_above` has it."""
        from PIL import Image

        cells = np.asarray(lit, bool)
        x = (np.arange(self.side * _FINER) + 0.5 - self._middle) / self._radius
        at = np.clip(np.floor((x + 1) / 2 * len(cells)).astype(np.int64), 0, len(cells) - 1)
        shown = cells[np.ix_(at, at)] & (x**2 + x[:, None] ** 2 < 1.0)
        self._image.paste(colour, mask=Image.fromarray(shown))

    def outline(self, along: ArrayLike, colour: str = LIGHT) -> None:
        """Fills the outline through directions (N, 3)."""
        self._draw.polygon([(x, y) for x, y in self._places(along)], fill=colour)

    def dots(self, along: ArrayLike, omega: Iterable[float], colour: str) -> None:
        """A dot for each direction (N, 3), as large as a solid angle of `omega` [sr] is here."""
        for place, angle in zip(self._places(along), omega, strict=True):
            self._disk(place - self._middle, self._radius * math.sqrt(angle / (2 * math.pi)), colour)

    def crosses(self, along: ArrayLike, colour: str) -> None:
        """A small cross for each direction (N, 3)."""
        arm = 0.006 * self._radius * 2
        for x, y in self._places(along):
            for slope in (1, -1):
                self._draw.line(
                    (x - arm, y - slope * arm, x + arm, y + slope * arm), fill=colour, width=_FINER
                )

    def rings(self, *angles: float) -> None:
        """Thin circles at angles θ from straight up."""
        for theta in angles:
            r, m = self._radius * math.sqrt(1 - math.cos(theta)), self._middle
            self._draw.ellipse((m - r, m - r, m + r, m + r), outline="#4e70aa", width=_FINER)

    def radiance(self) -> NDArray[np.float64]:
        """The picture as linear numbers (H, W, 3), white 1, for `Run.picture`."""
        from PIL import Image

        small = self._image.resize((self.side, self.side), Image.Resampling.BOX)
        shown = np.asarray(small, np.float64) / 255
        return linear(shown)

    @property
    def _middle(self) -> float:
        return self.side * _FINER / 2

    def _places(self, along: ArrayLike) -> NDArray[np.float64]:
        """Lambert's equal-area projection: distance √(1 − cos θ) from the middle; from above: distance sin θ."""
        d = np.asarray(along, np.float64)
        d = d / np.linalg.norm(d, axis=1, keepdims=True)
        if self._cosine:
            seen: NDArray[np.float64] = self._middle + self._radius * d[:, [0, 2]] * [1.0, -1.0]
            return seen
        # √(1 − cos θ) / sin θ = 1 / √(1 + cos θ).
        flat = d[:, [0, 2]] / np.sqrt(1 + d[:, 1:2]) * [1.0, -1.0]
        places: NDArray[np.float64] = self._middle + self._radius * flat
        return places

    def _disk(self, offset: Any, radius: float, colour: str) -> None:
        x, y = (self._middle + float(v) for v in offset)
        self._draw.ellipse((x - radius, y - radius, x + radius, y + radius), fill=colour)
