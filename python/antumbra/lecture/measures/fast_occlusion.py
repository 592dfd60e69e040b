"""Directions that are decided together, beside rays: the same bits, what it takes, how fast."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from antumbra.hit import Receivers
from antumbra.lecture.measures.replicates import median_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.occlusion import Occlusion
from antumbra.scene import Scene

METHODS = ("rays", "occluders", "receivers")
# Of each method in turn, to know its rate.
_CALLS = 7
# Corners of the middle of the picture are asked about: as many points a side as this.
_TILE = 8


class Asked(NamedTuple):
    """One kind of question about a scene, by each method."""

    differ: int
    """Bits that differ between methods, of all pairs of them with rays."""
    bits: int
    """Bits that were compared."""
    work: Occlusion
    """What "receivers" found."""
    rates: dict[str, Quantity]
    """Directions a second, by method [million]."""
    faster: dict[str, Quantity]
    """Directions a second over those of rays."""


def seen(run: Run, scene: Scene, size: tuple[int, int]) -> Receivers:
    """Points of tiles of 8 × 8 pixels that are spread over a picture of 16 times `size`, and meet something."""
    width, height = size
    rows, columns = (np.arange(n) for n in (height, width))
    origins, along = scene.camera_rays((16 * width, 16 * height))
    # Every sixteenth tile on both axes.
    at = [(n // _TILE) * _TILE * 16 + n % _TILE for n in (rows, columns)]
    picked = (at[0][:, None] * 16 * width + at[1]).ravel()
    hit = scene.closest_hit(origins[picked], along[picked])
    return hit.receivers[np.isfinite(hit.t)]


def asked(scene: Scene, receivers: Receivers, radius: float, count: int) -> Asked:
    """All methods in turn: the first round for the bits, the others for the rates."""
    found: dict[str, Occlusion] = {}
    seconds = np.empty((_CALLS, len(METHODS)))
    for turn in range(-1, _CALLS):
        for k, method in enumerate(METHODS):
            began = time.perf_counter()
            found[method] = scene.occlusion_masks(
                receivers, directions=count, radius=radius, method=method, turned=True
            )
            seconds[turn, k] = time.perf_counter() - began
    masks = [found[method].blocked for method in METHODS]
    differ = sum(int(np.sum(mask != masks[0])) for mask in masks[1:])
    note = f"median of {_CALLS} calls on all cores, the methods in turn"
    rates = {m: median_of(masks[0].size / seconds[:, k] / 1e6, "M/s", note) for k, m in enumerate(METHODS)}
    faster = {m: median_of(seconds[:, 0] / seconds[:, k], "", note) for k, m in enumerate(METHODS)}
    return Asked(differ, 2 * masks[0].size, found["receivers"], rates, faster)


def together(
    run: Run, scene: Scene, name: str, size: tuple[int, int], radii: Sequence[float], counts: Sequence[int]
) -> tuple[dict[str, Quantity], int, int]:
    """By radius and number of directions, named `name-radius-count`: triangles `in_range` of a point, `tested`
    directions of such a pair, `rays`, `occluders`, `receivers`: rates, `faster`: the better method over rays. And how
    many bits differ, of how many.
    """
    found, differ, bits = {}, 0, 0
    receivers = seen(run, scene, size)
    for radius in radii:
        for count in counts:
            one = asked(scene, receivers, radius, count)
            key, work = f"{name}-{radius:g}-{count}", one.work.work
            found[f"{key}-in_range"] = Quantity(work.in_range / len(receivers))
            found[f"{key}-tested"] = Quantity(work.tested / max(work.in_range, 1))
            found |= {f"{key}-{method}": rate for method, rate in one.rates.items()}
            found[f"{key}-faster"] = max((one.faster[m] for m in METHODS[1:]), key=lambda q: q.value)
            differ, bits = differ + one.differ, bits + one.bits
    return found, differ, bits
