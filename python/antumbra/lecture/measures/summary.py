"""What every technique takes for one picture: rays, time, error, and what follows of them."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from antumbra.lecture.measures.noise import of_lit_pixels
from antumbra.lecture.measures.ratio import farthest_from_one, ratio, squared, times
from antumbra.lecture.measures.replicates import mean_of, median_of, of_interval
from antumbra.lecture.measures.seconds import of_rays
from antumbra.lecture.measures.slopes import Errors
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import two_windows
from antumbra.lecture.scenes.lone_lights import ABOVE, alone
from antumbra.lecture.scenes.square_lights import irradiance_under
from antumbra.lecture.variant import Pick
from antumbra.study import statistics


class Way(NamedTuple):
    """A technique: its name, the options of `render` that make it, and how many samples a shadow ray of these means.

    `fixed`: it has no random numbers, so that its error is not seen in the scatter of replicates.
    """

    name: str
    options: dict[str, Any]
    samples: int = 1
    fixed: bool = False

    def of(self, count: int) -> dict[str, Any]:
        """The options for so many samples a pixel."""
        return self.options | {"shadow_rays": count // self.samples}


_DIRECTIONS: dict[str, Any] = {"estimator": "hemisphere"}
_LIGHTS: dict[str, Any] = {"estimator": "area"}
_CHOSEN = _LIGHTS | {"lights": "contribution"}
WAYS: dict[str, Way] = {
    "even": Way("directions", _DIRECTIONS | {"directions": "uniform"}),
    "cosine": Way("by cosine", _DIRECTIONS | {"directions": "cosine"}),
    "surfaces": Way("all surfaces", {"estimator": "surfaces"}),
    "area": Way("light points", _LIGHTS | {"lights": "uniform", "light_points": "area"}),
    "angle": Way("solid angle", _LIGHTS | {"lights": "uniform"}),
    "mis": Way("MIS", _CHOSEN | {"estimator": "mis"}, 2),
    "power": Way("by power", _LIGHTS | {"lights": "power"}),
    "chosen": Way("contribution", _CHOSEN),
    "regular": Way("regular", _CHOSEN | {"sampler": "regular"}, fixed=True),
    "turned": Way("regular, turned", _CHOSEN | {"sampler": "regular", "rotate": True}),
    "owen": Way("owen", _CHOSEN | {"sampler": "owen"}),
    "stratified": Way("stratified", _CHOSEN | {"sampler": "stratified"}),
    "each": Way("each light", _LIGHTS | {"lights": "all"}, 2),
    "best": Way("each, owen", _LIGHTS | {"lights": "all", "sampler": "owen"}, 2),
}
FIRST, BEST = "even", "best"
# Ways that draw directions or all surfaces alike, and hardly meet a light: their means are less well known.
DIRECTIONS = ("even", "cosine", "surfaces")
# Samples of a pixel; the last is compared.
COUNTS = [4, 16, 64]
SAMPLES = COUNTS[-1]
# Options whose variance under a lone square light is known.
SQUARE: dict[str, dict[str, Any]] = {
    "even": {"estimator": "hemisphere", "directions": "uniform"},
    "cosine": {"estimator": "hemisphere", "directions": "cosine"},
    "area": {"estimator": "area", "light_points": "area"},
    "angle": {"estimator": "area", "light_points": "solid-angle"},
}


def of_square() -> dict[str, float]:
    """Variance of one sample [W² m⁻⁴] under a square light of edge 2 at height 1, L_e = 1, in closed form.

    Those of points by quadrature (CF36); those of directions by E[X²] = π E, and 2π ∫ cos² θ dω over the light.
    """
    points, angles, omega = 0.7736671199708, 0.04390754223785, 2 * math.pi / 3
    light = irradiance_under(2.0, 1.0)
    square = (angles + light**2) / omega
    return {
        "even": 2 * math.pi * square - light**2,
        "cosine": math.pi * light - light**2,
        "area": points,
        "angle": angles,
    }


def compared(run: Run) -> Errors:
    """The errors of all techniques at all counts."""
    errors: Errors = run.once("errors", lambda: Errors(run, dict.fromkeys(WAYS, COUNTS)))
    return errors


def _of_way(run: Run, way: str) -> dict[str, Quantity]:
    """What 64 samples take and give.

    `rays` that are traced and `time` [µs] of a pixel; `error`: scatter of the replicates over the mean, for which no
    truth is judge in its own cause (of a fixed way, what it is off the truth); `mse`: its square; `mean` over that of
    the truth.
    """
    key = f"{way}-{SAMPLES}"
    images, (each, truth) = run.images(key), of_lit_pixels(run, key, "truth")
    pixels = images[0].width * images[0].height
    root = compared(run).rmse(way, SAMPLES) if WAYS[way].fixed else statistics.root(statistics.variance(each))
    return {
        "rays": Quantity(float(np.mean([image.rays + image.shadow_rays for image in images])) / pixels),
        "time": median_of([1e6 * seconds / pixels for seconds in _seconds(run, way)], "µs"),
        "error": of_interval(statistics.Interval(*(end / truth.mean() for end in root)), "%"),
        "mse": squared(of_interval(root)),
        "mean": ratio(mean_of(each.mean(1)), mean_of(truth.mean(1))),
    }


def _seconds(run: Run, way: str) -> list[float]:
    return of_rays(run.images(f"{way}-{SAMPLES}"), run.scene(two_windows()), **WAYS[way].of(SAMPLES))


def _square(run: Run, k: int, way: str) -> Quantity:
    """Variance of one sample under the square light over its closed form."""
    rays, estimates = 16, run.pick(Pick(1 << 14, 1 << 16))
    found = run.scene(alone(ABOVE)).irradiance(
        np.zeros((estimates, 3)), (0.0, 1.0, 0.0), shadow_rays=rays, sampler="random", seed=run.seeded(k), **SQUARE[way]
    )  # fmt: skip
    groups = np.asarray(found, np.float64)[:, 1].reshape(32, -1)
    return ratio(mean_of(rays * groups.var(1, ddof=1)), Quantity(of_square()[way]))


def of_ways(run: Run) -> dict[str, Quantity]:
    """What each way takes, and what it gives for it.

    `what-way` as `_of_way` has it; `sample-way`, `second-way`: 1/(mse · samples) and 1/(mse · time) over those of
    directions drawn evenly; `fewer`: the first of the best way, in thousands; `off-points`: of the techniques that draw
    points of lights, the mean that is farthest from the truth's, over that; `off-directions`: of the others; `square`:
    variance under a lone square over its closed form, of four ways that which is farthest off.
    """
    found = {f"{what}-{way}": q for way in WAYS for what, q in _of_way(run, way).items()}
    first = found[f"mse-{FIRST}"], found[f"time-{FIRST}"]
    for way in WAYS:
        mse, time = found[f"mse-{way}"], found[f"time-{way}"]
        found[f"sample-{way}"] = ratio(first[0], mse) if way != FIRST else Quantity(1.0)
        found[f"second-{way}"] = ratio(times(*first), times(mse, time)) if way != FIRST else Quantity(1.0)
    groups = {"directions": DIRECTIONS, "points": [way for way in WAYS if way not in DIRECTIONS]}
    off = {
        f"off-{name}": farthest_from_one(found[f"mean-{way}"] for way in ways)
        for name, ways in groups.items()
    }
    square = {"square": farthest_from_one(_square(run, k, way) for k, way in enumerate(SQUARE))}
    return found | off | square | {"fewer": times(found[f"sample-{BEST}"], Quantity(1e-3), "thousand")}
