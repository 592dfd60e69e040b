"""What shadow rays cost, one from each pixel: boxes and primitives visited, and rays a second."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.anatomy import Visits
from antumbra.hit import Receivers
from antumbra.scene import Scene

# Closest hit ends this far before the light, which it would meet otherwise.
_SHORT = 0.9999


class Asked(NamedTuple):
    """One shadow ray from each pixel whose receiver a light can reach."""

    where: NDArray[np.bool_]
    """(H, W)"""
    receivers: Receivers
    targets: NDArray[np.float64]
    visits: Visits

    def mean(self, count: str, blocked: bool) -> float:
        """Mean of a count of `Visits` over the rays that are blocked, or over those that are free."""
        counts: NDArray[np.uint32] = getattr(self.visits, count)
        return float(np.mean(counts[self.visits.blocked == blocked]))

    def total(self, kind: str) -> NDArray[np.float64]:
        """Boxes and primitives of each ray, for "any" or "closest" hit."""
        boxes, primitives = (getattr(self.visits, f"{kind}_{what}") for what in ("boxes", "primitives"))
        both: NDArray[np.float64] = np.add(boxes, primitives, dtype=np.float64)
        return both

    def saved(self, some: NDArray[np.bool_] | slice = slice(None)) -> float:
        """The share of visits that any hit leaves out, of all rays or of some."""
        return float(1 - self.total("any")[some].sum() / self.total("closest")[some].sum())

    def picture(self, values: ArrayLike) -> NDArray[np.float64]:
        """Values of the rays as (H, W); NaN where there is none."""
        found = np.full(self.where.shape, np.nan)
        found[self.where] = values
        return found


def shadow_rays(scene: Scene, size: tuple[int, int], random: np.random.Generator | None = None) -> Asked:
    """Through the pixel centres to random points of one light, or all to its middle, and what that visits."""
    hit = scene.closest_hit(*scene.camera_rays(size))
    met = np.isfinite(hit.t)
    receivers = hit.receivers[met]
    cube = np.full((len(receivers), 3), 0.5) if random is None else random.random((len(receivers), 3))
    cube[:, 0] = 0.01
    samples = scene.sample_light(receivers, None, cube, lights="uniform", light_points="area")
    reached = samples.radiance.max(1) > 0
    met[met] = reached
    receivers, targets = receivers[reached], samples.target[reached]
    return Asked(met.reshape(size[::-1]), receivers, targets, scene.visits(receivers, targets))


def disagree(scene: Scene, asked: Asked) -> float:
    """The share of rays whose answer differs from what their closest hit says: another object before the light."""
    met = scene.closest_hit(asked.receivers, asked.targets - asked.receivers.positions, 1.001)
    light = np.bincount(met.mesh[abs(met.t - 1.0) < 1e-3]).argmax()
    blocked = (met.t < _SHORT) & (met.mesh != light)
    return float(np.mean(blocked != asked.visits.blocked))


def rates(scene: Scene, asked: Asked, blocked: bool) -> tuple[float, float]:
    """Million rays a second of any hit and of closest hit on all cores, the best of five calls each."""
    some = asked.visits.blocked == blocked
    receivers, targets = asked.receivers[some], asked.targets[some]
    along = targets - receivers.positions
    return (
        _rate(len(targets), lambda: scene.occluded(receivers, targets)),
        _rate(len(targets), lambda: scene.closest_hit(receivers, along, _SHORT)),
    )


def _rate(count: int, call: Callable[[], object]) -> float:
    took = []
    for _ in range(5):
        began = time.perf_counter()
        call()
        took.append(time.perf_counter() - began)
    return count / min(took) / 1e6
