"""Scenes of the figures: the built-in ones, and small ones made for one figure."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np

import antumbra as am
from antumbra.lecture.variant import Pick

SceneOf = Callable[[], am.Scene]


@cache
def builtin(name: str, **parameters: float) -> SceneOf:
    """A built-in scene with parameters; the same call gives the same function, so that a run builds it once."""
    return partial(am.builtin, name, **parameters)


def square(scene: am.Scene, y: float, half: float, material: Any = None, name: str = "floor") -> None:
    """Adds a square floor that faces up: height `y`, edges of 2 `half`."""
    corners = np.array([[-1.0, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]) * half + [0, y, 0]
    scene.add_mesh(corners, [[0, 2, 1], [0, 3, 2]], material=material, name=name)


EYE = (0.0, 3.0, 5.6)


@cache
def slid_ball(scale: float) -> SceneOf:
    """A ball on the floor at `scale` 1, slid towards `EYE` and made smaller so that it covers the same pixels.

    A second ball stays where it is. The light is a sun, so that moving does not change what arrives unshadowed.
    """

    def build() -> am.Scene:
        scene = am.Scene("slid-ball")
        square(scene, 0.0, 40.0, am.materials.Diffuse(0.6))
        eye = np.array(EYE)
        center = eye + scale * (np.array([-0.35, 0.5, 0.0]) - eye)
        scene.add_shape(
            am.shapes.Sphere(tuple(center), 0.5 * scale), material=am.materials.Diffuse(0.7), name="ball"
        )
        scene.add_shape(
            am.shapes.Sphere((1.15, 0.3, -0.9), 0.3), material=am.materials.Diffuse(0.7), name="still"
        )
        scene.add_light(am.lights.Sun((-0.75, 1.0, 0.2), half_angle=0.035, radiance=1000.0), name="sun")
        return scene

    return build


@cache
def disk_over_floor(light: float, occluder: float = 0.2) -> SceneOf:
    """A disk of light of radius `light` at y = 2, a disk of radius `occluder` at y = 1, a floor at y = 0."""

    def build() -> am.Scene:
        scene = am.Scene("disk-over-floor")
        square(scene, 0.0, 4.0, am.materials.Diffuse(0.5))
        scene.add_shape(am.shapes.Disk((0.0, 1.0, 0.0), (0.0, 1.0, 0.0), occluder), name="occluder")
        scene.add_light(am.lights.Disk((0.0, 2.0, 0.0), (0.0, -1.0, 0.0), light, radiance=1.0), name="light")
        return scene

    return build


def _pillars_light(size: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Corner and sides of the light of the built-in `pillars`: it faces the middle of the floor."""
    center = np.array([-3.3, 6.2, -3.6])
    toward = np.array([0.0, 0.5, 0.0]) - center
    u = np.cross(toward / np.linalg.norm(toward), [0.0, 1.0, 0.0])
    u *= size / np.linalg.norm(u)
    v = np.cross(toward / np.linalg.norm(toward), u)
    return center - (u + v) / 2, u, v


PILLARS_LIGHT = _pillars_light(2.0)
# A camera near the pillars, with all of their shadows in view.
PILLARS_VIEW: dict[str, Any] = {"eye": (-7.4, 5.6, 5.4), "look_at": (0.3, 0.55, 0.3), "fov": 0.5}
# From there, one viewing ray through the centre of each pixel: all the noise comes from the light.
CENTRED = PILLARS_VIEW | {
    "estimator": "area",
    "viewing": "centre",
    "viewing_rays": 1,
    "size": Pick((96, 68), (240, 168)),
}


def _pillars_and(corner: np.ndarray, u: np.ndarray, v: np.ndarray, name: str) -> am.Scene:
    """The pillars under their light of edge 2, and another rectangle of the same radiance."""
    scene = am.builtin("pillars", light_size=2.0)
    radiance = 165.0 / 4.0 * np.array([1.0, 0.93, 0.82])
    sides = corner.tolist(), u.tolist(), v.tolist()
    scene.add_light(am.lights.Rectangle(*sides, radiance=tuple(radiance)), name=name)
    return scene


@cache
def two_windows(apart: float = 3.0) -> SceneOf:
    """The pillars under two equal square lights, their centres `apart`, in one plane."""
    corner, u, v = PILLARS_LIGHT
    return lambda: _pillars_and(corner + apart / 2.0 * u, u, v, "second")


@cache
def pillars_with_strip(start: float, end: float) -> SceneOf:
    """The pillars, and the part `start` to `end` of their light along its first side as a light "strip" of its own.

    It lies in the other light: only for light sampling with one of the two.
    """
    corner, u, v = PILLARS_LIGHT
    return lambda: _pillars_and(corner + start * u, (end - start) * u, v, "strip")


def white_box() -> am.Scene:
    """The Cornell box under a sky of radiance 1, the light "white"."""
    scene = am.builtin("cornell-box")
    scene.add_light(am.lights.Environment(1.0), name="white")
    return scene


@cache
def half_hidden_disk() -> SceneOf:
    """A disk light of radius 1 at height 1; a plate hides the half x < 0 of it from the origin (CF35e)."""

    def build() -> am.Scene:
        scene = am.Scene("half-hidden-disk")
        scene.add_light(am.lights.Disk((0.0, 1.0, 0.0), (0.0, -1.0, 0.0), 1.0, radiance=1.0), name="light")
        corners = [[-3.0, 0.5, -3.0], [0.0, 0.5, -3.0], [0.0, 0.5, 3.0], [-3.0, 0.5, 3.0]]
        scene.add_mesh(corners, [[0, 2, 1], [0, 3, 2]], name="plate")
        return scene

    return build
