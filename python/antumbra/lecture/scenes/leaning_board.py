"""A board that leans on a floor beside a ball: a scene at any scale, and its visibility in closed form.

Built upright, in metres: the floor is y = 0, the board rises from the line x = y = 0 at `ANGLE` to +x, a point light is
on the other side. Then everything is turned by `TURN`, so that no surface lies along an axis, and scaled.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

import antumbra as am

Rows = NDArray[np.float64]

ANGLE, LENGTH, HALF = np.radians(50.0), 0.9, 0.7
LIGHT, BALL, RADIUS = np.array([-2.2, 2.8, 0.7]), np.array([-0.6, 0.28, 0.95]), 0.28
FLOOR, BOARD, SPHERE = 0, 1, 2
_ALONG, _UP = np.array([np.cos(ANGLE), np.sin(ANGLE), 0.0]), np.array([-np.sin(ANGLE), np.cos(ANGLE), 0.0])
_EDGE = 4.0


def _turn() -> Rows:
    """A turn by 0.7 about (2, 3, 1) (Rodrigues' formula)."""
    x, y, z = np.array([2.0, 3.0, 1.0]) / np.sqrt(14.0)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    turned: Rows = np.eye(3) + np.sin(0.7) * cross + (1 - np.cos(0.7)) * cross @ cross
    return turned


TURN = _turn()


def placed(points: ArrayLike, scale: float) -> Rows:
    """Upright points (…, 3) in metres where the scene has them."""
    found: Rows = np.asarray(points, np.float64) @ TURN.T * scale
    return found


@cache
def leaning_board(scale: float) -> Callable[[], am.Scene]:
    """The scene with coordinates `scale` times as large as in metres."""

    def build() -> am.Scene:
        scene, grey = am.Scene("leaning-board"), am.materials.Diffuse(0.6)
        floor = np.array([[-1.0, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]]) * _EDGE
        scene.add_mesh(placed(floor, scale), [[0, 2, 1], [0, 3, 2]], material=grey, name="floor")
        foot = np.array([[0.0, 0, HALF], [0, 0, -HALF]])
        board = np.concatenate([foot, foot[::-1] + LENGTH * _ALONG])
        dark = am.materials.Diffuse(0.3)
        scene.add_mesh(placed(board, scale), [[0, 1, 2], [0, 2, 3]], material=dark, name="board")
        ball = am.shapes.Sphere(tuple(placed(BALL, scale)), RADIUS * scale)
        scene.add_shape(ball, material=grey, name="ball")
        light = am.lights.Point(tuple(placed(LIGHT, scale)), intensity=60.0 * scale**2)
        scene.add_light(light, name="light")
        return scene

    return build


def look(scale: float, eye: ArrayLike, at: ArrayLike, fov: float) -> dict[str, Any]:
    """Options of a camera that stands upright."""
    turned = {"eye": tuple(placed(eye, scale)), "look_at": tuple(placed(at, scale))}
    return {**turned, "up": tuple(placed((0, 1, 0), 1.0)), "fov": fov}


class Truth(NamedTuple):
    """What each of N viewing rays meets by the closed form, in double precision."""

    object: NDArray[np.int64]
    """FLOOR, BOARD, SPHERE, or −1."""
    distance: Rows
    """Along the ray, in metres; inf for a miss."""
    place: Rows
    """Upright, in metres, (N, 3)."""
    facing: NDArray[np.bool_]
    """The light shines on this side."""
    free: NDArray[np.bool_]
    """Nothing lies strictly between it and the light."""


def truth(origins: Rows, directions: Rows, scale: float) -> Truth:
    """Follows viewing rays (N, 3) of a camera in the scene."""
    o, d = origins / scale @ TURN, directions @ TURN
    with np.errstate(divide="ignore", invalid="ignore"):
        every = np.stack([_floor(o, d), _board(o, d), _ball(o, d)])
        met = np.where(np.isfinite(every.min(0)), every.argmin(0), -1)
        distance = every.min(0)
        place = np.where(met[:, None] >= 0, o + distance[:, None] * d, 0.0)
        normal = np.choose(np.maximum(met, 0)[:, None], [[0.0, 1.0, 0.0], _UP, (place - BALL) / RADIUS])
        normal *= -np.sign(np.sum(normal * d, 1))[:, None]
        toward = LIGHT - place
        facing = (met >= 0) & (np.sum(normal * toward, 1) > 1e-3 * np.linalg.norm(toward, axis=1))
        board = (_board(place, toward) < 1) & (met != BOARD)
        ball = (_ball(place, toward) < 1) & (met != SPHERE)
    return Truth(met, distance, place, facing, ~(board | ball))


def _floor(o: Rows, d: Rows) -> Rows:
    t = -o[:, 1] / d[:, 1]
    p = o + t[:, None] * d
    return np.where((t > 0) & (abs(p[:, [0, 2]]).max(1) < _EDGE), t, np.inf)


def _board(o: Rows, d: Rows) -> Rows:
    t = -(o @ _UP) / (d @ _UP)
    p = o + t[:, None] * d
    along = p @ _ALONG
    return np.where((t > 0) & (along > 0) & (along < LENGTH) & (abs(p[:, 2]) < HALF), t, np.inf)


def _ball(o: Rows, d: Rows) -> Rows:
    c, a = o - BALL, np.sum(d * d, 1)
    b = np.sum(c * d, 1)
    t = (-b - np.sqrt(b * b - a * (np.sum(c * c, 1) - RADIUS**2))) / a
    return np.where(t > 0, t, np.inf)
