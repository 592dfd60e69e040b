"""The law of visibility for pairs (ray, triangle), in double precision, and in whole numbers where that is too close.

What the core decides for the closest triangle, this decides for each.

With A = a − o, B = b − o, C = c − o: W₀ = d·(A × B), W₁ = d·(B × C), W₂ = d·(C × A), D = W₀ + W₁ + W₂, V = A·(B × C). A
ray meets the closed triangle iff D ≠ 0, no Wᵢ has the sign opposite to D, and t = V / D > 0.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
# Three arrays of the same length, one a component; of float64, or of Python's whole numbers.
Vectors = tuple[Array, Array, Array]

# 10 roundings of double precision: what Wᵢ, V and D may be off by, relative to the sums of their absolute terms.
TEN_W = 10 * 2.0**-53
# Stands for what underflow may take away.
FLOOR = 2.0**-1000
# Two computed t of the same place differ by less, relatively; each is right to 2⁻²⁹.
NEAR = 2.0**-27


class Pairs(NamedTuple):
    """Rays and triangles, pair by pair: origins, directions and the three corners."""

    o: Vectors
    d: Vectors
    a: Vectors
    b: Vectors
    c: Vectors

    def take(self, chosen: Array) -> Pairs:
        """Some of them."""
        o, d, a, b, c = ((x[chosen], y[chosen], z[chosen]) for x, y, z in self)
        return Pairs(o, d, a, b, c)


def vectors(rows: Array) -> Vectors:
    """The components of (N, 3) rows."""
    return rows[:, 0], rows[:, 1], rows[:, 2]


def minus(p: Vectors, q: Vectors) -> Vectors:
    """p − q."""
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def plus(p: Vectors, q: Vectors) -> Vectors:
    """p + q."""
    return p[0] + q[0], p[1] + q[1], p[2] + q[2]


def dot(p: Vectors, q: Vectors) -> Array:
    """p · q."""
    found: Array = (p[0] * q[0] + p[1] * q[1]) + p[2] * q[2]
    return found


def cross(p: Vectors, q: Vectors) -> Vectors:
    """p × q."""
    return p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]


def size(p: Vectors) -> Vectors:
    """Absolute components."""
    return np.abs(p[0]), np.abs(p[1]), np.abs(p[2])


def cross_size(p: Vectors, q: Vectors) -> Vectors:
    """The terms of p × q added up instead of subtracted, for components that are not negative."""
    return p[1] * q[2] + p[2] * q[1], p[2] * q[0] + p[0] * q[2], p[0] * q[1] + p[1] * q[0]


def plane(pairs: Pairs) -> tuple[Array, Array]:
    """V and how much it may be off: on which side of the triangle's plane the origin lies."""
    e0, e1, to_a = minus(pairs.b, pairs.a), minus(pairs.c, pairs.b), minus(pairs.a, pairs.o)
    v = dot(to_a, cross(e0, e1))
    return v, TEN_W * dot(size(to_a), cross_size(size(e0), size(e1))) + FLOOR


def hits(pairs: Pairs) -> tuple[Array, Array]:
    """Which pairs meet, as their numbers, and t of each, right to 2⁻²⁹ relatively."""
    certain, t, open_ = _filter(pairs)
    chosen, found = np.flatnonzero(open_), np.zeros(len(t), bool)
    if len(chosen):
        exact = Exact(pairs.take(chosen))
        found[chosen] = met = exact.met()
        t[chosen[met]] = exact.t(met)
    numbers = np.flatnonzero(certain | found)
    return numbers, t[numbers]


