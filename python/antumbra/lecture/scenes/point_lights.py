"""Many point lights over a place, and what is known of them."""

from __future__ import annotations

import math
from functools import cache

import antumbra as am
from antumbra.lecture.scenes import SceneOf

# Of 1000 of them: the variance of one ray to a light drawn alike, and in proportion to its power [W² m⁻⁴].
VARIANCES = {"uniform": 10439.51013048, "power": 7103.103556845}


@cache
def point_lights(count: int) -> SceneOf:
    """Points in y = 3 on a spiral about the origin, of intensities 1 to 7 in turn."""

    def build() -> am.Scene:
        scene = am.Scene("point-lights")
        turn = math.pi * (3 - math.sqrt(5))
        for k in range(count):
            r, phi = math.sqrt(k) / 4, k * turn
            scene.add_light(
                am.lights.Point((r * math.cos(phi), 3.0, r * math.sin(phi)), k % 7 + 1.0), name=f"p{k}"
            )
        return scene

    return build
