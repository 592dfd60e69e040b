"""Irradiance as a camera sees it: through everything that a picture goes through."""

from __future__ import annotations

from typing import Any

import numpy as np

from antumbra.lecture.measures.replicates import mean_of
from antumbra.lecture.quantity import Quantity
from antumbra.scene import Scene

# Pixels of the little picture: as many independent replicates.
_SIDE = 8


def irradiance_seen(
    scene: Scene,
    point: tuple[float, float, float],
    albedo: float,
    viewing_rays: int,
    seed: int,
    **options: Any,
) -> Quantity:
    """E = π L / `albedo` [W/m²] at a point of a level floor, by a picture of that point alone.

    The camera hangs 0.5 over it and sees less than a tenth of a millimetre; each of its pixels is a replicate.
    """
    x, y, z = point
    image = scene.render(
        eye=(x, y + 0.5, z), look_at=point, up=(0.0, 0.0, -1.0), fov=1e-4, size=(_SIDE, _SIDE),
        viewing="centre", viewing_rays=viewing_rays, seed=seed, **options,
    )  # fmt: skip
    return mean_of(np.pi / albedo * image.pixels[..., 1].astype(np.float64).ravel())
