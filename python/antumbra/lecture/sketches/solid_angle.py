"""A square light over a receiver: from the side, and as the receiver's fisheye sees it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.fisheye import FOUND, LIGHT, MISSED, Fisheye
from antumbra.lecture.measures import solid_angle
from antumbra.lecture.stages import Drawing, Sketch
from antumbra.lecture.stages.drawing import INK, LIT, RIM, Point
from antumbra.scene import Scene

# Of the side view: units of the drawing per unit of the scene, the middle of the light, the receiver's height.
_UNIT, _MIDDLE, _FLOOR, _WIDTH = 68.0, 240.0, 186.0, 480


class Sky(NamedTuple):
    """What a fisheye shows, and the numbers that go with it."""

    directions: NDArray[np.float64]
    """Random directions: dots find the light, crosses do not."""
    area: NDArray[np.float64]
    """Patches of the light, as dots of their dω."""
    found: int
    """How many directions found it."""
    total: float
    """Sum over the patches [sr]."""
    most: float
    """The largest dω of a patch over the smallest."""


def sky(scene: Scene, x: float, pixels: int, shown: int, side: int, seed: int) -> Sky:
    """From a receiver at (x, 0, 0): `shown` random directions, `side`² patches of a light of 2 × 2 at height 1."""
    at, edge = (x, 0.0, 0.0), np.linspace(-1, 1, 48)
    ones = np.ones_like(edge)
    ring = [(edge, -ones), (ones, edge), (-edge, ones), (-ones, -edge)]
    outline = np.concatenate([np.stack([u - x, ones, v], 1) for u, v in ring])
    first, second = Fisheye(pixels), Fisheye(pixels)
    along = solid_angle.directions(np.random.default_rng(seed).random((shown, 2)))
    hits = solid_angle.found(scene, at, along)
    first.outline(outline)
    first.crosses(along[~hits], MISSED)
    first.dots(along[hits], np.full(hits.sum(), 8e-4), FOUND)
    toward, omega = solid_angle.pieces(scene, at, solid_angle.patches(side))
    second.outline(outline, "#4a3f1c")
    second.dots(toward, omega / side**2, LIGHT)
    for fisheye in (first, second):
        fisheye.rings(np.pi / 6, np.pi / 3)
    return Sky(
        first.radiance(),
        second.radiance(),
        int(hits.sum()),
        float(omega.mean()),
        float(omega.max() / omega.min()),
    )


def from_the_side(x: float, omega: float) -> Drawing:
    """The light, the receiver at `x` and its hemisphere of radius 1, of which the light fills `omega` sr."""
    drawing = Sketch(_WIDTH, 240, ground=LIT)
    at, top = _MIDDLE + _UNIT * x, _FLOOR - _UNIT
    ends = (_MIDDLE - _UNIT, _MIDDLE + _UNIT)
    drawing.line((0, _FLOOR), (_WIDTH, _FLOOR), width=2).light((ends[0], top - 4), (ends[1], top - 4))
    drawing.curve(_arc(at, 0.0, np.pi), dash="3 3")
    filled = (float(np.arctan2(_UNIT, end - at)) for end in ends[::-1])
    drawing.curve(_arc(at, *filled), colour=RIM, width=5)
    patch = _MIDDLE + 0.5 * _UNIT
    for end in ends:
        drawing.line((at, _FLOOR), (end, top), faint=True)
    drawing.line((at, _FLOOR), (patch, top), width=1.5).line((patch, top), (patch, top + 38), dash="2 3")
    drawing.line((patch - 6, top - 4), (patch + 6, top - 4), width=8)
    drawing.text((patch, top - 16), "dA", anchor="middle").text((patch + 5, top + 32), "θ′", fine=True)
    drawing.text(((at + patch) / 2 - 12, (_FLOOR + top) / 2 + 12), "r", fine=True)
    side = "middle" if abs(x) < 2.4 else "start" if x < 0 else "end"
    drawing.circle((at, _FLOOR), 5, INK).text((at, _FLOOR + 30), "receiver", anchor=side)
    return drawing.text((16, 34), f"Ω = {omega:.3f} sr", tells=True).done(
        f"Side view: a light 2 m wide hangs 1 m above the floor; the receiver lies {_aside(x)} its middle. From there "
        f"the light fills {omega:.3f} of the {2 * np.pi:.3f} sr of the hemisphere."
    )


def said(seen: Sky, x: float, shown: int, side: int) -> tuple[str, str]:
    """What the two fisheyes show, in sentences."""
    part, place = f"{100 * seen.found / shown:.1f} %", _aside(x)
    patches = (
        "all alike" if seen.most < 1.05 else f"the nearest {seen.most:.3g} times as large as the farthest"
    )
    return (
        f"The whole sky of a receiver {place} the middle of the light, as a disk. Of {shown:,} random directions "
        f"{seen.found:,} meet the light ({part}); the others go into the dark.",
        f"The same sky, the light cut into {side}² equal patches. Each is a dot as large as its dω, {patches}; "
        f"they sum up to {seen.total:.4f} sr.",
    )


def _aside(x: float) -> str:
    return "straight below" if x == 0 else f"{abs(x):g} m to the {'left' if x < 0 else 'right'} of"


def _arc(at: float, first: float, last: float) -> list[Point]:
    """A part of the circle of radius 1 about the receiver, as far as the drawing goes."""
    turns = np.linspace(first, last, 48)
    points = [(at + _UNIT * float(np.cos(t)), _FLOOR - _UNIT * float(np.sin(t))) for t in turns]
    return [(u, v) for u, v in points if 0 <= u <= _WIDTH]
