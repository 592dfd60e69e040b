"""Scenes of parallel disks over a floor: a light, an occluder, a receiver, all about the y axis."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

import antumbra as am
from antumbra.lecture.geometry import Disks
from antumbra.lecture.scenes import SceneOf, square


@cache
def receiver_behind(disks: Disks, g: float) -> SceneOf:
    """A floor at y = 0, the occluding disk at height `g`, the disk of light `disks.a` above it."""

    def build() -> am.Scene:
        scene = am.Scene("receiver")
        square(scene, 0.0, 30.0, am.materials.Diffuse(0.5), "receiver")
        scene.add_shape(am.shapes.Disk((0.0, g, 0.0), (0.0, 1.0, 0.0), disks.r), name="occluder")
        light = am.lights.Disk((0.0, g + disks.a, 0.0), (0.0, -1.0, 0.0), disks.R, radiance=1.0)
        scene.add_light(light, name="light")
        return scene

    return build


def from_above(height: float, half: float) -> dict[str, Any]:
    """A camera over the origin that sees a square of the floor, edges of 2 `half`, as a map without perspective."""
    return {
        "eye": (0.0, height, 0.0),
        "look_at": (0.0, 0.0, 0.0),
        "up": (0.0, 0.0, -1.0),
        "fov": 2 * np.arctan(half / height),
    }
