"""Triangles over a point and the directions that they take, one after another; the tables of rates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from antumbra._words import written
from antumbra.lecture.fisheye import Fisheye
from antumbra.lecture.measures.alone_and_together import COUNTS as LIGHT_POINTS
from antumbra.lecture.measures.fast_occlusion import WAYS
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes.shards import shards, some_shards
from antumbra.lecture.stages import Frame, Table
from antumbra.occlusion import Occlusion

COUNT = 256
_FREE, _BLOCKED, _TRIANGLE, _NEW = "#5fd98a", "#ff8d5e", "#2f3a5c", "#4e70aa"


def _masks(run: Run, first: int, last: int) -> Occlusion:
    return run.scene(some_shards(first, last)).occlusion_masks([[0, 0, 0]], [[0, 1, 0]], directions=COUNT)


def _edges(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points along the edges of a triangle: straight lines are bent in the fisheye."""
    part = np.linspace(0, 1, 32, endpoint=False)[:, None]
    return np.concatenate(
        [(1 - part) * a + part * b for a, b in zip(corners, np.roll(corners, -1, 0), strict=True)]
    )


def _fisheye(
    found: Occlusion, triangles: NDArray[np.float64], newest: int, pixels: int
) -> NDArray[np.float64]:
    sky = Fisheye(pixels)
    for k, corners in enumerate(triangles):
        sky.outline(_edges(corners), _NEW if k == newest else _TRIANGLE)
    along, blocked = found.directions @ found.frames[0], found.blocked[0]
    sky.dots(along[~blocked], np.full(np.sum(~blocked), 2e-3), _FREE)
    sky.crosses(along[blocked], _BLOCKED)
    return sky.radiance()


def one_more(run: Run, k: int, pixels: int) -> Frame:
    """The k-th triangle alone, and all up to it."""
    alone, all_so_far = _masks(run, max(k - 1, 0), k), _masks(run, 0, k)
    taken, left = int(alone.blocked.sum()), int((~all_so_far.blocked).sum())
    tested = alone.work.tested
    said = (
        f"Triangle {k} alone takes {taken} of {COUNT} directions; {tested} of them needed a test."
        if k else f"No triangle: all {COUNT} directions are free.",
        f"{k} triangle{'' if k == 1 else 's'}: {left} of {COUNT} directions are free.",
    )  # fmt: skip
    shown = (
        _fisheye(alone, shards()[max(k - 1, 0) : k], 0, pixels),
        _fisheye(all_so_far, shards()[:k], k - 1, pixels),
    )
    pictures = [
        run.picture(picture, alt, name=f"{which}-{k}", white=1.0, colour=True, tones=32)
        for which, alt, picture in zip(("alone", "all"), said, shown, strict=True)
    ]
    says = f"{k}: takes {taken}, {tested} tested; {left} left" if k else f"none: {left} left"
    return Frame(str(k), says, pictures, short=str(k))


def _scene(name: str, radius: float) -> str:
    return f"{name}, R = {radius:g}"


def by_radius(found: Mapping[str, Quantity], rows: Sequence[tuple[str, float]], note: str) -> Table:
    """A line for each scene and radius: triangles in range, tests, and the rate of each way at N = 256."""
    lines = []
    for name, radius in rows:
        of = [f"{name}-{radius:g}-{COUNT}-{what}" for what in ("in_range", "tested", *WAYS)]
        lines.append([_scene(name, radius), *(written(found[key].value, 2) for key in of)])
    head = ("N = 256", "in range", "tests", "single", "packets", "tiles", "points")
    return Table(head, lines, "Directions by all four ways, by radius [M/s]", fine=(2,), note=note)


def by_count(
    found: Mapping[str, Quantity], rows: Sequence[tuple[str, float]], counts: Sequence[int], note: str
) -> Table:
    """A line for each scene and radius: both methods over packets, at each number of directions."""
    lines = [
        [_scene(name, radius), *(
            written(found[f"{name}-{radius:g}-{n}-times-{method}"].value, 2) for method in WAYS[2:] for n in counts
        )]
        for name, radius in rows
    ]  # fmt: skip
    head = ("× packets", *(f"{word} {n}" for word in ("tiles", "points") for n in counts))
    return Table(head, lines, "Both methods over rays in packets, by N", note=note)


def of_light(found: Mapping[str, Quantity], names: Sequence[str], note: str) -> Table:
    """A line for each scene: points of a light asked singly and together, at each number of points."""
    lines = [
        [name, *(
            " → ".join(written(found[f"{name}-light-{n}-{way}"].value, 2) for way in ("single", "together"))
            for n in LIGHT_POINTS
        )]
        for name in names
    ]  # fmt: skip
    head = ("M rays/s", *(f"N = {n}" for n in LIGHT_POINTS))
    return Table(head, lines, "Points of a light asked singly and together", note=note)
