"""A low closed room of 4 × 4 × 1.25 m under a disk of light, and what closed forms say of the middle of its floor."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np

import antumbra as am
from antumbra.lecture.scenes import SceneOf, square

HEIGHT, HALF = 1.25, 2.0
# The camera: in the room, with floor, light and three walls in view.
VIEW: dict[str, Any] = {
    "eye": (0.0, 0.62, 1.95),
    "look_at": (0.0, 0.5, -1.0),
    "up": (0.0, 1.0, 0.0),
    "fov": 1.15,
}
# Three balls that do not stand between the middle of the floor and the light.
_BALLS = ((-1.2, -0.75), (0.55, -1.3), (1.35, -0.1))


@cache
def low_room(ratio: float) -> SceneOf:
    """The disk has the radius `ratio` · HEIGHT, at most HALF, and always the same power."""

    def build() -> am.Scene:
        scene, plaster = am.Scene("low-room"), am.materials.Diffuse(0.6)
        square(scene, 0.0, HALF, plaster)
        top = HEIGHT + 0.01
        ring = [(-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF)]
        scene.add_mesh(
            [(x, top, z) for x, z in ring], [[0, 1, 2], [0, 2, 3]], material=plaster, name="ceiling"
        )
        for n, ((x0, z0), (x1, z1)) in enumerate(zip(ring, ring[1:] + ring[:1], strict=True)):
            wall = np.array([[x0, 0, z0], [x1, 0, z1], [x1, top, z1], [x0, top, z0]], np.float64)
            scene.add_mesh(wall, [[0, 1, 2], [0, 2, 3]], material=plaster, name=f"wall-{n}")
        for x, z in _BALLS:
            scene.add_shape(am.shapes.Sphere((x, 0.25, z), 0.25), material=plaster, name="ball")
        down = (0.0, -1.0, 0.0)
        scene.add_light(am.lights.Disk((0.0, HEIGHT, 0.0), down, ratio * HEIGHT, 1 / ratio**2), name="light")
        return scene

    return build


def areas(ratio: float) -> tuple[float, float]:
    """Area of the light, and of all surfaces with it."""
    light = math.pi * (ratio * HEIGHT) ** 2
    walls = 2 * (2 * HALF) ** 2 + 8 * HALF * (HEIGHT + 0.01)
    return light, walls + len(_BALLS) * 4 * math.pi * 0.25**2 + light


def filled(ratio: float) -> float:
    """Share of the hemisphere over the middle of the floor that the light fills, counted with cos θ: E / (π L_e)."""
    return ratio**2 / (1 + ratio**2)


def variance_of_points(ratio: float) -> float:
    """Of one uniform light point's E / L_e: A ∫ (cos θ cos θ′ / r²)² dA − (E / L_e)²."""
    u = 1 + ratio**2
    return math.pi**2 * (ratio**2 / 3 * (1 - u**-3) - filled(ratio) ** 2)


def variance_of_directions(ratio: float) -> float:
    """Of one direction with p = cos θ / π: π² p (1 − p), p = `filled`."""
    return math.pi**2 * filled(ratio) * (1 - filled(ratio))


def even_ratio() -> float:
    """The radius over the height at which both are the same: u³ − 3u² − 1 = 0 for u = 1 + ratio²."""
    u = float(np.max(np.real(np.roots([1.0, -3.0, 0.0, -1.0]))))
    return math.sqrt(u - 1)
