"""How a pixel's rays are split into viewing rays and shadow rays: bias, noise, and the split that theory advises.

σ_p²: variance over the pixel of its exact radiance; σ_s²: mean variance of one shadow ray. With V viewing rays and N
shadow rays each the variance is (σ_p² + σ_s²/N) / V, and V (c_v + N c_s) is what they cost (CF38). Functions named …_of
take arrays: luminances of K replicates, (K, H, W).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.maps import box_mean
from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.ratio import farthest_from_one, ratio, scaled
from antumbra.lecture.measures.replicates import median_of, of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.study import statistics
from antumbra.study.statistics import Interval

RAYS = 200
# Viewing rays; each has RAYS / V − 1 shadow rays.
VIEWING = [100, 50, 40, 25, 20, 10, 8, 5, 4, 2, 1]
# Of pictures so wide [pixels]: left, top, width, height.
WIDTH, CROPS = 240, {"edge": (72, 76, 20, 20), "penumbra": (206, 138, 20, 20)}
# Shadow rays of the pictures "place-…", whose noise is that of the place in the pixel.
MANY = 64
_CALLS = 7


class Scatter(NamedTuple):
    """Estimates of σ_p² and σ_s² [W²·m⁻⁴·sr⁻²], of each pixel by each replicate, (K, H, W): their means count."""

    place: NDArray[np.float64]
    light: NDArray[np.float64]

    def variance(self, viewing: float, shadow: float) -> Interval:
        """Mean over the pixels with so many viewing rays and shadow rays each."""
        return statistics.mean((self.place + self.light / shadow) / viewing)

    def advised(self, cost: float = 1.0) -> float:
        """N* for these pixels together, `cost` being c_v / c_s; infinite where only the light scatters."""
        place, light = (max(float(each.mean()), 0.0) for each in self)
        return math.sqrt(max(cost, 0.0) * light / place) if place else math.inf


def scatter_of(one: NDArray[np.float64], place: NDArray[np.float64], many: int) -> Scatter:
    """From one viewing ray with one shadow ray, and with `many` of which the first is the same.

    The mean square of their difference is σ_s² (1 − 1/many). The variance of the second is σ_p² + σ_s²/many, by each
    replicate as the jackknife has it.
    """
    light = (one - place) ** 2 / (1 - 1 / many)
    return Scatter(statistics.variance_pseudo_values(place) - light / many, light)


def scatter(run: Run, where: str) -> Scatter:
    """Of the variants one-… and place-…: one viewing ray with one shadow ray or `MANY`."""
    return scatter_of(luminances(run, f"one-{where}"), luminances(run, f"place-{where}"), MANY)


def advised_map(run: Run, faint: float, cost: float = 1.0) -> NDArray[np.float64]:
    """N* of each pixel, over 3 × 3 of them; NaN where one ray scatters less than `faint` [W·m⁻²·sr⁻¹]."""
    place, light = (np.maximum(box_mean(each.mean(0), 1), 0.0) for each in scatter(run, "all"))
    with np.errstate(divide="ignore", invalid="ignore"):
        found: NDArray[np.float64] = np.sqrt(max(cost, 0.0) * light / place)
    return np.where(place + light > faint**2, found, np.nan)


def mse_of(each: NDArray[np.float64], truth: NDArray[np.float64]) -> Interval:
    """Mean squared error of one replicate against the mean of `truth`, whose own noise is taken off."""
    own = truth.var(0, ddof=1) / len(truth)
    squares = statistics.squared_errors(each, truth.mean(0), own)
    return statistics.mse_of(squares, own_half=statistics.reference_half(each, truth))


def square_bias_of(each: NDArray[np.float64], truth: NDArray[np.float64]) -> Interval:
    """Mean square of the bias: errors of two replicates that have no noise in common but the truth's, multiplied."""
    off, own = each - truth.mean(0), float((truth.var(0, ddof=1) / len(truth)).mean())
    products = (off[::2] * off[1::2]).mean((1, 2)) - own
    return statistics.mse_of(products, own_half=statistics.reference_half(each, truth))


def key_of(viewing: int) -> str:
    """Of the variant with so many viewing rays and `RAYS` rays in all."""
    return f"{viewing}x{RAYS // viewing - 1}"


def measured(run: Run, white: float) -> dict[str, Quantity]:
    """By crop: noise-KEY-CROP, error-KEY-CROP and bias-KEY-CROP over `white`; `edge`: the error of 1 × 199 through the
    centre over that of 100 × 1; `penumbra`: the error of 100 × 1 over that of it; `more`: its bias over that with 100
    shadow rays; `law`: measured variance over (σ_p² + σ_s²/N) / V, of all splits that which may be farthest from 1.
    """
    found: dict[str, Quantity] = {}
    laws = []

    def shown(square: Interval) -> Quantity:
        return scaled(of_interval(statistics.root(square)), 1 / white, "%")

    for where in CROPS:
        of, truth = scatter(run, where), luminances(run, f"truth-{where}")
        for key in [*map(key_of, VIEWING), "centre100", f"centre{RAYS - 1}"]:
            each = luminances(run, f"{key}-{where}")
            found[f"noise-{key}-{where}"] = shown(statistics.variance(each))
            found[f"error-{key}-{where}"] = shown(mse_of(each, truth))
            if key in (key_of(100), "centre100", f"centre{RAYS - 1}"):
                found[f"bias-{key}-{where}"] = shown(square_bias_of(each, truth))
        for v in VIEWING:
            seen = statistics.variance(luminances(run, f"{key_of(v)}-{where}"))
            laws.append(of_interval(statistics.ratio(seen, of.variance(v, RAYS / v - 1))))
    many, centred = key_of(100), f"centre{RAYS - 1}"
    return found | {
        "edge": ratio(found[f"error-{centred}-edge"], found[f"error-{many}-edge"]),
        "penumbra": ratio(found[f"error-{many}-penumbra"], found[f"error-{centred}-penumbra"]),
        "more": ratio(found[f"bias-{centred}-edge"], found["bias-centre100-edge"]),
        "law": farthest_from_one(laws),
    }


def cost(run: Run, options: dict[str, Any], count: int = 50) -> Quantity:
    """c_v / c_s by the clock: time of `count` × 1 over that of 1 × `count`, in turn."""
    scene, look = run.scene(builtin("pillars")), {n: run.pick(v) for n, v in options.items()}
    ways: Sequence[dict[str, Any]] = (
        {"viewing_rays": count, "shadow_rays": 1}, {"viewing_rays": 1, "shadow_rays": count},
    )  # fmt: skip
    taken = [[scene.render(**look, **way, seed=n).seconds for way in ways] for n in range(_CALLS)]
    over = np.divide(*np.array(taken).T)
    return median_of(count * (over - 1) / (count - over), note=f"median of {_CALLS} pictures in turn")
