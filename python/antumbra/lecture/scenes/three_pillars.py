"""Three pillars and a ball on a floor, under a square light that is in the picture: one pixel of it is taken apart."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import antumbra as am
from antumbra.lecture.scenes import square

# The camera, and a pixel in the penumbra of the tallest pillar.
VIEW: dict[str, Any] = {
    "eye": (1.6, 2.3, 6.0),
    "look_at": (-0.45, 1.3, -0.2),
    "fov": 0.66,
    "size": (640, 440),
}
PIXEL = (472, 384)
# The light faces (0.4, 0.1, 0.3): corner, edges, radiance, and its area.
_MIDDLE, EDGE = np.array([-2.0, 2.9, -1.3]), 1.4
_TOWARD = np.array([0.4, 0.1, 0.3]) - _MIDDLE
U = np.cross(_TOWARD, [0.0, 1.0, 0.0])
U *= EDGE / np.linalg.norm(U)
V = np.cross(_TOWARD / np.linalg.norm(_TOWARD), U)
CORNER = _MIDDLE - (U + V) / 2
RADIANCE, AREA = 10.0, EDGE * EDGE
# Of the floor.
ALBEDO = 0.6


def three_pillars() -> am.Scene:
    """The scene."""
    scene, stone = am.Scene("three-pillars"), am.materials.Diffuse(0.7)
    square(scene, 0.0, 40.0, am.materials.Diffuse(ALBEDO))
    for x, z, height, turn in ((-0.3, -0.15, 1.7, 0.5), (-1.5, 0.6, 0.8, 0.2), (1.2, -0.9, 1.1, 0.9)):
        vertices, faces = _pillar(x, z, height, turn)
        scene.add_mesh(vertices, faces, material=stone, name="pillar")
    scene.add_shape(am.shapes.Sphere((1.8, 0.28, 0.3), 0.28), material=stone, name="ball")
    light = am.lights.Rectangle(tuple(CORNER), tuple(U), tuple(V), radiance=RADIANCE)
    scene.add_light(light, name="light")
    return scene


def _pillar(x: float, z: float, height: float, turn: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Sides and top of an upright box, 0.42 wide, turned about its axis."""
    cos, sin = np.cos(turn), np.sin(turn)
    ring = 0.21 * np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]]) @ [[cos, sin], [-sin, cos]] + [x, z]
    low, high = (np.insert(ring, 1, y, axis=1) for y in (0.0, height))
    faces = [[4, 6, 5], [4, 7, 6]]
    for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
        faces += [[a, a + 4, b], [b, a + 4, b + 4]]
    return np.concatenate([low, high]), np.array(faces)
