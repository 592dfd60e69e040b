"""Noise and time of one shadow ray for all lamps, and of one for each."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.noise import reflected
from antumbra.lecture.measures.ratio import farthest_from_one, ratio, squared, times
from antumbra.lecture.measures.replicates import mean_of, median_of, of_interval
from antumbra.lecture.measures.seconds import of_rays
from antumbra.lecture.pictures import luminance
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.lecture.scenes.point_lights import VARIANCES, point_lights
from antumbra.lecture.variant import Pick
from antumbra.study import statistics

# How a lamp is drawn: all alike, in proportion to its power, to what it would give the receiver; or a ray to each.
WAYS = ("uniform", "power", "contribution", "all")
LAMPS = Pick([10, 100, 1000, 10_000], [10, 100, 1000, 10_000, 100_000])
# More lamps are not asked one by one here.
MOST = 1000
# Rays of a pixel where a lamp is drawn for each.
RAYS = 16
# A noise at which times are compared.
NOISE = 0.1


def measured(run: Run, way: str) -> list[int]:
    """The numbers of lamps for which a way is measured."""
    return [k for k in run.pick(LAMPS) if k <= MOST or way != "all"]


def lit(run: Run, key: str) -> NDArray[np.float64]:
    """Luminance of each replicate of a variant without the lamps that are seen themselves, (K, H, W)."""
    return luminance(reflected(run, key))


def _noise(run: Run, way: str, lamps: int) -> Quantity:
    """Standard deviation of a pixel over the mean light: of one ray, or of one to each lamp.

    One mean for all ways, that of the least noise among those that are measured.
    """
    found = statistics.root(statistics.variance(lit(run, f"{way}-{lamps}")))
    mean = lit(run, f"{'all' if lamps <= MOST else 'contribution'}-{lamps}").mean()
    scale = (1 if way == "all" else RAYS**0.5) / mean
    return of_interval(statistics.Interval(*(scale * end for end in found)), "%")


def _time(run: Run, way: str, lamps: int) -> Quantity:
    """Time of a pixel [µs] for one ray, or one to each lamp: the median of the pictures.

    Less what makes the lamps ready, as all ways do.
    """
    images, scene = run.images(f"{way}-{lamps}"), run.scene(builtin("many-lights", lights=lamps))
    rays = images[0].width * images[0].height * (1 if way == "all" else RAYS)
    seconds = of_rays(images, scene, estimator="area", lights=way)
    return median_of([1e6 * each / rays for each in seconds], "µs")


def _cost(noise: Quantity, time: Quantity) -> Quantity:
    """Time of a pixel for a noise of 10 %: of so many whole rays, or passes over all lamps, at least of one."""
    value, low, high = (max(1.0, math.ceil((x / NOISE) ** 2)) for x in (noise.value, *noise.interval))
    return times(time, of_interval(statistics.Interval(value, low, high)), "µs")


def forecast(found: Mapping[str, Quantity], lamps: int) -> float:
    """`cost-all-…` beyond what is measured: time in proportion to the lamps, noise as with the most that are asked."""
    return found[f"cost-all-{MOST}"].value * lamps / MOST


def _points(run: Run, how: str) -> Quantity:
    """Variance of one ray under 1000 points over its closed form."""
    scene, estimates, rays = run.scene(point_lights(1000)), run.pick(Pick(1 << 14, 1 << 17)), 16
    found = scene.irradiance(
        np.zeros((estimates, 3)), (0.0, 1.0, 0.0), shadow_rays=rays, lights=how, sampler="random",
        seed=run.seeded(0),
    )  # fmt: skip
    groups = np.asarray(found, np.float64)[:, 1].reshape(32, -1)
    return ratio(mean_of(rays * groups.var(1, ddof=1)), Quantity(VARIANCES[how]))


def of_lamps(run: Run) -> dict[str, Quantity]:
    """What a ray to one of many lamps, or to each, is worth.

    `noise-way-k` of one ray (or one to each of k lamps), `time-way-k` of it [µs a pixel], `cost-way-k`: time for a
    noise of 10 %; `alike` and `chosen`: rays to lamps drawn alike, and by contribution, with the noise of one to each
    of 1000, the first in thousands; `traced`: rays of a pixel that one to each of 1000 makes, none to lamps below the
    horizon; `same`: mean by contribution over that by all;
    `closed`: variance under 1000 points over its closed form, alike or by power, that which is farther off.
    """
    found: dict[str, Quantity] = {}
    for way in WAYS:
        for k in measured(run, way):
            noise, time = _noise(run, way, k), _time(run, way, k)
            found |= {f"noise-{way}-{k}": noise, f"time-{way}-{k}": time}
            found[f"cost-{way}-{k}"] = _cost(noise, time)
    each = found[f"noise-all-{MOST}"]
    alike, chosen = (
        squared(ratio(found[f"noise-{way}-{MOST}"], each)) for way in ("uniform", "contribution")
    )
    found |= {"alike": times(alike, Quantity(1e-3), "thousand"), "chosen": chosen}
    means: list[Any] = [mean_of(lit(run, f"{way}-{MOST}").mean((1, 2))) for way in ("contribution", "all")]
    images = run.images(f"all-{MOST}")
    traced = np.mean([image.shadow_rays / (image.width * image.height) for image in images])
    return found | {
        "traced": Quantity(float(traced)),
        "same": ratio(*means),
        "closed": farthest_from_one(_points(run, how) for how in VARIANCES),
    }
