"""The questions that `check` asks: small scenes at whose receivers the reflected light is known exactly."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.checks.lamps import Lamp, irradiance, lambert
from antumbra.checks.law import EXPONENTS, Exponents
from antumbra.lights import Environment, Rectangle
from antumbra.materials import Diffuse
from antumbra.scene import Scene

Rays = tuple[NDArray[np.float64], NDArray[np.float64]]

# Lamps at other distances and angles each, so that every law of r, θ and θ′ but the right one is off at some.
LAMPS = {
    "lamp overhead": Lamp((0, 2.0, 0), (0, -1, 0), 0.8),
    "lamp twice as high": Lamp((0, 4.0, 0), (0, -1, 0), 1.6),
    "lamp near": Lamp((0, 0.9, 0), (0, -1, 0), 0.5),
    "lamp low at the side": Lamp((2.4, 0.8, 0), (-2.4, -0.8, 0), 0.8),
    "lamp turned away": Lamp((0, 2.0, 0), (1.6, -1, 0), 0.8),
    "lamp low and turned": Lamp((-1.8, 1.0, 0.6), (0.2, -1.0, 0), 0.9),
    "lamp half below the horizon": Lamp((1.2, 0.15, 0), (-1, 0, 0), 1.2),
}
RHO = 0.8


class Case(NamedTuple):
    """A scene, viewing rays to its receivers, and `truth`, the radiance that these reflect [W·m⁻²·sr⁻¹]."""

    name: str
    scene: Callable[[], Scene]
    rays: Callable[[int], Rays]
    truth: float
    lamp: Lamp | None = None
    # Shares of the truth, and what an answer between them betrays.
    hints: tuple[tuple[tuple[float, float], str], ...] = ()


def _floor(
    scene: Scene, rho: float = RHO, size: float = 20.0, turn: NDArray[np.float64] | None = None
) -> Scene:
    corners = np.array([(-1, 0, -1), (-1, 0, 1), (1, 0, 1), (1, 0, -1)]) * size
    if turn is not None:
        corners = corners @ turn.T
    scene.add_mesh(corners, [(0, 1, 2), (0, 2, 3)], material=Diffuse(rho))
    return scene


def _under(*lamps: Lamp, rho: float = RHO) -> Callable[[], Scene]:
    def scene() -> Scene:
        made = _floor(Scene(), rho)
        for lamp in lamps:
            corner, u, v = (tuple(part) for part in lamp.corner_and_sides())
            made.add_light(Rectangle(corner, u, v, radiance=lamp.radiance))
        return made

    return scene


def _at_origin(count: int) -> Rays:
    """The same short ray to the origin, seen from a little above it."""
    eye = np.array([0.013, 0.02, -0.007])
    return np.tile(eye, (count, 1)), np.tile(-eye / np.linalg.norm(eye), (count, 1))


def _wall(scene: Callable[[], Scene], corners: list[tuple[float, float, float]]) -> Callable[[], Scene]:
    def walled() -> Scene:
        made = scene()
        made.add_mesh(np.array(corners), [(0, 1, 2), (0, 2, 3)], material=Diffuse(0.0))
        return made

    return walled


# A wall half way up to the lamp overhead, with its edge at x = 0.1: what lies beyond x = 0.2 of the lamp is seen.
_OVERHEAD = LAMPS["lamp overhead"]
_EDGE = [(-3.0, 1.0, -3.0), (0.1, 1.0, -3.0), (0.1, 1.0, 3.0), (-3.0, 1.0, 3.0)]
_SEEN = [np.array([x, 2.0, z]) for x, z in [(0.2, -0.4), (0.4, -0.4), (0.4, 0.4), (0.2, 0.4)]]
# A plate close above the floor, its edge at x = −0.0125, and a wall close below the lamp, its edge at z = 0.09: of the
# lamp x > −0.25, z < 0.1 is seen. From a start above the floor the plate hides less, from above it nothing.
_CLOSE = [(-3.0, 0.1, -3.0), (-0.0125, 0.1, -3.0), (-0.0125, 0.1, 3.0), (-3.0, 0.1, 3.0)]
_HIGH = [(-3.0, 1.8, 0.09), (3.0, 1.8, 0.09), (3.0, 1.8, 3.0), (-3.0, 1.8, 3.0)]
_LEFT = [np.array([x, 2.0, z]) for x, z in [(-0.25, -0.4), (0.4, -0.4), (0.4, 0.1), (-0.25, 0.1)]]
_BEHIND = [(-3.0, 2.6, -3.0), (3.0, 2.6, -3.0), (3.0, 2.6, 3.0), (-3.0, 2.6, 3.0)]
_BRIGHT = Lamp((1.2, 1.8, 0.4), (-0.5, -1, 0), 0.7, radiance=6.0)


def _furnace() -> Scene:
    scene = _floor(Scene(), rho=0.5, turn=_TURN)
    scene.add_light(Environment(1.0))
    return scene


def _turned() -> NDArray[np.float64]:
    """A rotation about no axis in particular: coordinates of the plane's points are then rounded, as in any model."""
    a, b = 0.7, 0.4
    about_x = np.array([[1, 0, 0], [0, math.cos(a), -math.sin(a)], [0, math.sin(a), math.cos(a)]])
    about_z = np.array([[math.cos(b), -math.sin(b), 0], [math.sin(b), math.cos(b), 0], [0, 0, 1]])
    return np.asarray(about_z @ about_x, np.float64)


