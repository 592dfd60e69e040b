"""Lamps over a floor: square lights whose light at a point is known in closed form, and by which law it falls."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]

# Points per side of a lamp in the sums over its area: at these distances the error of the right law's is below 10⁻⁴.
_GRID = 64


class Lamp(NamedTuple):
    """A square light of `side` about `center` that emits `radiance` L_e along `normal`; the floor is y = 0."""

    center: tuple[float, float, float]
    normal: tuple[float, float, float]
    side: float
    radiance: float = 1.0

    def corner_and_sides(self) -> tuple[Points, Points, Points]:
        """Corner, u and v, with u × v along the normal."""
        n = np.array(self.normal) / np.linalg.norm(self.normal)
        u = np.cross((0.0, 0.0, 1.0) if abs(n[2]) < 0.9 else (1.0, 0.0, 0.0), n)
        u *= self.side / np.linalg.norm(u)
        v = np.cross(n, u)
        return np.array(self.center) - (u + v) / 2, u, v


def irradiance(lamp: Lamp) -> float:
    """E at the origin, normal +y, of what lies of the lamp above the floor."""
    corner, u, v = lamp.corner_and_sides()
    return lamp.radiance * lambert([corner, corner + v, corner + u + v, corner + u])


def lambert(polygon: list[Points]) -> float:
    """E at the origin, normal +y, of a flat polygon with L_e = 1: a sum over its edges (Lambert 1760).

    E = ½ |Σ γ_i n · (v_i × v_{i+1}) / |v_i × v_{i+1}||, γ_i the angle between v_i and v_{i+1}.
    """
    above, total = _above(polygon), 0.0
    for a, b in zip(above, [*above[1:], *above[:1]], strict=True):
        across = np.cross(a, b)
        size = float(np.linalg.norm(across))
        if size > 0:
            total += np.arctan2(size, float(np.dot(a, b))) * across[1] / size
    return abs(total) / 2


def _above(polygon: list[Points]) -> list[Points]:
    """The part of a polygon above y = 0 (Sutherland & Hodgman 1974, one plane)."""
    kept = []
    for a, b in zip(polygon, [*polygon[1:], *polygon[:1]], strict=True):
        if a[1] >= 0:
            kept.append(a)
        if (a[1] >= 0) != (b[1] >= 0):
            kept.append(a + (b - a) * a[1] / (a[1] - b[1]))
    return kept


@cache
def falls_as(lamp: Lamp, cos: float, cos_light: float, distance: float) -> float:
    """∫ L_e cos^a θ cos^b θ′ / r^c dA over the lamp: its irradiance for a, b, c = 1, 1, 2, else that of a wrong law."""
    corner, u, v = lamp.corner_and_sides()
    at = (np.arange(_GRID) + 0.5) / _GRID
    points = corner + u * at[:, None, None] + v * at[None, :, None]
    r = np.linalg.norm(points, axis=-1)
    n = np.array(lamp.normal) / np.linalg.norm(lamp.normal)
    up, back = points[..., 1] / r, -(points @ n) / r
    seen = (up > 0) & (back > 0)
    law = np.where(seen, np.abs(up) ** cos * np.abs(back) ** cos_light / r**distance, 0.0)
    return float(lamp.radiance * law.mean() * lamp.side**2)
