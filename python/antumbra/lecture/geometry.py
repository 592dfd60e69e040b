"""Closed forms that figures are held against: similar triangles, overlapping disks; where a camera sees a point."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Project = Callable[[ArrayLike], tuple[float, float]]


class Disks(NamedTuple):
    """A disk of light of radius `R`, a parallel disk of radius `r` at distance `a` before it, all on one axis."""

    R: float
    r: float
    a: float

    def umbra(self, g: float) -> float:
        """Radius of the umbra at `g` behind the occluder; where it is negative, less it is that of the antumbra."""
        return self.r - (self.R - self.r) * g / self.a

    def penumbra(self, g: float) -> float:
        """Outer radius of the penumbra at `g` behind the occluder."""
        return self.r + (self.R + self.r) * g / self.a

    @property
    def length(self) -> float:
        """How far behind the occluder the umbra closes: a r / (R − r)."""
        return self.a * self.r / (self.R - self.r)


def lens(first: float, second: float, apart: float) -> float:
    """Area that two disks of these radii have in common, their centres `apart`."""
    small, large = min(first, second), max(first, second)
    if apart >= small + large:
        return 0.0
    if apart <= large - small:
        return math.pi * small**2
    a = (apart**2 + small**2 - large**2) / (2 * apart * small)
    b = (apart**2 + large**2 - small**2) / (2 * apart * large)
    kite = math.sqrt((small + large) ** 2 - apart**2) * math.sqrt(apart**2 - (large - small) ** 2) / 2
    return small**2 * math.acos(a) + large**2 * math.acos(b) - kite


class Bodies(NamedTuple):
    """Radii of sun, moon and earth and the distance `unit` of the sun from the earth [km]; all three in line.

    The earth's centre is the origin, sun and moon lie along x.
    """

    sun: float
    moon: float
    earth: float
    unit: float

    def length(self, distance: float) -> float:
        """Length of the umbra, from the moon's centre [km]: D r / (R − r), D from the sun to the moon."""
        return (self.unit - distance) * self.moon / (self.sun - self.moon)

    @property
    def turns(self) -> float:
        """Distance of the moon at which the tip of the umbra touches the ground: total below, annular above [km]."""
        share = self.moon / (self.sun - self.moon)
        return (self.unit * share + self.earth) / (1 + share)

    def umbra(self, distance: float) -> float:
        """Radius of the umbra on the ground [km], the moon at `distance`; negative: less that of the antumbra."""
        rise = math.tan(math.asin((self.sun - self.moon) / (self.unit - distance)))
        return (self.length(distance) - (distance - self.earth)) * rise

    def penumbra(self, distance: float) -> float:
        """Outer radius of the penumbra [km], in the plane through the ground below the moon."""
        spread = math.asin((self.sun + self.moon) / (self.unit - distance))
        return self.moon / math.cos(spread) + (distance - self.earth) * math.tan(spread)

    def on_ground(self, beside: float) -> NDArray[np.float64]:
        """The point of the earth's surface `beside` km from the axis, towards y."""
        return np.array([math.sqrt(self.earth**2 - beside**2), beside, 0.0])

    def covered(self, distance: float, beside: float) -> float:
        """Share of the sun's disk that the moon covers from `on_ground(beside)`: flat disks of the angular radii."""
        p = self.on_ground(beside)
        to_sun, to_moon = np.array([self.unit, 0, 0]) - p, np.array([distance, 0, 0]) - p
        far, near = float(np.linalg.norm(to_sun)), float(np.linalg.norm(to_moon))
        sun, moon = math.asin(self.sun / far), math.asin(self.moon / near)
        apart = math.asin(float(np.linalg.norm(np.cross(to_sun, to_moon))) / (far * near))
        return lens(sun, moon, apart) / (math.pi * sun**2)


def projector(eye: ArrayLike, look_at: ArrayLike, fov: float, size: tuple[int, int]) -> Project:
    """Where a camera that stands upright sees a point, in pixels from the upper left; `fov` is vertical."""
    origin = np.asarray(eye, np.float64)
    forward = np.asarray(look_at) - origin
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    upward, scale = np.cross(right, forward), size[1] / 2 / np.tan(fov / 2)

    def project(point: ArrayLike) -> tuple[float, float]:
        toward = np.asarray(point) - origin
        x, y = (float(toward @ axis / (toward @ forward) * scale) for axis in (right, upward))
        return size[0] / 2 + x, size[1] / 2 - y

    return project


def seen_from_above(side: int) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """The hemisphere over a point from straight above, in `side` × `side` cells: which lie in the disk, their middles.

    (side, side) and directions (N, 3), up along +y, +x at the right, +z up. Equal areas are equal parts of ∫ cos θ dω.
    """
    x = (np.arange(side) + 0.5) * 2 / side - 1
    right, up = np.meshgrid(x, -x)
    square = right**2 + up**2
    inside: NDArray[np.bool_] = square < 1.0
    along = np.stack([right, np.sqrt(np.maximum(1.0 - square, 0.0)), up], -1)
    return inside, along[inside]