def _filter(pairs: Pairs) -> tuple[Array, Array, Array]:
    """Which surely meet, their t, and which are too close to say."""
    o, d, a, b, c = pairs
    to = minus(a, o), minus(b, o), minus(c, o)
    edges = minus(b, a), minus(c, b), minus(a, c)
    along = size(d)
    all_above, all_below = np.ones((2, len(o[0])), bool)
    any_above, any_below = np.zeros((2, len(o[0])), bool)
    for edge, p, q in zip(edges, to, (to[1], to[2], to[0]), strict=True):
        # e × (P + Q) = −2 P × Q: the same number, negated, from the two triangles of an edge.
        w = dot(d, cross(edge, plus(p, q)))
        room = TEN_W * dot(along, cross_size(size(edge), plus(size(p), size(q)))) + FLOOR
        above, below = w > room, w < -room
        all_above, all_below = all_above & above, all_below & below
        any_above, any_below = any_above | above, any_below | below
    e0, e1 = size(edges[0]), size(edges[1])
    normal, normal_size = cross(edges[0], edges[1]), cross_size(e0, e1)
    det, det_room = dot(d, normal), TEN_W * dot(along, normal_size) + FLOOR
    v, v_room = dot(to[0], normal), TEN_W * dot(size(to[0]), normal_size) + FLOOR
    side = np.where(all_above, -1.0, np.where(all_below, 1.0, np.sign(det)))
    inside = all_above | all_below
    sure = inside | (np.abs(det) > det_room)
    v = side * v
    miss = (any_above & any_below) | (sure & (v < -v_room))
    miss |= sure & np.where(side > 0, any_above, any_below)
    sharp = (v_room <= 2.0**-30 * v) & (det_room <= 2.0**-30 * np.abs(det))
    hit = inside & sharp & ~miss
    with np.errstate(divide="ignore", invalid="ignore"):
        return hit, v / np.abs(det), ~hit & ~miss


class Exact:
    """Pairs in whole numbers: every sign and every comparison of distances without rounding."""

    def __init__(self, pairs: Pairs) -> None:
        """Scales places by one power of two and directions by another, so that all are whole."""
        places, self._place_scale = _whole([*pairs.o, *pairs.a, *pairs.b, *pairs.c])
        along, self._along_scale = _whole([*pairs.d])
        o, a, b, c = ((places[k], places[k + 1], places[k + 2]) for k in (0, 3, 6, 9))
        d = along[0], along[1], along[2]
        to_a, to_b, to_c = minus(a, o), minus(b, o), minus(c, o)
        ab, bc, ca = cross(to_a, to_b), cross(to_b, to_c), cross(to_c, to_a)
        self.w = dot(d, ab), dot(d, bc), dot(d, ca)
        self.det: Array = self.w[0] + self.w[1] + self.w[2]
        self.v = dot(to_a, bc)

    def met(self) -> Array:
        """The law."""
        side = sign(self.det)
        found: Array = (side != 0) & self.encloses() & (sign(self.v) * side > 0)
        return found

    def encloses(self) -> Array:
        """No Wᵢ has the sign opposite to D: the line meets the closed triangle, if it is not parallel to it."""
        w0, w1, w2 = (sign(w) * sign(self.det) >= 0 for w in self.w)
        found: Array = w0 & w1 & w2
        return found

    def t(self, chosen: Array) -> Array:
        """V / D, rounded once."""
        quotients = (self.v[chosen] / self.det[chosen]).astype(np.float64)
        return np.ldexp(quotients, self._place_scale - self._along_scale)

    def order(self) -> Array:
        """Whole numbers that are equal where t is equal as a real number, and larger where it is larger."""
        v, det = np.abs(self.v), np.abs(self.det)
        # Two unequal quotients differ by at least 1/D², so that their whole parts differ after this shift.
        bits = 2 * max((int(x).bit_length() for x in det), default=0) + 1
        found: Array = np.left_shift(v, bits) // det
        return found


def sign(values: Array) -> Array:
    """−1, 0 or 1."""
    return np.asarray(values > 0).astype(np.int8) - np.asarray(values < 0).astype(np.int8)


def _whole(values: list[Array]) -> tuple[list[Array], int]:
    """The numbers over 2^scale, whole; and the scale."""
    mantissas, exponents = np.frexp(np.array(values))
    whole = np.ldexp(mantissas, 53).astype(np.int64)
    zeros = np.array([_trailing(w) for w in whole]).reshape(whole.shape)
    exponents = exponents.astype(np.int64) - 53 + zeros
    used = whole != 0
    scale = int(exponents[used].min()) if used.any() else 0
    shifts = np.where(used, exponents - scale, 0).astype(object)
    return list(np.left_shift((whole >> zeros).astype(object), shifts)), scale


def _trailing(whole: Array) -> Array:
    """How many binary zeros each number ends with (0 for 0)."""
    lowest = (whole & -whole).astype(np.float64)
    return np.where(whole == 0, 0, np.frexp(lowest)[1] - 1).astype(np.int64)
