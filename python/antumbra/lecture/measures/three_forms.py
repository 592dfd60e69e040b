"""Three forms of one integral, sampled at the middle of the floor of the low room: how they scatter, what they cost."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import antumbra as am
from antumbra.lecture.measures.maps import box_mean
from antumbra.lecture.measures.one_sample import Samples, moments_of_light_points, one_sample
from antumbra.lecture.measures.ratio import ratio
from antumbra.lecture.measures.replicates import mean_of, median_of
from antumbra.lecture.quantity import Quantity
from antumbra.lecture.run import Run
from antumbra.lecture.scenes import low_room
from antumbra.lecture.scenes.square_lights import square_light
from antumbra.lecture.variant import Pick

# What is sampled, and the options of `render` that do it.
FORMS = {"hemisphere": "directions", "surfaces": "all surfaces", "area": "the light"}
ONE: dict[str, dict[str, Any]] = {
    "hemisphere": {"estimator": "hemisphere", "directions": "cosine"},
    "surfaces": {"estimator": "surfaces"},
    "area": {"estimator": "area", "light_points": "area"},
}
# Between these both variances are the same; a line through their logarithms is 0.005 % off there.
CROSSING = (1.4, 1.5)
# The edge of the light that reaches a corner, and how far from that edge the wall is looked at [m].
_EDGE = 4.0
DISTANCES = (0.1, 0.2, 0.3, 0.4, 0.6, 0.8)


def at_the_middle(run: Run, ratios: Sequence[float]) -> dict[str, Quantity]:
    """Variances in units of E² (`form`-`ratio`), shares of samples that bring light (share-…), and what follows.

    even: where points of the light and directions scatter alike; surfaces, areas: mean square of all surfaces over
    that of the light, and their areas; time-…: of one sample, the light being 1; corner-…: `near_a_corner`.
    """
    samples = {
        (form, at): _samples(run, form, at, stream) for stream, at in enumerate(ratios) for form in FORMS
    }
    light, everything = low_room.areas(1.0)
    found = {
        "even": _even(samples),
        "surfaces": ratio(samples["surfaces", 1.0].moment, samples["area", 1.0].moment),
        "areas": Quantity(everything / light),
    }
    for (form, at), each in samples.items():
        # Of E / L_e, in units of its square: the light has the radiance 1 / ratio².
        scale = (at**2 / (np.pi * low_room.filled(at))) ** 2
        found[f"{form}-{at}"] = mean_of(scale * each.variances)
        found[f"share-{form}-{at}"] = each.share
    for form in FORMS:
        # Of each size of the light once: what the machine does besides meets all forms alike.
        cost = [samples[form, at].seconds / samples["area", at].seconds for at in ratios]
        found[f"time-{form}"] = median_of(cost, "", "of the time of a point of the light")
    return found | near_a_corner(run)


def near_a_corner(run: Run) -> dict[str, Quantity]:
    """Mean square of a point of a light that reaches a corner, its radiance 1, from `DISTANCES`; and its slope.

    corner-directions-…: that of a direction.
    """
    scene, side = am.Scene("corner"), run.pick(Pick(128, 512))
    scene.add_light(square_light(_EDGE, 0.0))
    places, normal = [(_EDGE / 2, -d, 0.0) for d in DISTANCES], (-1.0, 0.0, 0.0)
    moments = [moments_of_light_points(scene, place, normal, side, run.seeded(1)) for place in places]
    directions = [
        one_sample(scene, place, side**2, run.seeded(2), normal, **ONE["hemisphere"]).moment
        for place in places
    ]
    found = {f"corner-{d}": mean_of(each) for d, each in zip(DISTANCES, moments, strict=True)}
    found |= {f"corner-directions-{d}": each for d, each in zip(DISTANCES, directions, strict=True)}
    return found | {"corner": mean_of(np.polyfit(np.log(DISTANCES), np.log(moments), 1)[0])}


def exact_near_a_corner(form: str, distance: ArrayLike) -> NDArray[np.float64]:
    """Mean squares there, of a light of radiance 1.

    Of a light point A ∫ (cos θ cos θ′ / r²)² dA, which is A π / (24 d²) for distances d far below the light's edge; of
    a direction π² times the part of the hemisphere that the light fills, counted with cos θ.
    """
    d = np.asarray(distance, np.float64)
    if form == "area":
        return _EDGE**2 * np.pi / (24 * d**2)
    far = np.hypot(d, _EDGE)
    filled = (np.arctan(_EDGE / 2 / d) - d / far * np.arctan(_EDGE / 2 / far)) / np.pi
    return np.asarray(np.pi**2 * filled)


def scatter(run: Run, form: str, at: float, rays: int) -> NDArray[np.float64]:
    """Variance of one sample at each pixel of a picture of `rays` of them, a mean over 5 × 5 pixels."""
    error = run.image(f"{form}-{at}").standard_error
    assert error is not None
    return box_mean(error[..., 1].astype(np.float64) ** 2 * rays, 2)


def exact(form: str, at: ArrayLike) -> NDArray[np.float64]:
    """The closed forms: variance of one sample over E², for radii of the light over the height."""

    def one(r: float) -> float:
        light, everything = low_room.areas(r)
        mean, points = np.pi * low_room.filled(r), low_room.variance_of_points(r)
        if form == "hemisphere":
            return float(low_room.variance_of_directions(r) / mean**2)
        return float((everything / light if form == "surfaces" else 1.0) * (points / mean**2 + 1) - 1)

    return np.array([one(float(r)) for r in np.atleast_1d(at)])


def _samples(run: Run, form: str, at: float, stream: int) -> Samples:
    close = at in CROSSING if form != "surfaces" else at == 1.0
    count = run.pick(Pick(2**17, 2**20) if close else Pick(2**14, 2**18))
    scene = run.scene(low_room.low_room(at))
    return one_sample(scene, (0.0, 0.0, 0.0), count, run.seeded(stream), **ONE[form])


def _even(samples: Mapping[tuple[str, float], Samples]) -> Quantity:
    """The share of the hemisphere, by a line through ln of the ratio of the variances in each group."""
    over = np.log([samples["area", r].variances / samples["hemisphere", r].variances for r in CROSSING])
    slope, height = np.polyfit(np.log(CROSSING), over, 1)
    note = "R² / (R² + h²) where both variances are the same"
    return mean_of(1 / (1 + np.exp(2 * height / slope)), "%", note)
