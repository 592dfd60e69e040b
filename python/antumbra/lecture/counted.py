"""A scene that counts the rays of every query that it is asked: `counted`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra.anatomy import Visits
from antumbra.estimate import Estimate
from antumbra.explanation import Explanation
from antumbra.hit import Hit
from antumbra.image import Image
from antumbra.occlusion import Occlusion
from antumbra.scene import Scene


def counted(scene: Scene, count: Callable[[int], object]) -> Scene:
    """The same scene, which gives `count` the rays of each picture and query."""
    same = Counted.__new__(Counted)
    same.__dict__.update(vars(scene), _count=count)
    return same


class Counted(Scene):
    """Counts the rays of what it is asked, each receiver of a query with all of its rays."""

    _count: Callable[[int], object]

    def render(self, **options: Any) -> Image:
        """As of a scene."""
        image = super().render(**options)
        self._count(image.rays + image.shadow_rays)
        return image

    def occluded(self, *of: Any, **options: Any) -> NDArray[np.bool_]:
        """As of a scene."""
        found = super().occluded(*of, **options)
        self._count(len(found))
        return found

    def closest_hit(self, *of: Any, **options: Any) -> Hit:
        """As of a scene."""
        found = super().closest_hit(*of, **options)
        self._count(len(found.t))
        return found

    def visible_fraction(self, *of: Any, **options: Any) -> Estimate:
        """As of a scene."""
        found = super().visible_fraction(*of, **options)
        self._count(len(found.values) * found.rays)
        return found

    def occlusion_masks(self, *of: Any, **options: Any) -> Occlusion:
        """As of a scene; every direction of a point is a ray."""
        found = super().occlusion_masks(*of, **options)
        self._count(64 * found.masks.size)
        return found

    def regions(self, *of: Any, **options: Any) -> NDArray[np.int8]:
        """As of a scene; a ray to each point inside the light and to each on its outline."""
        found = super().regions(*of, **options)
        self._count(2 * len(found) * int(options.get("n", 64)))
        return found

    def visits(self, *of: Any, **options: Any) -> Visits:
        """As of a scene; any hit and closest hit of each."""
        found = super().visits(*of, **options)
        self._count(2 * len(found.blocked))
        return found

    def explain(self, *of: Any, **options: Any) -> Explanation:
        """As of a scene."""
        found = super().explain(*of, **options)
        self._count(len(found.viewing_rays) + len(found.light_rays))
        return found

    def _estimate(self, *of: Any) -> Estimate:
        found = super()._estimate(*of)
        self._count(len(found.values) * found.rays)
        return found
