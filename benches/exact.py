"""Who is right where answers differ: the question decided in rational numbers, without rounding."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
Vector = tuple[Fraction, Fraction, Fraction]


def blocked(corners: Array, origin: Array, direction: Array, reach: float) -> bool:
    """Some closed triangle of `corners` (F, 3, 3) is met at 0 < t < `reach`; one that is parallel to the ray is not."""
    o, d = _vector(origin), _vector(direction)
    far = None if np.isinf(reach) else Fraction(float(reach))
    return any(_hit(o, d, far, corners[i]) for i in _candidates(corners, origin, direction))


def _candidates(corners: Array, origin: Array, direction: Array) -> Array:
    """Triangles that the line may meet: decided in double precision, with far more room than its rounding needs."""
    a, b, c = (corners.astype(np.float64) - origin.astype(np.float64)).transpose(1, 0, 2)
    d = direction.astype(np.float64)
    sides, room = [], []
    for p, q in ((a, b), (b, c), (c, a)):
        sides.append(np.cross(p, q) @ d)
        room.append(1e-12 * np.linalg.norm(p, axis=1) * np.linalg.norm(q, axis=1) * np.linalg.norm(d))
    above = np.any([w > r for w, r in zip(sides, room, strict=True)], axis=0)
    below = np.any([w < -r for w, r in zip(sides, room, strict=True)], axis=0)
    return np.flatnonzero(~(above & below))


def _hit(o: Vector, d: Vector, far: Fraction | None, triangle: Array) -> bool:
    a, b, c = (_minus(_vector(corner), o) for corner in triangle)
    w = [_dot(d, _cross(p, q)) for p, q in ((a, b), (b, c), (c, a))]
    det, v = sum(w), _dot(a, _cross(b, c))
    if det == 0 or any(side * det < 0 for side in w):
        return False
    t = v / det
    return t > 0 and (far is None or t < far)


def _vector(values: Array) -> Vector:
    x, y, z = (Fraction(float(value)) for value in values)
    return x, y, z


def _minus(p: Vector, q: Vector) -> Vector:
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def _cross(p: Vector, q: Vector) -> Vector:
    return p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]


def _dot(p: Vector, q: Vector) -> Fraction:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
