"""The things of the built-in `sky-dome` under many skies, and in a sphere of light instead of one."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray

import antumbra as am
from antumbra.lecture.scenes import SceneOf

# Elevation and azimuth of the sun [rad], and turbidity.
SUNS = {
    "morning": am.lights.Sky(math.radians(12.0), math.radians(100.0)),
    "midday": am.lights.Sky(math.radians(60.0), math.radians(160.0)),
    "sunset": am.lights.Sky(math.radians(4.0), math.radians(255.0), turbidity=5.0),
}
SKIES = (*SUNS, "painted", "studio")
# The scene's bounding sphere about the origin [m].
RADIUS = 3.0
# Centre and radius of the gold ball and of the mirror.
GOLD, MIRROR = (
    (np.array([1.75 * math.cos(a), r, -1.75 * math.sin(a)]), r)
    for a, r in ((2 * math.pi * 0.75, 0.36), (2 * math.pi * 0.91, 0.40))
)
# Texels of the studio's map, each a patch of one radiance: a dark room with softboxes (rows, columns, radiance).
_ROWS, _COLUMNS, _FINER = 32, 64, 8
_ROOM, _FLOOR = (0.05, 0.05, 0.06), (0.03, 0.028, 0.025)
_BOXES = (
    ((6, 14), (22, 26), (14.0, 12.6, 10.5)),
    ((8, 15), (40, 44), (3.4, 4.2, 6.0)),
    ((1, 3), (2, 62), (1.5, 1.5, 1.5)),
)
TURNS = 16
# Sides of the sphere along a patch.
_SIDES = 8


def lights_of(sky: str) -> list[str]:
    """The names of the lights that make a sky of `under_skies`."""
    return [sky, f"{sky} sun"] if sky in SUNS else ["sky" if sky == "painted" else sky]


def studio() -> NDArray[np.float64]:
    """Radiance of the studio by patch, (32, 64, 3), row 0 at the top."""
    room = np.empty((_ROWS, _COLUMNS, 3))
    room[: _ROWS // 2], room[_ROWS // 2 :] = _ROOM, _FLOOR
    for (top, bottom), (left, right), radiance in _BOXES:
        room[top:bottom, left:right] = radiance
    return room


def studio_map(turn: int = 0) -> NDArray[np.float64]:
    """The studio as a lat-long picture, (256, 512, 3), turned eastward by so many sixteenths of a turn."""
    fine = studio().repeat(_FINER, 0).repeat(_FINER, 1)
    return np.roll(fine, turn * fine.shape[1] // TURNS, axis=1)


def under_skies() -> am.Scene:
    """The things of `sky-dome` with all `SKIES` and all turns of the studio: `light=` keeps one (`lights_of`)."""
    scene = am.builtin("sky-dome")
    for name, sky in SUNS.items():
        scene.add_light(sky, name=name)
    for turn in range(TURNS):
        scene.add_light(am.lights.Environment(studio_map(turn)), name=f"turn-{turn}" if turn else "studio")
    return scene


@cache
def alone(sky: str) -> SceneOf:
    """One of `SKIES` alone, with or without things under it: for directions drawn of it."""

    def build() -> am.Scene:
        if sky == "painted":
            return am.builtin("sky-dome")
        scene = am.Scene(sky)
        scene.add_light(SUNS[sky] if sky in SUNS else am.lights.Environment(studio_map()), name=sky)
        return scene

    return build


@cache
def in_sphere(radii: float) -> SceneOf:
    """The same things in a sphere that is light inside, of so many times their radius: each patch of the studio."""

    def build() -> am.Scene:
        scene = am.builtin("sky-dome")
        # Sides that run along a parallel are straight: many of them, so that they stay near it.
        room = studio().repeat(_SIDES, axis=1)
        rows, columns, _ = room.shape
        theta, phi = np.linspace(0, math.pi, rows + 1)[:, None], np.linspace(0, 2 * math.pi, columns + 1)
        points = [np.sin(phi) * np.sin(theta), np.cos(theta) + 0 * phi, -np.cos(phi) * np.sin(theta)]
        vertices = radii * RADIUS * np.stack(points, -1).reshape(-1, 3)
        corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
        below = corner + columns + 1
        faces = np.stack([corner, below, corner + 1, corner + 1, below, below + 1], 1).reshape(-1, 2, 3)
        colours, patch = np.unique(room.reshape(-1, 3), axis=0, return_inverse=True)
        for k, colour in enumerate(colours):
            scene.add_mesh(
                vertices, faces[patch == k].reshape(-1, 3), emission=tuple(colour), name=f"sphere-{k}",
                material=am.materials.Diffuse(0.0),
            )  # fmt: skip
        return scene

    return build
