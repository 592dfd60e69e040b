"""The same rays in two orders: receiver by receiver, and so that no two neighbours share anything. What each takes."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.ratio import ratio
from antumbra.lecture.measures.replicates import median_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.variant import Pick
from antumbra.occlusion import Occlusion
from antumbra.scene import Scene

Rows = NDArray[np.float32]
# Of each way in turn, to know its rate.
_CALLS = 7
# A start lies above its point by this part of the point's largest coordinate, as `occlusion_masks` has it.
_LIFT = 2.0**-21
# Pixels of the picture whose places ask for light.
_PIXELS = Pick((108, 72), (384, 256))
COUNTS = (1, 16, 64, 256)


def starts(points: NDArray[np.float64], normals: NDArray[np.float64]) -> Rows:
    """Where the rays of points with normals (N, 3) start."""
    lifted = points + normals * (_LIFT * np.abs(points).max(1, keepdims=True))
    return np.asarray(lifted, np.float32)


def rays_of(masks: Occlusion, start: Rows) -> tuple[Rows, Rows, NDArray[np.float64]]:
    """Starts, directions and lengths of all rays that masks of `start` (N, 3) decide, receiver by receiver."""
    x, y, z = (masks.directions[None, :, k, None] for k in range(3))
    # In the order of operations in which the core computes it: the bits are the same.
    along = (x * masks.frames[:, None, 0] + y * masks.frames[:, None, 1]) + z * masks.frames[:, None, 2]
    count = len(masks.directions)
    return np.repeat(start, count, 0), along.reshape(-1, 3), np.tile(masks.lengths, len(start)).astype(float)


def in_turn(
    ways: Mapping[str, Callable[[], Any]], count: int, ready: Callable[[], Any] = lambda: None
) -> tuple[dict[str, Any], dict[str, Quantity]]:
    """What each way answers, and how many of `count` rays [million] it decides in a second of processor time.

    `ready`: what the ways behind the second one do first, once for any number of rays: its time does not count.
    """
    found, seconds, made = {}, np.empty((_CALLS, len(ways))), []
    # The first round is not timed: the core learns in it which way is the faster one.
    for turn in range(-1, _CALLS):
        for k, (name, ask) in enumerate(ways.items()):
            began = time.process_time()
            found[name] = ask()
            seconds[turn, k] = time.process_time() - began
        began = time.process_time()
        ready()
        made.append(time.process_time() - began)
    # What is left of a short call may drown in other work.
    seconds[:, 2:] = np.maximum(seconds[:, 2:] - np.median(made), seconds[:, 2:] / 100)
    note = f"median of {_CALLS} calls, the ways in turn, by processor time of all threads"
    rates = {name: median_of(count / seconds[:, k] / 1e6, "M/s", note) for k, name in enumerate(ways)}
    return found, rates


class Asked:
    """Segments of which two orders are kept ready, so that only the asking is timed."""

    def __init__(self, run: Run, scene: Scene, origins: Rows, **ends: Any) -> None:
        """`origins` (N, 3); `ends`: what else `Scene.occluded` takes, (N, …) each."""
        self._order = np.random.default_rng(run.seeded(0)).permutation(len(origins))
        self._scene, self._own = scene, (origins, ends)
        self._mixed = origins[self._order], {name: of[self._order] for name, of in ends.items()}

    def together(self) -> NDArray[np.bool_]:
        """The answers, asked in the order of the rays."""
        return self._scene.occluded(self._own[0], **self._own[1])

    def single(self) -> NDArray[np.bool_]:
        """The answers, asked in a random order; given in that order, `back` puts them right."""
        return self._scene.occluded(self._mixed[0], **self._mixed[1])

    def back(self, found: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Answers of `single` in the order of the rays."""
        right = np.empty_like(found)
        right[self._order] = found
        return right


def of_light(
    run: Run, scene: Scene, name: str, corner: Rows, sides: Rows
) -> tuple[dict[str, Quantity], int, int]:
    """`name-light-N-single`, `-together`: rates of N points of a parallelogram of light (`sides` (2, 3) from `corner`)
    for each receiver, `-worth`: the second over the first. And how many answers differ, of how many.

    About as many rays for each N: the places of all pixels, or of every N-th.
    """
    hit = scene.closest_hit(*scene.camera_rays(run.pick(_PIXELS)))
    toward = corner + sides.sum(0) / 2 - hit.position
    facing = np.isfinite(hit.t) & ((toward * hit.normal).sum(1) > 0)
    start = starts(hit.position[facing], hit.normal[facing])
    found: dict[str, Quantity] = {}
    differ = compared = 0
    for n in COUNTS:
        some = start[::n]
        rays = Asked(run, scene, np.repeat(some, n, 0), targets=_points(run, len(some), n, corner, sides))
        answers, rates = in_turn({"single": rays.single, "together": rays.together}, n * len(some))
        differ += int(np.sum(rays.back(answers["single"]) != answers["together"]))
        compared += n * len(some)
        key = f"{name}-light-{n}"
        found |= {f"{key}-{way}": rate for way, rate in rates.items()}
        found[f"{key}-worth"] = ratio(rates["together"], rates["single"])
    return found, differ, compared


def _points(run: Run, receivers: int, n: int, corner: Rows, sides: Rows) -> Rows:
    """One random point in each of n = k² equal parts of the light, for each receiver, (receivers · n, 3)."""
    k = round(n**0.5)
    part = np.stack(np.meshgrid(np.arange(k), np.arange(k), indexing="ij"), -1).reshape(-1, 2)
    uv = (part + np.random.default_rng(run.seeded(1)).random((receivers, n, 2))) / k
    return np.asarray(corner + uv.reshape(-1, 2) @ sides, np.float32)
