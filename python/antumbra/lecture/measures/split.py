"""How a pixel's rays are split into viewing rays and shadow rays: bias, noise, and the split that theory advises.

σ_p²: variance over the pixel of its exact radiance; σ_s²: mean variance of one shadow ray. With V viewing rays and N
shadow rays each the variance is (σ_p² + σ_s²/N) / V, and V (c_v + N c_s) is what they cost (CF38).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from antumbra.lecture.measures.maps import box_mean
from antumbra.lecture.measures.noise import luminances
from antumbra.lecture.measures.ratio import ratio
from antumbra.lecture.measures.replicates import mean_of, median_of, of_interval
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import builtin
from antumbra.study import statistics

RAYS = 200
# Viewing rays; each has RAYS / V − 1 shadow rays.
VIEWING = [100, 50, 40, 25, 20, 10, 8, 5, 4, 2, 1]
# Of pictures so wide [pixels]: left, top, width, height.
WIDTH, CROPS = 240, {"edge": (72, 76, 20, 20), "penumbra": (206, 138, 20, 20)}
# Shadow rays of the pictures "place-…", whose noise is that of the place in the pixel.
MANY = 64
_CALLS = 7


class Scatter(NamedTuple):
    """σ_p² and σ_s² [W²·m⁻⁴·sr⁻²] of each pixel, (H, W)."""

    place: NDArray[np.float64]
    light: NDArray[np.float64]

    def variance(self, viewing: float, shadow: float) -> float:
        """Mean over the pixels with so many viewing rays and shadow rays each."""
        return float((self.place.mean() + self.light.mean() / shadow) / viewing)

    @property
    def advised(self) -> float:
        """N* where both kinds of ray cost the same, for these pixels together."""
        return math.sqrt(max(self.light.mean(), 0.0) / self.place.mean())


def scatter(run: Run, where: str) -> Scatter:
    """Of the variants one-… and place-…: one viewing ray with one shadow ray or `MANY`.

    Viewing ray and first shadow ray are the same in both: the mean square of their difference is σ_s² (1 − 1/`MANY`).
    """
    one, place = luminances(run, f"one-{where}"), luminances(run, f"place-{where}")
    light = ((one - place) ** 2).mean(0) / (1 - 1 / MANY)
    return Scatter(place.var(0, ddof=1) - light / MANY, light)


def advised_map(run: Run, faint: float) -> NDArray[np.float64]:
    """N* of each pixel, over 3 × 3 of them; NaN where one ray scatters less than `faint` [W·m⁻²·sr⁻¹]."""
    of = scatter(run, "all")
    place, light = (np.maximum(box_mean(each, 1), 0.0) for each in of)
    with np.errstate(divide="ignore", invalid="ignore"):
        found: NDArray[np.float64] = np.sqrt(light / place)
    return np.where(place + light > faint**2, found, np.nan)


def _mse(run: Run, key: str, where: str) -> Quantity:
    """Mean squared error of one picture against the truth, whose own noise is taken off."""
    each, truth = luminances(run, f"{key}-{where}"), luminances(run, f"truth-{where}")
    own = truth.var(0, ddof=1) / len(truth)
    return of_interval(
        statistics.mse_of(
            statistics.squared_errors(each, truth.mean(0), own),
            own_half=statistics.reference_half(each, truth),
        )
    )


def _bias(run: Run, key: str, where: str) -> Quantity:
    """Root of the mean square of the bias: errors of two replicates that have no noise in common, multiplied."""
    each, truth = luminances(run, f"{key}-{where}"), luminances(run, f"truth-{where}")
    off, own = each - truth.mean(0), float((truth.var(0, ddof=1) / len(truth)).mean())
    products = (off[::2] * off[1::2]).mean((1, 2)) - own
    return of_interval(statistics.root(statistics.mean(products)))


def _root(of: Quantity) -> Quantity:
    return of_interval(statistics.root(statistics.Interval(of.value, *of.interval)))


def key_of(viewing: int) -> str:
    """Of the variant with so many viewing rays and `RAYS` rays in all."""
    return f"{viewing}x{RAYS // viewing - 1}"


def measured(run: Run, white: float) -> dict[str, Quantity]:
    """By crop: noise-KEY-CROP, error-KEY-CROP and bias-KEY-CROP over `white`; `edge`: the error of 1 × 199 through the
    centre over that of 100 × 1; `penumbra`: the noise of 100 × 1 over that of it; `more`: its bias over that with 100
    shadow rays; `law`: measured variance over (σ_p² + σ_s²/N) / V, mean of all splits.
    """
    found: dict[str, Quantity] = {}
    share = Quantity(white)
    laws = []
    for where in CROPS:
        of = scatter(run, where)
        for key in [*map(key_of, VIEWING), "centre100", f"centre{RAYS - 1}"]:
            noise = of_interval(statistics.root(statistics.variance(luminances(run, f"{key}-{where}"))))
            found[f"noise-{key}-{where}"] = ratio(noise, share, "%")
            found[f"error-{key}-{where}"] = ratio(_root(_mse(run, key, where)), share, "%")
        for key in (key_of(100), "centre100", f"centre{RAYS - 1}"):
            bias = _bias(run, key, where)
            found[f"bias-{key}-{where}"] = (
                ratio(bias, share, "%") if bias.value else Quantity(0.0, bias.interval[1] / white, "%")
            )
        laws += [
            found[f"noise-{key_of(v)}-{where}"].value ** 2 * white**2 / of.variance(v, RAYS / v - 1)
            for v in VIEWING
        ]
    many, centred = key_of(100), f"centre{RAYS - 1}"
    return found | {
        "edge": ratio(found[f"error-{centred}-edge"], found[f"error-{many}-edge"]),
        "penumbra": ratio(found[f"noise-{many}-penumbra"], found[f"noise-{centred}-penumbra"]),
        "more": ratio(found[f"bias-{centred}-edge"], found["bias-centre100-edge"]),
        "law": mean_of(laws),
    }


def cost(run: Run, options: dict[str, Any], count: int = 50) -> Quantity:
    """c_v / c_s by the clock: time of `count` × 1 over that of 1 × `count`, in turn."""
    scene, look = run.scene(builtin("pillars")), {n: run.pick(v) for n, v in options.items()}
    ways: Sequence[dict[str, Any]] = (
        {"viewing_rays": count, "shadow_rays": 1}, {"viewing_rays": 1, "shadow_rays": count},
    )  # fmt: skip
    taken = [[scene.render(**look, **way, seed=n).seconds for way in ways] for n in range(_CALLS)]
    over = np.divide(*np.array(taken).T)
    return median_of(
        count * (over - 1) / (count - over), note=f"median and range of {_CALLS} pictures in turn"
    )
