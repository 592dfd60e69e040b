"""The shadow rays of one pixel, one to each cell of a square light, factor by factor."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.run import Run
from antumbra.lecture.scenes.three_pillars import ALBEDO, AREA, CORNER, PIXEL, RADIANCE, U, V, three_pillars

Array = NDArray[np.float64]


class Rays(NamedTuple):
    """The factors of all rays (N,) from the receiver p, computed anew from the points; cell after cell of the light."""

    p: Array
    points: Array
    free: NDArray[np.bool_]
    cos: Array
    cos_light: Array
    squared: Array
    pdf: Array
    """Per area of the light [1/m²]."""

    @property
    def pdf_angle(self) -> Array:
        """The same density per solid angle [1/sr]: pdf r² / cos θ′."""
        found: Array = self.pdf * self.squared / self.cos_light
        return found

    @property
    def brings(self) -> Array:
        """What each adds to the pixel: f_r L_e V cos θ cos θ′ A / (N r²)."""
        light = ALBEDO / np.pi * RADIANCE / len(self.free)
        found: Array = light * self.free * self.cos * self.cos_light * AREA / self.squared
        return found


def rays_of_pixel(run: Run, cells: int, options: Mapping[str, Any]) -> Rays:
    """One ray to each of `cells`² cells, as `Scene.explain` lists them for the pixel of `three_pillars`."""
    found = run.scene(three_pillars).explain(PIXEL, seed=run.seeded(0), **options)
    [met] = [ray.receiver for ray in found.viewing_rays if ray.receiver]
    p, points = np.array(met.position), found.light_rays.array("point")
    order = np.lexsort([np.floor(cells * ((points - CORNER) @ edge) / (edge @ edge)) for edge in (U, V)])
    points, along = points[order], points[order] - p
    squared = np.sum(along**2, 1)
    cos_light = abs(along @ np.cross(U, V)) / AREA / np.sqrt(squared)
    # The renderer has its density in solid angle.
    pdf = found.light_rays.array("pdf")[order] * cos_light / squared
    free = found.light_rays.array("visible")[order] > 0
    return Rays(p, points, free, along[:, 1] / np.sqrt(squared), cos_light, squared, pdf)
