"""Shadows taken apart: which part of a light a point sees (`Region`), and what `Scene` answers about it."""

from __future__ import annotations

import operator
from enum import IntEnum
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra import settings
from antumbra._arrays import matching, per_row, places, starts
from antumbra.hit import Hit, Receivers

if TYPE_CHECKING:
    from antumbra import _core
    from antumbra.explanation import Explanation


class Region(IntEnum):
    """What stands in `image.aov["regions"]` and in `Scene.regions`."""

    NONE = -1
    """Nothing is met there, or the light does not shine there: from its dark side, or below the horizon."""
    UMBRA = 0
    """Nothing of the light is visible."""
    PENUMBRA = 1
    """Some of it."""
    ANTUMBRA = 2
    """Its whole outline, but not all of its inside: a ring of light stands all around the occluder."""
    LIT = 3
    """All of it."""


class Visits(NamedTuple):
    """What each segment visited, as `Scene.visits` describes."""

    any_boxes: NDArray[np.uint32]
    any_primitives: NDArray[np.uint32]
    closest_boxes: NDArray[np.uint32]
    closest_primitives: NDArray[np.uint32]
    blocked: NDArray[np.bool_]


class Anatomy:
    """The part of `Scene` that takes shadows apart."""

    _core: _core.Scene

    def regions(
        self,
        points: ArrayLike | Hit | Receivers,
        normals: ArrayLike | None = None,
        *,
        light: str | int = 0,
        n: int = 64,
        **options: Any,
    ) -> NDArray[np.int8]:
        """Umbra, penumbra, antumbra or lit with regard to one light, (N,) int8 of `Region`.

        `n` points inside the light and `n` on its outline, the same ones from everywhere: none visible is the umbra,
        all visible is lit, the whole outline but not all of the inside is the antumbra, anything else the penumbra.
        What is thinner than the distance of two such points may be missed. A light point below a point's horizon is
        not visible. `light`: its name, or its number in the order of building.

        >>> import antumbra as am
        >>> scene = am.builtin("eclipse", distance=356_500)
        >>> am.Region(scene.regions([[6371.001, 0, 0]], [[1, 0, 0]])[0]).name
        'UMBRA'
        """
        start, facing, _ = places(points, normals)
        words = settings.words({"region_points": n, **options})
        return self._core.regions(start, facing, str(light), list(words.items()))

    def visits(
        self,
        origins: ArrayLike | Hit | Receivers,
        targets: ArrayLike | None = None,
        *,
        directions: ArrayLike | None = None,
        max_distance: ArrayLike = np.inf,
    ) -> Visits:
        """What segments cost: boxes and primitives tested to learn whether anything blocks (any hit), and what is first
        (closest hit).

        Takes what `occluded` takes. Gives `any_boxes`, `any_primitives`, `closest_boxes`, `closest_primitives`, (N,)
        uint32 each, and `blocked` (N,) bool, the answer of `occluded`. A free segment gains nothing by any hit. The
        counts are those of the exact traversal in double precision, one segment after the other; alpha masks count as
        opaque there.

        >>> import antumbra as am
        >>> found = am.builtin("pillars").visits([[-3.0, 0.3, 0], [0, 5, 0]], [[3.0, 0.3, 0], [0, 6, 0]])
        >>> bool((found.any_boxes <= found.closest_boxes).all())
        True
        """
        start, ends, reach = self._segments(origins, targets, directions, max_distance)
        counts, blocked = self._core.visits(start, ends, reach)
        any_boxes, any_primitives, closest_boxes, closest_primitives = counts.T
        return Visits(any_boxes, any_primitives, closest_boxes, closest_primitives, blocked)

    def explain(self, pixel: tuple[int, int], **options: Any) -> Explanation:
        """One pixel (column, row from the upper left) taken apart.

        Every viewing ray, its receiver, and every ray to a light with each factor of what it brings; their sum is the
        pixel of `render` with the same options and seed. Options as in `render`; direct light only: `estimator` "area"
        (the default here), "hemisphere" or "mis".

        Raises SceneError for another estimator, for a pixel outside the picture and for more than a million rows.

        >>> import antumbra as am
        >>> found = am.builtin("pillars").explain((250, 300), viewing_rays=1, shadow_rays=4)
        >>> len(found.light_rays), found.viewing_rays[0].receiver.object
        (4, 'floor')
        """
        from antumbra.explanation import Explanation

        words = settings.words({"estimator": "area", **options})
        column, row = (operator.index(x) for x in pixel)
        if min(column, row) < 0:
            raise ValueError(f"pixel is ({column}, {row}): column and row count from 0")
        found = self._core.explain((column, row), list(words.items()))
        return Explanation(self._core.name, (column, row), found, words)

    def _segments(
        self, origins: Any, targets: Any, directions: Any, max_distance: Any
    ) -> tuple[Any, Any, NDArray[np.float64] | None]:
        """Starts, ends and reach of segments to targets or along directions."""
        if (targets is None) == (directions is None):
            raise ValueError("one of targets and directions is needed")
        start, count = starts(origins)
        if targets is not None:
            return start, matching("targets", targets, "origins", count), None
        along = matching("directions", directions, "origins", count)
        return start, along, per_row("max_distance", max_distance, count)
