"""Lights alone, seen from the origin, and their solid angles: closed forms, and a 1-D integral for the disk aside."""

from __future__ import annotations

from functools import cache

import numpy as np

import antumbra as am
from antumbra.lecture.measures.solid_angle import of_rectangle, of_triangle
from antumbra.lecture.scenes import SceneOf
from antumbra.lecture.scenes.square_lights import square_light
from antumbra.lights import Light

_CORNERS = np.array([[1.0, 2.0, 0.5], [-1.5, 2.5, 1.0], [0.2, 1.8, -1.4]])
_DOWN = (0.0, -1.0, 0.0)
# The one over the receiver: 2 × 2, 1 above it.
ABOVE = "square above"
LIGHTS: dict[str, tuple[Light, float]] = {
    ABOVE: (square_light(2.0, 1.0), of_rectangle((-1, -1), (2, 2), 1.0)),
    "rectangle aside": (am.lights.Rectangle((2, 1, 1), (3, 0, 0), (0, 0, 3)), of_rectangle((2, 1), (3, 3), 1.0)),
    "triangle": (am.lights.Triangle(*(tuple(v) for v in _CORNERS)), of_triangle(*_CORNERS)),
    "sphere": (am.lights.Sphere((0, 2, 0), 1.0), 2 * np.pi * (1 - np.sqrt(0.75))),
    "disk above": (am.lights.Disk((0, 2, 0), _DOWN, 1.0), 2 * np.pi * (1 - 2 / np.sqrt(5))),
    "disk aside": (am.lights.Disk((1.5, 2, 0), _DOWN, 1.0), 0.3943787693890751),
}  # fmt: skip


@cache
def alone(name: str) -> SceneOf:
    """A light of `LIGHTS` by name, and nothing else."""

    def build() -> am.Scene:
        scene = am.Scene("light")
        scene.add_light(LIGHTS[name][0], name="light")
        return scene

    return build


def omega_above(x: float) -> float:
    """Exact Ω [sr] of the square `ABOVE` from a receiver at (x, 0, 0)."""
    return of_rectangle((-1 - x, -1), (2, 2), 1.0)
