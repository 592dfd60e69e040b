"""Sun, moon and earth in one line: the slider that moves the moon."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.geometry import Bodies
from antumbra.lecture.measures.regions import Radii, radii_of
from antumbra.lecture.run import Run
from antumbra.lecture.stages import Frame, Strip

# Height of the view to the sun [rad].
ACROSS = 0.0124
# What the view to the sun shows: nothing, the moon, the sun. A black moon could not be told from the sky.
_BODIES = ("#141a2e", "#555c69", "#f2b705")


def moon_moved(
    run: Run, sky: Bodies, distances: Sequence[int], width: float, space: Mapping[str, Any], tells: int
) -> Strip:
    """Earth, ground and sun for each distance of the moon [km]: variants `space-`, `ground-` and `sky-`.

    `width`: of the ground that is seen [km]; `space`: the camera that sees the earth; `tells`: the frame of the number.
    """
    white = 1.7 * run.white(f"space-{distances[-1]}")
    frames = [
        _frame(
            run, sky, distance, radii_of(run, f"ground-{distance}", width), white, _inset(sky, width, space)
        )
        for distance in distances
    ]
    labels = ("The earth", f"In the frame: {width:.0f} km", "The sun from there, 0.7°")
    return Strip("moon", "Distance of the moon, from centre to centre", frames, labels, tells=tells)


def _inset(sky: Bodies, width: float, space: Mapping[str, Any]) -> tuple[float, float, float]:
    """Where the ground that is seen apart, `width` [km], lies on the earth: right, down, and its width, of 1 each."""
    eye = np.asarray(space["eye"], np.float64)
    ahead = -eye / np.linalg.norm(eye)
    right = np.cross(ahead, (0.0, 1.0, 0.0))
    right /= np.linalg.norm(right)
    way = np.array([sky.earth, 0.0, 0.0]) - eye
    whole = 2 * np.tan(space["fov"] / 2) * float(way @ ahead)
    return 0.5 + float(way @ right) / whole, 0.5 - float(way @ np.cross(right, ahead)) / whole, width / whole


def _with_frame(
    pixels: NDArray[np.float64], inset: tuple[float, float, float], white: float
) -> NDArray[np.float64]:
    """The earth with a frame about what the inset shows, a pixel wide and 3 pixels inside at least."""
    framed, size = pixels.copy(), len(pixels)
    across, down, width = (size * x for x in inset)
    half = max(width / 2, 1.5) + 0.5
    low, high = (np.round([down + way * half, across + way * half]).astype(int) for way in (-1, 1))
    box = framed[low[0] : high[0] + 1, low[1] : high[1] + 1]
    inside = box[1:-1, 1:-1].copy()
    box[:] = white * np.array([1.0, 0.5, 0.0])
    box[1:-1, 1:-1] = inside
    return framed


def _frame(
    run: Run, sky: Bodies, d: int, at: Radii, white: float, inset: tuple[float, float, float]
) -> Frame:
    says, true = _says(at), sky.umbra(d)
    seen = run.image(f"sky-{d}").aov
    bodies = np.where(seen["emission"].max(2) > 0, 2, np.where(seen["albedo"].max(2) > 0, 1, 0))
    # Of the sun's disk, as wide as it is from there, what the map shows.
    disk = np.pi * (sky.sun / (sky.unit - sky.earth) / ACROSS * len(bodies)) ** 2
    covered = max(0.0, 1 - float(np.count_nonzero(bodies == 2)) / disk)
    regions = run.aov(f"ground-{d}", "regions").astype(np.uint8)
    alts = (
        f"The earth with the moon's shadow, the moon at {d:,} km.",
        f"The ground at the axis of the shadow: {says}.",
        f"The sun from the ground: {covered:.1%} of it is covered.",
    )
    pictures = [
        run.picture(
            _with_frame(run.pixels(f"space-{d}"), inset, white),
            alts[0],
            name=f"space-{d}",
            white=white,
            colour=True,
            tones=64,
        ),
        run.classes(regions, alts[1], name=f"ground-{d}"),
        run.classes(bodies, alts[2], name=f"sky-{d}", colours=_BODIES),
    ]
    facts = [
        f"radius {at.umbra:.1f} / {true:.1f} km" if true > 1 else "none here",
        f"out to {sky.penumbra(d):,.0f} km",
        f"radius {at.antumbra:.1f} / {-true:.1f} km" if true < -1 else "none here",
    ]
    more = f", {covered:.1%} of the sun covered"
    return Frame(f"{d}", f"{d:,} km: {says}", pictures, f"{d:,} km", more, facts=facts)


def _says(at: Radii) -> str:
    """What the map of the ground shows."""
    if at.umbra:
        return f"total, umbra {2 * at.umbra:.0f} km wide"
    return f"annular, antumbra {2 * at.antumbra:.0f} km wide" if at.antumbra else "no umbra, no antumbra"