_TURN = _turned()


def _over_the_plane(count: int) -> Rays:
    """Rays straight down onto points all over the turned plane."""
    spots = np.random.default_rng(1).uniform(-9, 9, (count, 2))
    on_plane = np.column_stack([spots[:, 0], np.full(count, 0.5), spots[:, 1]])
    return on_plane @ _TURN.T, np.tile(_TURN @ (0.0, -1.0, 0.0), (count, 1))


_ANY = (-math.inf, math.inf)
_LIT = [
    *(
        Case(name, _under(lamp), _at_origin, RHO / math.pi * irradiance(lamp), lamp)
        for name, lamp in LAMPS.items()
    ),
    Case(
        "two lamps, one brighter",
        _under(_OVERHEAD, _BRIGHT),
        _at_origin,
        RHO / math.pi * (irradiance(_OVERHEAD) + irradiance(_BRIGHT)),
        hints=(
            ((0.45, 0.55), "p(light) is missing: one of two lamps was drawn, with probability 1/2"),
            (
                _ANY,
                "with two lamps the light is wrong, with one it is right: which one is drawn, with which p(light)?",
            ),
        ),
    ),
    Case(
        "a darker floor",
        _under(_OVERHEAD, rho=0.3),
        _at_origin,
        0.3 / math.pi * irradiance(_OVERHEAD),
        hints=((_ANY, "the surface's own albedo is not heeded: f_r comes from scene.brdf"),),
    ),
    Case(
        "plate close above the floor",
        _wall(_wall(_under(_OVERHEAD), _CLOSE), _HIGH),
        _at_origin,
        RHO / math.pi * lambert(_LEFT),
        # Without the wall alone the share is 1.6, without V 2.
        hints=(
            (
                (1.0, 1.55),
                "too large an offset: shadow rays start so far above the surface that what lies close blocks less",
            ),
            ((1.55, 1.7), "shadow rays end long before the light (t_max): a wall close to it is not found"),
        ),
    ),
    Case(
        "lamp partly hidden",
        _wall(_under(_OVERHEAD), _EDGE),
        _at_origin,
        RHO / math.pi * lambert(_SEEN),
        hints=(
            ((3.0, math.inf), "V is missing: a wall between receiver and lamp changes nothing"),
            (
                _ANY,
                "what a wall hides of a lamp is wrong: is the shadow ray the segment to the point that was drawn?",
            ),
        ),
    ),
    Case(
        "wall behind the lamp",
        _wall(_under(_OVERHEAD), _BEHIND),
        _at_origin,
        RHO / math.pi * irradiance(_OVERHEAD),
        hints=((_ANY, "a wall behind the lamp shadows it: the shadow ray must end at the light (t_max)"),),
    ),
    Case(
        "furnace",
        _furnace,
        _over_the_plane,
        0.5,
        hints=(
            ((-0.01, 0.01), "light from infinity (an environment) is not seen"),
            (
                (0.01, 0.999),
                "false shadow: shadow rays start in the surface itself; give `at`, which knows a safe start",
            ),
            (_ANY, "under light from everywhere the answer is not ρ L"),
        ),
    ),
]


