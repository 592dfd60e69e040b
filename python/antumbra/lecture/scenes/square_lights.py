"""Scenes under a square light that faces down, and what closed forms say of it."""

from __future__ import annotations

import math
from functools import cache

import antumbra as am
from antumbra.lecture.scenes import SceneOf, square

# Three boards between light and floor: height of each over the floor, middle and half of its width in z. Their
# shadows lie side by side, in the order of d₂/d₁: from the occluder to the floor over from the light to the occluder.
LIGHT_HEIGHT = 2.0
BOARDS = ((0.25, 1.05, 0.25), (0.5, 0.3, 0.25), (1.0, -0.42, 0.3))
DISTANCE_RATIOS = {"1/7": 1 / 7, "1/3": 1 / 3, "1": 1.0}


@cache
def boards_under_square(size: float, intensity: float = 4.0) -> SceneOf:
    """Boards that end at x = 0 under a square light of edge `size` in y = 2; 0 is a point light.

    All have the power π · `intensity`: radiance = `intensity` / size², so that a small square sends `intensity`
    [W/sr] straight down. The point sends its power to all sides alike, `intensity` / 4 straight down.
    All edges lie under the middle of the light.
    """

    def build() -> am.Scene:
        scene = am.Scene("boards")
        square(scene, 0.0, 12.0, am.materials.Diffuse(0.6))
        for height, middle, half in BOARDS:
            board = am.shapes.Rectangle((-1.5, height, middle - half), (0.0, 0.0, 2 * half), (1.5, 0.0, 0.0))
            scene.add_shape(board, material=am.materials.Diffuse(0.45), name=f"board-{height:g}")
        if size > 0:
            scene.add_light(square_light(size, LIGHT_HEIGHT, intensity / size**2), name="light")
        else:
            scene.add_light(am.lights.Point((0.0, LIGHT_HEIGHT, 0.0), intensity / 4), name="light")
        return scene

    return build


@cache
def floor_under_square(size: float, height: float) -> SceneOf:
    """A floor of albedo 0.5 under a square light of edge `size` and radiance 1 at `height`, nothing between."""

    def build() -> am.Scene:
        scene = am.Scene("square-light")
        square(scene, 0.0, 4.0, am.materials.Diffuse(0.5))
        scene.add_light(square_light(size, height), name="light")
        return scene

    return build


def square_light(size: float, height: float, radiance: float = 1.0) -> am.lights.Rectangle:
    """A square of edge `size` around the y axis that faces down from `height`."""
    half = size / 2
    return am.lights.Rectangle((-half, height, -half), (size, 0.0, 0.0), (0.0, 0.0, size), radiance)


def irradiance_under(size: float, height: float, x: float = 0.0, z: float = 0.0) -> float:
    """E / L_e at (x, 0, z) under a square light: element to rectangle, the signed sum of its four corners."""
    half = size / 2
    total = 0.0
    for side, other in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
        total += side * other * _corner((side * half - x) / height, (other * half - z) / height)
    return total


def _corner(a: float, b: float) -> float:
    """E / L_e of a rectangle a × b at height 1 with a corner over the receiver."""
    p, q = math.hypot(1.0, a), math.hypot(1.0, b)
    return 0.5 * (a / p * math.atan(b / p) + b / q * math.atan(a / q))
