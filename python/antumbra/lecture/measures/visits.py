"""What shadow rays cost, one from each pixel: boxes and primitives visited, and rays a second."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from antumbra.anatomy import Visits
from antumbra.hit import Receivers
from antumbra.lecture.measures.replicates import mean_of, median_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.scene import Scene

RAYS = {True: "blocked", False: "free"}
COUNTS = ("any_boxes", "closest_boxes", "any_primitives", "closest_primitives")
# Of each kind of hit in turn, to know its rate.
_CALLS = 21
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
    """The share of rays with another answer from any hit than from closest hit, both along the same numbers."""
    along = asked.targets - asked.receivers.positions
    any_hit = scene.occluded(asked.receivers, directions=along, max_distance=_SHORT)
    closest = scene.closest_hit(asked.receivers, along, _SHORT)
    return float(np.mean(any_hit != np.isfinite(closest.t)))


def visits_measured(
    run: Run, scene: Scene, size: tuple[int, int], times: int
) -> tuple[dict[str, Quantity], float]:
    """Of `times` random points of a light each: means of every count of `COUNTS`, shares, what any hit saves, and rates
    (`_rates`), for rays that are "blocked" and "free"; and the share of rays where the two kinds of hit disagree.
    """
    asked = [shadow_rays(scene, size, np.random.default_rng(run.seeded(n))) for n in range(times)]
    found = {"saved": mean_of([each.saved() for each in asked], unit="%")}
    for blocked, word in RAYS.items():
        chosen = [each.visits.blocked == blocked for each in asked]
        for count in COUNTS:
            found[f"{count}_{word}"] = mean_of([each.mean(count, blocked) for each in asked])
        found[f"share_{word}"] = mean_of([np.mean(some) for some in chosen], unit="%")
        saved = [each.saved(some) for each, some in zip(asked, chosen, strict=True)]
        found[f"saved_{word}"] = mean_of(saved, unit="%")
        found |= {f"{what}_{word}": rate for what, rate in _rates(scene, asked[0], blocked).items()}
    return found, float(np.mean([disagree(scene, each) for each in asked]))


def _rates(scene: Scene, asked: Asked, blocked: bool) -> dict[str, Quantity]:
    """Rates of any hit and of closest hit on all cores [million rays/s], and the one over the other: `faster`.

    Both kinds are called in turn, so that whatever else the machine does meets both, and the ratio is taken call by
    call; medians.
    """
    some = asked.visits.blocked == blocked
    receivers, targets = asked.receivers[some], asked.targets[some]
    along = targets - receivers.positions
    calls: list[Callable[[], object]] = [
        lambda: scene.occluded(receivers, targets),
        lambda: scene.closest_hit(receivers, along, _SHORT),
    ]
    # The first pair of calls warms up.
    turns = np.array([[_seconds(call) for call in calls] for _ in range(1 + _CALLS)])[1:]
    rates, note = (
        len(targets) / turns / 1e6,
        f"median of {_CALLS} calls on all cores, both kinds in turn",
    )
    return {
        "any_rate": median_of(rates[:, 0], "M/s", note),
        "closest_rate": median_of(rates[:, 1], "M/s", note),
        "faster": median_of(rates[:, 0] / rates[:, 1], "", note),
    }


def _seconds(call: Callable[[], object]) -> float:
    began = time.perf_counter()
    call()
    return time.perf_counter() - began