def _pit(opening: Lamp) -> Callable[[], Scene]:
    """Walls around the origin up to a square opening."""

    def scene() -> Scene:
        made, corner, (x, y, z) = _floor(Scene()), opening.side / 2, opening.center
        around = [
            (x - corner, z - corner),
            (x + corner, z - corner),
            (x + corner, z + corner),
            (x - corner, z + corner),
        ]
        for (x0, z0), (x1, z1) in zip(around, [*around[1:], around[0]], strict=True):
            walls = np.array([(x0, 0, z0), (x1, 0, z1), (x1, y, z1), (x0, y, z0)])
            made.add_mesh(walls, [(0, 1, 2), (0, 2, 3)], material=Diffuse(0.0))
        return made

    return scene


def _open_plane() -> Scene:
    return _floor(Scene(), turn=_TURN)


# As far beside the origin as it is high: from a start above the floor it hides less, from above it nothing.
_LOW = [(0.1, 0.0, -3.0), (0.1, 0.1, -3.0), (0.1, 0.1, 3.0), (0.1, 0.0, 3.0)]


# So large that an offset of some hands changes nothing in them.
PITS = {
    "pit as deep as half its width": Lamp((0, 50.0, 0), (0, -1, 0), 100.0),
    "deep pit": Lamp((0, 125.0, 0), (0, -1, 0), 100.0),
    "near a wall of the pit": Lamp((40.0, 50.0, 25.0), (0, -1, 0), 100.0),
    "shallow pit": Lamp((25.0, 10.0, 0), (0, -1, 0), 80.0),
}
_OCCLUDED = [
    *(Case(name, _pit(pit), _at_origin, irradiance(pit) / math.pi, pit) for name, pit in PITS.items()),
    Case(
        "low wall beside",
        _wall(lambda: _floor(Scene()), _LOW),
        _at_origin,
        1 - lambert([np.array(corner) for corner in _LOW]) / math.pi,
        # Without the wall the share is 1.17.
        hints=(
            (
                (1.0, 1.2),
                "too large an offset: rays start so far above the surface that what lies close blocks less",
            ),
        ),
    ),
    Case(
        "open plane",
        _open_plane,
        _over_the_plane,
        1.0,
        hints=(
            ((-0.01, 0.01), "an open plane is found closed: 1 means open, 0 closed"),
            (
                (0.01, 0.999),
                "false shadow: rays start in the surface itself; give `at`, which knows a safe start",
            ),
            (_ANY, "an open plane is not 1"),
        ),
    ),
]


_NO_LAMP = (
    "no lamp gives light: a shadow ray that does not end at the light (t_max) is blocked by the lamp itself"
)
_OWN_LAMP = "the lamp blocks its own shadow rays: they end at r exactly, which is rounded; t_max must be less"
_NO_OPENING = "every pit is found closed: rays that should leave through its opening are blocked"
_SOME_OPENING = "some pits are found closed: rays that should leave through their opening are blocked"


class Kind(NamedTuple):
    """What a function estimates: its cases (most on a floor of `albedo`), built-in scenes to agree on, with what."""

    cases: list[Case]
    albedo: float
    scenes: tuple[str, ...]
    estimator: str
    # What is wrong where no lamp, or no pit, gives any light, and where some give none.
    dark: str
    darkened: str
    # Exponents of cos θ, cos θ′ and 1/r that are tried for what answers follow.
    laws: Sequence[Exponents] = EXPONENTS


KINDS = {
    "light": Kind(_LIT, RHO, ("pillars", "cornell-box"), "mis", _NO_LAMP, _OWN_LAMP),
    # Light that comes from surfaces alone: what the area form sees.
    "lamps": Kind(
        [case for case in _LIT if case.name != "furnace"],
        RHO,
        ("pillars", "cornell-box"),
        "mis",
        _NO_LAMP,
        _OWN_LAMP,
    ),
    # Nothing but cos θ is in the integral; under a level opening cos θ′ would be the same.
    "occlusion": Kind(
        _OCCLUDED,
        1.0,
        ("pillars",),
        "ambient-occlusion",
        _NO_OPENING,
        _SOME_OPENING,
        [(cos, 1, 2) for cos in range(5)],
    ),
}
