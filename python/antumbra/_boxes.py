"""A tree of boxes over triangles, asked for every triangle that a ray may meet; whole arrays of rays at once."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

# Boxes in a group.
WIDTH = 8
# Pairs of ray and group that are looked at together: their arrays stay in a cache.
BATCH = 4096


class Boxes:
    """Groups of eight boxes, level over level; no triangle that a ray meets is left out.

    In the precision of the corners. Boxes are not padded: with u the rounding of that precision, (low − o) / d is right
    to 3u relatively, or to the smallest number where it underflows; the comparison has more room than that. In single
    precision, directions have no component in (0, 2⁻¹⁰⁰) and a largest one in [2⁻⁴⁰, 2⁴⁰]: 1 / d does not overflow.
    """

    def __init__(self, corners: Array) -> None:
        """`corners` (F, 3, 3) float32 or float64, F ≥ 1."""
        low, high = corners.min(axis=1), corners.max(axis=1)
        limits = np.finfo(corners.dtype)
        # 32u; and far more than what underflow takes away.
        self._room, self._floor = 1 + 16 * limits.eps, corners.dtype.type(limits.tiny * 64)
        self.low, self.high = low.min(axis=0), high.max(axis=0)
        self._order = _neighbours((low.astype(np.float64) + high) / 2)
        # A place that no triangle takes is a box that no ray reaches.
        never = np.full((1, 3), np.inf, corners.dtype)
        low = np.append(low, never, axis=0)[self._order]
        high = np.append(high, -never, axis=0)[self._order]
        self._levels: list[Array] = []
        while True:
            lows, highs = _groups(low, np.inf), _groups(high, -np.inf)
            # An axis after the other: first all low sides, then all high ones.
            self._levels.append(np.concatenate([lows, highs], axis=1))
            if lows.shape[1] == 1:
                break
            low, high = lows.min(axis=2).T, highs.max(axis=2).T

    def near(self, origins: Array, directions: Array) -> Iterator[tuple[Array, Array]]:
        """Rays and the triangles that they may meet at t ≥ 0, as pairs of numbers, batch by batch.

        `origins`, `directions` (N, 3) of the corners' precision. A ray without a direction meets nothing.
        """
        rays = np.flatnonzero(directions.any(axis=1))
        o = np.ascontiguousarray(origins.T)
        with np.errstate(divide="ignore", over="ignore"):
            slope = 1 / np.ascontiguousarray(directions.T)
        waiting = [(len(self._levels) - 1, rays, np.zeros(len(rays), np.int64))]
        while waiting:
            level, rays, groups = waiting.pop()
            if len(rays) > BATCH:
                waiting.append((level, rays[BATCH:], groups[BATCH:]))
                rays, groups = rays[:BATCH], groups[:BATCH]
            which, child = np.nonzero(self._reached(level, o[:, rays], slope[:, rays], groups))
            rays, boxes = rays[which], groups[which] * WIDTH + child
            if level == 0 and len(rays):
                yield rays, self._order[boxes]
            elif len(rays):
                waiting.append((level - 1, rays, boxes))

    def _reached(self, level: int, o: Array, slope: Array, groups: Array) -> Array:
        """(M, 8): ray m may reach box k of its group."""
        sides, back = self._levels[level], slope < 0
        count = sides.shape[1] // 2
        # Parallel to two sides and in one of them: 0 · ∞, NaN, is within, everywhere; fmax and fmin pass it over.
        flat = np.isinf(slope).any()
        later, sooner = (np.fmax, np.fmin) if flat else (np.maximum, np.minimum)
        enter, leave = np.full((2, len(groups), 1), [[[-np.inf]], [[np.inf]]], o.dtype)
        with np.errstate(invalid="ignore", over="ignore"):
            for axis in range(3):
                start, steep = o[axis][:, None], slope[axis][:, None]
                turned = back[axis] * count
                first, last = (
                    sides[axis].take(groups + turned, 0),
                    sides[axis].take(groups + (count - turned), 0),
                )
                for plane in (first, last):
                    np.subtract(plane, start, out=plane)
                    np.multiply(plane, steep, out=plane)
                enter, leave = later(enter, first), sooner(leave, last)
            reached: Array = (leave >= 0) & (enter <= leave * self._room + self._floor)
            return reached


def _groups(rows: Array, nothing: float) -> Array:
    """(3, groups, 8) of (N, 3) rows; the last group is filled up with `nothing`."""
    count = -(-len(rows) // WIDTH)
    padded = np.full((count * WIDTH, 3), nothing, rows.dtype)
    padded[: len(rows)] = rows
    return np.ascontiguousarray(padded.reshape(count, WIDTH, 3).transpose(2, 0, 1))


def _neighbours(points: Array) -> Array:
    """An order in which 8, 64, 512, … points that follow each other lie together: halves along the longest side.

    Filled up to 8 · 2ᵏ places; those that no point takes hold the number of points.
    """
    count, places = len(points), WIDTH
    while places < count:
        places *= 2
    order = np.minimum(np.arange(places), count)
    # What fills up lies in the farthest corner, so that it comes last.
    points = np.append(points, points.max(axis=0)[None], axis=0)
    length = places
    while length > WIDTH:
        parts = points[order].reshape(-1, length, 3)
        longest = (parts.max(axis=1) - parts.min(axis=1)).argmax(axis=1)
        keys = np.take_along_axis(parts, longest[:, None, None], axis=2)[:, :, 0]
        order = np.take_along_axis(order.reshape(-1, length), np.argsort(keys, axis=1), axis=1).reshape(-1)
        length //= 2
    return order
