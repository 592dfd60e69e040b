"""Shadow rays over a picture, from a receiver to the cells of a square light."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.lecture.stages import Drawing, Sketch
from antumbra.lecture.stages.drawing import LIGHT, RIM, Point

Array = NDArray[np.float64]
Project = Callable[[ArrayLike], Point]


def projector(eye: ArrayLike, look_at: ArrayLike, fov: float, size: tuple[int, int]) -> Project:
    """Where a camera that stands upright sees a point, in pixels from the upper left; `fov` is vertical."""
    origin = np.asarray(eye, np.float64)
    forward = np.asarray(look_at) - origin
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    upward, scale = np.cross(right, forward), size[1] / 2 / np.tan(fov / 2)

    def project(point: ArrayLike) -> Point:
        toward = np.asarray(point) - origin
        x, y = (float(toward @ axis / (toward @ forward) * scale) for axis in (right, upward))
        return size[0] / 2 + x, size[1] / 2 - y

    return project


class Drawn(NamedTuple):
    """A shadow ray: its `end` on the light, the point that it `reached`, and whether it is `free`."""

    end: ArrayLike
    reached: ArrayLike
    free: bool


def rays_over(
    project: Project,
    size: tuple[int, int],
    light: Sequence[Array],
    cells: int,
    p: ArrayLike,
    rays: Sequence[Drawn],
) -> Drawing:
    """Rays from `p` to a square `light` (corner and two edges) of `cells` × `cells` cells."""
    sketch, (corner, u, v) = Sketch(*size), light
    for n in range(cells + 1):
        outline, share = n in (0, cells), n / cells
        for a, b in ((u, v), (v, u)):
            ends = project(corner + share * a), project(corner + share * a + b)
            sketch.line(*ends, colour=LIGHT if outline else RIM, width=3 if outline else 1)
    start = project(p)
    for row, ray in enumerate(rays):
        drawn = Sketch(*size).ray(start, project(ray.reached), ray.free)
        if not ray.free:
            drawn.circle(project(ray.end), 4, "none", stroke="#bf3a12")
        sketch.linked(row, drawn)
    x, y = project(corner + u / 2 + v / 2)
    sketch.circle(start, 7, "#fff", stroke="#0b0d14").text(
        (start[0], start[1] + 32), "receiver p", anchor="middle"
    )
    sketch.text((x + 72, y), "light")
    free = sum(ray.free for ray in rays)
    return sketch.done(
        f"{len(rays)} shadow rays from the receiver to the light: {free} free, {len(rays) - free} blocked."
    )
